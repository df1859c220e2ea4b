# SPDX-License-Identifier: Apache-2.0
"""Stress categories of spirals: chords where the evaluator, its bounds or the geometry are known to be difficult.

Each function takes a numpy Generator and a number of chords and yields parts ``(surface, h, e)``: a spiral and the ends
of chords (N, 3) in its local coordinates, float64.
"""

import random
from collections.abc import Iterator

import numpy as np

from .chords_spiral import box_of, chords_through, random_spiral
from .scene import Spiral
from .spiral import gradient

Part = tuple[Spiral, np.ndarray, np.ndarray]
SHARE = 2_000  # chords of a part


def _parts(dice, count, make) -> Iterator[Part]:
    """``make(surface, n)`` gives chords; a surface None stands for any spiral of the family."""
    for start in range(0, count, SHARE):
        yield make(_spiral(dice), min(SHARE, count - start))


def _spiral(dice) -> Spiral:
    return random_spiral(random.Random(int(dice.integers(1 << 40))))


def _directions(dice, count):
    d = dice.normal(size=(count, 3))
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def _off(dice, count, scale, low=4, high=36):
    return (
        scale
        * _directions(dice, count)
        * 2.0 ** -dice.uniform(low, high, (count, 1))
        * (dice.random((count, 1)) < 0.67)
    )


def _size(surface):
    low, high = box_of(surface)
    return float(np.linalg.norm(high - low)) / 2


def tube_points(surface, s, tilt, depth=1.0):
    """Points (N, 3) of the tube at s turns, at an angle about the centre curve; depth 0 to 1 of its radius."""
    a, r = surface.R + surface.R_growth * s, (surface.r + surface.r_growth * s) * depth
    rho = a + r * np.cos(tilt)
    return np.stack(
        [rho * np.cos(2 * np.pi * s), rho * np.sin(2 * np.pi * s), surface.pitch * s + r * np.sin(tilt)], axis=1
    )


def _through(dice, surface, points, directions=None):
    """Chords through points, in any direction, each a random part of twice the size of the surface long."""
    d = _directions(dice, len(points)) if directions is None else directions
    length = dice.uniform(0.3, 1, (2, len(points), 1)) * 2 * _size(surface)
    return points - d * length[0], points + d * length[1]


def anywhere(dice, count):
    """Any chord through any spiral."""

    def make(surface, n):
        return surface, *chords_through(surface, n, int(dice.integers(1 << 40)))

    return _parts(dice, count, make)


def axis(dice, count):
    """Along the axis, across it and beside it at 2^-4 … 2^-36."""

    def make(surface, n):
        low, high = box_of(surface)
        points = np.stack([np.zeros(n), np.zeros(n), dice.uniform(low[2], high[2], n)], axis=1)
        along = np.where(dice.random((n, 1)) < 0.5, [0.0, 0.0, 1.0], _directions(dice, n))
        size = _size(surface)
        return surface, *_through(dice, surface, points + _off(dice, n, size), along)

    return _parts(dice, count, make)


def seam(dice, count):
    """Through the seam of a tube and the ball at its end."""

    def make(surface, n):
        s = np.where(dice.random(n) < 0.5, 0.0, surface.turns)
        points = tube_points(surface, s, dice.uniform(0, 2 * np.pi, n))
        return surface, *_through(dice, surface, points + _off(dice, n, surface.r))

    return _parts(dice, count, make)


def thin(dice, count):
    """Thin tubes: r a tenth to a thousandth of R, aimed at."""

    def make(_, n):
        R, turns = dice.uniform(0.4, 1), dice.uniform(0.2, 4)
        surface = Spiral(
            type="spiral", R=R, r=R * 10.0 ** dice.uniform(-3, -1), pitch=dice.uniform(0.1, 1), turns=turns
        )
        points = tube_points(surface, dice.uniform(0, turns, n), dice.uniform(0, 2 * np.pi, n), dice.uniform(0, 1.2, n))
        return surface, *_through(dice, surface, points)

    return _parts(dice, count, make)


