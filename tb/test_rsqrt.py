# SPDX-License-Identifier: Apache-2.0
"""Reciprocal square root: RTL equals the model in every bit, and the model is within its bound of the exact root."""

import math
from fractions import Fraction

import cocotb

import bench
from raydix.rsqrt import ENTRIES, INDEX_BITS, SQUARE_WIDTH, doubled, rsqrt

LATENCY = 5
LEAST, MOST = 1 << 32, 3 << 34  # of a normal that fills 18 bits
BOUND = 2.0**-16


def corners():
    """Ends of every interval of the table, before and after the even shift; 0 first and last."""
    yield 0
    for shift in (0, 2):
        for index in range(1 << (INDEX_BITS - 2), (1 << INDEX_BITS) + 1):
            edge = index << (SQUARE_WIDTH - INDEX_BITS - shift)
            yield from (s for s in (edge - 1, edge, edge + 1) if LEAST <= s <= MOST)
    yield 0


def stimuli(random, count):
    """Corners, then random arguments."""
    yield from corners()
    for _ in range(count):
        yield random.randint(LEAST, random.choice((LEAST << 1, LEAST << 2, MOST)))


@cocotb.test
async def equals_model(dut):
    """Root and shift are the model's, five clocks later."""
    await bench.start(dut)
    items = ({"square_i": square} for square in stimuli(bench.rng(), 4000))
    await bench.pipeline(dut, items, lambda item: {
        "root_o": rsqrt(item["square_i"]), "doubled_o": doubled(item["square_i"])}, LATENCY)  # fmt: skip


def test_rsqrt():
    """Every interval of the table, and random arguments."""
    bench.run(__name__, "rdx_rsqrt")


def test_error():
    """Relative error at most 2^-16, and more than half of that is needed; the root is at least one half, below one."""
    import random

    worst = 0.0
    for square in stimuli(random.Random(1), 100_000):
        if square:
            root = int(rsqrt(square))
            assert 1 << 16 <= root < 1 << 17
            worst = max(worst, abs(root * 2.0 ** doubled(square) * math.sqrt(square) / 2.0**34 - 1))
    assert BOUND / 2 < worst <= BOUND


def test_table_is_near_the_function():
    """The two ends of each interval's chord are equally far below the function as its middle is above it, to an ulp."""
    for index, (base, fall) in enumerate(ENTRIES):
        if base == 0 or index == 1 << (INDEX_BITS - 2):
            continue  # not used; cut to fit
        ends = [Fraction(base - 1, 1 << 18), Fraction(base - 1, 1 << 18) - Fraction(fall, 1 << 26)]
        places = [(index + k) / 2.0**INDEX_BITS for k in (0, 1)]
        below = [0.5 / math.sqrt(m) - float(v) for m, v in zip(places, ends, strict=True)]
        above = float(sum(ends) / 2) - 0.5 / math.sqrt(sum(places) / 2)
        assert all(abs(b - above) < 2.0**-18 for b in below), index
