# SPDX-License-Identifier: Apache-2.0
"""The intersection engines on a scene: clocks by simulation, error, and the time at the clock that they were placed at.

The engines are design points of `scripts/explore.py`; their clocks in MHz are those kept in docs/exploration.json.
"""

import json
from pathlib import Path

import numpy as np

from exploration.designs import Design
from picture_error import depth_errors
from raydix.compile import compile_scene
from raydix.golden import trace_golden
from raydix.oracle import ideal_frame
from raydix.rtl import trace_rtl
from raydix.scene import Scene
from raydix.shade import compose
from raydix.surfaces import form

PLACED = Path(__file__).resolve().parents[2] / "docs" / "exploration.json"
COLUMNS = (
    "scene",
    "engine",
    "clocks",
    "clocks / pixel",
    "simulated, s",
    "placed, MHz",
    "projected, ms",
    "ns / pixel",
    "error rms",
    "99.9 %",
    "silhouette",
)


def family(scene: Scene) -> str:
    """Which engines a scene of one surface takes."""
    (surface,) = scene.surfaces
    if surface.type == "spiral":
        return "spiral"
    return "quadric" if form(surface).q1 is None else "quartic"


def placed() -> dict[Design, float]:
    """Clocks in MHz of the engines that were placed."""
    return {Design(**result["design"]): result["fmax"] for result in json.loads(PLACED.read_text()) if "fmax" in result}


def clocks(scene: Scene) -> list[list[str]]:
    """A row for each placed engine of the scene's family with the certified rule, one unit or ring, all digits.

    Raises RuntimeError where RTL and golden model differ.
    """
    ideal = ideal_frame(scene).depth
    rows = []
    for design, fmax in placed().items():
        wanted = design.family == family(scene) and design.rules == "certified"
        if not wanted or design.units > 1 or design.n1 * design.steps != 24 or design.width not in (36, 38):
            continue
        config = design.config_for(scene)
        compiled = compile_scene(scene, config)
        hits, its = trace_rtl(compiled, config), trace_golden(compiled, config)
        if not np.array_equal(hits.surfaces[0].t, its.surfaces[0].t):
            raise RuntimeError(f"{scene.name}, {design}: RTL and golden model differ")
        errors = depth_errors(compose(scene, hits, config, config.layers).depth, ideal)
        seconds = hits.cycles / fmax / 1e6
        rows.append(
            [
                scene.name,
                str(design),
                f"{hits.cycles:,}",
                f"{hits.cycles / ideal.size:.3f}",
                f"{hits.seconds:.2f}",
                f"{fmax:.1f}",
                f"{1e3 * seconds:.2f}",
                f"{1e9 * seconds / ideal.size:.1f}",
                f"{errors['rms']:.1e}",
                f"{errors['p999']:.1e}",
                f"{errors['silhouette']}",
            ]
        )
    return rows
