# SPDX-License-Identifier: Apache-2.0
"""The intersection engines on a scene: clocks by simulation, error, and the time at the clock that they were placed at.

The engines are design points of `scripts/explore.py`; their clocks in MHz are those kept in docs/exploration.json.
"""

import json
from contextlib import suppress
from pathlib import Path

from exploration.designs import Design
from exploration.measure import checked
from picture_error import depth_errors
from raydix.compile import compile_scene
from raydix.oracle import ideal_frame
from raydix.scene import Scene, SceneError
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
    """Clocks in MHz of the engines that were placed. Raises RuntimeError where there are none yet."""
    if not PLACED.exists():
        raise RuntimeError(f"{PLACED}: found no file; allowed: the results of make explore ARGS=--write")
    return {Design(**result["design"]): result["fmax"] for result in json.loads(PLACED.read_text()) if "fmax" in result}


def engines_for(scene: Scene) -> dict[Design, float]:
    """The placed engines that can do a scene of one surface with the certified rule and all digits."""
    found = {}
    for design, fmax in placed().items():
        wanted = design.family == family(scene) and design.rules == "certified" and design.units == 1
        if wanted and design.n1 * design.steps == 24 and design.width == Design("quadric").width:
            with suppress(SceneError):  # it has no boxes, or not every spiral
                compile_scene(scene, design.config)
                found[design] = fmax
    return found


def clocks(scene: Scene) -> list[list[str]]:
    """A row for each engine, simulated as it was placed. Raises RuntimeError where RTL and golden model differ."""
    ideal = ideal_frame(scene).depth
    rows = []
    for design, fmax in engines_for(scene).items():
        hits = checked(design, compile_scene(scene, design.config), design.config)
        errors = depth_errors(compose(scene, hits, design.config, design.config.layers).depth, ideal)
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
