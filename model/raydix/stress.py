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
from .error_bounds import coordinates, halving
from .exact import changes, extrema
from .formats import COORD_FRAC, STEPS_MAX
from .oracle_spiral import spiral_value
from .rounding import bernstein, explained
from .segments import Segments, whole
from .stress_clip import CATEGORIES as CLIP

SAMPLES = 65  # between two roots of a spiral
WELL = 1.5  # ulp beyond its root within which f of a well-conditioned ray is lower than rounding reaches


class Judged(NamedTuple):
    """N items against the exact roots.

    hit, missed, false, wrong   (N) bool. missed: a root and nothing found; wrong: f turns between the first root and
          what was found, so that this belongs to another root
    band    (N) bool, of those three, or given up: rounding explains it (`rounding.explained`), by f on what was passed
          over and at the cell that was found
    off     (N) bool, none of those three, but not explained, or a well-conditioned root that is off by more than 2 ulp
    error   (N) float64, ulp of t from the first exact root, nan where nothing is to be compared
    well    (N) bool, the first root is well-conditioned: rounding cannot move it by more than `WELL` ulp
    given_up  (N) bool, no root found in as many steps as can be counted: told, so none of missed, false, wrong
    """

    hit: np.ndarray
    missed: np.ndarray
    false: np.ndarray
    wrong: np.ndarray
    band: np.ndarray
    off: np.ndarray
    error: np.ndarray
    well: np.ndarray
    given_up: np.ndarray

    @property
    def failed(self) -> np.ndarray:
        """missed, false or wrong, outside of the band; or off; or given up, though there is a root outside of it."""
        return (self.missed | self.false | self.wrong | self.given_up & self.hit) & ~self.band | self.off


def categories(degree: int, each: bool = False) -> dict:
    """Names of the categories of algebraic items -> function of (Generator, count, Config) that yields Segments.

    each   those that are one level or one distance of another one
    """

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

    polynomials = stress_polynomials.EACH if each else stress_polynomials.CATEGORIES
    named = {name: words(make) for name, make in polynomials.items()}
    if degree == 4 and not each:  # some of the surfaces are quartics
        named |= {name: rays(make) for name, make in stress_rays.CATEGORIES.items()} | CLIP
    return named


def resolved(exact: np.ndarray, digits: int) -> np.ndarray:
    """Exact changes (N, M) without the pairs that lie in one cell of the last level, which its ends cannot show."""
    cell = np.floor(exact * 2.0**digits)
    out = exact.copy()
    for i in np.flatnonzero((np.diff(cell, axis=1) == 0).any(axis=1)):
        kept: list[tuple[float, float]] = []
        for t, c in zip(exact[i], cell[i], strict=True):
            if kept and kept[-1][1] == c:
                kept.pop()
            elif not np.isnan(t):
                kept.append((t, c))
        out[i] = [t for t, _ in kept] + [np.nan] * (exact.shape[1] - len(kept))
    return out


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
    every = changes(segments.b) if exact is None else exact
    exact = resolved(every, digits)
    sure, possible = places(segments, exact, digits)
    found, count = t >= 0, np.arange(len(t))
    hit: np.ndarray = np.any(sure, axis=1)
    first = np.where(hit, sure.argmax(axis=1), exact.shape[1])
    allowed = possible & (np.arange(exact.shape[1]) <= first[:, None])
    away = np.abs((t[:, None] + 0.5) - exact / ulp)
    near = np.where(allowed, away, np.inf)
    which = near.argmin(axis=1)
    error = np.where(found & allowed.any(axis=1), near[count, which], np.nan)
    missed = hit & ~found
    false = found & ~allowed.any(axis=1)
    # f beyond the root, on the side where it is not positive
    root = exact[count, which]
    rounding = halving(config.n1, config.steps, config.degree, config.width)
    beyond = [bernstein(segments.b, np.clip(root + side * WELL * ulp, 0, 1)) for side in (-1, 1)]
    well = np.minimum(*beyond) <= -rounding
    wrong = np.zeros(len(t), bool)
    for i in np.flatnonzero(error > 2):
        low, top = sorted((root[i], (t[i] + 0.5) * ulp))
        wrong[i] = any(low < place < top for place, _ in extrema(segments.b[i].tolist()))
    good = explained(segments, t, every, config)
    bad = missed | false | wrong
    off = ~bad & (~good | (well & (error > 2)))
    error = np.where(wrong, np.nan, error)
    return Judged(hit, missed, false, wrong, bad & good, off, error, well, np.zeros(len(t), bool))


