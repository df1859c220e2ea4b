# SPDX-License-Identifier: Apache-2.0
"""Value and gradient of a quadric: RTL equals the model in every bit, and the model exact fractions, half up."""

from fractions import Fraction
from math import floor

import cocotb
import numpy as np
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from materials import MATERIAL_T, chosen, load, normal, random_materials, words_of
from raydix.formats import MATERIAL_INDEX, NORMAL_WIDTH
from raydix.gradient import quadric
from raydix.kernel import words, zeros

CONSTANTS, LATENCY = 2, 10
AT = MATERIAL_INDEX["q1_matrix"]
PARAMETERS = dict(Surfaces=64, Matrix=AT, Linear=AT + 6, Constant=AT + 9)


def model(material, point):
    """Value and gradient by the golden model."""
    g = zeros(3)
    return int(quadric(material, AT, words(point), g)), [int(v) for v in g]


def half_up(value):
    """A fraction as s2p16."""
    return min(max(floor(value * (1 << 16) + Fraction(1, 2)), bench.low(NORMAL_WIDTH)), bench.high(NORMAL_WIDTH))


def exact(material, point):
    """The same from exact fractions: g, g + m and q are rounded and cut once each."""
    c = [Fraction(int(v), 1 << 17) for v in material[AT : AT + 10]]
    p = [Fraction(v, 1 << 16) for v in point]
    rows = (c[0], c[3], c[5]), (c[3], c[1], c[4]), (c[5], c[4], c[2])
    slope = [sum(a * b for a, b in zip(row, p, strict=True)) for row in rows]
    wide = [Fraction(half_up(s + 2 * m), 1 << 16) for s, m in zip(slope, c[6:9], strict=True)]
    value = sum(w * x for w, x in zip(wide, p, strict=True)) / 2 + c[9]
    return half_up(value), [half_up(s + m) for s, m in zip(slope, c[6:9], strict=True)]


@cocotb.test
async def equals_model(dut):
    """A point a clock; it comes two clocks after its material, value and gradient ten after the point."""
    random = bench.rng()
    materials = random_materials(random, bench.parameter(dut, "Surfaces"))
    asked, point = bench.Port(dut, "material_i", MATERIAL_T), bench.Port(dut, "point_i")
    value, gradient = bench.Port(dut, "value_o"), bench.Port(dut, "gradient_o")
    await bench.start(dut)
    await load(dut, materials)
    items = [(chosen(random, materials), [normal(random) for _ in range(3)]) for _ in range(2000)]
    cut = 0
    for clock in range(len(items) + CONSTANTS + LATENCY):
        if clock < len(items):
            asked.write(items[clock][0])
        if 0 <= clock - CONSTANTS < len(items):
            point.write(items[clock - CONSTANTS][1])
        number = clock - CONSTANTS - LATENCY
        if number >= 0:
            await ReadOnly()
            material, p = items[number]
            both = model(words_of(materials, material), p)
            assert both == exact(words_of(materials, material), p), (material, p)
            cut += abs(both[0]) >= bench.high(NORMAL_WIDTH)
            lines = value.differences(value.words(both[0]), value.read())
            lines += gradient.differences(gradient.words(both[1]), gradient.read())
            if lines:
                raise bench.mismatch(number, {"material": material, "point": p}, lines)
        await FallingEdge(dut.clk_i)
    assert cut, "no value was cut"


def test_quadric():
    """Random materials and points of all magnitudes."""
    bench.run(__name__, "rdx_quadric", PARAMETERS)


def test_model_equals_fractions():
    """The compiled model, too."""
    import random

    from materials import random_material

    stream = random.Random(1)
    for _ in range(500):
        material, p = random_material(stream), [normal(stream) for _ in range(3)]
        assert model(np.array(material), p) == exact(material, p)
