# SPDX-License-Identifier: Apache-2.0
"""Pixels that wait for a verdict: zero_o of each line is that as many verdicts came as pixels were added."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from raydix.formats import PIXEL_WIDTH


@cocotb.test
@cocotb.parametrize(most=(1, 7, 1 << PIXEL_WIDTH))
async def counts_all_lines(dut, most):
    """Random additions and verdicts of all lines in one clock, never more verdicts than pixels; often to zero."""
    random, width, lines = bench.rng(most), bench.parameter(dut, "Verdicts"), bench.parameter(dut, "Lines")
    dut.add_i.value = dut.verdict_i.value = 0
    await bench.start(dut)
    waiting, zeros, full = [0] * lines, 0, 0
    for clock in range(9000):
        add = max(waiting) < (most // 2 if clock < 500 else 8) and random.random() < 0.5
        row, count = random.randrange(4), random.randint(1, min(most, most if clock < 500 else 9))
        if clock in (0, 1) and most > 4000:
            add, row, count = True, clock + 2, most
        dut.add_i.value, dut.add_row_i.value, dut.add_count_i.value = int(add), row, count - 1
        if add:
            waiting[row % lines] += count
        verdicts = rows = 0
        for bit in range(width):
            row = random.randrange(4)
            rows |= row << 2 * bit
            of = row % lines
            if waiting[of] and random.random() < (0.8 if clock // 64 % 2 else 0.1):
                verdicts |= 1 << bit
                waiting[of] -= 1
        dut.verdict_i.value, dut.verdict_row_i.value = verdicts, rows
        full += verdicts == (1 << width) - 1
        await FallingEdge(dut.clk_i)
        found = int(dut.zero_o.value)
        assert found == sum((n == 0) << row for row, n in enumerate(waiting)), f"zero_o = {found:02b}, {waiting}"
        zeros += found != 0
    assert zeros > 100 and full, f"{zeros} clocks with zero, {full} with all verdicts"


@cocotb.test
@cocotb.parametrize(row=(0, 1, 2, 3))
async def counts_far(dut, row):
    """Rows of any width, then 64 of 4,096 pixels; then as many verdicts: zero with the last and not before."""
    random, width, lines = bench.rng(row), bench.parameter(dut, "Verdicts"), bench.parameter(dut, "Lines")
    dut.add_i.value = dut.verdict_i.value = 0
    await bench.start(dut)
    for counts in ([random.randint(1, 1 << PIXEL_WIDTH) for _ in range(20)], [1 << PIXEL_WIDTH] * 64):
        dut.add_i.value, dut.add_row_i.value = 1, row
        for count in counts:
            dut.add_count_i.value = count - 1
            await FallingEdge(dut.clk_i)
        dut.add_i.value = 0
        dut.verdict_row_i.value = sum(row << 2 * bit for bit in range(width))
        left = sum(counts)
        while left:
            assert int(dut.zero_o.value) == (1 << lines) - 1 - (1 << row % lines), f"{left} pixels wait"
            dut.verdict_i.value = (1 << min(left, width)) - 1
            left -= min(left, width)
            await FallingEdge(dut.clk_i)
        dut.verdict_i.value = 0
        assert int(dut.zero_o.value) == (1 << lines) - 1


@cocotb.test
async def reset_zeroes(dut):
    """A reset of a clock sets all counts to 0."""
    lines = bench.parameter(dut, "Lines")
    dut.add_i.value = dut.verdict_i.value = 0
    await bench.start(dut)
    for row in range(lines):
        dut.add_i.value, dut.add_count_i.value, dut.add_row_i.value = 1, 5, row
        await FallingEdge(dut.clk_i)
    assert int(dut.zero_o.value) == 0
    dut.add_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    assert int(dut.zero_o.value) == (1 << lines) - 1


@pytest.mark.parametrize("verdicts, lines", [(4, 4), (3, 2)])
def test_tally(verdicts, lines):
    """The processor's four verdicts a clock of four lines, and three of two."""
    bench.run(__name__, "rdx_tally", dict(Verdicts=verdicts, Lines=lines))
