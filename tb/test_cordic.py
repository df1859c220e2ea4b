# SPDX-License-Identifier: Apache-2.0
"""CORDIC: RTL equals the model in every bit; length and angle are within their bounds of the exact values.

The bounds. Let n be the iterations, K the gain, L the vector's length, all in ulp of x.

Iteration i rounds down once in x and once in y, each by at most 1 - 2^-i. What follows turns these two by less than
2^-i and lengthens them by less than 1 + 4^-i/6: at the end they make less than
(1 - 2^-i)*(cos(2^-i) + sin(2^-i))*(1 + 4^-i/6) < 1 in x and in y, nothing for i = 0. So x and y are within n - 1 of
those of the exact vector, of length K*L, turned by the same angles.

The angle that is left of the exact vector is at most atan(2^(1-n)) if each iteration turns it towards the axis, since
atan(2^-i) is at most the sum of all that follow, the last one twice. It is turned away where rounding has changed the
sign of y, that is while it is at most asin((n-1)/(K*L)); by induction the angle left is at most the sum of both.
Of vectors so short, K*L < 2*(n-1), that y may change its sign anywhere nothing is said.

Where x stands still it is not rounded, and what it does not grow by is less than an ulp in all.

    x      K*L*(1 - cos(left)) + n - 1 below K*L, n - 1 above it
    angle  left, and what the angles of the table are off by, at most half an ulp each: 5.9 ulp in 28 iterations
"""

import math

import cocotb
import numpy as np
import pytest

import bench
from raydix.cordic import ANGLES, gain, lengths, right_half, turned, vectoring
from raydix.formats import ANGLE_WIDTH, LARGEST_ITERATIONS

TURN = 1 << ANGLE_WIDTH
EXACT = [math.atan(2.0**-i) / (2 * math.pi) * TURN for i in range(LARGEST_ITERATIONS)]
FLOAT = 1e-4  # ulp: errors of float64 in what is compared here


def parameters(dut):
    """W, Iterations, Still, Angle, AngleDrop."""
    return [bench.parameter(dut, name) for name in ("W", "Iterations", "Still", "Angle", "AngleDrop")]


def model(x, y, iterations, still, angle, drop=0):
    """K times the length, and the angle (0 without ``angle``), by the golden model."""
    xs, ys, angles = [x], [y], [0]
    if iterations % 4 == 0 and angle:
        vectoring(xs, ys, angles, 1, iterations, still, drop)
    elif iterations % 4 == 0:
        lengths(xs, ys, 1, iterations)
    else:  # its loops go by fours
        if angle:
            right_half(xs, ys, angles, 1, drop)
        x, y, turns = abs(x), ys[0], angles[0]
        for i in range(iterations):
            x, y, turns = turned(x, y, turns, i, drop)
        xs, angles = [x], [turns << drop & (TURN - 1)]
    return xs[0], angles[0] if angle else 0


def longest(width, iterations):
    """Length from which on x might not fit: K times the length and the roundings."""
    return ((1 << (width - 1)) - iterations) / float(gain(iterations))


def whole_disc(dut):
    """Every vector that is short enough."""
    width, iterations, *_ = parameters(dut)
    limit = longest(width, iterations)
    side = range(-int(limit), int(limit) + 1)
    return [(x, y) for x in side for y in side if math.hypot(x, y) <= limit]


def corners(limit):
    """Vectors along the axes, the diagonals and close to them, of all lengths."""
    sizes = [1 << i for i in range(int(limit).bit_length() - 1)]
    sizes += [s - 1 for s in sizes] + [int(limit), int(limit / math.sqrt(2))]
    for size in sizes:
        for x, y in ((size, 0), (size, 1), (size, size), (size, size - 1), (size - 1, size), (1, size), (0, size)):
            for sign in range(4):
                yield x * (1 - 2 * (sign & 1)), y * (1 - (sign & 2))


def wide(dut, count):
    """Corners, then random vectors: of any length, nearly of the largest, such as meet the axis after some turns."""
    width, iterations, *_ = parameters(dut)
    limit, random = longest(width, iterations), bench.rng()
    vectors = [*corners(limit)]
    for i in range(count):
        size = limit * (random.uniform(0.9, 1) if i % 3 else 2 ** random.uniform(1 - width, 0))
        turn = random.uniform(0, 2 * math.pi)
        if i % 3 == 2:
            turn = sum(random.choice((-1, 1)) * math.atan(2.0**-k) for k in range(random.randint(1, iterations)))
        vectors.append((int(size * math.cos(turn)), int(size * math.sin(turn)) + random.randint(-2, 2)))
    return [(x, y) for x, y in vectors if math.hypot(x, y) <= limit]


async def equal(dut, vectors, stall=0.0):
    """RTL and model on ``vectors``, at the latency that the module documents."""
    _, iterations, *others = parameters(dut)

    def expect(item):
        return dict(zip(("x_o", "angle_o"), model(item["x_i"], item["y_i"], iterations, *others), strict=True))

    await bench.start(dut)
    await bench.pipeline(dut, ({"x_i": x, "y_i": y} for x, y in vectors), expect, iterations + 1, stall=stall)


