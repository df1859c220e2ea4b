# SPDX-License-Identifier: Apache-2.0
"""Indicator at the ends of a ray's segment: RTL equals the model in every bit; stalls lose nothing."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, with_timeout

import bench
import latency
import spirals
import streams
import streams_extra
from raydix.ends import ends
from raydix.formats import COORD_FRAC, DEPTH_WIDTH, VECTOR_WIDTH
from raydix.item import DEPTH, B, C
from raydix.kernel import words, zeros
from raydix.vecsum import new_lanes

RATES = (0.0, 0.3, 0.8)
REACH = 7 << COORD_FRAC - 2
PORTS = ("ray_i", "ends_i")
STRUCTS = (bench.RAY, bench.ENDS)


def phases(dut):
    """Clocks for a ray."""
    return latency.phases(2, bench.parameter(dut, "Lanes"))


def items(random, found, count):
    """(ray, ends): rays of the surface's frame with any request, some between any points within reach."""
    choice = list(spirals.rays(found))
    for _ in range(count):
        _, _, _, first = random.choice(choice)
        points = [first[C : C + 3].tolist(), first[C + 3 : C + 6].tolist()]
        if random.random() < 0.4:
            corner = (REACH, -REACH, 0, 1, -1)
            points = [[random.choice((*corner, random.randint(-REACH, REACH))) for _ in range(3)] for _ in range(2)]
        depths = [random.choice((int(first[DEPTH + i]), random.getrandbits(DEPTH_WIDTH - 1))) for i in range(2)]
        segment = dict(start=points[0], stop=points[1], depth_start=depths[0], depth_stop=depths[1])
        yield bench.RAY.unpack(random.getrandbits(bench.RAY.width)), segment


def model(constants, general, drop, segment):
    """The segment with its values."""
    first, lanes = zeros(B + 2), new_lanes(2, drop)
    first[C : C + 6] = words(segment["start"] + segment["stop"])
    ends(first, lanes, constants, general)
    return segment | dict(b=first[B : B + 2].tolist())


async def start(dut, random):
    """Clock, reset, a surface's constants; the surface."""
    dut.ray_valid_i.value = 0
    dut.ray_ready_i.value = 0
    surfaces = spirals.GENERAL if bench.parameter(dut, "General") else spirals.HELIX
    found = spirals.surface(*random.choice(surfaces), 3)
    await bench.start(dut)
    await bench.noise(dut, "form_i")
    bench.Port(dut, "form_i", bench.FORM).write(bench.form_fields(spirals.form(found)))
    return found


async def run(dut, random, found, idle, stall, count):
    """Random rays through the module, compared with the model; the sink."""
    constants, general, drop = spirals.form(found), bench.parameter(dut, "General"), bench.parameter(dut, "VectorDrop")
    given = list(items(random, found, count))
    expected = [dict(ray_o=ray, segment_o=model(constants, general, drop, segment)) for ray, segment in given]
    outputs = {"ray_o": bench.RAY, "segment_o": bench.segment(VECTOR_WIDTH, 1)}
    sink = streams_extra.sink(dut, random, stall, "ray_", outputs)
    cocotb.start_soon(streams.source(dut, given, random, idle, "ray_", PORTS, STRUCTS))
    await with_timeout(
        cocotb.start_soon(sink.take(count, quiet=latency.vecsum(drop) + 20)), 10 * 100 * (count + 100), "ns"
    )
    streams_extra.compare(sink.port, expected, sink.received)
    return sink


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def equals_model(dut, idle, stall):
    """Every ray comes out once, in order, with the model's values, its own ends and its own request."""
    random = bench.rng(f"{idle} {stall}")
    sink = await run(dut, random, await start(dut, random), idle, stall, 120)
    if not idle and not stall:
        first, every = sink.transfers[0], phases(dut)
        assert sink.transfers == list(range(first, first + every * len(sink.received), every)), "a bubble"
        documented = latency.vecsum(bench.parameter(dut, "VectorDrop")) + every - 1
        assert documented <= first < documented + every, f"latency {first}, documented: {documented}"


@cocotb.test
async def reset_empties(dut):
    """After a reset no ray of before comes out, and the next ones are right."""
    random = bench.rng()
    found = await start(dut, random)
    task = cocotb.start_soon(streams.source(dut, items(random, found, 999), random, 0, "ray_", PORTS, STRUCTS))
    clocks = 0
    while dut.ray_valid_o.value == 0:
        await FallingEdge(dut.clk_i)
        clocks += 1
        assert clocks < 2 * latency.vecsum(bench.parameter(dut, "VectorDrop"))
    for _ in range(random.randint(0, 5)):
        await FallingEdge(dut.clk_i)
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    dut.ray_ready_i.value = 1
    for _ in range(2 * latency.vecsum(bench.parameter(dut, "VectorDrop"))):
        assert dut.ray_valid_o.value == 0
        await FallingEdge(dut.clk_i)
    for _ in range(12):  # in whatever phase it comes, the first ray is taken in the clock behind it
        for _ in range(random.randint(1, 4)):
            await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        assert dut.ray_ready_o.value == 1
        dut.rst_ni.value = 1
    await run(dut, random, found, 0.1, 0.2, 60)


CASES = [
    dict(Lanes=2, General=0),
    dict(Lanes=1, General=1),
    dict(Lanes=2, General=1),
    dict(Lanes=1, General=0, VectorDrop=12),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_ends(parameters):
    """A ray a clock and a ray every other; for helices and for every spiral."""
    bench.run(__name__, "rdx_ends", parameters)
