# SPDX-License-Identifier: Apache-2.0
"""Common scaling bit by bit: RTL equals the model in every bit; one shift for all, the largest that loses no sign."""

import cocotb
import pytest

import bench
from raydix.normalize import normalize


def model(dut, values):
    """The scaled values by the golden model."""
    width, count, bits = (bench.parameter(dut, name) for name in ("W", "Count", "Bits"))
    scaled = list(values)
    normalize(scaled, 0, count, width, width, (1 << bits) - 1)
    return scaled


def stimuli(dut, count):
    """All vectors where they are few; else corners and random vectors, also such that only one bit decides."""
    width, size = bench.parameter(dut, "W"), bench.parameter(dut, "Count")
    if width * size <= 12:
        yield from map(list, bench.every(width, size))
        return
    random = bench.rng()
    yield from bench.vectors(random, width, size, count)
    for bit in range(width - 1):
        for value in (1 << bit, (1 << bit) - 1, -1 << bit, (-1 << bit) - 1):
            place = random.randrange(size)
            yield [max(bench.low(width), value) if i == place else random.choice((0, -1)) for i in range(size)]


@cocotb.test
async def equals_model(dut):
    """Every bit is the model's, Stages clocks later, a vector a clock."""
    await bench.start(dut)
    items = ({"values_i": values} for values in stimuli(dut, 800))
    stages = bench.parameter(dut, "Stages")
    await bench.pipeline(dut, items, lambda item: {"values_o": model(dut, item["values_i"])}, stages)


@cocotb.test
async def largest_shift(dut):
    """The model's shift is the largest below 2^Bits that fits all values, and exact."""
    width, bits = bench.parameter(dut, "W"), bench.parameter(dut, "Bits")
    low, high = bench.low(width), bench.high(width)
    for number, values in enumerate(stimuli(dut, 800)):
        fits = max(s for s in range(1 << bits) if all(low <= v << s <= high for v in values))
        scaled = model(dut, values)
        if scaled != [v << fits for v in values]:
            raise bench.mismatch(number, {"values": values}, [f"shift {fits}, the model has {scaled}"])


SETS = [
    dict(W=36, Count=5, Bits=3, Stages=3),
    dict(W=36, Count=3, Bits=2, Stages=3),
    dict(W=48, Count=4, Bits=4, Stages=3),
    dict(W=6, Count=2, Bits=2, Stages=1),
    dict(W=4, Count=3, Bits=2, Stages=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_scale(parameters):
    """Steps of three, one and four digits; exhaustive at few bits, in one clock and in none."""
    bench.run(__name__, "rdx_scale", parameters)