def grazing(dice, count):
    """Tangents of the tube, and lines beside them at 2^-4 … 2^-36 of its radius."""

    def make(surface, n):
        points = tube_points(surface, dice.uniform(0, surface.turns, n), dice.uniform(0, 2 * np.pi, n))
        normal = gradient(surface, points)
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
        tangent = np.cross(normal, _directions(dice, n))
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        shift = dice.choice([-1, 0, 1], (n, 1)) * 2.0 ** -dice.uniform(4, 36, (n, 1)) * surface.r
        return surface, *_through(dice, surface, points + shift * normal, tangent)

    return _parts(dice, count, make)


def tip(dice, count):
    """Cone spirals whose tube comes near to the axis at the tip, and rays through the tip."""

    def make(_, n):
        turns, last = dice.uniform(1, 4), dice.uniform(0.02, 0.2)
        gap = 1 + 10.0 ** dice.uniform(-1.9, -0.5)  # R over r at the tip
        surface = Spiral(
            type="spiral", R=1, r=0.2, pitch=dice.uniform(0.5, 1), turns=turns,
            R_growth=-(1 - last) / turns, r_growth=-(0.2 - last / gap) / turns,
        )  # fmt: skip
        points = tube_points(surface, np.full(n, turns), np.zeros(n), 0.0) * [dice.uniform(-1, 1), 0.5, 1]
        return surface, *_through(dice, surface, points + _off(dice, n, last, 0, 8))

    return _parts(dice, count, make)


def turns(dice, count):
    """Turns that nearly touch: a pitch of 2.001 to 2.2 radii, and up to 30 of them."""

    def make(_, n):
        R = dice.uniform(0.4, 1)
        r, many = R * dice.uniform(0.02, 0.2), dice.uniform(2, 30)
        surface = Spiral(type="spiral", R=R, r=r, pitch=r * (2 + 10.0 ** dice.uniform(-3, -0.7)), turns=many)
        points = tube_points(surface, dice.uniform(0, many, n), dice.uniform(0, 2 * np.pi, n))
        return surface, *_through(dice, surface, points + _off(dice, n, r, 0, 20))

    return _parts(dice, count, make)


def scales(dice, count):
    """Spirals of 10^-6 to 10^6 units, in segments up to ten times as long."""

    def make(surface, n):
        size = 10.0 ** dice.uniform(-6, 6)
        keys = {key: getattr(surface, key) * size for key in ("R", "r", "pitch", "R_growth", "r_growth")}
        scaled = surface.model_copy(update=keys)
        h, e = chords_through(surface, n, int(dice.integers(1 << 40)), 10.0 ** dice.uniform(0, 1))
        aimed = tube_points(surface, dice.uniform(0, surface.turns, n), dice.uniform(0, 2 * np.pi, n), dice.random(n))
        shift = aimed - (h + e) / 2
        return scaled, (h + shift) * size, (e + shift) * size

    return _parts(dice, count, make)


def parallel(dice, count):
    """Direction with one or two components exactly 0."""

    def make(surface, n):
        h, e = chords_through(surface, n, int(dice.integers(1 << 40)), 1.0)
        return surface, h, np.where(dice.random((n, 3)) < 0.5, h, e)

    return _parts(dice, count, make)


def inside(dice, count):
    """The segment begins inside of the tube, or on it."""

    def make(surface, n):
        depth = dice.choice([0, 0.5, 0.9999, 1.0], n)
        h = tube_points(surface, dice.uniform(0, surface.turns, n), dice.uniform(0, 2 * np.pi, n), depth)
        return surface, h, h + _directions(dice, n) * 2 * _size(surface)

    return _parts(dice, count, make)


CATEGORIES = {
    "any chord through any spiral": anywhere,
    "spiral, along its axis": axis,
    "spiral, seam of tube and ball": seam,
    "thin spiral": thin,
    "spiral, grazing": grazing,
    "spiral, tip near the axis": tip,
    "spiral, turns nearly touch": turns,
    "spiral, 10^-6 to 10^6 units": scales,
    "spiral, zero direction components": parallel,
    "spiral, eye inside": inside,
}
