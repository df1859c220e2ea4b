# SPDX-License-Identifier: Apache-2.0
"""Stress of the descent: items of named categories through the golden model, judged by the exact roots of their words.

A study of the method apart from any picture. The table that it gives is that of docs/stress.md.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from . import stress_polynomials, stress_rays
from .chords import chord_items
from .chords_spiral import Chords, Compiled, slopes
from .config import Config
from .error_bounds import coordinates, halving, resolution
from .exact import changes, extrema
from .formats import COORD_FRAC, STEPS_MAX
from .segments import Segments, whole
from .stress_clip import CATEGORIES as CLIP

WELL = 1.5  # ulp beyond its root within which f of a well-conditioned ray is lower than rounding reaches


class Judged(NamedTuple):
    """N items against the exact roots.

    hit, missed, false, wrong   (N) bool. missed: a root and nothing found; wrong: f turns between the first root and
          what was found, so that this belongs to another root
    band    (N) bool, of those three: an extremum or end of f is so near to 0 that rounding may decide,
          or two roots are less than an ulp apart
    error   (N) float64, ulp of t from the first exact root, nan where nothing is to be compared
    well    (N) bool, the first root is well-conditioned: rounding cannot move it by more than `WELL` ulp
    given_up  (N) bool, no root found in as many steps as can be counted; none of missed, false, wrong
    """

    hit: np.ndarray
    missed: np.ndarray
    false: np.ndarray
    wrong: np.ndarray
    band: np.ndarray
    error: np.ndarray
    well: np.ndarray
    given_up: np.ndarray

    @property
    def failed(self) -> np.ndarray:
        """missed, false or wrong, outside of the band."""
        return (self.missed | self.false | self.wrong) & ~self.band


def categories(degree: int) -> dict:
    """Names of the categories of algebraic items -> function of (Generator, count, Config) that yields Segments."""

    def words(make):
        def items(dice, count, config):
            b = stress_polynomials.fitted(make(dice, count, config.degree), config.width)
            yield Segments(b, whole(count))

        return items

    def rays(make):
        def items(dice, count, config):
            for surface, h, e in make(dice, count):
                yield chord_items(surface, h, e, config)

        return items

    named = {name: words(make) for name, make in stress_polynomials.CATEGORIES.items()}
    if degree == 4:  # some of the surfaces are quartics
        named |= {name: rays(make) for name, make in stress_rays.CATEGORIES.items()} | CLIP
    return named


def resolved(exact: np.ndarray, digits: int) -> np.ndarray:
    """Exact changes (N, M) without the pairs that lie in one cell of the last level, which its ends cannot show."""
    cell = np.floor(exact * 2.0**digits)
    out = exact.copy()
    for i in np.flatnonzero((np.diff(cell, axis=1) == 0).any(axis=1)):
        kept = []
        for t, c in zip(exact[i], cell[i], strict=True):
            if kept and kept[-1][1] == c:
                kept.pop()
            elif not np.isnan(t):
                kept.append((t, c))
        out[i] = [t for t, _ in kept] + [np.nan] * (exact.shape[1] - len(kept))
    return out


def bernstein(b: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Polynomials (N, degree + 1) at t (N), float64."""
    degree = b.shape[1] - 1
    total, power, binomial = np.zeros(len(b)), np.ones(len(b)), 1.0
    for i in range(degree + 1):
        total = total * (1 - t) + binomial * power * b[:, i]
        power = power * t
        binomial = binomial * (degree - i) / (i + 1)
    return total


def places(segments: Segments, exact: np.ndarray, digits: int) -> tuple[np.ndarray, np.ndarray]:
    """Whether each exact root (N, M) is certainly inside of the box, and whether it may be."""
    known = ~np.isnan(exact)
    sure, possible = known.copy(), known.copy()
    for axis in range(3):
        if segments.box[axis] == 0:
            continue
        start, stop = (segments.ends[:, k + axis, None].astype(float) for k in (0, 3))
        face = 2.0 ** (COORD_FRAC + 1 - segments.box[axis])
        at = start + exact * (stop - start)
        margin = 2 * 2.0**-digits * np.abs(stop - start) + coordinates(digits) + 1
        sure &= np.abs(at) < face - margin
        possible &= np.abs(at) < face + margin
    return sure, possible


