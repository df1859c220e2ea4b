# SPDX-License-Identifier: Apache-2.0
"""The gradient of either family, whichever the material says: layers of both, mixed, have the golden model's."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
import latency
import test_swirl
from materials import MATERIAL_T, chosen, coordinate, load, random_materials, words_of
from raydix import formats
from raydix.gradient import gradient
from raydix.kernel import words, zeros
from test_vecsum import beside, points

ALGEBRAIC = {0: 0, 2: 12, 4: 21}
GENERAL = 2


def vector_words(found):
    """Words of a spiral's material."""
    made = [0] * formats.MATERIAL_WORDS
    made[formats.MATERIAL_INDEX["vector"]] = 1
    made[formats.SWIRL_FIRST : formats.SWIRL_FIRST + len(found.words)] = [int(word) for word in found.words]
    return made


@cocotb.test
async def equals_models(dut):
    """A point a clock, any surface of any bank, every second a spiral where both families are built; then a reset."""
    random, degree, vecsum = bench.rng(), bench.parameter(dut, "D"), bench.parameter(dut, "Vecsum")
    materials = random_materials(random, bench.parameter(dut, "Surfaces"))
    spirals, near = {}, {}
    for number, place in enumerate(materials):
        if vecsum and (not degree or number % 2):
            spirals[place] = test_swirl.random_swirl(random, vecsum == GENERAL)
            materials[place] = vector_words(spirals[place])
            form = spirals[place].form
            near[place] = [*points(random, form, 100), *(beside(random, form) for _ in range(100))]
    await bench.start(dut)
    await load(dut, materials)
    seen = []

    def items(count):
        for _ in range(count):
            material = chosen(random, materials)
            place = material["bank"], material["surface"]
            point = random.choice(near[place]) if place in spirals else [coordinate(random) for _ in range(3)]
            seen.append(place in spirals)
            yield {"material_i": material, "point_i": [int(v) for v in point]}

    def expect(item):
        place = item["material_i"]["bank"], item["material_i"]["surface"]
        if place in spirals:
            return {"gradient_o": test_swirl.gradient(spirals[place], item["point_i"], vecsum == GENERAL)}
        work = zeros(12)
        gradient(words_of(materials, item["material_i"]), words(item["point_i"]), work, degree)
        return {"gradient_o": [int(v) for v in work[:3]]}

    clocks = max(ALGEBRAIC[degree], latency.SWIRL if vecsum else 0)
    await bench.pipeline(dut, items(2500), expect, clocks, {"material_i": MATERIAL_T})
    changes = sum(a != b for a, b in zip(seen, seen[1:], strict=False))
    assert changes > 500 or not (degree and vecsum), f"{changes} changes between the families"
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    await bench.pipeline(dut, items(100), expect, clocks, {"material_i": MATERIAL_T})


SETS = [dict(D=4, Vecsum=2, Surfaces=7), dict(D=2, Vecsum=0, Surfaces=1), dict(D=0, Vecsum=1, Surfaces=64)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_normal(parameters):
    """Both families; quadrics alone; helices alone."""
    bench.run(__name__, "rdx_normal", parameters)
