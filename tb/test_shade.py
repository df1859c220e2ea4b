# SPDX-License-Identifier: Apache-2.0
"""Shading: RTL equals the model in every bit; the model against float64 and against cases worked out by hand."""

from dataclasses import replace
from pathlib import Path

import cocotb
import numpy as np
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from materials import ONE, coordinate, random_materials, unit
from raydix.blend import add_layer, finish
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.formats import COORD_WIDTH, MATERIAL_INDEX, SURFACE_WIDTH
from raydix.golden import trace_golden
from raydix.gradient import gradient
from raydix.kernel import words, zeros
from raydix.layers import layers_of
from raydix.light import color, cosine
from raydix.render import render_golden
from raydix.scene import Spiral, load_scene
from raydix.shade import compose, materials_of, paint, units
from raydix.srgb import srgb
from shading import encoded, linear_picture, with_enters

SCENES = Path(__file__).resolve().parents[1] / "scenes"
LAYER = bench.Struct(("shade", 1), ("first", 1), ("last", 1), ("enters", 1), ("surface", SURFACE_WIDTH),
                     ("point", -COORD_WIDTH, 3))  # fmt: skip
LATENCY = {2: 12 + 27 + 8 + 3, 4: 21 + 27 + 8 + 3}


def shaded(layers, materials, ambient, background, degree):
    """The 24 bits of a pixel by the golden model; layers are fields of LAYER with the material's words as ``words``."""
    total, through, work, shade = zeros(3), ONE, zeros(12), zeros(3)
    for layer in layers:
        if layer["shade"]:
            material = words(layer["words"])
            gradient(material, words(layer["point"]), work, degree)
            color(material, ambient, cosine(material, work, layer["enters"], zeros(3)), shade)
            through = add_layer(total, through, shade, material[MATERIAL_INDEX["opacity"]])
    finish(total, through, words(background))
    return sum(int(srgb(v)) << shift for v, shift in zip(total, (16, 8, 0), strict=True))


async def write_materials(dut, materials):
    """By the ports of rdx_shade: (bank, surface) -> words; the last one first."""
    for (bank, surface), constants in reversed(materials.items()):
        dut.we_i.value, dut.bank_i.value, dut.surface_i.value = 1, bank, surface
        for constant, data in enumerate(constants):
            dut.constant_i.value, dut.data_i.value = constant, int(data) & 0xFFFFFFFF
            await FallingEdge(dut.clk_i)
    dut.we_i.value = 0
    for _ in range(4):
        await FallingEdge(dut.clk_i)


async def send(dut, pixels, random, idle, bank):
    """Pixels, lists of layers and the code expected, by layer_i: each comes out at its clock, none else."""
    latency = LATENCY[bench.parameter(dut, "D")]
    layer_i, clocks = bench.Port(dut, "layer_i", LAYER), []
    dut.read_bank_i.value = bank
    for layers, code in pixels:
        for number, layer in enumerate(layers):
            while random.random() < idle:
                clocks.append((None, None))
            ends = {"first": int(number == 0), "last": int(number == len(layers) - 1)}
            clocks.append((layer | ends, code if ends["last"] else None))
    for clock in range(len(clocks) + latency):
        layer = clocks[clock][0] if clock < len(clocks) else None
        dut.layer_valid_i.value = layer is not None
        if layer is None:
            dut.layer_i.value = random.getrandbits(LAYER.width)
        else:
            layer_i.write(layer)
        await ReadOnly()
        if clock >= latency:
            code = clocks[clock - latency][1]
            assert bool(dut.pixel_valid_o.value) == (code is not None), f"clock {clock}"
            if code is not None and int(dut.pixel_o.value) != code:
                found = f"expected {code:06x}, got {int(dut.pixel_o.value):06x}"
                raise bench.mismatch(clock, {"layer": clocks[clock - latency][0]}, [found])
        await FallingEdge(dut.clk_i)


@cocotb.test
async def equals_model(dut):
    """Random layers of random materials in both banks, with and without gaps; pixels without a layer."""
    random, degree = bench.rng(), bench.parameter(dut, "D")
    most, surfaces = bench.parameter(dut, "Layers"), bench.parameter(dut, "Surfaces")
    materials = random_materials(random, surfaces)
    dut.layer_valid_i.value = 0
    dut.we_i.value = 0
    await bench.start(dut)
    await write_materials(dut, materials)
    for bank, idle in ((0, 0.0), (1, 0.0), (0, 0.4)):
        await bench.noise(dut, "ambient_i", "background_i")
        ambient, background = unit(random), [unit(random) for _ in range(3)]
        dut.ambient_i.value = ambient
        bench.Port(dut, "background_i").write(background)
        numbers, pixels = [s for b, s in materials if b == bank], []
        for _ in range(250):
            layers = []
            for _ in range(random.randint(1, most)):
                surface = random.choice(numbers)
                layers.append({"shade": 1, "enters": random.getrandbits(1), "surface": surface,
                               "point": [coordinate(random) for _ in range(3)],
                               "words": materials[bank, surface]})  # fmt: skip
            if random.random() < 0.2:
                layers = [layers[0] | {"shade": 0}]
            pixels.append((layers, shaded(layers, materials, ambient, background, degree)))
        await send(dut, pixels, random, idle, bank)


