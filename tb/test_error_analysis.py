# SPDX-License-Identifier: Apache-2.0
"""The inequalities of docs/error-analysis.md: the worst case found is within each bound, and not far below it."""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest

from raydix import error_measure
from raydix.config import Config
from raydix.error_bounds import halving

sys.path.append(str(Path(__file__).resolve().parents[1] / "scripts"))
import errors  # noqa: E402  (a script, found by the path above)


def checked(rows):
    """The rows; none may be refuted."""
    made = []
    for row, refuted in rows:
        assert not refuted, row
        made.append(row)
    return made


def test_halving():
    """Never below the exact control point, at most the bound above it."""
    above, below = checked(errors.halving_rows(4, 1, (4,), ((3, 8),)))
    assert above[3] == pytest.approx(13.714, abs=1e-3)
    assert above[4] > 1  # the stimuli do round
    assert below[4] == 0


def test_halving_would_be_refuted(monkeypatch):
    """An average rounded down goes below; one that rounds up by two goes above the bound."""

    def lower(cell, degree, n1):
        subdivide(cell, degree, n1)
        cell[1] -= 1

    def higher(cell, degree, n1):
        subdivide(cell, degree, n1)
        cell[1] += 20

    subdivide = error_measure.subdivide
    for broken in (lower, higher):
        monkeypatch.setattr(error_measure, "subdivide", broken)
        assert any(refuted for _, refuted in errors.halving_rows(2, 1, (4,), ((3, 8),)))


def test_words():
    """Within the bound, and more than a third of it is reached."""
    for row in checked(errors.word_rows(300, 1)):
        assert row[4] > row[3] / 3, row


def test_words_would_be_refuted(monkeypatch):
    """Words that are cut, not rounded, are off by more."""
    monkeypatch.setattr(mp, "nint", mp.floor)
    assert all(refuted for _, refuted in errors.word_rows(300, 1))


def test_product():
    """Within the bound, and more than a third of it is reached."""
    (row,) = checked(errors.product_rows(320, 1))
    assert row[4] > row[3] / 3


def test_coordinates():
    """Never below, at most (n + 1)/2 above."""
    above, below = checked(errors.coordinate_rows(1000, 1))
    assert above[3] == 12.5
    assert above[4] > 3
    assert below[4] == 0


def test_roots():
    """What was passed over, the cell found and t itself are within their bounds; in some rounding did decide."""
    over, positive, other, error = checked(errors.root_rows(1500, 1))
    assert over[2] > 100
    assert over[4] > 0.5
    assert positive[2] == other[2] > 10_000
    assert positive[4] > 0.5
    assert other[4] == 0
    assert error[2] > 5_000
    assert 0.5 < error[4] <= 2


def test_resolution():
    """Between two roots in one cell f is not higher than the bound, and nearly as high."""
    quartic, quadratic = checked(errors.resolution_rows(4000, 1))
    assert quartic[4] > quartic[3] / 4
    assert quadratic[4] > 0.85 * quadratic[3]


@pytest.mark.parametrize("change", ["lost", "moved"])
def test_roots_would_be_refuted(monkeypatch, change):
    """Hits that are taken away, or moved by three cells, are more than rounding does."""

    def broken(segments, config):
        t, steps = trace_segments(segments, config)
        t[::7, 0] = -1 if change == "lost" else np.minimum(t[::7, 0] + 3, (1 << config.digits) - 1)
        return t, steps

    trace_segments = errors.trace_segments
    monkeypatch.setattr(errors, "trace_segments", broken)
    refuted = [bad for _, bad in errors.root_rows(300, 1)]
    assert refuted[0] if change == "lost" else any(refuted[1:])


def test_indicator():
    """The evaluator is within epsilon of the exact indicator, and a twentieth of it is reached."""
    (row,) = checked(errors.indicator_rows(200, 1))
    assert row[2] > 100
    assert row[4] > 0.02


@pytest.mark.parametrize("n1", [1, 2, 3, 4])
def test_bound_does_not_grow_with_steps(n1):
    """The bound of the halving converges: a third of the digits more adds next to nothing."""
    assert halving(n1, 32 // n1, 4, 36) - halving(n1, 24 // n1, 4, 36) < 1e-3
    assert halving(n1, 24 // n1, 2, 36) < halving(n1, 24 // n1, 4, 36) < 17


def test_part_of_a_polynomial():
    """Control points on a part of the segment are the exact ones: values at its ends, the whole on the whole."""
    b = [3, -5, 7, 2, -9]
    assert error_measure.part(b, 0, 1) == b
    left = error_measure.part(b, errors_half := error_measure.Fraction(1, 4), error_measure.Fraction(1, 2))
    assert left[0] == error_measure.polynomial(b, errors_half)
    assert left[-1] == error_measure.polynomial(b, error_measure.Fraction(1, 2))


def test_wide_words_have_smaller_errors():
    """The bound counts in units of the control points: more bits, the same number."""
    dice = np.random.default_rng(1)
    for width in (36, 40):
        config = Config(width=width, units=1)
        b = dice.integers(-(2 ** (width - 1)), 2 ** (width - 1), 5)
        bound, low, high = error_measure.halving_error(b, int(dice.integers(0, 1 << 24)), config)
        assert low >= 0
        assert bound == halving(3, 8, 4, width)
        assert high <= bound + 1  # any path, not only one that is followed: cells without a root are not normalised