def judge_spiral(surface, compiled: Compiled, found: Chords, exact: np.ndarray, clearance: np.ndarray, config: Config):
    """First roots of chords through a spiral against exact ones (N, M), nan-padded, with their clearance: Judged."""
    ulp = 2.0**-config.digits
    every, exact = exact, seen(surface, compiled, exact, config.digits)
    t, steps = found.t[:, 0], found.steps
    row, hit = np.arange(len(t)), ~np.isnan(exact[:, 0])
    given_up = (t < 0) & (steps == STEPS_MAX)
    # the first root that must be seen, and those before it that rounding may show or not
    first = np.where(hit, exact[:, 0], np.inf)
    away = np.abs((t[:, None] + 0.5) - every / ulp)
    allowed = every <= first[:, None]
    near = np.where(allowed, away, np.inf)
    which = near.argmin(axis=1)
    error = np.where((t >= 0) & allowed.any(axis=1), near[row, which], np.nan)
    nearest = np.where(np.isnan(away), np.inf, away).argmin(axis=1)
    length = np.linalg.norm(compiled.e - compiled.h, axis=1)
    slope = slopes(surface, compiled.h, compiled.e, np.where(allowed.any(axis=1), every[row, which], 0.0))
    well = compiled.epsilon <= WELL * ulp * length * slope
    wrong = ~allowed[row, nearest] & (error > 64) | well & (error > 2)
    missed, false = hit & (t < 0) & ~given_up, ~allowed.any(axis=1) & (t >= 0)
    bad = missed | false | wrong
    rows = np.flatnonzero(bad | given_up | (first < t * ulp))
    passed = spiral_passed(surface, compiled, t, every, exact, rows, config.digits)
    cell = np.stack([spiral_value(surface, at(compiled, (t + k) * ulp)) for k in (0, 1)])
    there = (cell.min(axis=0) <= compiled.epsilon) & (cell.max(axis=0) > -compiled.epsilon) | (t < 0)
    off = ~bad & ~given_up & ~(passed & there)
    # where the clearance is epsilon at least nothing can be explained
    band = (clearance < compiled.epsilon) & (bad | given_up) & passed & there
    return Judged(hit, missed, false, wrong, band, off, np.where(wrong, np.nan, error), well, given_up)


def seen(surface, compiled: Compiled, exact: np.ndarray, digits: int) -> np.ndarray:
    """Exact roots (N, M) of chords without those that the ends of cells of the last level need not show.

    Two in one cell (`resolved`); two in neighbouring cells, or one in the first or last cell, where the indicator at
    the boundary between them, or at the end of the chord, is within epsilon.
    """
    out, last = resolved(exact, digits), (1 << digits) - 1

    def unsure(i, boundary):
        point = compiled.h[i] + boundary * 2.0**-digits * (compiled.e[i] - compiled.h[i])
        return abs(float(spiral_value(surface, point))) < compiled.epsilon

    cell = np.floor(out * 2.0**digits)
    with np.errstate(invalid="ignore"):
        rows = (np.diff(cell, axis=1) == 1).any(axis=1) | ((cell == 0) | (cell == last)).any(axis=1)
    for i in np.flatnonzero(rows):
        kept = [(float(t), int(c)) for t, c in zip(out[i], cell[i], strict=True) if not np.isnan(t)]
        if kept and kept[0][1] == 0 and unsure(i, 0):
            kept.pop(0)
        if kept and kept[-1][1] == last and unsure(i, last + 1):
            kept.pop()
        k = 0
        while k + 1 < len(kept):
            if kept[k + 1][1] == kept[k][1] + 1 and unsure(i, kept[k + 1][1]):
                del kept[k : k + 2]
            else:
                k += 1
        out[i] = [t for t, _ in kept] + [np.nan] * (out.shape[1] - len(kept))
    return out


def at(compiled: Compiled, t: np.ndarray) -> np.ndarray:
    """Points (N, 3) of the chords at t (N)."""
    return compiled.h + t[:, None] * (compiled.e - compiled.h)


def spiral_passed(surface, compiled: Compiled, t, every: np.ndarray, exact: np.ndarray, rows: np.ndarray, digits: int):
    """(N) bool, False only in ``rows``: the indicator stays above -epsilon, or below epsilon, on what was passed over.

    It is sampled `SAMPLES` times between each two roots (``every``) that must be seen (``exact``, see `seen`), and of
    cells that hide some at the borders only.
    """
    good = np.ones(len(t), bool)
    for i in rows:
        stop = 1.0 if t[i] < 0 else t[i] * 2.0**-digits
        marks = [0.0, *(r for r in exact[i] if r < stop), stop]
        x = np.concatenate([np.linspace(a, b, SAMPLES) for a, b in zip(marks, marks[1:], strict=False)])
        hidden = np.floor(np.setdiff1d(every[i], exact[i]) * 2.0**digits)  # nan among them hides nothing
        borders = np.concatenate([hidden, hidden + 1]) * 2.0**-digits
        x = np.concatenate([x[~np.isin(np.floor(x * 2.0**digits), hidden)], borders[borders <= stop]])
        f = spiral_value(surface, compiled.h[i] + x[:, None] * (compiled.e[i] - compiled.h[i]))
        good[i] = len(f) == 0 or f.min() > -compiled.epsilon or f.max() < compiled.epsilon
    return good


def batches(make, count: int, config: Config, seed: int, size: int = 100_000) -> Iterator[Segments]:
    """Segments of a category in batches of ``size``, each with a seed of its own."""
    for number, start in enumerate(range(0, count, size)):
        yield from make(np.random.default_rng([seed, number]), min(size, count - start), config)
