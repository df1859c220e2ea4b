# SPDX-License-Identifier: Apache-2.0
"""The exact oracle: known roots, its two ways against each other and against float64, what counts as a change."""

from fractions import Fraction

import numpy as np
import pytest

from raydix.exact import BITS, changes, exact_changes, extrema, roots, value
from raydix.stress_polynomials import CATEGORIES, dyadic, fitted, times

ONE = 1 << BITS


def power(b):
    """float64 coefficients of t^n … 1, for numpy.roots."""
    n = len(b) - 1
    return np.array([sum(c * v for c, v in zip(row, b, strict=True)) for row in _basis(n)], float)


def _basis(n):
    from math import comb

    for k in range(n, -1, -1):
        yield [comb(n, k) * comb(k, i) * (-1) ** (k - i) if i <= k else 0 for i in range(n + 1)]


def test_known_roots():
    """Roots at dyadic places, with their multiplicity, exact; others as floor(t * 2^64)."""
    half = np.array([[-1, 1]])  # 2t - 1
    triple = times(times(half, half), half)[0].tolist()
    assert roots(triple) == [(ONE // 2, True, 3)]
    third = np.array([[-1, 2]])  # 3t - 1
    found = roots(times(half, third)[0].tolist())
    assert found == [(ONE // 3, False, 1), (ONE // 2, True, 1)]
    assert roots([0, 0, 0]) == roots([5, 5, 5]) == roots([1, 2, 3, 4]) == []
    assert roots([-2, -1, 0]) == [(ONE, True, 1)]
    assert roots([0, 1, 2]) == [(0, True, 1)]


@pytest.mark.parametrize(
    ("b", "wanted"),
    [
        ([-1, 1], [ONE // 2]),
        ([0, 1, 2], [0]),  # zero, then positive
        ([0, -1, -2], []),  # zero, then negative: not positive throughout
        ([2, 1, 0], [ONE]),  # positive, then zero
        ([-2, -1, 0], []),
        ([1, -1, 1], []),  # touches from above at 1/2
        ([-1, 1, -1], []),  # touches from below
        ([0, 0, 0, 0, 0], []),
        ([0, 1, 0], [0, ONE]),
        ([0, -1, 0], []),
        ([0, 0, 1], [0]),  # a double root at the start, positive beside it
    ],
)
def test_changes_at_the_ends_and_at_double_roots(b, wanted):
    """Zero counts as not positive."""
    assert exact_changes(b) == wanted
    found = changes(np.array([b]))[0]
    assert np.allclose(found[~np.isnan(found)], [low / ONE for low in wanted], rtol=0, atol=2.0**-36)


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_subdivision_equals_flint(degree):
    """The 64-bit subdivision and python-flint find the same changes; numpy's roots are near them."""
    dice = np.random.default_rng(degree)
    b = dice.integers(-(2**35), 2**35, (400, degree + 1))
    fast = changes(b)
    for row, found in zip(b.tolist(), fast, strict=True):
        exact = [low / ONE for low in exact_changes(row)]
        found = found[~np.isnan(found)]
        assert len(found) == len(exact)
        assert np.allclose(found, exact, rtol=0, atol=2.0**-36)
        near = np.roots(power(row))
        assert all(np.abs(near - t).min() < 1e-5 for t in exact)


@pytest.mark.parametrize("name", CATEGORIES)
def test_stress_polynomials(name):
    """The same on each category; signs beside each change, and of a root's multiplicity, by exact evaluation."""
    b = fitted(CATEGORIES[name](np.random.default_rng(7), 60, 4), 36)
    for row, found in zip(b.tolist(), changes(b), strict=True):
        exact = exact_changes(row)
        found = found[~np.isnan(found)]
        assert len(found) == len(exact)
        assert np.allclose(found, [low / ONE for low in exact], rtol=0, atol=2.0**-36)
        inside = [root for root in roots(row) if 0 < root.low < ONE]
        for root in inside:
            apart = min([abs(other.low - root.low) for other in inside if other is not root], default=ONE)
            if min(root.low, ONE - root.low, apart) < 1 << 20:
                continue
            before, after = value(row, root.low - 1, BITS), value(row, root.low + 2, BITS)
            assert (before > 0) != (after > 0) if root.multiplicity % 2 else (before > 0) == (after > 0)
            assert (value(row, root.low, BITS) == 0) == root.exact


def test_exact_places_stay():
    """Words of the category with exact roots: a root is where it was put."""
    dice = np.random.default_rng(3)
    root = dyadic(dice, 50, dice.integers(1, 11, 50))
    b = fitted(times(root, root), 36)
    for r, row in zip(root, b.tolist(), strict=True):
        place = Fraction(-int(r[0]), int(r[1] - r[0]))
        assert roots(row) == [(int(place * ONE), True, 2)]
        assert value(row, int(place * ONE), BITS) == 0


def test_extrema():
    """Place and value of the extrema of a quadratic and of a quartic."""
    assert extrema([1, -1, 1]) == [(0.5, 0.0)]
    found = extrema([3, -1, 1])  # 3 - 8t + 6t^2
    assert len(found) == 1
    assert np.allclose(found[0], (2 / 3, 1 / 3))
    assert extrema([0, 1, 2]) == []
    dice = np.random.default_rng(2)
    for row in dice.integers(-(2**35), 2**35, (50, 5)).tolist():
        for t, v in extrema(row):
            beside = [float(Fraction(value(row, int((t + d) * 2**60), 60), 1 << 240)) for d in (-1e-3, 1e-3)]
            assert all(s > v for s in beside) or all(s < v for s in beside) or abs(beside[0] - v) < 1


def test_a_root_far_outside():
    """A root whose enclosure is wider than 2^-64, because it is large: it is not on the segment."""
    b = [-2, -17179869184, 1, 17179869181, 0]
    assert changes(np.array([b])).shape == (1, 5)
    assert all(0 <= root.low <= 1 << 64 for root in roots(b))