def judge(segments: Segments, t: np.ndarray, config: Config, exact: np.ndarray | None = None) -> Judged:
    """First roots t (N) int64, -1 = none, against the changes of the words (N, degree + 1), computed if not given."""
    digits = config.digits
    ulp = 2.0**-digits
    exact = changes(segments.b) if exact is None else exact
    with np.errstate(invalid="ignore"):
        together = (np.diff(exact, axis=1) < ulp).any(axis=1)
    exact = resolved(exact, digits)
    sure, possible = places(segments, exact, digits)
    found, count = t >= 0, np.arange(len(t))
    first = np.where(sure.any(axis=1), sure.argmax(axis=1), exact.shape[1])
    allowed = possible & (np.arange(exact.shape[1]) <= first[:, None])
    off = np.abs((t[:, None] + 0.5) - exact / ulp)
    near = np.where(allowed, off, np.inf)
    which = near.argmin(axis=1)
    error = np.where(found & allowed.any(axis=1), near[count, which], np.nan)
    missed = sure.any(axis=1) & ~found
    false = found & ~allowed.any(axis=1)
    # f beyond the root, on the side where it is not positive
    root = exact[count, which]
    rounding = halving(config.n1, config.steps, config.degree)
    beyond = [bernstein(segments.b, np.clip(root + side * WELL * ulp, 0, 1)) for side in (-1, 1)]
    well = np.minimum(*beyond) <= -rounding
    wrong, band = np.zeros((2, len(t)), bool)
    high = max(resolution(digits, config.degree, config.width), 2.0**-10)
    for i in np.flatnonzero(missed | false | (error > 2)):
        b = segments.b[i].tolist()
        peaks = extrema(b)
        low, top = sorted((root[i], (t[i] + 0.5) * ulp))
        wrong[i] = error[i] > 2 and any(low < place < top for place, _ in peaks)
        band[i] = together[i] or any(-rounding <= v <= high for v in (b[0], b[-1], *(v for _, v in peaks)))
    error = np.where(wrong, np.nan, error)
    return Judged(sure.any(axis=1), missed, false, wrong, band, error, well, np.zeros(len(t), bool))


def judge_spiral(surface, compiled: Compiled, found: Chords, exact: np.ndarray, clearance: np.ndarray, config: Config):
    """First roots of chords through a spiral against exact ones (N, M), nan-padded, with their clearance: Judged."""
    ulp = 2.0**-config.digits
    t, steps = found.t[:, 0], found.steps
    hit, band = ~np.isnan(exact[:, 0]), clearance < compiled.epsilon
    given_up = (t < 0) & (steps == STEPS_MAX)
    off = np.abs((t[:, None] + 0.5) - exact / ulp)
    error = np.where(hit & (t >= 0), off[:, 0], np.nan)
    nearest = np.where(np.isnan(off), np.inf, off).argmin(axis=1)
    length = np.linalg.norm(compiled.e - compiled.h, axis=1)
    slope = slopes(surface, compiled.h, compiled.e, np.where(hit, exact[:, 0], 0.0))
    well = compiled.epsilon <= WELL * ulp * length * slope
    wrong = (nearest > 0) & (error > 64)
    missed, false = hit & (t < 0) & ~given_up, ~hit & (t >= 0)
    return Judged(hit, missed, false, wrong, band, np.where(wrong, np.nan, error), well, given_up)


def batches(make, count: int, config: Config, seed: int, size: int = 100_000) -> Iterator[Segments]:
    """Segments of a category in batches of ``size``, each with a seed of its own."""
    for number, start in enumerate(range(0, count, size)):
        yield from make(np.random.default_rng([seed, number]), min(size, count - start), config)
