# SPDX-License-Identifier: Apache-2.0
"""Random chords through spirals: the golden model on arbitrary segments, judged against given roots.

A study of the method apart from any picture, as ``chords.py`` for algebraic surfaces.
"""

import random
from typing import NamedTuple

import mpmath as mp
import numpy as np
from pydantic import ValidationError

from .compile import PRECISION
from .compile_spiral import epsilon, form_words, needs_general, tube_of
from .config import Config
from .core import scratch
from .ends import ends
from .formats import COORD_FRAC, DEPTH_WIDTH, VECTOR_WIDTH
from .item import DEPTH, PAPER, ROOTS, STEPS, C
from .kernel import kernel, words
from .ring import trace
from .scene import Spiral
from .spiral import gradient
from .surfaces import bounding_box


def spiral_config(surface, n1: int = 3, steps: int = 8, rule: str = "certified") -> Config:
    """The smallest configuration that has the evaluator of a spiral."""
    vecsum = "general" if needs_general(surface) else "helix"
    return Config(n1, steps, units=1, degree=0, vecsum=vecsum, rule=rule)


class Chords(NamedTuple):
    """What the golden model found on N chords.

    t      (N, roots) int64, -1 = none
    steps  (N) int64
    """

    t: np.ndarray
    steps: np.ndarray


def random_spiral(dice: random.Random) -> Spiral:
    """Any spiral of the family: helices, rings, cones, flat spirals, shells, parts of a turn; either hand."""
    while True:
        kind = dice.choice(("helix", "ring", "part", "cone", "flat", "shell", "any"))
        R, turns = dice.uniform(0.3, 1.2), dice.uniform(1, 6)
        pitch = dice.choice((-1, 1)) * dice.uniform(0.05, 1.0)
        grow, swell = dice.uniform(-0.3, 0.6), dice.uniform(-0.1, 0.3)
        keys = {
            "helix": {"pitch": pitch, "turns": turns},
            "ring": {"pitch": 0, "turns": dice.choice((1, dice.uniform(0.1, 1)))},
            "part": {"pitch": pitch, "turns": dice.uniform(0.1, 1), "R_growth": grow, "r_growth": swell},
            "cone": {"pitch": pitch, "turns": turns, "R_growth": -R * dice.uniform(0.1, 0.9) / turns},
            "flat": {"pitch": 0, "turns": turns, "R_growth": grow},
            "shell": {"pitch": pitch, "turns": turns, "R_growth": abs(grow), "r_growth": abs(swell)},
            "any": {"pitch": pitch, "turns": turns, "R_growth": grow, "r_growth": swell},
        }[kind]
        try:
            return Spiral.model_validate({"type": "spiral", "R": R, "r": R * dice.uniform(0.03, 0.9), **keys})
        except ValidationError:
            continue


def box_of(surface) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corner (3) of the surface's box, float64."""
    low, high = (np.array([float(v) for v in corner]) for corner in bounding_box(surface))
    return low, high


def chords_through(surface, count: int, seed: int, size: float = 1.2) -> tuple[np.ndarray, np.ndarray]:
    """Ends h, e (count, 3) of chords between points spread evenly over ``size`` times the sphere about the box."""
    low, high = box_of(surface)
    points = np.random.default_rng(seed).normal(size=(2, count, 3))
    points *= size * np.linalg.norm(high - low) / 2 / np.linalg.norm(points, axis=2, keepdims=True)
    return points[0] + (low + high) / 2, points[1] + (low + high) / 2


class Compiled(NamedTuple):
    """N chords through a spiral as words.

    form         constants of the surface, int64
    coordinates  (N, 6) int64, x, y, z at h, then at e
    h, e         (N, 3) float64, the ends as the words have them
    epsilon      bound of the evaluator's error in local units
    factors      of the axes, mpmath numbers: word = 2^30 * factor * (local - origin)
    middle       z of that origin, whose x and y are 0
    """

    form: np.ndarray
    coordinates: np.ndarray
    h: np.ndarray
    e: np.ndarray
    epsilon: float
    factors: tuple[mp.mpf, ...]
    middle: mp.mpf


