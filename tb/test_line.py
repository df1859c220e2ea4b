# SPDX-License-Identifier: Apache-2.0
"""The line of memory: every value comes out unchanged after Depth clocks in which it moves."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, Timer

import bench


async def passes(dut, stall):
    """A random word each clock comes back Depth clocks later."""
    width, depth, random = bench.parameter(dut, "W"), bench.parameter(dut, "Depth"), bench.rng(stall)
    items = ({"data_i": random.getrandbits(width)} for _ in range(400))
    await bench.pipeline(dut, items, lambda item: {"data_o": item["data_i"]}, depth, stall=stall)


@cocotb.test
async def delays(dut):
    """Without stalls, and with stalls, in which nothing moves."""
    await bench.start(dut)
    for stall in (0.0, 0.5):
        await passes(dut, stall)


@cocotb.test
async def works_after_a_reset(dut):
    """A reset of one clock at any place, with en_i or without: then the same again."""
    random = bench.rng()
    await bench.start(dut)
    for _ in range(6):
        dut.en_i.value = 1
        for _ in range(random.randrange(2 * bench.parameter(dut, "Depth"))):
            await FallingEdge(dut.clk_i)
        dut.en_i.value = random.getrandbits(1)
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 1
        await passes(dut, 0.1)


@cocotb.test
async def begins_anywhere(dut):
    """Wherever the places happen to be, here both at the same: a reset in which nothing moves is enough."""
    random = bench.rng()
    await bench.start(dut)
    for _ in range(4):
        dut.en_i.value = 0
        dut.rst_ni.value = 0
        if hasattr(dut, "forget"):  # the second simulator: X
            dut.forget.value = 1
            await Timer(1, unit="ns")
            dut.forget.value = 0
        else:
            dut.write_q.value = dut.read_q.value = random.randrange(bench.parameter(dut, "Depth"))
        await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 1
        await passes(dut, 0.0)


@pytest.mark.parametrize("parameters", [dict(W=1, Depth=2), dict(W=38, Depth=29)], ids=bench.label)
def test_depths(parameters):
    """The shortest; one of the evaluator."""
    bench.run(__name__, "rdx_line", parameters)
