# SPDX-License-Identifier: Apache-2.0
"""Colour of a layer: RTL equals the model in every bit; the model's cosine is within its bound of the exact one."""

import math
import random as standard

import cocotb

import bench
from materials import MATERIAL_T, ONE, chosen, load, normal, random_materials, unit, words_of
from raydix.formats import MATERIAL_INDEX, MATERIAL_WORDS
from raydix.kernel import words, zeros
from raydix.light import color, cosine

LATENCY = 27
BOUND = 2.0**-14


def model(material, gradient, enters, ambient):
    """The colour by the golden model."""
    out = zeros(3)
    cos = cosine(material, words(gradient), enters, zeros(3))
    color(material, ambient, cos, out)
    return [int(v) for v in out]


@cocotb.test
async def equals_model(dut):
    """A layer a clock, any surface of any bank; also a gradient of 0 and one along the light."""
    random = bench.rng()
    materials = random_materials(random, bench.parameter(dut, "Surfaces"))
    largest, at = bench.high(18), MATERIAL_INDEX["color"]
    for (bank, surface), material in materials.items():
        if surface % 2:
            material[:9] = [largest, 0, 0, 0, largest, 0, 0, 0, largest]
        if surface == bench.parameter(dut, "Surfaces") - 1:
            material[at : at + 3] = [ONE - bank] * 3
    await bench.start(dut)
    await load(dut, materials)
    for ambient in (0, ONE, 0, ONE - 1, 1, ONE, unit(random), random.randint(0, ONE)):
        dut.ambient_i.value = ambient
        special = ([0, 0, 0], [0, 0, largest], [0, 0, -1 - largest], [0, 0, 1], [largest] * 3, [-1 - largest] * 3)
        items = ({"material_i": chosen(random, materials), "enters_i": random.getrandbits(1),
                  "gradient_i": random.choice((*special, *([normal(random) for _ in range(3)] for _ in range(9))))}
                 for _ in range(400))  # fmt: skip

        def expect(item, ambient=ambient):
            material = words_of(materials, item["material_i"])
            return {"color_o": model(material, item["gradient_i"], item["enters_i"], ambient)}

        await bench.pipeline(dut, items, expect, LATENCY, {"material_i": MATERIAL_T})


def test_light():
    """Random and special materials and gradients."""
    bench.run(__name__, "rdx_light", dict(Surfaces=64))


def test_cosine_error():
    """Rotations for T, gradients that fill the word: within 2^-14 of max(0, cos), more than a quarter is needed."""
    stream, worst = standard.Random(2), 0.0
    material = [0] * MATERIAL_WORDS
    for _ in range(20_000):
        quaternion = [stream.gauss(0, 1) for _ in range(4)]
        w, x, y, z = (v / math.hypot(*quaternion) for v in quaternion)
        rotation = (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))  # fmt: skip
        at = MATERIAL_INDEX["light"]
        material[at : at + 9] = [round(v * bench.high(18)) for v in rotation]
        gradient = [stream.randint(bench.low(18), bench.high(18)) for _ in range(3)]
        if max(map(abs, gradient)) < 1 << 16:
            continue
        exact = sum(a * b for a, b in zip(rotation[6:], gradient, strict=True)) / math.hypot(*gradient)
        for enters in (0, 1):
            got = cosine(words(material), words(gradient), enters, zeros(3)) / ONE
            worst = max(worst, abs(got - max(0.0, exact if enters else -exact)))
    assert BOUND / 4 < worst <= BOUND
