# SPDX-License-Identifier: Apache-2.0
"""Pixels of rows: each once and in order, with a ray or hidden by the limit; the lanes stand at the ray's pixel."""

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import looks

RATES = (0.0, 0.3, 0.8)


def make_rows(random, limits, count):
    """(first column, last column, lowest bits of the number, near plane) of rows."""
    return [
        (*looks.columns(random, width), random.getrandbits(2), random.choice(limits.depths))
        for width in looks.widths(random, count)
    ]


async def walk(dut, random, rows, limits, idle=0.0, stall=0.0, end=None):
    """Walk rows to the end, or for ``end`` clocks; (clocks of starts, clocks at which a pixel left).

    idle    probability of a clock without a row that waits
    """
    pixels = [(number, x) for number, row in enumerate(rows) for x in range(row[0], row[1] + 1)]
    offered, begun, lane, held = 0, -1, None, None
    starts, left, quiet, clock = [], [], 0, 0
    offers = False
    while quiet < 8 and clock != end:
        if not offers and offered < len(rows) and random.random() >= idle:
            offers = True
        row = rows[offered] if offers else (random.getrandbits(12), random.getrandbits(12), 0, 0)
        dut.next_i.value = int(offers)
        dut.next_x0_i.value, dut.next_x1_i.value, dut.next_row_i.value, dut.next_near_i.value = row
        dut.ray_ready_i.value = int(random.random() >= stall)
        await ReadOnly()
        asked = limits.asked()
        start, step = dut.start_o.value == 1, dut.step_o.value == 1
        valid, ready, hidden = (bool(s.value) for s in (dut.ray_valid_o, dut.ray_ready_i, dut.hidden_o))
        assert not (start and step) and not (valid and hidden)
        if held is not None:
            looks.differs(len(left), {}, ray=(held, (valid, int(dut.ray_x_o.value), int(dut.ray_limit_o.value))))
        held = (True, int(dut.ray_x_o.value), int(dut.ray_limit_o.value)) if valid and not ready else None
        assert not held or not (start or step), "the lanes move below a ray that is not taken"
        waits = begun >= 0 and len(left) < len(pixels) and pixels[len(left)][0] <= begun
        assert not ((waits or start) and dut.idle_o.value == 1), "idle with pixels under way"
        if valid or hidden:
            assert len(left) < len(pixels), "more pixels than there are"
            number, x = pixels[len(left)]
            _, _, bit, near = rows[number]
            given = {"row": rows[number], "limit": limits.of(bit, x)}
            looks.differs(len(left), given, lane=((number, x), lane), hidden=(limits.hides(bit, x, near), hidden))
            if valid:
                carried = (limits.carried(bit, x), int(dut.ray_limit_o.value))
                looks.differs(len(left), given, ray_x_o=(x, int(dut.ray_x_o.value)), ray_limit_o=carried)
            else:
                looks.differs(len(left), given, hidden_row_o=(bit, int(dut.hidden_row_o.value)))
            if hidden or ready:
                left.append(clock)
        if start:
            assert offers, "a start without a row that waits"
            begun, lane = begun + 1, (offered, rows[offered][0])
            starts.append(clock)
        elif step:
            lane = (lane[0], lane[1] + 1)
        await FallingEdge(dut.clk_i)
        limits.answer(asked)
        if start:
            offers, offered = False, offered + 1
        clock += 1
        quiet = quiet + 1 if len(left) == len(pixels) else 0
        assert clock < 1000 + 60 * len(pixels) + 60 * len(rows), f"{len(left)} of {len(pixels)} pixels"
    assert end or dut.idle_o.value == 1
    dut.next_i.value = 0
    return starts, left


def begin(dut):
    """The ports at rest."""
    for name in ("next_i", "next_x0_i", "next_x1_i", "next_row_i", "next_near_i", "ray_ready_i"):
        getattr(dut, name).value = 0


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES, share=(0.0, 0.5, 1.0))
async def every_pixel_once(dut, idle, stall, share):
    """Random rows, limits and stalls: every pixel leaves once, in order; equal depth does not hide."""
    random = bench.rng(f"{idle} {stall} {share}")
    begin(dut)
    limits = looks.Limits(dut, random, share)
    await bench.start(dut)
    await walk(dut, random, make_rows(random, limits, 40), limits, idle, stall)


@cocotb.test
@cocotb.parametrize(share=(0.0, 1.0))
async def no_gap(dut, share):
    """Rows that wait follow without a gap: a pixel a clock, hidden or not; a row of less than three takes three."""
    random = bench.rng(share)
    begin(dut)
    limits = looks.Limits(dut, random, share)
    limits.depths = (0, 1, looks.FAR - 1)  # all of them hide
    await bench.start(dut)
    for width in (1, 2, 3, 4, 9):
        rows = [(x0 := random.randrange(4000), x0 + width - 1, random.getrandbits(2), looks.FAR) for _ in range(8)]
        starts, left = await walk(dut, random, rows, limits, stall=share)  # hidden ones do not wait for ready
        period = max(3, width)
        assert starts == [starts[0] + period * i for i in range(8)], starts
        # a pixel leaves the clock after its start or step
        assert left == [1 + s + i for s in starts for i in range(width)]


@cocotb.test
async def widest_row(dut):
    """A row of 4096 pixels, from the first column to the last."""
    random = bench.rng()
    begin(dut)
    limits = looks.Limits(dut, random, 0.5)
    await bench.start(dut)
    await walk(dut, random, [(0, 4095, 1, limits.depths[-1]), (4095, 4095, 0, 0), (0, 0, 0, 0)], limits)


@cocotb.test
async def reset_ends_rows(dut):
    """After a reset in the middle of a row no pixel is left, and the row that waits begins anew."""
    random = bench.rng()
    begin(dut)
    limits = looks.Limits(dut, random, 0.3)
    await bench.start(dut)
    for end in (1, 2, 3, 4, 7):
        await walk(dut, random, [(5, 30, 1, 0), (7, 9, 1, 0)], limits, end=end)
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        assert dut.idle_o.value == 1 and dut.ray_valid_o.value == 0 and dut.hidden_o.value == 0
        dut.rst_ni.value = 1
        await walk(dut, random, make_rows(random, limits, 5), limits, 0.2, 0.2)


def test_walk():
    """The walk."""
    bench.run(__name__, "rdx_walk")
