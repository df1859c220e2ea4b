# SPDX-License-Identifier: Apache-2.0
"""Rays that cannot have a hit are dropped, each for its reason and where that counts; all others queue as they are."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, with_timeout

import bench
import streams
import streams_extra
from raydix.cells import subdivide
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH, DEPTH_WIDTH, LIMIT_WIDTH, PIXEL_WIDTH, SURFACE_WIDTH
from raydix.kernel import words, zeros
from raydix.outside import beyond

LEAST, MOST = bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)
ROOTLESS, BEYOND = 1, 2


def coefficients(random, width, degree):
    """Control points: of one sign, zeros among them, one of the other sign, or any."""
    high = (1 << (width - 1)) - 1
    sizes = [
        random.choice((0, 0, 1, high, random.randint(1, high), random.randint(1, high))) for _ in range(degree + 1)
    ]
    kind = random.choice(("positive", "negative", "zero", "one", "any", "any"))
    if kind == "positive":
        return [max(1, s) for s in sizes]
    if kind == "negative":
        return [-1 - s for s in sizes]
    if kind == "zero":  # 0 counts as not positive
        return [-s for s in sizes]
    if kind == "one":
        sign = random.choice((-1, 1))
        values = [sign * max(1, s) for s in sizes]
        values[random.randrange(degree + 1)] *= -1
        return values
    return [random.choice((-1, 1)) * s for s in sizes]


def ends_of_axis(random, box):
    """Coordinates of both ends at faces of the box and beside them, or anywhere."""
    face = 1 << (COORD_FRAC + 1 - box)
    some = [s * face + d for s in (-1, 1) for d in (-1, 0, 1)] + [0, random.randint(LEAST, MOST)]
    return [max(LEAST, min(MOST, random.choice(some))) for _ in range(2)]


def rays(dut, random, count):
    """Pairs of fields: ray and segment."""
    width, degree = bench.parameter(dut, "W"), bench.parameter(dut, "D")
    for _ in range(count):
        box = [random.choice((0, 0, 1, 2, random.randrange(1 << BOX_WIDTH))) for _ in range(3)]
        ray = {"surface": random.getrandbits(SURFACE_WIDTH), "x": random.getrandbits(PIXEL_WIDTH)}
        ray |= {"y": random.getrandbits(PIXEL_WIDTH), "paper": random.getrandbits(1), "roots": random.randrange(8)}
        ends = [ends_of_axis(random, b) for b in box]
        segment = {"start": [e[0] for e in ends], "stop": [e[1] for e in ends]}
        segment |= {name: random.getrandbits(DEPTH_WIDTH - 1) for name in ("depth_start", "depth_stop")}
        ray |= {"box": box, "limit": random.getrandbits(LIMIT_WIDTH)}
        yield ray, segment | {"b": coefficients(random, width, degree)}


def mixed(levels, b):
    """Some cell after so many halvings has control points of both signs."""
    degree = len(b) - 1
    cells = zeros((degree << levels) + 1)
    cells[: degree + 1] = words(b)
    subdivide(cells, degree, levels)
    return any(len({int(v) > 0 for v in cells[i : i + degree + 1]}) == 2 for i in range(0, degree << levels, degree))


def reason(levels, ray, segment, rootless, boxes):
    """Why a ray is dropped; 0 where it is not."""
    if rootless and not mixed(levels, segment["b"]):
        return ROOTLESS
    axes = zip(segment["start"], segment["stop"], ray["box"], strict=True)
    return BEYOND if boxes and any(box and beyond(h, e, box) for h, e, box in axes) else 0


async def drops(dut, found):
    """Record what is dropped: (reason, lowest bits of the row)."""
    while True:
        await ReadOnly()
        if dut.rootless_o.value == 1 or dut.beyond_o.value == 1:
            found.append((int(dut.rootless_o.value) | int(dut.beyond_o.value) << 1, int(dut.row_o.value)))
        await FallingEdge(dut.clk_i)


async def sift(dut, random, items, rootless, boxes, idle, stall):
    """All of ``items`` through the design; reasons of those that were dropped."""
    dut.rootless_i.value, dut.boxes_i.value = rootless, boxes
    structs = {"ray_o": bench.RAY, "segment_o": bench.segment(bench.parameter(dut, "W"), bench.parameter(dut, "D"))}
    levels = bench.parameter(dut, "Levels")
    boxes = boxes and bench.parameter(dut, "Clip")
    why = [reason(levels, *item, rootless, boxes) for item in items]
    passed = [dict(zip(structs, item, strict=True)) for item, w in zip(items, why, strict=True) if not w]
    sink = streams_extra.sink(dut, random, stall, "ray_", structs)
    found = []
    watch = cocotb.start_soon(drops(dut, found))
    ports = ("ray_i", "segment_i")
    feed = streams.source(dut, items, random, idle, "ray_", ports, tuple(structs.values()))
    given = cocotb.start_soon(feed)
    await with_timeout(cocotb.start_soon(sink.take(len(passed))), 10 * (1000 + 40 * len(items)), "ns")
    await with_timeout(given, 10 * (1000 + 40 * len(items)), "ns")
    for _ in range(20):
        await FallingEdge(dut.clk_i)
    watch.cancel()
    streams_extra.compare(sink.port, passed, sink.received)
    streams.compare([(w, item[0]["y"] & 3) for item, w in zip(items, why, strict=True) if w], found)
    return why


async def start(dut):
    """Clock and reset, with both ports at rest."""
    dut.ray_valid_i.value = 0
    dut.ray_ready_i.value = 0
    dut.rootless_i.value = dut.boxes_i.value = 0
    await bench.start(dut)


@cocotb.test
@cocotb.parametrize(rootless=(0, 1), boxes=(0, 1))
async def equals_model(dut, rootless, boxes):
    """Both reasons on and off, with and without idle clocks and stalls; of two reasons a ray counts for the first."""
    random = bench.rng(f"{rootless} {boxes}")
    await start(dut)
    seen = set()
    for idle, stall in ((0, 0), (0.3, 0.3), (0.0, 0.7)):
        seen |= set(await sift(dut, random, list(rays(dut, random, 250)), rootless, boxes, idle, stall))
    assert seen == {0, *([ROOTLESS] * rootless), *([BEYOND] * (boxes and bench.parameter(dut, "Clip")))}


@cocotb.test
async def a_ray_a_clock_until_full(dut):
    """A ray is taken in every clock, dropped or not, until as many as the queue holds wait; who leaves makes room."""
    random = bench.rng()
    await start(dut)
    dut.rootless_i.value = dut.boxes_i.value = 1
    queue, levels = bench.parameter(dut, "Queue"), bench.parameter(dut, "Levels")
    items = list(rays(dut, random, 60 * queue))
    kept = sum(not reason(levels, *item, 1, 1) for item in items)
    assert kept > 3 * queue and len(items) - kept > queue
    ports = [bench.Port(dut, "ray_i", bench.RAY)]
    ports.append(bench.Port(dut, "segment_i", bench.segment(bench.parameter(dut, "W"), bench.parameter(dut, "D"))))
    waiting, quiet, latency = 0, 0, levels * bench.parameter(dut, "HalveStages") + 2
    await FallingEdge(dut.clk_i)
    for ready, end in ((0, latency + 5), (1, 0)):
        dut.ray_ready_i.value, quiet = ready, 0
        while quiet < end if end else items:
            dut.ray_valid_i.value = 1
            for port, value in zip(ports, items[0], strict=True):
                port.write(value)
            await ReadOnly()
            taken = dut.ray_ready_o.value == 1
            dropped = dut.rootless_o.value == 1 or dut.beyond_o.value == 1
            left = dut.ray_valid_o.value == 1 and ready
            assert taken or waiting == queue, f"not taken, {waiting} rays of {queue} are under way"
            assert waiting <= queue
            quiet = 0 if taken else quiet + 1
            await FallingEdge(dut.clk_i)
            waiting += taken - dropped - left
            if taken:
                items.pop(0)
        assert waiting == queue or ready, "the queue fills up"
    dut.ray_valid_i.value = 0


@cocotb.test
async def reset_takes_rays_away(dut):
    """After a reset no ray is left, under way or in the queue."""
    random = bench.rng()
    await start(dut)
    queue = bench.parameter(dut, "Queue")
    for clocks in (1, 5, 9, 4 * queue):
        dut.ray_valid_i.value = 1
        bench.Port(dut, "segment_i").write(0)
        bench.Port(dut, "ray_i").write(0)
        for _ in range(clocks):
            await FallingEdge(dut.clk_i)
        dut.ray_valid_i.value = 0
        assert clocks < queue or (dut.ray_valid_o.value == 1 and dut.ray_ready_o.value == 0)
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        assert dut.ray_ready_o.value == 0, "a ray would be taken in the reset"
        dut.rst_ni.value = 1
        for _ in range(20):
            assert dut.ray_valid_o.value == 0 and dut.rootless_o.value == 0
            await FallingEdge(dut.clk_i)
    await sift(dut, random, list(rays(dut, random, 50)), 1, 1, 0.2, 0.2)


SETS = [
    dict(W=36, D=4, Levels=3, Queue=32),
    dict(W=36, D=2, Levels=1, Queue=16),
    dict(W=16, D=2, Levels=0, Queue=16),
    dict(W=24, D=4, Levels=2, HalveStages=1, Queue=64),
    dict(W=36, D=2, Levels=2, Queue=16, Clip=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_sift(parameters):
    """Quartics, quadrics, narrow control points; none to three halvings; without boxes."""
    bench.run(__name__, "rdx_sift", parameters)
