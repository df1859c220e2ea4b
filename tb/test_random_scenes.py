# SPDX-License-Identifier: Apache-2.0
"""Random scenes of every type against float64 roots: cameras inside and outside, any placement, clip boxes."""

import random

import numpy as np
import pytest

from raydix.accuracy import depth_errors
from raydix.chords_spiral import random_spiral
from raydix.config import Config
from raydix.oracle import ideal_frame, ideal_hits
from raydix.render import render_golden
from raydix.scene import load_scene

CLOSED = ("sphere", "ellipsoid", "torus", "cyclide", "spiral")
WIDTH, HEIGHT = 96, 72
SCENES_PER_TYPE = 8


def keys(kind, uniform):
    """Random parameters of a surface type."""

    def ten():
        return [uniform(-1, 1) for _ in range(10)]

    if kind == "spiral":
        shape = random_spiral(random.Random(uniform(0, 1)))
        return {key: getattr(shape, key) for key in ("R", "r", "pitch", "turns", "R_growth", "r_growth")}
    a = uniform(0.5, 1.5)
    return {
        "plane": {},
        "sphere": {"R": uniform(0.3, 2)},
        "ellipsoid": {k: uniform(0.3, 2) for k in "abc"},
        "cylinder": {"R": uniform(0.2, 1)},
        "cone": {"k": uniform(0.2, 2)},
        "paraboloid": {k: uniform(0.3, 1) for k in "ab"},
        "hyperbolic_paraboloid": {k: uniform(0.3, 1) for k in "ab"},
        "hyperboloid_one_sheet": {k: uniform(0.3, 1) for k in "abc"},
        "hyperboloid_two_sheet": {k: uniform(0.3, 1) for k in "abc"},
        "quadric": {"coefficients": ten()},
        "torus": {"R": uniform(0.3, 1.5), "r": uniform(0.05, 1)},
        "cyclide": {"a": a, "b": uniform(0.3, 1) * a, "d": uniform(0.1, 1)},
        "quartic": {"Q1": ten(), "Q2": ten(), "Q3": ten()},
    }[kind]


TYPES = tuple(
    [
        "plane",
        "sphere",
        "ellipsoid",
        "cylinder",
        "cone",
        "paraboloid",
        "hyperbolic_paraboloid",
        "hyperboloid_one_sheet",
        "hyperboloid_two_sheet",
        "quadric",
        "torus",
        "cyclide",
        "quartic",
        "spiral",
    ]
)


def scene_text(kind, dice):
    """A random camera on one random surface near it; sizes over four decades, one camera in four within the surface."""
    uniform = dice.uniform
    scale = 10 ** uniform(-2, 2)
    center = [uniform(-1, 1) * scale for _ in range(3)]
    away = np.array([dice.gauss(0, 1) for _ in range(3)])
    away *= (uniform(0.05, 1) if dice.random() < 0.25 else uniform(3, 8)) / np.linalg.norm(away)
    lines = [
        "[camera]",
        f"eye = {[float(c + scale * x) for c, x in zip(center, away, strict=True)]}",
        f"look_at = {[c + scale * uniform(-0.3, 0.3) for c in center]}",
        f"up = {[uniform(-1, 1) for _ in range(3)]}",
        f"vfov = {uniform(15, 100)}",
        f"width = {WIDTH}",
        f"height = {HEIGHT}",
        "[[surface]]",
        f'type = "{kind}"',
        f"center = {center}",
        f"axis = {[uniform(-1, 1) for _ in range(3)]}",
        f"angle = {uniform(-180, 180)}",
        f"scale = {scale}",
        f"opacity = {dice.choice([1.0, 0.5])}",
    ]
    lines += [f"{key} = {value}" for key, value in keys(kind, uniform).items()]
    if kind not in CLOSED or dice.random() < 0.4:
        box = [[uniform(-1.5, -0.1) for _ in range(3)], [uniform(0.1, 1.5) for _ in range(3)]]
        lines.append(f"clip = {box}")
    return "\n".join(lines)


@pytest.mark.parametrize("kind", TYPES)
def test_random_scenes(kind, tmp_path):
    """As many roots on every ray as in float64, and a depth error of at most 2 ulp away from tangency, 64 near it.

    Rays within 1e-6 of losing a root (tangent, or on an edge of the clip box) are left out of the count.
    """
    dice = random.Random(f"scenes of {kind}")
    hits = 0
    for number in range(SCENES_PER_TYPE):
        path = tmp_path / f"{kind}-{number}.toml"
        path.write_text(scene_text(kind, dice))
        scene = load_scene(path)
        frame = render_golden(scene, Config(vecsum="general"), 1)
        ideal = ideal_hits(scene, 0)
        count = np.zeros((HEIGHT, WIDTH), int)
        for found in frame.hits.surfaces:
            x0, y0, x1, y1 = found.surface.rect
            count[y0 : y1 + 1, x0 : x1 + 1] = (found.t >= 0).sum(axis=2)
        wanted = ideal.count if scene.surfaces[0].opacity < 1 else np.minimum(ideal.count, 1)
        wrong = (count != wanted) & (ideal.clearance > 1e-6)
        assert not wrong.any(), f"{path.read_text()}\npixels (y, x): {np.argwhere(wrong)[:5].tolist()}"
        reference = ideal_frame(scene)
        errors = depth_errors(frame, reference)
        hits += errors.hit
        if errors.hit:
            assert errors.ulp_max < 64, path.read_text()
            clear = np.isfinite(frame.depth) & np.isfinite(reference.depth) & (ideal.clearance > 1e-2)
            off = np.abs(frame.depth[clear] - reference.depth[clear])
            assert off.max(initial=0) < 2 * np.nanmax(frame.ulp), path.read_text()
    assert hits > 500
