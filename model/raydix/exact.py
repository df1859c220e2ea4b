# SPDX-License-Identifier: Apache-2.0
"""Exact roots of polynomials in Bernstein form with integer coefficients: what the descent is judged by.

The control points of an item define a polynomial exactly. Its real roots are isolated and counted with certainty by
python-flint (Arb's enclosures of all roots of an integer polynomial) and refined to 2**-64. Nothing here is shared
with the golden model: no halving with rounding, no rule, no digits.

A *change* is what a descent looks for: a place where "f > 0" changes, zero counting as not positive. That is a root of
odd multiplicity inside of (0, 1), or an end of the segment with f = 0 beside which f is positive.

:func:`changes` works on many polynomials. Most are settled by an exact subdivision in 64-bit integers with Descartes'
rule of signs (no rounding: each halving makes the coefficients ``degree`` bits longer); the rest go to python-flint.
Both give the same (``tb/test_exact.py``).
"""

from math import comb
from typing import NamedTuple

import flint
import numpy as np
from numba import njit

BITS = 64  # roots are refined to 2**-BITS
PRECISION = 128  # of the enclosures, bits
DEGREE = 4  # the largest
ROOM = 62  # bits of a coefficient in the subdivision
LEVELS = 40  # of it, at most
FINE = 2.0**-36  # half width, in cells, of the bracket whose ends' signs prove a root of the subdivision


class Root(NamedTuple):
    """A real root in [0, 1]: ``low <= t * 2**64 < low + 1``, with equality on the left where ``exact``."""

    low: int
    exact: bool
    multiplicity: int


def power_basis(b):
    """Integer coefficients of 1, t, t**2 … of the polynomial with Bernstein coefficients ``b`` (fmpz_poly)."""
    n = len(b) - 1
    return flint.fmpz_poly(
        [comb(n, k) * sum((-1) ** (k - i) * comb(k, i) * int(b[i]) for i in range(k + 1)) for k in range(n + 1)]
    )


def value(b, numerator, bits):
    """The polynomial at ``numerator * 2**-bits``, times ``2**(bits * degree)``: an integer, exact."""
    n, x = len(b) - 1, int(numerator)
    y = (1 << bits) - x
    return sum(comb(n, i) * int(c) * x**i * y ** (n - i) for i, c in enumerate(b))


def roots(b):
    """All real roots in [0, 1] of the polynomial with Bernstein coefficients ``b``, increasing: list of :class:`Root`.

    The zero polynomial has none.
    """
    p = power_basis(b)
    found: list[Root] = []
    if p.degree() < 1:
        return found
    before, flint.ctx.prec = flint.ctx.prec, PRECISION
    try:
        for root, multiplicity in p.complex_roots():
            if root.imag != 0:
                continue
            place = _place(b, root.real)
            if place is not None:
                low, exact = place
                found.append(Root(low, exact, multiplicity))
    finally:
        flint.ctx.prec = before
    return sorted(found)


def _place(b, enclosure):
    """floor(t * 2**64) of the only root in the enclosure, and whether it is that; None outside of [0, 1]."""
    if enclosure < 0 or enclosure > 1:  # certainly outside, however wide
        return None
    scaled = enclosure * flint.arb(2) ** BITS
    low, high = int(scaled.lower().floor().unique_fmpz()), int(scaled.upper().floor().unique_fmpz())
    if low == high:
        exact = bool(scaled.contains(low)) and value(b, low, BITS) == 0
        return (low, exact) if 0 <= low < (1 << BITS) + exact else None
    assert high == low + 1, f"root of {list(b)} not refined to 2**-{BITS}: {enclosure}"
    if value(b, high, BITS) == 0:
        return (high, True) if 0 <= high <= 1 << BITS else None
    sharp = flint.arb(high) * flint.arb(2) ** -BITS
    raise ArithmeticError(f"root of {list(b)} closer than 2**-{PRECISION} to {sharp} and not equal")


def exact_changes(b):
    """Changes of one polynomial, increasing: list of integers, floor(t * 2**64)."""
    found, top = [], 1 << BITS
    inside = roots(b)
    for number, root in enumerate(inside):
        if root.exact and root.low in (0, top):
            # f beside the end: its sign half-way to the next root
            beside = inside[number + 1].low if root.low == 0 and number + 1 < len(inside) else None
            if root.low == top:
                beside = inside[number - 1].low + 1 if number else None
            middle = (root.low + (top - root.low if beside is None else beside)) // 2
            if value(b, middle, BITS) > 0:
                found.append(root.low)
        elif root.multiplicity % 2:
            found.append(root.low)
    return found