@cocotb.test
async def equals_model_exhaustively(dut):
    """Every bit of length and angle is the model's, Iterations + 1 clocks later, for every vector."""
    await equal(dut, whole_disc(dut))


@cocotb.test
async def equals_model(dut):
    """The same for corners and random vectors."""
    await equal(dut, wide(dut, 600))


@cocotb.test
async def stalls(dut):
    """Clocks without en_i do not count: nothing moves, nothing is lost."""
    await equal(dut, wide(dut, 100)[-300:], 0.5)


def table(drop):
    """Errors of the angles that have ``drop`` digits fewer, in ulp of them."""
    return [abs(((ANGLES[i] + (1 << drop >> 1)) >> drop) - EXACT[i] / (1 << drop)) for i in range(LARGEST_ITERATIONS)]


def bounds(size, iterations, drop=0):
    """How far x may lie below and above ``size``, K times the length, how far the angle may be off; all in ulp.

    drop  digits that the angle has fewer: its ulp is 2^(drop-32) turns
    """
    rounding = iterations - 1
    left = np.arctan(2.0**-rounding) + np.arcsin(np.minimum(0.5, rounding / np.maximum(size, 1)))
    left = np.where(size < 2 * rounding, np.pi, left)
    return (
        size * 2 * np.sin(left / 2) ** 2 + rounding,
        rounding,
        left / (2 * np.pi) * (TURN >> drop) + sum(table(drop)[:iterations]),
    )


def errors(x, y, iterations, still, angle, drop):
    """How far the model's x lies below and above K times the length, and by how much its angle is off. In ulp."""
    length, turns = model(x, y, iterations, still, angle, drop)
    above = length - float(gain(iterations)) * math.hypot(x, y)
    off = (turns - math.atan2(y, x) / (2 * math.pi) * TURN + TURN / 2) % TURN - TURN / 2
    return -above, above, abs(off) / (1 << drop) if angle and (x or y) else 0.0


def check_bounds(dut, vectors):
    """The model is within the bounds above on ``vectors``. At least a third of those of x and angle is needed."""
    _, iterations, still, angle, drop = parameters(dut)
    worst = [0.0] * 3
    for number, (x, y) in enumerate(vectors):
        size = float(gain(iterations)) * math.hypot(x, y)
        allowed, found = bounds(size, iterations, drop), errors(x, y, iterations, still, angle, drop)
        if any(f > a + FLOAT for f, a in zip(found, allowed, strict=True)):
            lines = [f"x below, x above, angle: off by {found}, allowed {allowed}"]
            raise bench.mismatch(number, {"x_i": x, "y_i": y}, lines)
        worst = [max(w, f / (a or 1)) for w, f, a in zip(worst, found, allowed, strict=True)]
    parts = "largest parts of the bounds: x below {:.2f}, x above {:.2f}, angle {:.2f}".format(*worst)
    dut._log.info(parts)
    assert max(worst[:2]) > 1 / 3 and (not angle or worst[2] > 1 / 3), f"an idle bound: {parts}"


@cocotb.test
async def within_bound(dut):
    """Length and angle of corners and random vectors within the bounds above."""
    check_bounds(dut, wide(dut, 1500))


@cocotb.test
async def within_bound_exhaustively(dut):
    """The same for every vector."""
    check_bounds(dut, whole_disc(dut))


SMALL = [dict(W=7, Iterations=i, Angle=i % 2) for i in (1, 4)]
SMALL += [dict(W=8, Iterations=5, Angle=1), dict(W=7, Iterations=4, Still=4, Angle=1)]
WIDE = [
    dict(W=38, Iterations=28, Still=20, Angle=1),
    dict(W=38, Iterations=28, Angle=1),
    dict(W=38, Iterations=16, Angle=0),
    dict(W=36, Iterations=32, Angle=1),
    dict(W=26, Iterations=16, Angle=1, AngleDrop=12),
    dict(W=30, Iterations=20, Still=16, Angle=1, AngleDrop=8),
]


def test_table():
    """Each angle of the table is within half an ulp."""
    assert max(table(0)) <= 0.5


@pytest.mark.parametrize("parameters", SMALL, ids=bench.label)
def test_every_small_vector(parameters):
    """Exhaustive at reduced width."""
    bench.run(__name__, "rdx_cordic", parameters, ["equals_model_exhaustively", "stalls", "within_bound_exhaustively"])


@pytest.mark.parametrize("parameters", WIDE, ids=bench.label)
def test_wide_vectors(parameters):
    """Corners and random vectors: radius and azimuth, and length alone, as the evaluator has them."""
    bench.run(__name__, "rdx_cordic", parameters, ["equals_model", "stalls", "within_bound"])
