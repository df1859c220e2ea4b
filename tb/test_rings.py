# SPDX-License-Identifier: Apache-2.0
"""Rings side by side: every ray's records are the model's, none lost, none twice, and all rings have work."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
import latency
import test_ring as ring
from raydix.formats import VECTOR_WIDTH


class Rings(ring.Shape):
    """Parameters of the rings within; ``slots`` are those of all of them."""

    def __init__(self, dut, random):
        names = ("N1", "D", "U", "Rules", "HalveStages", "Lanes", "VectorDrop")
        n1, degree, units, rules, stages, lanes, drop = (bench.parameter(dut, name) for name in names)
        phases = latency.phases((1 << n1) - 1, lanes) if degree == 1 else 1
        slots = -(-(units * latency.step(n1, degree, stages, lanes, rules, drop) + 3) // phases)
        super().__init__(dut, random, Slots=slots)
        self.rings = bench.parameter(dut, "Rings")


async def start(dut, random):
    """Clock and reset, with both ports at rest; the shape."""
    dut.ray_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    await ring.still(dut, bench.parameter(dut, "D"))
    return Rings(dut, random)


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.6), stall=(0.0, 0.3, 0.9))
async def equals_model(dut, idle, stall):
    """The records of each ray are the model's, in order of t, `last` once: none lost, none twice."""
    random = bench.rng(f"{idle} {stall}")
    shape = await start(dut, random)
    each = 40 if idle else max(40, 2 * shape.slots)  # so many that each ring has its share
    rays = [ring.random_ray(random, shape, number) for number in range(each * shape.rings)]
    await ring.trace_all(dut, shape, rays, random, idle, stall)


@cocotb.test
async def all_rings_work(dut):
    """Rays of K steps that come without a pause and are taken at once: every ring takes its share.

    As many rays as fill all slots twice take little longer than one ring alone would take for its share.
    """
    random = bench.rng()
    shape = await start(dut, random)
    rays = [ring.plain_ray(random, shape, number) for number in range(2 * shape.rings * shape.slots)]
    dut.hit_ready_i.value = 1
    for _ in range(2 * shape.turn):
        await FallingEdge(dut.clk_i)
    sink = await ring.trace_all(dut, shape, rays, random, 0.0, 0.0)
    turns = -(-shape.steps // shape.units)
    # all of them together take a ray a clock at best; the ray in front of a full ring waits for its first slot
    most = 3 * turns * shape.turn + (shape.rings + 2) * shape.turn + 30
    assert sink.transfers[-1] <= most, f"{sink.transfers[-1]} clocks, {most} at most"


@cocotb.test
async def reset_empties(dut):
    """After a reset in the middle of work only the records of new rays come."""
    random = bench.rng()
    shape = await start(dut, random)
    old = [ring.random_ray(random, shape, 3000 + number) for number in range(3 * shape.rings * shape.slots)]
    task = ring.feed(dut, shape, old, random)
    for _ in range((random.randint(3, 6) + -(-shape.steps // shape.units)) * shape.turn):
        await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 1
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 0
    dut.rst_ni.value = 1
    rays = [ring.random_ray(random, shape, number) for number in range(40)]
    await ring.trace_all(dut, shape, rays, random, 0.0, 0.2, new=True)


VECTOR = dict(W=VECTOR_WIDTH, D=1, U=1, Rings=2)
CASES = [
    dict(N1=3, K=4, W=36, D=2, U=1, Rings=4, Rules=ring.CERTIFIED, Limit=1),
    dict(N1=2, K=5, W=24, D=4, U=2, Rings=3, Rules=ring.BOTH),
    dict(N1=1, K=6, W=36, D=2, U=6, Rings=1, Rules=ring.CERTIFIED),
    dict(N1=1, K=6, **VECTOR, Rules=ring.CERTIFIED, HalveStages=1, Lanes=1, General=0, VectorDrop=12, Limit=1),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_rings(parameters):
    """Four, three, one; of vector sums two; with limits and without."""
    bench.run(__name__, "rdx_rings", parameters)
