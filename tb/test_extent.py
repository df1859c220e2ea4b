# SPDX-License-Identifier: Apache-2.0
"""Bounds of what is to be seen of a surface: no point of it is outside of them, and they are close."""

import random
from functools import partial
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest

from raydix import compile, extent, spiral
from raydix.compile import PRECISION, camera_of, clip_box, compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.render import render_golden
from raydix.scene import load_scene
from raydix.surfaces import form, value
from test_random_scenes import TYPES, scene_text

SCENES = Path(__file__).resolve().parents[1] / "scenes"
LINES, PLACES = 4000, 65


def placed(scene):
    """Of a scene's first surface: box, and the map of local points to camera coordinates; float64."""
    surface, camera = scene.surfaces[0], camera_of(scene)
    axes = mp.matrix([list(v) for v in (camera.right, camera.up, camera.forward)])
    matrix = axes * mp.matrix(surface.matrix) * surface.scale
    eye = axes * (mp.matrix(surface.center) - camera.eye)
    low, high, _ = clip_box(surface)
    return tuple(np.array(v.tolist(), np.float64).squeeze() for v in (low, high, matrix, eye))


def points_on(surface, low, high, rng):
    """Points of the surface on random lines through its box: where F changes its sign between neighbouring places."""
    f = partial(spiral.value, surface) if surface.type == "spiral" else partial(value, form(surface))
    ends = rng.uniform(low, high, (2, LINES, 3))
    t = np.linspace(0, 1, PLACES)
    points = ends[0, :, None] + t[:, None] * (ends[1] - ends[0])[:, None]
    positive = f(points) > 0
    line, place = np.nonzero(positive[:, 1:] != positive[:, :-1])
    below, above = points[line, place], points[line, place + 1]
    sign = positive[line, place]
    for _ in range(50):
        middle = (below + above) / 2
        same = ((f(middle) > 0) == sign)[:, None]
        below, above = np.where(same, middle, below), np.where(same, above, middle)
    return below


def reach(points, matrix, eye):
    """Extent of points."""
    right, up, depth = (points @ matrix.T + eye).T
    return [(v.min(), v.max()) for v in (right / depth, up / depth, depth)]


@pytest.mark.parametrize("kind", TYPES)
def test_nothing_is_outside(kind, tmp_path):
    """No point that is found on a random surface before the camera is outside of its extent."""
    dice, rng, seen = random.Random(f"extent {kind}"), np.random.default_rng(7), 0
    for _ in range(40):
        (tmp_path / "scene.toml").write_text(scene_text(kind, dice))
        scene = load_scene(tmp_path / "scene.toml", 64, 48)
        low, high, matrix, eye = placed(scene)
        corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
        if (low >= high).any() or (corners @ matrix[2] + eye[2]).min() <= 0:
            continue
        points = points_on(scene.surfaces[0], low, high, rng)
        found = extent.extent(scene.surfaces[0], low, high, matrix, eye)
        if not len(points):
            continue
        assert found is not None
        seen += 1
        for (least, most), (a, b) in zip(found, reach(points, matrix, eye), strict=True):
            assert least - 1e-9 * (b - a) <= a and b <= most + 1e-9 * (b - a)
    assert seen >= 5


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_rectangles_are_close(path):
    """Of a surface that nothing hides, hits reach to within 2 % and three pixels of all sides of its rectangle."""
    scene = load_scene(path, 320, 240)
    frame = trace_golden(compile_scene(scene, Config(**families(scene))), Config(**families(scene)))
    for hits in frame.surfaces:
        hit = hits.t[..., 0] >= 0
        assert hit.any()
        for axis in (0, 1):
            places = np.nonzero(hit.any(1 - axis))[0]
            allowed = 3 + 0.02 * hit.shape[axis]
            assert places[0] <= allowed and hit.shape[axis] - 1 - places[-1] <= allowed


def sphere(center, radius, more=""):
    """A scene of one sphere before a camera at the origin that looks along x, z up."""
    return (
        "[camera]\neye = [0.0, 0.0, 0.0]\nlook_at = [1.0, 0.0, 0.0]\nup = [0.0, 0.0, 1.0]\nvfov = 60.0\nwidth = 64\n"
        "height = 48\n[light]\ndirection = [-0.36, -0.48, 0.80]\nambient = 0.1\n[background]\ncolor = [0.0, 0.0, 0.0]\n"
        f'[[surface]]\ntype = "sphere"\nR = {radius}\ncenter = {center}\ncolor = [1.0, 1.0, 1.0]\n{more}'
    )