@cocotb.test
async def reset_forgets(dut):
    """Of the layers under way at a reset none becomes a pixel."""
    latency = LATENCY[bench.parameter(dut, "D")]
    dut.we_i.value = dut.layer_valid_i.value = 0
    await bench.start(dut)
    dut.layer_i.value, dut.layer_valid_i.value = LAYER.pack(LAYER.unpack(0) | {"first": 1, "last": 1}), 1
    for _ in range(latency + 3):
        await FallingEdge(dut.clk_i)
    assert dut.pixel_valid_o.value == 1
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value, dut.layer_valid_i.value = 1, 0
    for clock in range(latency + 2):
        assert dut.pixel_valid_o.value == 0, f"{clock} clocks after the reset"
        await FallingEdge(dut.clk_i)


@cocotb.test
async def equals_picture(dut):
    """Layers of two scenes, one after the other, by a scene each bank: the pixels are those of the golden picture."""
    random = bench.rng()
    dut.layer_valid_i.value = 0
    dut.we_i.value = 0
    await bench.start(dut)
    for bank, name in enumerate(("glass", "cyclide")):
        scene = load_scene(SCENES / f"{name}.toml", 24, 18)
        frame = with_enters(scene, trace_golden(compile_scene(scene, Config()), Config()))
        near = layers_of(scene, frame, 4)
        _, rgb = paint(scene, frame, near, True)
        await write_materials(dut, {(bank, s): m for s, m in enumerate(materials_of(scene, frame))})
        dut.ambient_i.value = int(units([scene.light.ambient])[0])
        bench.Port(dut, "background_i").write([int(v) for v in units(scene.background.color)])
        pixels = []
        for pixel in range(near.count.size):
            layers = []
            for surface, hit in zip(near.surface[pixel], near.index[pixel], strict=True):
                if len(layers) < near.count[pixel]:
                    layers.append({"shade": 1, "enters": int(near.enters[hit]), "surface": int(surface),
                                   "point": [int(v) for v in near.point[hit]]})  # fmt: skip
            nothing = [{"shade": 0, "enters": 0, "surface": 0, "point": [0, 0, 0]}]
            pixels.append((layers or nothing, int.from_bytes(rgb[pixel].tobytes(), "big")))
        assert near.count.any() and not near.count.all()
        await send(dut, pixels, random, 0.1, bank)


SETS = [dict(D=2, Surfaces=1, Layers=1), dict(D=2, Surfaces=3, Layers=4), dict(D=4, Surfaces=64, Layers=4)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_shading(parameters):
    """Quadrics with one layer and with several, quartics."""
    bench.run(__name__, "rdx_shade", parameters, ["equals_model", "reset_forgets"])


def test_picture():
    """A scene of quadrics and quartics, transparent and opaque."""
    bench.run(__name__, "rdx_shade", SETS[2], ["equals_picture"])


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda p: p.stem)
def test_error(path):
    """At most one code from the float64 picture in every pixel, and linear within 2^-10.

    The turns of the shell meet: along the creases two of them are equally near, and either's normal may be taken.
    """
    scene = load_scene(path, 320, 240)
    config = Config(vecsum="general")
    frame = with_enters(scene, trace_golden(compile_scene(scene, config), config))
    picture = compose(scene, frame, config, layers=8)
    exact = linear_picture(scene, frame)
    assert not picture.dropped.any() and (picture.surface >= 0).any()
    off = np.abs(picture.linear - exact).max(axis=2) >= 2.0**-10
    off |= np.abs(picture.rgb - np.rint(encoded(exact))).max(axis=2) > 1
    assert off.sum() <= (0.001 * (picture.surface >= 0).sum() if path.stem == "shell" else 0)


def test_dropped_layers():
    """With four layers some pixels of the glass scene lack one or two; the others are as with eight."""
    scene = load_scene(SCENES / "glass.toml", 320, 240)
    frame = with_enters(scene, trace_golden(compile_scene(scene, Config()), Config()))
    four, eight = (compose(scene, frame, Config(), layers=count) for count in (4, 8))
    lacking = four.dropped > 0
    assert 0 < lacking.sum() < 200 and four.dropped.max() <= 2
    assert (four.rgb[~lacking] == eight.rgb[~lacking]).all() and (four.rgb[lacking] != eight.rgb[lacking]).any()


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


ULP = 3 * 2.0**-16  # rounding of a few products
RED, GREEN, BLUE = [0.8, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 1.0]
BACK = np.array([0.1, 0.2, 0.4])


def test_opaque_in_full_light(centre):
    """Normal along the light: ambient + (1 - ambient) = 1 times the colour."""
    linear, surface, depth, frame = centre(plane(0.0, RED))
    assert np.allclose(linear, RED, atol=ULP)
    assert surface == 0 and abs(depth - 5) < 1e-6
    assert np.allclose(frame.normal[2, 2], [0, -1, 0], atol=1e-6)


