# SPDX-License-Identifier: Apache-2.0
"""Vector sums from rays to hits: the model's records, and idle_o says that no ray is under way."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import latency
import streams
import test_ring as ring
from raydix.formats import VECTOR_WIDTH


class Vector(ring.Shape):
    """Parameters of the ring within."""

    def __init__(self, dut, random):
        n1, lanes = bench.parameter(dut, "N1"), bench.parameter(dut, "Lanes")
        units, rules = bench.parameter(dut, "U"), bench.parameter(dut, "Rules")
        clocks = units * latency.step(n1, 1, 1, lanes, rules, bench.parameter(dut, "VectorDrop")) + 2
        slots = -(-clocks // latency.phases((1 << n1) - 1, lanes))
        super().__init__(dut, random, W=VECTOR_WIDTH, D=1, Slots=slots)


async def start(dut, random):
    """Clock and reset, with both ports at rest; the shape."""
    dut.ray_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    await ring.still(dut, 1)
    return Vector(dut, random)


async def idle_is_empty(dut):
    """For ever: idle_o means that every ray taken has left its last record."""
    rays = 0
    last = bench.Port(dut, "hit_o", bench.HIT)
    while True:
        await ReadOnly()
        assert int(dut.idle_o.value) == (rays == 0), f"idle_o = {dut.idle_o.value}, {rays} rays are under way"
        rays += int(dut.ray_valid_i.value) & int(dut.ray_ready_o.value)
        if int(dut.hit_valid_o.value) & int(dut.hit_ready_i.value):
            rays -= bench.HIT.unpack(last.read()[0])["last"]
        await FallingEdge(dut.clk_i)


async def surface(dut, shape, random, idle, stall, count):
    """Rays of one surface through the module, compared with the model; ends as soon as idle_o says so."""
    rays = [ring.random_ray(random, shape, number) for number in range(count)]
    records = [record for ray in rays for record in ring.model(shape, *ray)]
    limit = (max(r["steps"] for r in records) + 5) * shape.turn + 40 * len(records)
    sink = ring.hit_sink(dut, random, stall)
    given = [(ray, {name: value for name, value in segment.items() if name != "b"}) for ray, segment in rays]
    task = cocotb.start_soon(sink.take())
    await streams.source(dut, given, random, idle, "ray_", ("ray_i", "ends_i"), (bench.RAY, bench.ENDS))
    clocks = 0
    while dut.idle_o.value == 0:
        await FallingEdge(dut.clk_i)
        clocks += 1
        assert clocks < limit, "idle_o does not come"
    task.cancel()
    ring.compare(shape, rays, sink.received)


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.8), stall=(0.0, 0.7))
async def equals_model(dut, idle, stall):
    """The records of each ray are the model's; when idle_o rises the constants become another surface's."""
    random = bench.rng(f"{idle} {stall}")
    shape = await start(dut, random)
    watch = cocotb.start_soon(idle_is_empty(dut))
    for count in (30 if idle or stall else 200, 1, 12):  # so many that some enter while others leave
        await surface(dut, shape, random, idle, stall, count)
        shape.use(dut, random)
    watch.cancel()


@cocotb.test
async def reset_makes_idle(dut):
    """A reset while rays are under way: none is, and those that come then are right."""
    random = bench.rng()
    shape = await start(dut, random)
    rays = ((ray, {n: v for n, v in segment.items() if n != "b"}) for ray, segment in
            (ring.random_ray(random, shape, number) for number in range(999)))  # fmt: skip
    names, structs = ("ray_i", "ends_i"), (bench.RAY, bench.ENDS)
    task = cocotb.start_soon(streams.source(dut, rays, random, 0, "ray_", names, structs))
    for _ in range(random.randint(2, 5) * shape.turn):
        await FallingEdge(dut.clk_i)
    assert dut.idle_o.value == 0
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.idle_o.value == 1 and dut.hit_valid_o.value == 0
    dut.rst_ni.value = 1
    watch = cocotb.start_soon(idle_is_empty(dut))
    await surface(dut, shape, random, 0.1, 0.2, 30)
    watch.cancel()


CASES = [
    dict(N1=2, K=5, U=2, Rules=ring.BOTH, Lanes=2, General=1, VectorDrop=4, Limit=1),
    pytest.param(dict(N1=1, K=12, U=1, Rules=1, Lanes=1, General=0), marks=pytest.mark.long),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_vector(parameters):
    """Some lanes and two units, with limits; the smallest, whose rays enter every other clock."""
    bench.run(__name__, "rdx_vector", parameters)
