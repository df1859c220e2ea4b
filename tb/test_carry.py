# SPDX-License-Identifier: Apache-2.0
"""Coordinates and depth of the cells: RTL equals the model; each end is within N1/2 ulp of the exact line."""

from fractions import Fraction

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from raydix.carry import descend
from raydix.cells import subdivide
from raydix.formats import COORD_WIDTH, DEPTH_WIDTH


def model(start, stop, pick, n1):
    """Ends of cell ``pick`` by the golden model."""
    ends = [start, stop]
    descend(ends, 0, 1, pick, n1)
    return ends


def random_ends(random):
    """Random ends, corners among them; the depth is never negative."""

    def coord():
        return random.choice(
            (bench.low(COORD_WIDTH), bench.high(COORD_WIDTH), 0, -1, random.getrandbits(32) - (1 << 31))
        )

    def depth():
        return random.choice((0, bench.high(DEPTH_WIDTH), random.getrandbits(31)))

    lines = [(coord(), coord()) for _ in range(3)]
    start, stop = ([line[end] for line in lines] for end in range(2))
    return {"start": start, "stop": stop, "depth_start": depth(), "depth_stop": depth()}


@cocotb.test
async def boundaries(dut):
    """coords_o are the model's boundaries, N1*HalveStages clocks later, one item a clock."""
    random, n1 = bench.rng("boundaries"), bench.parameter(dut, "N1")

    def expect(item):
        lanes = []
        for ends in zip(item["ends_i"]["start"], item["ends_i"]["stop"], strict=True):
            cells = [*ends] + [0] * ((1 << n1) - 1)
            subdivide(cells, 1, n1)
            lanes.append(cells)
        return {"coords_o": lanes}

    await bench.start(dut)
    items = ({"ends_i": random_ends(random)} for _ in range(400))
    await bench.pipeline(dut, items, expect, n1 * bench.parameter(dut, "HalveStages"), {"ends_i": bench.ENDS})


@cocotb.test
async def every_cell(dut):
    """cell_o holds the ends of cell pick_i, Wait clocks after the boundaries, for every cell."""
    random, n1 = bench.rng("cells"), bench.parameter(dut, "N1")
    latency = n1 * bench.parameter(dut, "HalveStages") + bench.parameter(dut, "Wait")
    await bench.start(dut)
    ends, pick, cell = (
        bench.Port(dut, n, s) for n, s in (("ends_i", bench.ENDS), ("pick_i", None), ("cell_o", bench.ENDS))
    )
    for number in range(60):
        item = random_ends(random)
        ends.write(item)
        for _ in range(latency):
            await FallingEdge(dut.clk_i)
        for j in range(1 << n1):
            pick.write(j)
            await ReadOnly()
            lanes = [model(*line, j, n1) for line in zip(item["start"], item["stop"], strict=True)]
            depth = model(item["depth_start"], item["depth_stop"], j, n1)
            expected = {
                "start": [lane[0] for lane in lanes],
                "stop": [lane[1] for lane in lanes],
                "depth_start": depth[0],
                "depth_stop": depth[1],
            }
            lines = cell.differences(cell.words(expected), cell.read())
            if lines:
                raise bench.mismatch(number, {"ends_i": item, "pick_i": j}, lines)
            await FallingEdge(dut.clk_i)


@cocotb.test
async def within_bound(dut):
    """The ends of a cell lie within N1/2 ulp of the exact line, and neighbours share theirs."""
    random, n1 = bench.rng("bound"), bench.parameter(dut, "N1")
    for number in range(200):
        a, b = random.getrandbits(32) - (1 << 31), random.getrandbits(32) - (1 << 31)
        cells = [model(a, b, j, n1) for j in range(1 << n1)]
        exact = [a + Fraction(b - a, 1 << n1) * j for j in range((1 << n1) + 1)]
        errors = [abs(v - exact[j + end]) for j, cell in enumerate(cells) for end, v in enumerate(cell)]
        shared = all(left[1] == right[0] for left, right in zip(cells, cells[1:], strict=False))
        if max(errors) > Fraction(n1, 2) or not shared:
            raise bench.mismatch(number, {"a": a, "b": b}, [f"cells {cells}", f"largest error {float(max(errors))}"])


SETS = [dict(N1=3, HalveStages=2, Wait=1), dict(N1=1, HalveStages=1, Wait=3), dict(N1=4, HalveStages=1, Wait=0)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_carry(parameters):
    """Boundaries, picked cells and their bound."""
    bench.run(__name__, "rdx_carry", parameters)
