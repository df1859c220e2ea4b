# SPDX-License-Identifier: Apache-2.0
"""The queue in a memory: nothing is lost, doubled or reordered; it takes Depth and more, and a word a clock."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import streams

RATES = (0.0, 0.3, 0.8)


def registers(dut):
    """Behind the memory."""
    return 1 if bench.parameter(dut, "Depth") <= 16 else 2


async def begin(dut):
    """Clock and reset, with nothing offered."""
    dut.valid_i.value = 0
    dut.ready_i.value = 0
    await bench.start(dut)


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def keeps_the_stream(dut, idle, stall):
    """Idle source times stalling sink. Without either, an item each clock from the second or third on."""
    rng = bench.rng(f"{idle} {stall}")
    await begin(dut)
    items = [rng.getrandbits(bench.parameter(dut, "W")) for _ in range(400)]
    items[10:14] = [items[9]] * 4  # equal neighbours: a doubled item would be one too many
    sink = await streams.through(dut, items, items, idle, stall, rng)
    if not idle and not stall:
        first = 1 + registers(dut)
        assert sink.transfers[0] == first, f"the first item took {sink.transfers[0]} clocks, documented: {first}"
        assert sink.transfers == list(range(first, first + len(items))), "a bubble"


@cocotb.test
async def fills_and_empties(dut):
    """Without a receiver it takes as many words as it has places and no more, ready_o falls; then all leave; twice."""
    rng, depth = bench.rng(), bench.parameter(dut, "Depth")
    await begin(dut)
    for _ in range(2):
        taken = []
        dut.ready_i.value = 0
        for _ in range(2 * depth + 10):
            dut.valid_i.value = 1
            dut.data_i.value = word = rng.getrandbits(bench.parameter(dut, "W"))
            await ReadOnly()
            if dut.ready_o.value:
                taken.append(word)
            await FallingEdge(dut.clk_i)
        assert len(taken) == depth + registers(dut) and not dut.ready_o.value, f"{len(taken)} words"
        dut.valid_i.value = 0
        dut.ready_i.value = 1
        for word in taken:
            await ReadOnly()
            assert dut.valid_o.value and int(dut.data_o.value) == word
            await FallingEdge(dut.clk_i)
        assert not dut.valid_o.value and dut.ready_o.value


@cocotb.test
async def reset_empties(dut):
    """What waits is gone after one clock of reset."""
    await begin(dut)
    dut.valid_i.value, dut.data_i.value = 1, 1
    for _ in range(6):
        await FallingEdge(dut.clk_i)
    assert dut.valid_o.value
    dut.valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    for _ in range(5):
        assert not dut.valid_o.value and dut.ready_o.value
        await FallingEdge(dut.clk_i)


SETS = [dict(W=1, Depth=2), dict(W=32, Depth=16), dict(W=97, Depth=4), dict(W=24, Depth=128)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_fifo(parameters):
    """Narrow and wide, of two places and as deep as the processor's."""
    bench.run(__name__, "rdx_fifo", parameters)