def compile_chords(surface, h: np.ndarray, e: np.ndarray, config: Config) -> Compiled:
    """Words of chords with the ends ``h``, ``e`` (N, 3) in local coordinates."""
    low, high = box_of(surface)
    with mp.workprec(PRECISION):
        both = np.concatenate([h, e])
        corners = [mp.matrix([float(v) for v in corner]) for corner in (both.min(axis=0), both.max(axis=0))]
        length = float(np.linalg.norm(e - h, axis=1).max())
        form, middle, factors = form_words(surface, corners, length, low, high, (False,) * 3, config.n1)
        error = float(epsilon(tube_of(surface), factors[0], config.digits) / factors[0])
    factor = np.array([float(f) for f in factors])
    origin = np.array([0, 0, float(middle)])
    scale = factor * 2.0**COORD_FRAC
    integers = [np.rint((v - origin) * scale).astype(np.int64) for v in (h, e)]
    h, e = (v / scale + origin for v in integers)
    return Compiled(words(form), np.concatenate(integers, axis=1), h, e, error, factors, middle)


def trace_spiral(compiled: Compiled, config: Config, roots: int = 1) -> Chords:
    """The golden model on compiled chords."""
    count = len(compiled.coordinates)
    t = np.full(count * roots, -1, np.int64)
    depth, enters = np.zeros(count * roots, np.int64), np.zeros(count * roots, np.int64)
    point = np.zeros((count * roots, 3), np.int64)
    steps = np.zeros(count, np.int64)
    _, item, first, _, work = scratch(config, 1)
    first[DEPTH], first[DEPTH + 1] = 0, (1 << (DEPTH_WIDTH - 1)) - 1
    item[PAPER] = config.rule == "paper"
    parameters = roots, config.n1, config.steps, int(config.vecsum == "general")
    _run(compiled.coordinates, compiled.form, *parameters, item, first, work, t, depth, point, enters, steps)
    return Chords(t.reshape(count, roots), steps)


@kernel
def _run(coordinates, form, roots, n1, count, general, item, first, work, t, depth, point, enters, steps):
    for i in range(len(coordinates)):
        for k in range(6):
            first[C + k] = coordinates[i, k]
        ends(first, work.lanes, form, general)
        item[ROOTS] = roots
        trace(item, first, form, work, n1, count, VECTOR_WIDTH, 1, general, t, depth, point, enters, i * roots)
        steps[i] = item[STEPS]


def slopes(surface, h: np.ndarray, e: np.ndarray, t: np.ndarray) -> np.ndarray:
    """|cosine| between chord and normal at parameters ``t`` (N) float64: how steeply the chord enters."""
    direction = e - h
    normal = gradient(surface, h + t[:, None] * direction)
    length = np.linalg.norm(normal, axis=1) * np.linalg.norm(direction, axis=1)
    return np.abs((normal * direction).sum(axis=1)) / np.where(length > 0, length, 1)


class Judged(NamedTuple):
    """First roots of N chords against exact ones; those of less clearance than epsilon are left out of all counts.

    error, slope  of the chords that hit and were found: ulp of t, and :func:`slopes`
    wrong         a later root is nearer to what was found than the first, which is over 64 ulp away
    """

    chords: int
    left_out: int
    hit: int
    missed: int
    false: int
    wrong: int
    error: np.ndarray
    slope: np.ndarray
    steps_hit: np.ndarray
    steps_miss: np.ndarray


def judge(surface, compiled: Compiled, chords: Chords, exact: np.ndarray, clearance: np.ndarray, digits: int) -> Judged:
    """Judge against exact roots (N, M) float64, nan-padded, with their clearance (N), local units."""
    found, hit, kept = chords.t[:, 0], ~np.isnan(exact[:, 0]), clearance >= compiled.epsilon
    both = kept & hit & (found >= 0)
    at = (found[both] + 0.5) * 2.0**-digits
    off = np.abs(exact[both] - at[:, None]) * 2.0**digits
    nearest = np.nanargmin(off, axis=1) if both.any() else np.zeros(0, int)
    return Judged(
        len(found),
        int((~kept).sum()),
        int((kept & hit).sum()),
        int((kept & hit & (found < 0)).sum()),
        int((kept & ~hit & (found >= 0)).sum()),
        int(((nearest > 0) & (off[:, 0] > 64)).sum()),
        off[:, 0],
        slopes(surface, compiled.h[both], compiled.e[both], exact[both, 0]),
        chords.steps[kept & hit],
        chords.steps[kept & ~hit],
    )
