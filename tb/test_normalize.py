# SPDX-License-Identifier: Apache-2.0
"""Common scaling: RTL equals the model in every bit; the model is exact for equal widths and floors otherwise."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from raydix.normalize import norm_limit, normalize


def sizes(dut):
    """WIn, WOut, Count, Limit."""
    return [bench.parameter(dut, name) for name in ("WIn", "WOut", "Count", "Limit")]


def model(dut, values):
    """The scaled values by the golden model."""
    width_in, width_out, count, limit = sizes(dut)
    scaled = list(values)
    normalize(scaled, 0, count, width_in, width_out, limit)
    return scaled


def stimuli(dut, count):
    """All vectors where they are few; else corners and random vectors, also such that only one bit decides."""
    width, _, size, _ = sizes(dut)
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
    """Every bit is the model's, Stages clocks later."""
    dut.en_i.value = 1
    await bench.start(dut)
    stages = bench.parameter(dut, "Stages")
    items = ({"values_i": values} for values in stimuli(dut, 800))
    await bench.pipeline(dut, items, lambda item: {"values_o": model(dut, item["values_i"])}, stages)


@cocotb.test
async def stalls(dut):
    """Clocks without en_i do not count: the output waits, nothing is lost."""
    random = bench.rng()
    width, _, size, _ = sizes(dut)
    values_i, values_o = bench.Port(dut, "values_i"), bench.Port(dut, "values_o")
    taken, latency = [], bench.parameter(dut, "Stages")
    await bench.start(dut)
    for number in range(400):
        values = [bench.signed(random.getrandbits(width) >> random.randrange(width), width) for _ in range(size)]
        enable = random.random() < 0.5
        values_i.write(values)
        dut.en_i.value = enable
        await FallingEdge(dut.clk_i)
        taken += [values] if enable else []
        if len(taken) >= latency:
            expected = values_o.words(model(dut, taken[-latency]))
            lines = values_o.differences(expected, values_o.read())
            if lines:
                raise bench.mismatch(number, {"values_i": taken[-latency]}, lines)


@cocotb.test
async def within_bound(dut):
    """One shift for all, the largest that loses no sign, at most Limit; then exact, or the floor of what is dropped."""
    width_in, width_out, _, limit = sizes(dut)
    low, high = bench.low(width_in), bench.high(width_in)
    for number, values in enumerate(stimuli(dut, 800)):
        fits = [s for s in range(limit + 1) if all(low <= v << s <= high for v in values)]
        expected = [(v * 2 ** max(fits)) // 2 ** (width_in - width_out) for v in values]
        scaled = model(dut, values)
        signs = all((v < 0) == (s < 0) and (width_in != width_out or (v > 0) == (s > 0))
                    for v, s in zip(values, scaled, strict=True))  # fmt: skip
        if scaled != expected or not signs:
            raise bench.mismatch(number, {"values": values}, [f"expected {expected}, the model has {scaled}"])


SETS = [
    dict(WIn=6, WOut=6, Count=2, Limit=3),
    dict(WIn=6, WOut=4, Count=2, Limit=3),
    dict(WIn=36, WOut=36, Count=5, Limit=7),
    dict(WIn=6, WOut=5, Count=2, Limit=3, Stages=3),
    dict(WIn=36, WOut=36, Count=5, Limit=7, Stages=3),
    dict(WIn=48, WOut=48, Count=3, Limit=15),
    dict(WIn=17, WOut=5, Count=2, Limit=15, Stages=4),
    dict(WIn=48, WOut=48, Count=3, Limit=31, Stages=4),
    dict(WIn=64, WOut=36, Count=5, Limit=63),
    dict(WIn=64, WOut=36, Count=5, Limit=63, Stages=4),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_scaling(parameters):
    """Exhaustive at 6 bits; corners and random values at the step's widths and with bits dropped."""
    bench.run(__name__, "rdx_normalize", parameters)


@pytest.mark.parametrize("n1", [1, 2, 3, 4])
def test_limit_covers_a_double_root(n1):
    """The step's limit is a power of two less one and at least 2*n1, the bits a double root loses in a step."""
    limit = norm_limit(n1)
    assert limit & (limit + 1) == 0 and 2 * n1 <= limit < 4 * n1
