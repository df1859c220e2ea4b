# SPDX-License-Identifier: Apache-2.0
"""Scaling in short stages: RTL equals the model of rdx_normalize in every bit."""

import cocotb
import pytest

import bench
from raydix.kernel import words
from raydix.normalize import normalize

LATENCY = 6
WIDTH = 32


def model(values, width):
    """The scaled values by the golden model."""
    scaled = words(values)
    normalize(scaled, 0, len(scaled), WIDTH, width, WIDTH - 1)
    return scaled


@cocotb.test
async def equals_model(dut):
    """Every bit is the model's, six clocks later; each shift occurs."""
    random, width, count = bench.rng(), bench.parameter(dut, "WOut"), bench.parameter(dut, "Count")
    vectors = [*bench.vectors(random, WIDTH, count, 2000)]
    for bit in range(WIDTH - 1):
        for value in (1 << bit, (2 << bit) - 1, -1 << bit, (-1 << bit) - 1):
            place = random.randrange(count)
            vectors.append([value if i == place else random.choice((0, -1)) for i in range(count)])
    await bench.start(dut)
    items = ({"values_i": values} for values in vectors)
    await bench.pipeline(dut, items, lambda item: {"values_o": list(model(item["values_i"], width))}, LATENCY)


@pytest.mark.parametrize("parameters", [dict(WOut=18, Count=3), dict(WOut=32, Count=1)], ids=bench.label)
def test_fill(parameters):
    """As the shading has it, and without a bit dropped."""
    bench.run(__name__, "rdx_fill", parameters)


def test_nothing_but_zero_stays_short():
    """Every vector but 0 fills its word: the largest component has no redundant sign bit."""
    for values in bench.corners(WIDTH, 3):
        scaled = model(values, 18)
        assert not any(values) or max(max(v, -1 - v) for v in scaled) >= 1 << 16, values
