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
    began, compared, enters, next_ones = {}, 0, None, []
    dut.rst_ni.value = 0
    dut.take_i.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    for clock in range(clocks):
        filled, soon = (bool(int(port.value)) for port in (dut.filled_o, dut.next_o))
        enter = bool(next_ones and next_ones[-1])  # the place that enters was the next one a clock ago
        next_ones.append(soon)
        assert filled == (clock >= turn), f"filled_o = {filled}, {clock} clocks after the reset; a turn: {turn}"
        if filled and enter and enters is None:
            enters = clock % phases
        if enters is not None:
            since = (clock - enters) % phases
            assert enter == (since == 0), f"clock {clock}: next_o = {enter} a clock ago"
            assert int(dut.phase_o.value) == (since - 1) % phases, f"clock {clock}: phase_o"  # it entered a clock ago
        for port, ahead in ((0, 2), (1, 1)):  # what leaves the last unit could be replaced two clocks later
            place = (clock + ahead) % turn
            if place in began:
                found = int((dut.origin_o, dut.segment_o)[port].value)
                assert found == began[place][port], f"clock {clock}: {('origin_o', 'segment_o')[port]}, place {place}"
                compared += 1
        take, first = filled and enter and random.random() < rate, (random.getrandbits(1), random.getrandbits(1))
        if take:
            began[clock % turn] = first
        dut.take_i.value, dut.origin_i.value, dut.segment_i.value = int(take), *first
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
