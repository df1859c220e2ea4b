# SPDX-License-Identifier: Apache-2.0
"""Walk of a surface's screen rectangle: every ray once, in row order, with the model's ends and accumulators."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, with_timeout

import bench
import streams
import streams_extra
from raydix.core import FORM_AT
from raydix.fdiff import ROWS, next_pixel, next_row
from raydix.formats import BOX_WIDTH, COORD_ACC_WIDTH, FORM, QUADRIC_WORDS, QUARTIC_WORDS, VECTOR_WORDS
from raydix.item import BOX, DEPTH, PAPER, SIZE, C
from raydix.kernel import words, zeros
from raydix.raster import (
    BOX_AT,
    LANES,
    PAPER_AT,
    QUARTIC_AT,
    ROOTS_AT,
    VECTOR_AT,
    header,
    is_quartic,
    is_vector_sum,
    load_lanes,
    rectangle,
    roots_wanted,
    sample,
)
from raydix.ring import NO_LIMIT

QUADRIC, QUARTIC, VECTOR = QUADRIC_WORDS, QUARTIC_WORDS, VECTOR_WORDS  # kinds of surfaces by their words
SIZES = [(1, 1), (1, 7), (7, 1), (2, 2), (1, 1)]  # columns, rows; then random ones


def bits(random, count):
    """A number of up to ``count`` bits, either sign, any size."""
    size = random.randint(2, count)
    return bench.signed(random.getrandbits(size), size)


def descriptor(random, columns, rows, kind):
    """Words of a surface whose lanes stay in their formats over the rectangle; first column and row anywhere."""
    x0, y0 = random.randrange(4097 - columns), random.randrange(4097 - rows)
    head = random.getrandbits(6) | random.randint(1, 4) << ROOTS_AT | random.getrandbits(1) << PAPER_AT
    head |= (kind == QUARTIC) << QUARTIC_AT | (kind == VECTOR) << VECTOR_AT
    for axis in range(3):
        head |= random.randrange(21) << (BOX_AT + axis * BOX_WIDTH)
    out = [head, x0 | y0 << 16 | (x0 + columns - 1) << 32 | (y0 + rows - 1) << 48]
    out.append(random.getrandbits(31) | random.getrandbits(31) << 32)
    for _ in range(6):
        # value, dx, dy: half of the range, and the rest for up to 64 pixels each way
        out += [bits(random, COORD_ACC_WIDTH - 1), *(bits(random, COORD_ACC_WIDTH - 9) for _ in range(2))]
    for _ in range({QUADRIC: 3, QUARTIC: 9, VECTOR: 0}[kind]):
        out += [bits(random, 63), *(bits(random, 55) for _ in range(2)), *(bits(random, 48) for _ in range(3))]
    if kind == VECTOR:
        for field in FORM:
            bits_of = [random.getrandbits(field.width) for _ in range(field.count)]
            out += [bench.signed(b, field.width) if field.token[0] == "s" else b for b in bits_of]
    assert len(out) == kind
    return out


def model(descriptor_words, quads_built, form):
    """The rays of a surface in order, as fields of the raster's output ports; ``form``: of the last vector sum."""
    w = words(descriptor_words)
    state, first, item, quads = zeros(ROWS * LANES).reshape(ROWS, LANES), zeros(SIZE), zeros(SIZE), zeros(9)
    x0, y0, x1, y1 = rectangle(w)
    header(w, item, first)
    load_lanes(state, w)
    built = quads_built if is_quartic(w) else 0 if is_vector_sum(w) else 3
    for y in range(y0, y1 + 1):
        for x in range(x0, x1 + 1):
            sample(state, first, quads)
            ray = {"surface": w[0] & 63, "x": x, "y": y, "paper": item[PAPER], "roots": roots_wanted(w)}
            ray |= {"box": list(item[BOX : BOX + 3]), "limit": NO_LIMIT}
            ends = {"start": list(first[C : C + 3]), "stop": list(first[C + 3 : C + 6])}
            ends |= {"depth_start": first[DEPTH], "depth_stop": first[DEPTH + 1]}
            # lanes that the descriptor does not carry hold what the last quartic left there
            values = [*quads[:built], *[None] * (quads_built - built)]
            kinds = {"quartic_o": int(is_quartic(w)), "vector_o": int(is_vector_sum(w))}
            yield {"ray_o": ray, "ends_o": ends, **kinds, "quads_o": values, "form_o": form}
            if x < x1:
                next_pixel(state)
        next_row(state)


STRUCTS = {"ray_o": bench.RAY, "ends_o": bench.ENDS, "quartic_o": None, "vector_o": None, "quads_o": None}
STRUCTS |= {"form_o": bench.FORM}
RATES = (0.0, 0.3, 0.8)


def kinds(dut):
    """Kinds of surfaces that the raster at hand takes."""
    vector = bench.parameter(dut, "Vector")
    return [VECTOR] * vector + {0: [], 2: [QUADRIC], 4: [QUARTIC, QUADRIC]}[bench.parameter(dut, "D")]


