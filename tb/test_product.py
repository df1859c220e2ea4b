# SPDX-License-Identifier: Apache-2.0
"""Control points of a ray: RTL equals the model in every bit, the model is within its bound, stalls lose nothing."""

from fractions import Fraction
from functools import partial

import cocotb
import pytest
from cocotb.triggers import FallingEdge, with_timeout

import bench
import latency
import streams
import streams_extra
from raydix.kernel import words, zeros
from raydix.product import product
from test_quartic import bounds, exact, stimuli

RATES = (0.0, 0.3, 0.8)


def model(quads, quartic, width, degree):
    """Control points of the model."""
    out = zeros(degree + 1)
    product(words([*quads, *[0] * (9 - len(quads))]), quartic, out, 0, width, degree)
    return list(out)


def items(random, degree, count):
    """(ray, ends, quartic, quads): accumulators as in test_quartic, the rest any bits."""
    for quads, quartic in stimuli(random, count):
        if degree == 2:
            # no product to leave room for: all 64 bits
            scale = random.choice((1, 1, 7))
            quads, quartic = [q * scale // (1 if quartic else 2) for q in quads[:3]], random.random() < 0.5
        ray, ends = (s.unpack(random.getrandbits(s.width)) for s in (bench.RAY, bench.ENDS))
        yield ray, ends, int(quartic), list(quads)


async def run(dut, random, idle, stall, count):
    """Random items through the module, compared with the model; the sink."""
    width, degree = bench.parameter(dut, "W"), bench.parameter(dut, "D")
    dut.ray_valid_i.value = 0
    dut.ray_ready_i.value = 0
    await bench.start(dut)
    given = list(items(random, degree, count))
    expected = [
        {"ray_o": ray, "segment_o": {**ends, "b": model(quads, quartic, width, degree)}}
        for ray, ends, quartic, quads in given
    ]
    sink = streams_extra.sink(
        dut, random, stall, "ray_", {"ray_o": bench.RAY, "segment_o": bench.segment(width, degree)}
    )
    names, structs = ("ray_i", "ends_i", "quartic_i", "quads_i"), (bench.RAY, bench.ENDS, None, None)
    cocotb.start_soon(streams.source(dut, given, random, idle, "ray_", names, structs))
    await with_timeout(cocotb.start_soon(sink.take(len(expected))), 10 * 100 * (count + 100), "ns")
    streams_extra.compare(sink.port, expected, sink.received)
    return sink


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def equals_model(dut, idle, stall):
    """Every ray comes out once, in order, with the model's control points, its own ends and its own request."""
    sink = await run(dut, bench.rng(f"{idle} {stall}"), idle, stall, 150)
    if not idle and not stall:
        first = sink.transfers[0]
        assert sink.transfers == list(range(first, first + len(sink.received))), "a bubble"
        assert first == latency.product(bench.parameter(dut, "D")), f"latency {first}"


@cocotb.test
async def reset_empties(dut):
    """After a reset no ray of before comes out."""
    random = bench.rng()
    degree = bench.parameter(dut, "D")
    dut.ray_valid_i.value = 0
    dut.ray_ready_i.value = 0
    await bench.start(dut)
    names, structs = ("ray_i", "ends_i", "quartic_i", "quads_i"), (bench.RAY, bench.ENDS, None, None)
    task = cocotb.start_soon(streams.source(dut, items(random, degree, 9), random, 0, "ray_", names, structs))
    for _ in range(24):
        await FallingEdge(dut.clk_i)
    assert dut.ray_valid_o.value == 1
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    dut.ray_ready_i.value = 1
    for _ in range(24):
        assert dut.ray_valid_o.value == 0
        await FallingEdge(dut.clk_i)
    assert dut.ray_ready_o.value == 1
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.ray_ready_o.value == 0, "a ray would be taken in the reset"
    dut.rst_ni.value = 1
    # every place is free, and no more than there are
    taken, dut.ray_valid_i.value, dut.ray_ready_i.value = 0, 1, 0
    for _ in range(40):
        taken += int(dut.ray_ready_o.value)
        await FallingEdge(dut.clk_i)
    assert taken == (16 if degree == 4 else 8), f"{taken} rays are taken while none leaves"


def outside_of_bound(b, coefficients, below_above, width):
    """Lines about control points ``b`` that are no common scaling of ``coefficients`` within the bound.

    The header's figures: scaling is by one power of two 2^s, so that the largest uses all W bits; then the floor to W
    bits takes less than 1, downwards. ``below_above`` is what the coefficients, 6 F for degree 4, lack already.
    """
    top = 1 << (width - 2)
    if any(b) and not any(v >= top or v < -top for v in b):
        return [f"{b}: not all {width} bits are used"]
    lines = []
    for s in range(64):
        unit = Fraction(1 << s, 1 << (64 - width))
        lines = [
            f"control point {k}, scaled by {unit}: {got}, exact {float(f * unit)}"
            for k, (got, f, (below, above)) in enumerate(zip(b, coefficients, below_above, strict=True))
            if not -below * unit - 1 < got - f * unit <= above * unit
        ]
        if not lines:
            return []
    return lines


@cocotb.test
async def within_bound(dut):
    """The model is a scaling of the exact rational coefficients within its bound, and uses all bits."""
    width, degree = bench.parameter(dut, "W"), bench.parameter(dut, "D")
    within = partial(outside_of_bound, width=width)
    for number, (_, _, quartic, quads) in enumerate(items(bench.rng("bound"), degree, 500)):
        b = model(quads, quartic, width, degree)
        if degree == 2:
            lines = within(b, quads, [(0, 0)] * 3)
        else:
            lines = within(b, [6 * f for f in exact(quads, quartic)], bounds(quads, quartic))
        if lines:
            raise bench.mismatch(number, {"quads": quads, "quartic": quartic}, lines)


CASES = [dict(W=16, D=4), dict(W=36, D=4), dict(W=48, D=4), dict(W=36, D=2)]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_product(parameters):
    """Narrow, reference and wide control points; quadrics alone."""
    bench.run(__name__, "rdx_product", parameters)
