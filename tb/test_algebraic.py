# SPDX-License-Identifier: Apache-2.0
"""Algebraic surfaces from rays to hits: the records are those of the model's ring for the model's control points."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
import latency
import streams
import test_product
import test_ring as ring

NAMES, STRUCTS = ("ray_i", "ends_i", "quartic_i", "quads_i"), (bench.RAY, bench.ENDS, None, None)


async def start(dut, random):
    """Clock and reset, with both ports at rest; the shape of the ring within."""
    dut.ray_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    await ring.still(dut, 2)
    n1, degree, units, rules, stages = (bench.parameter(dut, n) for n in ("N1", "D", "U", "Rules", "HalveStages"))
    return ring.Shape(dut, random, Slots=units * latency.step(n1, degree, stages, 0, rules) + 3)


def random_rays(random, shape, count):
    """What goes in, and the same with control points, as the ring gets it."""
    given, rays = [], []
    for number, (_, ends, quartic, quads) in enumerate(test_product.items(random, shape.degree, count)):
        ray = ring.random_request(random, shape, number)
        if random.random() < 0.7:
            ray["box"] = [0, 0, 0]
        ends = ends | {name: random.randrange(1 << 31) for name in ("depth_start", "depth_stop")}  # never negative
        ray = ring.with_limit(random, ray, ends)
        given.append((ray, ends, quartic, quads))
        rays.append((ray, ends | {"b": test_product.model(quads, quartic, shape.width, shape.degree)}))
    return given, rays


async def through(dut, shape, random, idle, stall, count):
    """Random rays through the module, compared with the model."""
    given, rays = random_rays(random, shape, count)
    records = sum(len(ring.model(shape, *ray)) for ray in rays)
    assert sum(ring.model(shape, *ray)[0]["hit"] for ray in rays) > count // 10
    sink = ring.hit_sink(dut, random, stall)
    cocotb.start_soon(streams.source(dut, given, random, idle, "ray_", NAMES, STRUCTS))
    await ring.all_taken(shape, rays, sink, cocotb.start_soon(sink.take(records, quiet=2 * shape.turn)))
    assert not dut.rootless_o.value and not dut.beyond_o.value, "without rdx_sift no ray is kept out"


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.8), stall=(0.0, 0.3, 0.8))
async def equals_model(dut, idle, stall):
    """Every ray's records are the model's, none lost, none twice."""
    random = bench.rng(f"{idle} {stall}")
    shape = await start(dut, random)
    await through(dut, shape, random, idle, stall, 70)


@cocotb.test
async def reset_empties(dut):
    """After a reset in the middle of work only the records of new rays come."""
    random = bench.rng()
    shape = await start(dut, random)
    given, _ = random_rays(random, shape, 3 * shape.slots)
    task = cocotb.start_soon(streams.source(dut, given, random, 0, "ray_", NAMES, STRUCTS))
    for _ in range(random.randint(3, 6) * shape.slots):
        await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 1
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 0
    dut.rst_ni.value = 1
    await through(dut, shape, random, 0.1, 0.2, 40)


CASES = [
    dict(N1=3, K=8, W=36, D=4, U=2, Rules=ring.BOTH, Limit=1),
    dict(N1=2, K=6, W=24, D=2, U=1, Rules=ring.CERTIFIED),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_algebraic(parameters):
    """Quartics and both rules; quadrics on one unit."""
    bench.run(__name__, "rdx_algebraic", parameters)
