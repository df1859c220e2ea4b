# SPDX-License-Identifier: Apache-2.0
"""Random chords through one surface: how often a rule misses a root or finds a later one.

A study of the method apart from any picture: the golden model's product and ring on arbitrary segments h to e,
and the paper's rule in float64 with the true distance as its indicator.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .config import Config
from .segments import Segments, products, trace_segments, whole
from .surfaces import Form, form

QUAD_SCALE = 2.0**61  # largest accumulator of Q1 and Q2 among the chords, and of Q3 as far as the product allows
PRODUCT_SCALE = 2.0**-66


class Rates(NamedTuple):
    """Chords that hit; and of them, as fractions: found none, found a root that is not the first; steps per chord."""

    chords: int
    missed: float
    wrong: float
    false: int
    steps_per_hit: float
    steps_per_miss: float


def random_chords(count: int, radius: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Ends h, e (count, 3) of chords between points spread evenly over a sphere around the origin."""
    points = np.random.default_rng(seed).normal(size=(2, count, 3))
    points *= radius / np.linalg.norm(points, axis=2, keepdims=True)
    return points[0], points[1]


def _blossom(q: np.ndarray, p: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Polar form of a quadric (ten coefficients) at points (N, 3)."""
    xx, yy, zz, xy, yz, zx, x, y, z, one = q
    square = xx * p[:, 0] * s[:, 0] + yy * p[:, 1] * s[:, 1] + zz * p[:, 2] * s[:, 2]
    mixed = xy * (p[:, 0] * s[:, 1] + p[:, 1] * s[:, 0]) + yz * (p[:, 1] * s[:, 2] + p[:, 2] * s[:, 1])
    mixed += zx * (p[:, 2] * s[:, 0] + p[:, 0] * s[:, 2])
    return square + (mixed + (p + s) @ np.array([x, y, z])) / 2 + one


def chord_quads(shape: Form, h: np.ndarray, e: np.ndarray) -> np.ndarray:
    """Accumulators (N, 9), int64, of Q3, Q1, Q2 at (h,h), (h,e), (e,e): what the raster would give."""

    def points(q):
        values = np.array([float(v) for v in q])
        return np.stack([_blossom(values, h, h), _blossom(values, h, e), _blossom(values, e, e)], axis=1)

    q3 = points(shape.q3)
    if shape.q1 is None:
        out = np.zeros((len(h), 9))
        out[:, :3] = q3 * (2.0**60 / np.abs(q3).max())
        return out.astype(np.int64)
    q1, q2 = points(shape.q1), points(shape.q2)
    f1, f2 = QUAD_SCALE / np.abs(q1).max(), QUAD_SCALE / np.abs(q2).max()
    less = min(1.0, np.sqrt(2.0**59 / (np.abs(q3).max() * f1 * f2 * PRODUCT_SCALE)))
    f1, f2 = f1 * less, f2 * less
    return np.concatenate([q3 * (f1 * f2 * PRODUCT_SCALE), q1 * f1, q2 * f2], axis=1).astype(np.int64)


def chord_items(surface, h: np.ndarray, e: np.ndarray, config: Config) -> Segments:
    """Chords (N, 3) through an algebraic surface, all in one scale, without a box."""
    shape = form(surface)
    return Segments(products(chord_quads(shape, h, e), shape.q1 is not None, config), whole(len(h)))


def trace_chords(quads: np.ndarray, quartic: bool, config: Config, roots: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """The golden model on chords: t (N, roots) int64, -1 = none, and steps (N)."""
    return trace_segments(Segments(products(quads, quartic, config), whole(len(quads))), config, roots)


def rates(t: np.ndarray, exact: np.ndarray, digits: int, steps: np.ndarray | None = None) -> Rates:
    """Judge first roots ``t`` (N) int64 against exact roots (N, 4), nan-padded.

    A root is the wrong one if a later exact root is nearer to it than the first and the first is over 16 ulp away.
    """
    hit = ~np.isnan(exact[:, 0])
    found = t >= 0
    value = (t + 0.5) * 2.0**-digits
    off = np.abs(exact - value[:, None])
    nearest = np.argmin(np.where(np.isnan(off), np.inf, off), axis=1)
    wrong = hit & found & (nearest > 0) & (off[:, 0] > 16 * 2.0**-digits)

    def mean(mask):
        return float(steps[mask].mean()) if steps is not None and mask.any() else float("nan")

    return Rates(
        int(hit.sum()),
        float((hit & ~found).sum() / hit.sum()),
        float(wrong.sum() / hit.sum()),
        int((found & ~hit).sum()),
        mean(hit),
        mean(~hit),
    )


def paper_float(
    indicator: Callable[[np.ndarray], np.ndarray], h: np.ndarray, e: np.ndarray, n1: int, steps: int
) -> np.ndarray:
    """The paper's rule in float64 with any indicator of points (…, 3): digits of t (N), -1 = miss.

    Follows the text of the paper, section 3; opaque: the first cell with a sign change.
    """
    count, cells = len(h), 1 << n1
    t, seen = np.zeros(count), np.zeros(count, bool)
    lane = np.arange(count)
    for k in range(1, steps + 1):
        size = 2.0 ** (-n1 * k)
        at = t[:, None] + np.arange(cells + 1) * size
        r = indicator(h[:, None] + at[..., None] * (e - h)[:, None])
        change = (r[:, 1:] > 0) != (r[:, :-1] > 0)
        two = change.any(axis=1)
        low = np.abs(r).argmin(axis=1)
        second = np.abs(np.diff(r, axis=1))
        right, left = second[lane, np.minimum(low, cells - 1)], second[lane, np.maximum(low - 1, 0)]
        guess = np.where((low == 0) | ((low < cells) & (right <= left)), low, low - 1)
        t = t + np.where(two, change.argmax(axis=1), guess) * size
        seen |= two
    return np.where(seen, np.rint(t * 2.0 ** (n1 * steps)), -1).astype(np.int64)
