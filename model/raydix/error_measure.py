# SPDX-License-Identifier: Apache-2.0
"""Worst rounding errors found, beside their bounds: each function measures one inequality of docs/error-analysis.md.

All compare integers of the golden model with exact rational numbers. Each returns (bound, worst found) in the unit of
the inequality; a single measurement where ``found > bound`` would refute the derivation.
"""

from fractions import Fraction
from math import comb

import mpmath as mp
import numpy as np
from flint import arb

from . import fdiff, raster
from .cells import subdivide
from .chords_spiral import compile_chords
from .compile import PRECISION, Quadratic
from .compile_spiral import linear_lane
from .config import Config
from .cordic import gain
from .error_bounds import coordinates, halving, product_error, word
from .exact_spiral import ends_of_words, indicator
from .formats import (
    ANGLE_ITERATIONS,
    COORD_ACC_WIDTH,
    COORD_LANES,
    COORD_WIDTH,
    LENGTH_ITERATIONS,
    OPERAND_SHIFT,
    PRODUCT_DROP,
    QUAD_ACC_WIDTH,
    VECTOR_FRAC,
)
from .halve import average
from .item import SIZE, C
from .kernel import zeros
from .normalize import norm_limit, normalize, redundant_bits
from .segments import products
from .vecsum import GUARD, evaluate, new_lanes


def part(b: list, start: Fraction, stop: Fraction) -> list[Fraction]:
    """Bernstein coefficients on [start, stop] of the polynomial with coefficients ``b`` on [0, 1]: exact."""
    degree, out = len(b) - 1, []
    for k in range(degree + 1):
        row = [Fraction(int(v)) for v in b]
        for level in range(degree):
            at = stop if level < k else start
            row = [(1 - at) * x + at * y for x, y in zip(row, row[1:], strict=False)]
        out.append(row[0])
    return out


def halving_error(b, digits: int, config: Config) -> tuple[float, Fraction, Fraction]:
    """Control points of all cells of a descent to the cell ``digits`` of the last level.

    Returns the bound, and the least and the largest of (computed - exact), in units of the first control points.
    """
    n1, steps, degree = config.n1, config.steps, config.degree
    values = [int(v) for v in b]
    cells = np.zeros((degree << n1) + 1, np.int64)
    least = most = Fraction(0)
    start, scale = Fraction(0), 1
    for level in range(steps):
        cells[: degree + 1] = values
        subdivide(cells, degree, n1)
        size = Fraction(1, 1 << n1 * (level + 1))
        for j in range(1 << n1):
            exact = part(b, start + j * size, start + (j + 1) * size)
            for i in range(degree + 1):
                off = Fraction(int(cells[j * degree + i]), scale) - exact[i]
                least, most = min(least, off), max(most, off)
        pick = digits >> n1 * (steps - 1 - level) & ((1 << n1) - 1)
        start += pick * size
        chosen = cells[pick * degree : (pick + 1) * degree + 1].copy()
        scale <<= int(redundant_bits(chosen, 0, degree + 1, config.width, norm_limit(n1)))
        normalize(chosen, 0, degree + 1, config.width, config.width, norm_limit(n1))
        values = chosen.tolist()
    return halving(n1, steps, degree, config.width), least, most