def extrema(b):
    """Extrema inside of (0, 1): list of (t, value), float64 of enclosures good to 2**-64; value in units of ``b``."""
    n = len(b) - 1
    slope = [int(b[i + 1]) - int(b[i]) for i in range(n)]
    found: list[tuple[float, float]] = []
    if n < 2:
        return found
    for root in roots(slope):
        if root.multiplicity % 2 and 0 < root.low < 1 << BITS:
            found.append((root.low / 2**BITS, float(value(b, root.low, BITS) / (1 << BITS * n))))
    return found


def changes(b):
    """Changes of many polynomials.

    b       (N, degree + 1) integers, degree 1 to 4
    Returns float64 (N, degree + 1), increasing, nan-padded: t of the changes, good to 2**-36 at least.
    """
    b = np.ascontiguousarray(b, dtype=np.int64)
    out = np.full(b.shape, np.nan)
    undecided = np.zeros(len(b), np.bool_)
    _subdivide_all(b, out, undecided)
    for i in np.flatnonzero(undecided):
        found = exact_changes(b[i].tolist())
        out[i] = np.nan
        out[i, : len(found)] = [low / 2**BITS for low in found]
    return out


@njit(cache=True, nogil=True)
def _subdivide_all(b, out, undecided):
    size = b.shape[1]
    nodes, depth = np.zeros((LEVELS + 1, size), np.int64), np.zeros(LEVELS + 1, np.int64)
    work, cell = np.zeros(size, np.int64), np.zeros(size)
    for i in range(len(b)):
        undecided[i] = not _subdivide(b[i], nodes, depth, work, cell, out[i])


@njit(cache=True, nogil=True)
def _subdivide(b, nodes, depth, work, cell, out):
    """Changes of one polynomial into ``out``; False where its roots are not separated before 64 bits are full.

    nodes, depth: the cells that wait, the leftmost on top, and how often each was halved.
    """
    degree = len(b) - 1
    count, at, top = 0, 0.0, 0
    nodes[0] = b
    depth[0] = 0
    while top >= 0:
        node, level = nodes[top], depth[top]
        if node[0] == 0 or node[degree] == 0:
            return False
        variations = _variations(node)
        if variations > 1:  # the right half stays, the left half on top of it
            if level == LEVELS - 1 or np.max(np.abs(node)) >> (ROOM - degree) != 0:
                return False
            work[:] = node
            left = nodes[top + 1]
            left[0], node[degree] = work[0] << degree, work[degree] << degree
            for row in range(1, degree + 1):
                for i in range(degree - row + 1):
                    work[i] += work[i + 1]
                left[row] = work[0] << (degree - row)
                node[degree - row] = work[degree - row] << (degree - row)
            depth[top] = level + 1
            top += 1
            depth[top] = level + 1
            continue
        if variations == 1:
            cell[:] = node
            root = _root(cell)
            if np.isnan(root):
                return False
            out[count] = at + root * 2.0**-level
            count += 1
        at += 2.0**-level
        top -= 1
    return True


@njit(cache=True, nogil=True)
def _variations(node):
    """Changes of sign among the coefficients, zeros left out: the number of roots in (0, 1), or an even number more."""
    count, sign = 0, node[0] > 0
    for i in range(1, len(node)):
        if node[i] != 0 and (node[i] > 0) != sign:
            sign = not sign
            count += 1
    return count


@njit(cache=True, nogil=True)
def _value(cell, x):
    """The polynomial at x, in float64: the error is below 2**-49 times the largest coefficient."""
    degree = len(cell) - 1
    y, power, total, binomial = 1.0 - x, 1.0, 0.0, 1.0
    for i in range(degree + 1):
        total = total * y + binomial * power * cell[i]
        power *= x
        binomial = binomial * (degree - i) / (i + 1)
    return total


@njit(cache=True, nogil=True)
def _root(cell):
    """The only root in (0, 1), nan where float64 cannot prove it to be within FINE."""
    largest = np.max(np.abs(cell))
    a, b = 0.0, 1.0
    va, vb = cell[0], cell[-1]
    for turn in range(120):  # false position, kept off the ends; each third time the middle
        least = 0.001 * (b - a)
        x = min(max(a - va * (b - a) / (vb - va), a + least), b - least) if turn % 3 < 2 else 0.5 * (a + b)
        v = _value(cell, x)
        if (v > 0.0) == (vb > 0.0):
            b, vb = x, v
        else:
            a, va = x, v
        if b - a < 0.25 * FINE:
            break
    x = 0.5 * (a + b)
    low, high = _value(cell, max(x - FINE, 0.0)), _value(cell, min(x + FINE, 1.0))
    if min(abs(low), abs(high)) <= 2.0**-49 * largest or (low > 0.0) == (high > 0.0):
        return np.nan
    return x
