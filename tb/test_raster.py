# SPDX-License-Identifier: Apache-2.0
"""Walk of a surface's screen rectangle: every ray once, in row order, with the model's ends and accumulators."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, with_timeout

import bench
import streams
import streams_extra
from raydix.fdiff import ROWS, next_pixel, next_row
from raydix.formats import BOX_WIDTH, COORD_ACC_WIDTH, QUADRIC_WORDS, QUARTIC_WORDS
from raydix.item import BOX, DEPTH, PAPER, SIZE, C
from raydix.kernel import words, zeros
from raydix.raster import (
    BOX_AT,
    LANES,
    PAPER_AT,
    QUARTIC_AT,
    ROOTS_AT,
    header,
    is_quartic,
    load_lanes,
    rectangle,
    roots_wanted,
    sample,
)

SIZES = [(1, 1), (1, 7), (7, 1), (2, 2), (1, 1)]  # columns, rows; then random ones


def bits(random, count):
    """A number of up to ``count`` bits, either sign, any size."""
    size = random.randint(2, count)
    return bench.signed(random.getrandbits(size), size)


def descriptor(random, columns, rows, quartic):
    """Words of a surface whose lanes stay in their formats over the rectangle; first column and row anywhere."""
    x0, y0 = random.randrange(4097 - columns), random.randrange(4097 - rows)
    head = random.getrandbits(6) | random.randint(1, 4) << ROOTS_AT | random.getrandbits(1) << PAPER_AT
    head |= quartic << QUARTIC_AT
    for axis in range(3):
        head |= random.randrange(21) << (BOX_AT + axis * BOX_WIDTH)
    out = [head, x0 | y0 << 16 | (x0 + columns - 1) << 32 | (y0 + rows - 1) << 48]
    out.append(random.getrandbits(31) | random.getrandbits(31) << 32)
    for _ in range(6):
        # value, dx, dy: half of the range, and the rest for up to 64 pixels each way
        out += [bits(random, COORD_ACC_WIDTH - 1), *(bits(random, COORD_ACC_WIDTH - 9) for _ in range(2))]
    for _ in range(9 if quartic else 3):
        out += [bits(random, 63), *(bits(random, 55) for _ in range(2)), *(bits(random, 48) for _ in range(3))]
    assert len(out) == (QUARTIC_WORDS if quartic else QUADRIC_WORDS)
    return out


def model(descriptor_words, quads_built):
    """The rays of a surface in order, as fields of the raster's output ports."""
    w = words(descriptor_words)
    state, first, item, quads = zeros(ROWS * LANES).reshape(ROWS, LANES), zeros(SIZE), zeros(SIZE), zeros(9)
    x0, y0, x1, y1 = rectangle(w)
    header(w, item, first)
    load_lanes(state, w)
    built = quads_built if is_quartic(w) else 3
    for y in range(y0, y1 + 1):
        for x in range(x0, x1 + 1):
            sample(state, first, quads)
            ray = {"surface": w[0] & 63, "x": x, "y": y, "paper": item[PAPER], "roots": roots_wanted(w)}
            ray["box"] = list(item[BOX : BOX + 3])
            ends = {"start": list(first[C : C + 3]), "stop": list(first[C + 3 : C + 6])}
            ends |= {"depth_start": first[DEPTH], "depth_stop": first[DEPTH + 1]}
            # lanes that the descriptor does not carry hold what the last quartic left there
            values = [*quads[:built], *[None] * (quads_built - built)]
            yield {"ray_o": ray, "ends_o": ends, "quartic_o": int(is_quartic(w)), "quads_o": values}
            if x < x1:
                next_pixel(state)
        next_row(state)


STRUCTS = {"ray_o": bench.RAY, "ends_o": bench.ENDS, "quartic_o": None, "quads_o": None}
RATES = (0.0, 0.3, 0.8)


def surfaces(dut, random):
    """Descriptors one after the other: the sizes above and random ones, quadrics and, where built, quartics."""
    quartics = bench.parameter(dut, "D") == 4
    sizes = [*SIZES, *((random.randint(1, 9), random.randint(1, 9)) for _ in range(3))]
    return [descriptor(random, *size, quartics and i % 3 != 1) for i, size in enumerate(sizes)]


async def walk(dut, random, idle, stall, descriptors):
    """All rays of ``descriptors`` through the raster, compared with the model; the sink."""
    quads = len(bench.Port(dut, "quads_o").handles)
    expected = [ray for d in descriptors for ray in model(d, quads)]
    sink = streams_extra.sink(dut, random, stall, "ray_", STRUCTS)
    feed = streams.source(dut, [w for d in descriptors for w in d], random, idle, "desc_", "desc_data_i")
    cocotb.start_soon(feed)
    await with_timeout(cocotb.start_soon(sink.take(len(expected))), 10 * 100 * (len(expected) + 1000), "ns")
    streams_extra.compare(sink.port, expected, sink.received)
    return sink


async def start(dut):
    """Clock and reset, with both ports at rest."""
    dut.desc_valid_i.value = 0
    dut.ray_ready_i.value = 0
    await bench.start(dut)


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def equals_model(dut, idle, stall):
    """Every ray of every surface comes out once, row by row, with the model's ends and accumulators."""
    random = bench.rng(f"{idle} {stall}")
    await start(dut)
    await walk(dut, random, idle, stall, surfaces(dut, random))


@cocotb.test
async def no_bubble(dut):
    """Without stalls a ray leaves every clock, across rows too, the first one the clock after the last word."""
    random = bench.rng()
    descriptors = surfaces(dut, random)
    await start(dut)
    sink = await walk(dut, random, 0, 0, descriptors)
    at, before = sink.transfers, None
    for d in descriptors:
        x0, y0, x1, y1 = rectangle(words(d))
        count = (x1 - x0 + 1) * (y1 - y0 + 1)
        mine, at = at[:count], at[count:]
        assert mine == list(range(mine[0], mine[0] + count)), f"{count} rays at clocks {mine}"
        if before is not None:
            # the first word one clock after the last ray, the first ray one clock after the last word
            assert mine[0] == before + len(d) + 1, f"{len(d)} words, but {mine[0] - before} clocks without a ray"
        before = mine[-1]


@cocotb.test
async def wide_rectangle(dut):
    """Columns and rows to the last pixel of the largest image: 4096 in a row, 4096 below each other."""
    random = bench.rng()
    descriptors = [descriptor(random, *size, False) for size in ((4096, 1), (1, 4096))]
    for d in descriptors:
        # slopes that 4096 pixels take
        d[3:] = [w if i % 3 == 0 and i < 18 else w >> 16 for i, w in enumerate(d[3:])]
    await start(dut)
    await walk(dut, random, 0, 0, descriptors)


@cocotb.test
async def reset_ends_walk(dut):
    """A reset in the middle of a walk: no ray is left, and the next words are a descriptor's first."""
    random = bench.rng()
    await start(dut)
    dut.ray_ready_i.value = 1
    await streams.source(dut, descriptor(random, 9, 9, False), random, 0, "desc_", "desc_data_i")
    for _ in range(20):
        assert dut.ray_valid_o.value == 1 and dut.desc_ready_o.value == 0
        await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.ray_valid_o.value == 0
    dut.rst_ni.value = 1
    await walk(dut, random, 0.2, 0.2, surfaces(dut, random))


@pytest.mark.parametrize("parameters", [dict(D=2), dict(D=4)], ids=bench.label)
def test_raster(parameters):
    """Quadrics alone, and quartics too."""
    bench.run(__name__, "rdx_raster", parameters)
