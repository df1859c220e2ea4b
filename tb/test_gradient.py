# SPDX-License-Identifier: Apache-2.0
"""Gradient of an algebraic surface: RTL equals the model in every bit; the model is near the exact direction."""

import cocotb
import numpy as np
import pytest
from cocotb.triggers import FallingEdge

import bench
from materials import MATERIAL_T, chosen, coordinate, load, random_materials, words_of
from raydix.formats import COORD_FRAC
from raydix.gradient import gradient
from raydix.kernel import words, zeros
from raydix.material import material_words
from raydix.scene import load_scene
from raydix.surfaces import form
from raydix.surfaces import gradient as float_gradient

LATENCY = {2: 12, 4: 21}


def model(material, point, degree):
    """The scaled gradient by the golden model."""
    work = zeros(12)
    gradient(material, words(point), work, degree)
    return [int(v) for v in work[:3]]


@cocotb.test
async def equals_model(dut):
    """A point a clock, any surface of any bank; also after a reset."""
    random, degree = bench.rng(), bench.parameter(dut, "D")
    materials = random_materials(random, bench.parameter(dut, "Surfaces"))
    for words_ in materials.values():
        if random.random() < 0.3:
            words_[14:23] = [0] * 9  # Q3 is 0, so that the product of the others counts
    await bench.start(dut)
    await load(dut, materials)

    def items(count):
        for _ in range(count):
            yield {"material_i": chosen(random, materials), "point_i": [coordinate(random) for _ in range(3)]}

    def expect(item):
        return {"gradient_o": model(words_of(materials, item["material_i"]), item["point_i"], degree)}

    await bench.pipeline(dut, items(2500), expect, LATENCY[degree], {"material_i": MATERIAL_T})
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    await bench.pipeline(dut, items(100), expect, LATENCY[degree], {"material_i": MATERIAL_T})


@pytest.mark.parametrize("parameters", [dict(D=2, Surfaces=1), dict(D=4, Surfaces=64)], ids=bench.label)
def test_gradient(parameters):
    """Quadrics alone, and quartics too."""
    bench.run(__name__, "rdx_gradient", parameters)


@pytest.mark.parametrize(
    ("name", "bound"), [("ellipsoid", 6e-5), ("quadric", 6e-5), ("torus", 2e-4), ("cyclide", 8e-4)]
)
def test_direction(name, bound):
    """Angle to the exact gradient at the same point of the surface: below the bound, half of which is needed."""
    from raydix.compile import compile_scene
    from raydix.config import Config
    from raydix.golden import trace_golden

    scene = load_scene(f"scenes/{name}.toml", 80, 60)
    hits = trace_golden(compile_scene(scene, Config()), Config()).surfaces[0]
    s, surface = hits.surface, scene.surfaces[0]
    material = words(material_words(scene, surface, s.origin, s.unit))
    worst = 0.0
    for point in hits.point[hits.t >= 0]:
        got = np.array(model(material, point, 4), float)
        local = np.array(s.origin) + point / float(1 << COORD_FRAC) * np.array(s.unit)
        exact = float_gradient(form(surface), local) * s.unit
        sine = np.linalg.norm(np.cross(got, exact)) / np.linalg.norm(got) / np.linalg.norm(exact)
        assert got @ exact > 0
        worst = max(worst, sine)
    assert bound / 2 < worst <= bound
