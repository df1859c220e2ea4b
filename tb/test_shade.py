# SPDX-License-Identifier: Apache-2.0
"""From hits to colours: order, ties and transparency against values worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from raydix.config import Config
from raydix.render import render_golden
from raydix.scene import Spiral, load_scene
from raydix.shade import compose

HEAD = """
[camera]
eye = [0.0, -5.0, 0.0]
look_at = [0.0, 0.0, 0.0]
vfov = 10.0
width = 5
height = 5
[light]
direction = [0.0, -1.0, 0.0]
ambient = 0.2
[background]
color = [0.1, 0.2, 0.4]
"""


def plane(y, color, opacity=1.0):
    """A square across the view axis, facing the camera and the light, at depth 5 + y."""
    return f"""
[[surface]]
type = "plane"
axis = [1.0, 0.0, 0.0]
angle = 90.0
center = [0.0, {y}, 0.0]
clip = [[-2.0, -2.0, -0.1], [2.0, 2.0, 0.1]]
color = {color}
opacity = {opacity}
"""


def sphere(radius, color, opacity=1.0):
    """A sphere around the origin."""
    return f"""
[[surface]]
type = "sphere"
R = {radius}
color = {color}
opacity = {opacity}
"""


@pytest.fixture
def centre(tmp_path):
    """Renders surfaces and gives linear colour, surface and depth of the middle pixel, whose ray is the view axis."""

    def render(*surfaces, head=HEAD):
        path = tmp_path / "scene.toml"
        path.write_text(head + "".join(surfaces))
        frame = render_golden(load_scene(path), Config())
        return frame.linear[2, 2].astype(float), int(frame.surface[2, 2]), float(frame.depth[2, 2]), frame

    return render


RED, GREEN, BLUE = [0.8, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 1.0]
BACK = np.array([0.1, 0.2, 0.4])


def test_opaque_in_full_light(centre):
    """Normal along the light: ambient + (1 - ambient) = 1 times the colour."""
    linear, surface, depth, frame = centre(plane(0.0, RED))
    assert np.allclose(linear, RED, atol=1e-6)
    assert surface == 0 and abs(depth - 5) < 1e-6
    assert np.allclose(frame.normal[2, 2], [0, -1, 0], atol=1e-6)


def test_away_from_the_light_is_ambient(centre):
    """Light from behind the surface: 0.2 times the colour is left."""
    linear, _, _, _ = centre(plane(0.0, RED), head=HEAD.replace("[0.0, -1.0, 0.0]", "[0.0, 1.0, 0.0]"))
    assert np.allclose(linear, 0.2 * np.array(RED), atol=1e-6)


def test_slanted_light(centre):
    """Light at 60 degrees to the normal: 0.2 + 0.8 * 0.5."""
    linear, _, _, _ = centre(plane(0.0, RED), head=HEAD.replace("[0.0, -1.0, 0.0]", "[1.7320508, -1.0, 0.0]"))
    assert np.allclose(linear, 0.6 * np.array(RED), atol=1e-6)


def test_from_inside(centre):
    """The far wall of a sphere around the camera: its normal turns towards the viewer, and so to the light."""
    linear, _, depth, frame = centre(sphere(8.0, RED))
    assert np.allclose(linear, RED, atol=1e-6)
    assert np.allclose(frame.normal[2, 2], [0, -1, 0], atol=1e-6)
    assert abs(depth - 13) < 1e-5


def test_two_transparent_layers_over_the_background(centre):
    """Front to back: 0.25 red, 0.75 * 0.5 green, 0.75 * 0.5 background, in either order of the scene."""
    wanted = 0.25 * np.array(RED) + 0.75 * 0.5 * np.array(GREEN) + 0.75 * 0.5 * BACK
    front, back = plane(-1.0, RED, 0.25), plane(1.0, GREEN, 0.5)
    for order, number in (((front, back), 0), ((back, front), 1)):
        linear, surface, depth, _ = centre(*order)
        assert np.allclose(linear, wanted, atol=1e-6)
        assert surface == number and abs(depth - 4) < 1e-6


def test_transparent_before_opaque(centre):
    """What lies behind an opaque surface adds nothing."""
    wanted = 0.25 * np.array(RED) + 0.75 * np.array(GREEN)
    linear, _, _, _ = centre(plane(-1.0, RED, 0.25), plane(0.0, GREEN), plane(1.0, BLUE))
    assert np.allclose(linear, wanted, atol=1e-6)


def test_both_walls_of_a_transparent_sphere(centre):
    """Near and far wall face the viewer and the light."""
    linear, _, depth, frame = centre(sphere(1.0, GREEN, 0.5))
    wanted = 0.5 * np.array(GREEN) + 0.5 * 0.5 * np.array(GREEN) + 0.25 * BACK
    assert np.allclose(linear, wanted, atol=1e-6)
    assert abs(depth - 4) < 1e-6
    assert (frame.hits.surfaces[0].t[2, 2] >= 0).sum() == 2


def test_equal_depth_goes_to_the_lower_number(centre):
    """Two surfaces in one place: the first of the scene is seen, whichever it is."""
    for colors in ((RED, GREEN), (GREEN, RED)):
        linear, surface, _, _ = centre(sphere(1.0, colors[0]), sphere(1.0, colors[1]))
        assert surface == 0
        assert np.allclose(linear, colors[0], atol=1e-5)


def test_normals_of_a_spiral(tmp_path):
    """One flat turn of even thickness is the torus: the torus' hits, shaded as the spiral's, give its picture."""
    place = "rotation = [[0.8, 0.0, 0.6], [0.0, 2.0, 0.0], [-0.6, 0.0, 0.8]]\nopacity = 0.5\n"
    path = tmp_path / "scene.toml"
    path.write_text(HEAD.replace("= 5\n", "= 48\n") + '[[surface]]\ntype = "torus"\nR = 0.25\nr = 0.1\n' + place)
    scene = load_scene(path)
    torus = render_golden(scene, Config())
    keys = scene.surfaces[0].model_dump() | {"type": "spiral", "pitch": 0.0, "turns": 1.0}
    spiral = compose(replace(scene, surfaces=(Spiral.model_validate(keys),)), torus.hits, Config())
    assert (torus.surface == 0).sum() > 300
    assert np.allclose(spiral.normal, torus.normal, atol=1e-5)
    assert np.allclose(spiral.linear, torus.linear, atol=1e-5)


def test_miss_is_background(centre):
    """No surface on the ray: background colour in linear and sRGB, -1, inf, 0."""
    _, _, _, frame = centre(sphere(0.02, RED))
    corner = frame.linear[0, 0], frame.rgb[0, 0], frame.surface[0, 0], frame.depth[0, 0], frame.t[0, 0]
    assert np.allclose(corner[0], BACK)
    assert corner[1].tolist() == [89, 124, 170]  # 1.055 c^(1/2.4) - 0.055 of 0.1, 0.2, 0.4, times 255
    assert corner[2:] == (-1, np.inf, -1)
    assert (frame.normal[0, 0] == 0).all()
