# SPDX-License-Identifier: Apache-2.0
"""The ends of a chosen cell, or its middle: RTL equals the model; they are the boundaries evaluated, within N1/2 ulp of
the line."""

from fractions import Fraction

import cocotb
import pytest

import bench
import latency
from raydix.carry import descend
from raydix.cells import subdivide
from raydix.formats import COORD_WIDTH, DEPTH_WIDTH

POINT = bench.Struct(("at", -COORD_WIDTH, 3))


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


def cell(ends, pick, n1):
    """Ends of cell ``pick`` by the golden model."""
    lanes = [model(*line, pick, n1) for line in zip(ends["start"], ends["stop"], strict=True)]
    depth = model(ends["depth_start"], ends["depth_stop"], pick, n1)
    start, stop = ([lane[end] for lane in lanes] for end in range(2))
    return {"start": start, "stop": stop, "depth_start": depth[0], "depth_stop": depth[1]}


def closed(ends):
    """The ends of a cell that has shrunk to its middle, half up."""
    middles = [(a + b + 1) >> 1 for a, b in zip(ends["start"], ends["stop"], strict=True)]
    depth = (ends["depth_start"] + ends["depth_stop"] + 1) >> 1
    return {"start": middles, "stop": middles, "depth_start": depth, "depth_stop": depth}


@cocotb.test
async def equals_model(dut):
    """Every cell of each of many segments, as it is and closed, one a clock: the point first, then both ends."""
    random, n1 = bench.rng(), bench.parameter(dut, "N1")
    moving = latency.moving(n1, bench.parameter(dut, "Moves"))
    await bench.start(dut)
    segments = [random_ends(random) for _ in range(100)]
    items = [(ends, pick, close) for ends in segments for pick in range(1 << n1) for close in (0, 1)]
    random.shuffle(items)

    def clocks():
        late = [0] * (moving - 1) + [close for *_, close in items]
        for number, close in enumerate(late):
            ends, pick, _ = items[min(number, len(items) - 1)]
            yield {"ends_i": ends, "pick_i": pick, "close_i": close}

    def answers():
        for ends, pick, close in items:
            chosen = cell(ends, pick, n1)
            yield closed(chosen) if close else chosen

    structs = {"ends_i": bench.ENDS, "ends_o": bench.ENDS, "point_o": POINT}
    for port, clock in (("point_o", moving + 1), ("ends_o", moving + 3)):
        wanted = answers()

        def expect(_, port=port, wanted=wanted):
            ends = next(wanted, None)
            return {port: {"at": ends["start"]} if port == "point_o" else ends} if ends else {}

        await bench.pipeline(dut, clocks(), expect, clock, structs)


@cocotb.test
async def ends_are_boundaries(dut):
    """A cell's ends by the model are the boundaries of the segment halved as a whole, bit for bit."""
    random, n1 = bench.rng("boundaries"), bench.parameter(dut, "N1")
    for number in range(300):
        ends = random_ends(random)
        for start, stop in [*zip(ends["start"], ends["stop"], strict=True), (ends["depth_start"], ends["depth_stop"])]:
            boundaries = [start, stop] + [0] * ((1 << n1) - 1)
            subdivide(boundaries, 1, n1)
            cells = [model(start, stop, pick, n1) for pick in range(1 << n1)]
            if cells != [boundaries[j : j + 2] for j in range(1 << n1)]:
                raise bench.mismatch(number, {"start": start, "stop": stop}, [f"{cells}, boundaries {boundaries}"])


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


SETS = [*(dict(N1=n1) for n1 in (1, 2, 3, 4)), dict(N1=3, Moves=4), dict(N1=4, Moves=3), dict(N1=1, Moves=4)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_descend(parameters):
    """Two to sixteen cells; two moves a clock, three, four, also more than there are."""
    bench.run(__name__, "rdx_descend", parameters)