def word_errors(quadratics: list[Quadratic], linear: list[tuple], pixel: tuple[int, int]) -> list[tuple]:
    """All lanes of exact coefficients at a pixel, by words and the raster: (kind, bound, |computed - exact|) of each.

    quadratics  nine polynomials, in units of the accumulator
    linear      six (first, per column, per row), likewise
    Kinds: "quadrics" and "coordinates", both in units of the accumulator, and "ends", the raster's, units of s2p30.
    """
    x, y = pixel
    state, first, quads = zeros((fdiff.ROWS, raster.LANES)), zeros(SIZE), zeros(9)
    with mp.workprec(PRECISION):
        words = [[*linear_lane(p, 1), 0, 0, 0] for p in linear] + [p.lane(1) for p in quadratics]
        for lane, mine in enumerate(words):
            fdiff.load(state, lane, np.array(mine, np.int64), 0, lane >= COORD_LANES)
        for _ in range(y):
            fdiff.next_row(state)
        for _ in range(x):
            fdiff.next_pixel(state)
        raster.sample(state, first, quads)
        out, cut = [], COORD_ACC_WIDTH - COORD_WIDTH
        for p, value in zip(quadratics, quads.tolist(), strict=True):
            exact = p.c00 + p.c10 * x + p.c01 * y + p.c20 * x * x + p.c11 * x * y + p.c02 * y * y
            out.append(("quadrics", word(x, y, True), float(abs(value - exact))))
        for lane, (start, across, down) in enumerate(linear):
            exact, end = start + across * x + down * y, int(first[C + lane % 2 * 3 + lane // 2])
            off = float(abs(int(state[fdiff.VALUE, lane]) - exact))
            out.append(("coordinates", word(x, y, False), off))
            out.append(("ends", 1 + word(x, y, False) * 2.0**-cut, float(abs(end - mp.ldexp(exact, -cut)))))
        return out


def product_errors(quads: np.ndarray, config: Config) -> list[tuple[float, float]]:
    """Control points of accumulators (N, 9) of quartics: (bound, largest |computed - exact|) of each, units of sWp0."""
    computed, out = products(quads, True, config), []
    for row, b in zip(quads.tolist(), computed.tolist(), strict=True):
        (c0, c1, c2), (p0, p1, p2), (q0, q1, q2) = ([Fraction(v) for v in row[i : i + 3]] for i in (0, 3, 6))
        unit = Fraction(1, 1 << 2 * OPERAND_SHIFT + PRODUCT_DROP)
        exact = [
            6 * (p0 * q0 * unit + c0),
            3 * ((p0 * q1 + p1 * q0) * unit + c0 + c1),
            (p0 * q2 + 4 * p1 * q1 + p2 * q0) * unit + c0 + 4 * c1 + c2,
            3 * ((p1 * q2 + p2 * q1) * unit + c1 + c2),
            6 * (p2 * q2 * unit + c2),
        ]
        if not any(b):
            continue
        # the scale: of all powers of two the one that fits the largest coefficient
        place = max(range(5), key=lambda i: abs(b[i]))
        shift = round(np.log2(abs(b[place]) / abs(float(exact[place])))) + QUAD_ACC_WIDTH - config.width
        scale = Fraction(2) ** (shift - (QUAD_ACC_WIDTH - config.width))
        largest = max(abs(v) for v in row[3:])
        found = max(abs(v - e * scale) for v, e in zip(b, exact, strict=True))
        out.append((product_error(shift, largest, config.width), float(found)))
    return out


def coordinate_error(start: int, stop: int, digits: int, config: Config) -> tuple[float, Fraction]:
    """A coordinate at the middle of the cell ``digits``: (bound, computed - exact), units of s2p30."""
    low, high = int(start), int(stop)
    for bit in range(config.digits - 1, -1, -1):
        middle = average(low, high)
        low, high = (middle, high) if digits >> bit & 1 else (low, middle)
    t = Fraction(2 * digits + 1, 2 << config.digits)
    return coordinates(config.digits), average(low, high) - (int(start) + t * (int(stop) - int(start)))


def polynomial(b: list, t: Fraction) -> Fraction:
    """Value at t, exact."""
    n = len(b) - 1
    return sum((comb(n, i) * int(c) * t**i * (1 - t) ** (n - i) for i, c in enumerate(b)), Fraction(0))


def indicator_errors(surface, points: np.ndarray, config: Config) -> list[tuple[float, float]]:
    """The evaluator at points (N, 3), float64, local: (bound, |computed - exact|) of each, as parts of the bound.

    Points where the value is limited by the distance from the axis are left out.
    """
    compiled = compile_chords(surface, points, points, config)
    lanes, general, out = new_lanes(1), int(config.vecsum == "general"), []
    squared = float(gain(ANGLE_ITERATIONS) * gain(LENGTH_ITERATIONS) * compiled.factors[0]) * 2.0**VECTOR_FRAC
    for words in compiled.coordinates:
        for axis, lane in enumerate((lanes.x, lanes.y, lanes.z)):
            lane[0] = words[axis]
        evaluate(lanes, 1, compiled.form, general)
        value, axis = int(lanes.value[0]), int(lanes.rho[0])
        if abs(value) >= 3 * axis >> 2 or abs(value) <= int(compiled.form[GUARD]) - (3 * axis >> 1):
            continue
        point, _ = ends_of_words([int(w) for w in words], compiled.factors, compiled.middle)
        exact = float(indicator(surface, [arb(v) for v in point]).mid())
        out.append((1.0, abs(value / squared - exact) / compiled.epsilon))
    return out
