# SPDX-License-Identifier: Apache-2.0
"""Segments as the descent gets them, and the golden model on them: for studies apart from any picture."""

from typing import NamedTuple

import numpy as np

from .config import Config
from .core import scratch
from .formats import COORD_FRAC, DEPTH_WIDTH
from .item import BOX, DEPTH, PAPER, ROOTS, STEPS, B, C
from .kernel import kernel
from .product import product
from .ring import trace


class Segments(NamedTuple):
    """N segments as the descent gets them.

    b     (N, degree + 1) int64, control points sWp0
    ends  (N, 6) int64, coordinates at h, then at e, s2p30
    box   (3) box exponents, 0: no face
    """

    b: np.ndarray
    ends: np.ndarray
    box: tuple[int, ...] = (0, 0, 0)


def whole(count: int) -> np.ndarray:
    """Coordinates of segments without a box: from 0 to the largest."""
    return np.tile(np.array([0, 0, 0, *[(1 << COORD_FRAC) - 1] * 3], np.int64), (count, 1))


def products(quads: np.ndarray, quartic: bool, config: Config) -> np.ndarray:
    """Control points (N, degree + 1) of accumulators (N, 9): Q3, Q1, Q2 at (h,h), (h,e), (e,e)."""
    b = np.zeros((len(quads), config.degree + 1), np.int64)
    _products(quads, quartic, b, config.width, config.degree)
    return b


@kernel
def _products(quads, quartic, b, width, degree):
    for i in range(len(quads)):
        product(quads[i], quartic, b[i], 0, width, degree)


def trace_segments(segments: Segments, config: Config, roots: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """The golden model on segments: t (N, roots) int64, -1 = none, and steps (N)."""
    count = len(segments.b)
    t, steps = np.full(count * roots, -1, np.int64), np.zeros(count, np.int64)
    depth, enters = np.zeros(count * roots, np.int64), np.zeros(count * roots, np.int64)
    point = np.zeros((count * roots, 3), np.int64)
    _, item, first, _, work = scratch(config, config.degree)
    first[DEPTH], first[DEPTH + 1] = 0, (1 << (DEPTH_WIDTH - 1)) - 1
    item[PAPER] = config.rule == "paper"
    item[BOX : BOX + 3] = segments.box
    parameters = roots, config.n1, config.steps, config.width, config.degree
    _run(segments.b, segments.ends, *parameters, item, first, work, t, depth, point, enters, steps)
    return t.reshape(count, roots), steps


@kernel
def _run(b, ends, roots, n1, count, width, degree, item, first, work, t, depth, point, enters, steps):
    for i in range(len(b)):
        for k in range(6):
            first[C + k] = ends[i, k]
        for k in range(degree + 1):
            first[B + k] = b[i, k]
        item[ROOTS] = roots
        # the last of the parameters: the constants of a vector sum, which is not asked for
        trace(item, first, b[i], work, n1, count, width, degree, 0, t, depth, point, enters, i * roots)
        steps[i] = item[STEPS]
