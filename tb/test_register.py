# SPDX-License-Identifier: Apache-2.0
"""The stream register: nothing is lost, doubled or reordered; one transfer a clock; the reset takes valid away."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import streams

RATES = (0.0, 0.3, 0.8)


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def keeps_the_stream(dut, idle, stall):
    """Idle source times stalling sink: what goes in comes out, in order. Without either, an item each clock."""
    rng = bench.rng(f"{idle} {stall}")
    dut.valid_i.value = 0
    dut.ready_i.value = 0
    await bench.start(dut)
    items = [rng.getrandbits(bench.parameter(dut, "W")) for _ in range(400)]
    items[10:14] = [items[9]] * 4  # equal neighbours: a doubled item would be one too many
    sink = await streams.through(dut, items, items, idle, stall, rng)
    if not idle and not stall:
        assert sink.transfers == list(range(sink.transfers[0], sink.transfers[0] + len(items))), "a bubble"
        assert sink.transfers[0] == 1, f"the first item took {sink.transfers[0]} clocks, documented: 1"


@cocotb.test
async def reset_empties(dut):
    """An item that waits in the register is gone after one clock of reset."""
    dut.valid_i.value = 1
    dut.ready_i.value = 0
    dut.data_i.value = 1
    await bench.start(dut)
    await FallingEdge(dut.clk_i)
    assert dut.valid_o.value == 1 and dut.ready_o.value == 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.valid_o.value == 0 and dut.ready_o.value == 1


@cocotb.test
async def ready_passes_through(dut):
    """ready_o is ready_i while an item waits, in the same clock; valid_o depends on neither."""
    dut.valid_i.value = 1
    dut.ready_i.value = 0
    await bench.start(dut)
    for ready in (0, 0, 1, 0, 1, 1):
        await FallingEdge(dut.clk_i)
        dut.ready_i.value = ready
        await ReadOnly()
        assert dut.ready_o.value == ready and dut.valid_o.value == 1


@pytest.mark.parametrize("parameters", [dict(W=1), dict(W=32), dict(W=173)], ids=bench.label)
def test_stream(parameters):
    """Narrow, the default, and as wide as a hit record or more."""
    bench.run(__name__, "rdx_register", parameters)
