# SPDX-License-Identifier: Apache-2.0
"""What slots began with: each item meets its own again whenever it leaves the last unit, and no other's."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench


async def turning(dut, random, clocks, rate):
    """A reset, then ``clocks`` clocks in which an item enters at ``rate`` where one may; how many values were compared.

    All outputs come from registers: they are looked at before the inputs of the clock are driven.
    """
    phases = bench.parameter(dut, "Phases")
    turn = bench.parameter(dut, "Slots") * phases
    began, compared, enters = {}, 0, None
    dut.rst_ni.value = 0
    dut.take_i.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    for clock in range(clocks):
        filled, enter = (bool(int(port.value)) for port in (dut.filled_o, dut.enter_o))
        assert filled == (clock >= turn), f"filled_o = {filled}, {clock} clocks after the reset; a turn: {turn}"
        if filled and enter and enters is None:
            enters = clock % phases
        if enters is not None:
            since = (clock - enters) % phases
            assert enter == (since == 0), f"clock {clock}: enter_o = {enter}"
            assert int(dut.phase_o.value) == (since - 1) % phases, f"clock {clock}: phase_o"  # it entered a clock ago
        place = (clock + 1) % turn  # the item that leaves the last unit could be replaced a clock later
        if place in began:
            assert int(dut.first_o.value) == began[place], f"clock {clock}: first_o, place {place}"
            compared += 1
        take, first = filled and enter and random.random() < rate, random.getrandbits(1)
        if take:
            began[clock % turn] = first
        dut.take_i.value, dut.first_i.value = int(take), first
        await FallingEdge(dut.clk_i)
    assert enters is not None, "no item may enter"
    return compared


@cocotb.test
@cocotb.parametrize(rate=(1.0, 0.3, 0.1))
async def keeps_what_entered(dut, rate):
    """For many turns, from each of several resets on, one clock long, at any moment."""
    random = bench.rng(rate)
    dut.take_i.value = 0
    await bench.start(dut)
    turn = bench.parameter(dut, "Slots") * bench.parameter(dut, "Phases")
    compared = 0
    for _ in range(4):
        compared += await turning(dut, random, random.randint(30, 34) * turn + random.randrange(turn), rate)
    assert compared > 3 * bench.parameter(dut, "Slots"), f"{compared} values compared"


CASES = [dict(Slots=64), dict(Slots=7, Phases=1), dict(Slots=5, Phases=3), dict(Slots=2, Phases=15)]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_slots(parameters):
    """Places with an item each, and with an item every few places; a power of two and others."""
    bench.run(__name__, "rdx_slots", parameters)