def test_away_from_the_light_is_ambient(centre):
    """Light from behind the surface: 0.2 times the colour is left."""
    linear, _, _, _ = centre(plane(0.0, RED), head=HEAD.replace("[0.0, -1.0, 0.0]", "[0.0, 1.0, 0.0]"))
    assert np.allclose(linear, 0.2 * np.array(RED), atol=ULP)


def test_slanted_light(centre):
    """Light at 60 degrees to the normal: 0.2 + 0.8 * 0.5."""
    linear, _, _, _ = centre(plane(0.0, RED), head=HEAD.replace("[0.0, -1.0, 0.0]", "[1.7320508, -1.0, 0.0]"))
    assert np.allclose(linear, 0.6 * np.array(RED), atol=ULP)


def test_from_inside(centre):
    """The far wall of a sphere around the camera: its normal turns towards the viewer, and so to the light."""
    linear, _, depth, frame = centre(sphere(8.0, RED))
    assert np.allclose(linear, RED, atol=ULP)
    assert np.allclose(frame.normal[2, 2], [0, -1, 0], atol=1e-6)
    assert abs(depth - 13) < 1e-5


def test_two_transparent_layers_over_the_background(centre):
    """Front to back: 0.25 red, 0.75 * 0.5 green, 0.75 * 0.5 background, in either order of the scene."""
    wanted = 0.25 * np.array(RED) + 0.75 * 0.5 * np.array(GREEN) + 0.75 * 0.5 * BACK
    front, back = plane(-1.0, RED, 0.25), plane(1.0, GREEN, 0.5)
    for order, number in (((front, back), 0), ((back, front), 1)):
        linear, surface, depth, _ = centre(*order)
        assert np.allclose(linear, wanted, atol=ULP)
        assert surface == number and abs(depth - 4) < 1e-6


def test_transparent_before_opaque(centre):
    """What lies behind an opaque surface adds nothing."""
    wanted = 0.25 * np.array(RED) + 0.75 * np.array(GREEN)
    linear, _, _, _ = centre(plane(-1.0, RED, 0.25), plane(0.0, GREEN), plane(1.0, BLUE))
    assert np.allclose(linear, wanted, atol=ULP)


def test_both_walls_of_a_transparent_sphere(centre):
    """Near and far wall face the viewer and the light."""
    linear, _, depth, frame = centre(sphere(1.0, GREEN, 0.5))
    wanted = 0.5 * np.array(GREEN) + 0.5 * 0.5 * np.array(GREEN) + 0.25 * BACK
    assert np.allclose(linear, wanted, atol=ULP)
    assert abs(depth - 4) < 1e-6
    assert (frame.hits.surfaces[0].t[2, 2] >= 0).sum() == 2


def test_equal_depth_goes_to_the_lower_number(centre):
    """Two surfaces in one place: the first of the scene is seen, whichever it is."""
    for colors in ((RED, GREEN), (GREEN, RED)):
        linear, surface, _, _ = centre(sphere(1.0, colors[0]), sphere(1.0, colors[1]))
        assert surface == 0
        assert np.allclose(linear, colors[0], atol=ULP)


def test_normals_of_a_spiral(tmp_path):
    """One flat turn of even thickness is the torus: at the torus' hits it has its normals, and both pictures agree."""
    place = "rotation = [[0.8, 0.0, 0.6], [0.0, 2.0, 0.0], [-0.6, 0.0, 0.8]]\nopacity = 0.5\n"
    path = tmp_path / "scene.toml"
    path.write_text(HEAD.replace("= 5\n", "= 48\n") + '[[surface]]\ntype = "torus"\nR = 0.25\nr = 0.1\n' + place)
    scene = load_scene(path)
    torus = render_golden(scene, Config())
    keys = scene.surfaces[0].model_dump() | {"type": "spiral", "pitch": 0.0, "turns": 1.0}
    coil = replace(scene, surfaces=(Spiral.model_validate(keys),))
    spiral = compose(coil, torus.hits, Config())
    assert (torus.surface == 0).sum() > 300
    assert np.allclose(spiral.normal, torus.normal, atol=1e-5)
    picture = render_golden(coil, Config(vecsum="general"))
    both = (torus.surface == 0) & (picture.surface == 0)
    assert both.sum() > 300 and np.allclose(picture.linear[both], torus.linear[both], atol=2e-3)


def test_miss_is_background(centre):
    """No surface on the ray: background colour in linear and sRGB, -1, inf, 0."""
    _, _, _, frame = centre(sphere(0.02, RED))
    corner = frame.linear[0, 0], frame.rgb[0, 0], frame.surface[0, 0], frame.depth[0, 0], frame.t[0, 0]
    assert np.allclose(corner[0], BACK, atol=ULP)
    assert corner[1].tolist() == [89, 124, 170]  # 1.055 c^(1/2.4) - 0.055 of 0.1, 0.2, 0.4, times 255
    assert corner[2:] == (-1, np.inf, -1)
    assert (frame.normal[0, 0] == 0).all()
