# SPDX-License-Identifier: Apache-2.0
"""The delay line: every value comes out unchanged after Depth clocks."""

import cocotb
import pytest

import bench


@cocotb.test
async def delays(dut):
    """A random vector each clock comes back Depth clocks later."""
    count, random = bench.parameter(dut, "Count"), bench.rng()
    await bench.start(dut)
    items = ({"data_i": [random.getrandbits(1) for _ in range(count)]} for _ in range(300))
    await bench.pipeline(dut, items, lambda item: {"data_o": item["data_i"]}, bench.parameter(dut, "Depth"))


@pytest.mark.parametrize("parameters", [dict(Count=8, Depth=d) for d in (0, 1, 5)], ids=bench.label)
def test_depths(parameters):
    """A wire, a register, a line of registers."""
    bench.run(__name__, "rdx_delay", parameters)