def test_of_a_sphere(tmp_path):
    """Tangent of the angle to the tangent plane, in closed form: from outside, closer than 1 %."""
    (tmp_path / "scene.toml").write_text(sphere([5.0, 1.0, 0.0], 1.0))
    scene = load_scene(tmp_path / "scene.toml")
    right, up, depth = extent.extent(scene.surfaces[0], *placed(scene))
    middle, half = np.arctan2(-1, 5), np.arcsin(1 / np.hypot(5, 1))  # y points to the left
    for (least, most), (a, b) in (
        (right, (np.tan(middle - half), np.tan(middle + half))),
        (up, (-np.tan(np.arcsin(1 / 5)), np.tan(np.arcsin(1 / 5)))),
        (depth, (4.0, 6.0)),
    ):
        slack = 0.01 * (b - a)
        assert a - slack < least <= a and b <= most < b + slack


def test_nothing_in_the_box(tmp_path):
    """A surface that is nowhere in its box is out of view; one that touches its corner is not."""
    for corner, seen in ((0.5, False), (0.6, True)):
        # the farthest corner of the box is at corner * sqrt(3) from the centre, the sphere at 1
        (tmp_path / "scene.toml").write_text(sphere([5.0, 0.0, 0.0], 1.0, f"clip = [{[0.0] * 3}, {[corner] * 3}]\n"))
        scene = load_scene(tmp_path / "scene.toml")
        assert bool(compile_scene(scene, Config()).surfaces) == seen


def test_camera_in_the_box(tmp_path):
    """From within the box every pixel is looked at, from the camera on."""
    (tmp_path / "scene.toml").write_text(sphere([0.5, 0.0, 0.0], 1.0))
    scene = load_scene(tmp_path / "scene.toml")
    (surface,) = compile_scene(scene, Config()).surfaces
    assert surface.rect == (0, 0, 63, 47) and surface.near == 0


PLATE = """[camera]
eye = [{0}, {1}, {2}]
look_at = [{0}, {1}, 0.3]
up = [0.0, 1.0, 0.0]
vfov = 20.0
width = 16
height = 12
[[surface]]
type = "plane"
center = [{0}, {1}, 0.3]
clip = [[-{4}, -{4}, -{3}], [{4}, {4}, {3}]]
"""


@pytest.mark.parametrize("offset", [0.1, 0.0])
@pytest.mark.parametrize("distance", [3.0, 10.0, 1e3, 1e6, 1e8])
@pytest.mark.parametrize("half", [1e-7, 1e-4, 1e-2, 1.0])
def test_thin_and_far(half, distance, offset, tmp_path, monkeypatch):
    """A plate that faces the camera has no depth: rounding must not lose it. The same pixels as without bounds."""
    (tmp_path / "scene.toml").write_text(PLATE.format(offset, 2 * offset, distance + 0.3, half, distance / 10))
    scene, hits = load_scene(tmp_path / "scene.toml"), []
    for bound in (extent.extent, lambda *_: extent.Extent(extent.NOWHERE, extent.NOWHERE, extent.NOWHERE)):
        monkeypatch.setattr(compile, "extent", bound)
        frame = render_golden(scene, Config())
        hits.append((frame.surface >= 0).sum())
    assert hits[0] == hits[1] > 20


@pytest.mark.parametrize("distance", [1e2, 1e5, 1e8])
def test_rounding_of_the_projection(distance, tmp_path):
    """The exact depth of a plate that faces the camera is within its bounds, which are a few ulp of it apart."""
    for offset in (0.1, 0.3, 0.7, 1.1):
        (tmp_path / "scene.toml").write_text(PLATE.format(offset, 2 * offset, distance + 0.3, 1.0, distance / 10))
        scene = load_scene(tmp_path / "scene.toml")
        with mp.workprec(PRECISION):
            exact = mp.mpf(distance + 0.3) - mp.mpf(0.3)
        least, most = extent.extent(scene.surfaces[0], *placed(scene)).depth
        assert least < exact < most and most - least < 1e-9 * distance


def test_least_depth(tmp_path):
    """A plate has a segment of 1/256 of the depth of its box, as far as that has room."""
    for half, wanted in ((1.0, 11 / 256), (1e-3, 2e-3)):
        (tmp_path / "scene.toml").write_text(PLATE.format(0.1, 0.2, 10.3, half, 1.0))
        (surface,) = compile_scene(load_scene(tmp_path / "scene.toml"), Config()).surfaces
        assert surface.far - surface.near == pytest.approx(wanted, rel=2e-3)