def surfaces(dut, random):
    """Descriptors one after the other, of every kind: the sizes above and random ones."""
    sizes = [*SIZES, *((random.randint(1, 9), random.randint(1, 9)) for _ in range(3))]
    order = kinds(dut)
    return [descriptor(random, *size, order[i % len(order)]) for i, size in enumerate(sizes)]


def rays(dut, descriptors):
    """What comes out. The constants of a vector sum stay until those of the next are loaded."""
    quads = len(bench.Port(dut, "quads_o").handles)
    form = None if bench.parameter(dut, "Vector") else bench.FORM.unpack(0)
    for d in descriptors:
        if len(d) == VECTOR:
            form = bench.form_fields(d[FORM_AT:])
        for ray in model(d, quads, form):
            yield ray if bench.parameter(dut, "D") else ray | {"quads_o": [0] * quads}


async def under_way(dut, random, rate):
    """Drives vector_idle_i: each ray of a vector sum is on its way for a time, and the constants stay as long."""
    form, port, count = None, bench.Port(dut, "form_o", bench.FORM), 0
    while True:
        dut.vector_idle_i.value = int(count == 0)
        await ReadOnly()
        if count:
            assert port.read() == form, "the constants have changed below a ray"
        taken = dut.ray_valid_o.value == 1 and dut.ray_ready_i.value == 1 and dut.vector_o.value == 1
        if taken:
            form = port.read()
        await FallingEdge(dut.clk_i)
        count += taken
        while count and random.random() < rate:
            count -= 1


async def walk(dut, random, idle, stall, descriptors, rate=None):
    """All rays of ``descriptors`` through the raster, compared with the model; the sink.

    rate    at which rays of vector sums come to their end; at once if not given
    """
    expected = list(rays(dut, descriptors))
    sink = streams_extra.sink(dut, random, stall, "ray_", STRUCTS)
    feed = streams.source(dut, [w for d in descriptors for w in d], random, idle, "desc_", "desc_data_i")
    dut.vector_idle_i.value = 1
    watch = cocotb.start_soon(under_way(dut, random, rate)) if rate else None
    cocotb.start_soon(feed)
    await with_timeout(cocotb.start_soon(sink.take(len(expected))), 10 * 100 * (len(expected) + 1000), "ns")
    if watch:
        watch.cancel()
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
    await walk(dut, random, idle, stall, surfaces(dut, random), random.choice((0.2, 0.5, 0.9)))


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
    descriptors = [descriptor(random, *size, kinds(dut)[-1]) for size in ((4096, 1), (1, 4096))]
    for d in descriptors:
        # slopes that 4096 pixels take
        lanes = d[3:QUADRIC] if len(d) != VECTOR else d[3:FORM_AT]
        d[3 : 3 + len(lanes)] = [w if i % 3 == 0 and i < 18 else w >> 16 for i, w in enumerate(lanes)]
    await start(dut)
    await walk(dut, random, 0, 0, descriptors)


@cocotb.test
async def reset_ends_walk(dut):
    """A reset in the middle of a walk: no ray is left, and the next words are a descriptor's first."""
    random = bench.rng()
    await start(dut)
    dut.ray_ready_i.value = 1
    dut.vector_idle_i.value = 1
    await streams.source(dut, descriptor(random, 9, 9, kinds(dut)[-1]), random, 0, "desc_", "desc_data_i")
    for _ in range(20):
        assert dut.ray_valid_o.value == 1 and dut.desc_ready_o.value == 0
        await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.ray_valid_o.value == 0
    dut.rst_ni.value = 1
    await walk(dut, random, 0.2, 0.2, surfaces(dut, random))


@cocotb.test
async def waits_for_rays(dut):
    """While rays of a vector sum are under way the lanes of the next are loaded, not its constants; others go on."""
    random, port = bench.rng(), bench.Port(dut, "form_o", bench.FORM)
    await start(dut)
    dut.ray_ready_i.value = 1
    for kind in kinds(dut):
        dut.vector_idle_i.value = 0
        before, d = port.read(), descriptor(random, 1, 1, kind)
        taken = 0
        for _ in range(200):
            dut.desc_valid_i.value, dut.desc_data_i.value = 1, d[min(taken, kind - 1)] & ((1 << 64) - 1)
            await ReadOnly()
            taken += dut.desc_ready_o.value == 1
            assert port.read() == before and (kind != VECTOR or dut.ray_valid_o.value == 0)
            await FallingEdge(dut.clk_i)
            if taken == kind:
                break
        dut.desc_valid_i.value = 0
        assert taken == (FORM_AT if kind == VECTOR else kind), f"{taken} words were taken"
        dut.vector_idle_i.value = 1
        await streams.source(dut, d[taken:], random, 0, "desc_", "desc_data_i")
        await ReadOnly()
        assert dut.ray_valid_o.value == 1
        wanted = bench.form_fields(d[FORM_AT:]) if kind == VECTOR else None
        assert not port.differences(port.words(wanted), port.read())
        await FallingEdge(dut.clk_i)


CASES = [dict(D=2), dict(D=4), dict(D=0, Vector=1), dict(D=2, Vector=1), dict(D=4, Vector=1)]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_raster(parameters):
    """Quadrics alone, and quartics too; vector sums alone, and beside them."""
    bench.run(__name__, "rdx_raster", parameters)
