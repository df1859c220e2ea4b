# SPDX-License-Identifier: Apache-2.0
"""Stress categories given by geometry: chords through surfaces, which pass the product before the descent.

Each function takes a numpy Generator and a number of chords and yields parts ``(surface, h, e)``: a surface of the
scene file and the ends of chords (N, 3) in its local coordinates, float64. A part shares one scale of its words, as the
rays of a surface in a frame do.
"""

from collections.abc import Iterator
from types import SimpleNamespace

import numpy as np

Part = tuple[SimpleNamespace, np.ndarray, np.ndarray]
PARTS = 16  # surfaces of a category
KINDS = (
    "sphere",
    "ellipsoid",
    "cylinder",
    "cone",
    "paraboloid",
    "hyperbolic_paraboloid",
    "hyperboloid_one_sheet",
    "hyperboloid_two_sheet",
    "quadric",
    "torus",
    "cyclide",
    "quartic",
)


def _surface(kind, **keys):
    return SimpleNamespace(type=kind, **keys)


def _directions(dice, count):
    d = dice.normal(size=(count, 3))
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def _about(dice, points, radius):
    """Chords of a length about 2*radius through points (N, 3), in any direction."""
    d = _directions(dice, len(points)) * radius
    return points - d * dice.uniform(0.3, 1, (len(points), 1)), points + d * dice.uniform(0.3, 1, (len(points), 1))


def _off(dice, count, low=4, high=44):
    """Small offsets of all magnitudes (count, 3); a third of them 0."""
    return _directions(dice, count) * 2.0 ** -dice.uniform(low, high, (count, 1)) * (dice.random((count, 1)) < 0.67)


def random_surface(dice):
    """Any of the algebraic types, about the unit sphere."""
    kind = dice.choice(KINDS)
    a, b, c = dice.uniform(0.2, 1.0, 3)
    match kind:
        case "sphere" | "cylinder":
            return _surface(kind, R=a)
        case "cone":
            return _surface(kind, k=a)
        case "paraboloid" | "hyperbolic_paraboloid":
            return _surface(kind, a=a, b=b)
        case "quadric":
            return _surface(kind, coefficients=dice.normal(size=10))
        case "torus":
            return _surface(kind, R=0.4 + 0.4 * a, r=0.35 * b)
        case "cyclide":
            return _surface(kind, a=0.5 + 0.3 * a, b=0.5, d=0.1 + 0.3 * b)
        case "quartic":
            return _surface(kind, Q1=dice.normal(size=10), Q2=dice.normal(size=10), Q3=dice.normal(size=10))
    return _surface(kind, a=a, b=b, c=c)


def _parts(dice, count, make) -> Iterator[Part]:
    share = -(-count // PARTS)
    for start in range(0, count, share):
        yield make(min(share, count - start))


def anywhere(dice, count):
    """Random chords of the unit sphere through surfaces of every algebraic type."""
    return _parts(dice, count, lambda n: (random_surface(dice), _directions(dice, n), _directions(dice, n)))


def apex(dice, count):
    """Through the apex of a cone, and past it at 2^-4 … 2^-44."""

    def make(n):
        return _surface("cone", k=dice.uniform(0.2, 2)), *_about(dice, _off(dice, n), 1)

    return _parts(dice, count, make)


def centre(dice, count):
    """Through the centre of a torus, and past it; flat ones meet the tube four times."""

    def make(n):
        R = dice.uniform(0.3, 0.9)
        h, e = _about(dice, _off(dice, n), 1.5)
        flat = dice.choice([0, 1e-9, 1e-3, 0.3, 1], (n, 1))
        h[:, 2:], e[:, 2:] = h[:, 2:] * flat, e[:, 2:] * flat
        return _surface("torus", R=R, r=R * dice.uniform(0.05, 0.95)), h, e

    return _parts(dice, count, make)


def axis(dice, count):
    """Along the axis of a torus, cone, cylinder, paraboloid or hyperboloid, and beside it at 2^-4 … 2^-44."""

    def make(n):
        surface = random_surface(dice)
        lift = np.zeros((n, 3))
        lift[:, 2] = dice.uniform(0.3, 1.0, n)
        return surface, _off(dice, n) - lift, _off(dice, n) + lift

    return _parts(dice, count, make)


def rulings(dice, count):
    """Along a ruling of a saddle, a hyperboloid, a cone or a cylinder (all control points 0), and beside it."""

    def make(n):
        kind = dice.integers(0, 4)
        turn, s = dice.uniform(0, 2 * np.pi, n), dice.uniform(0.2, 1, (2, n))
        zero = np.zeros(n)
        cos, sin = np.cos(turn), np.sin(turn)
        if kind == 0:  # x**2 - y**2 = z holds x - y = c, z = c (x + y): dyadic numbers, so that all is exact
            surface, c = _surface("hyperbolic_paraboloid", a=1.0, b=1.0), np.rint(dice.uniform(-64, 64, n)) / 128
            ends = [np.stack([(v + c) / 2, (v - c) / 2, c * v], axis=1) for v in np.rint(s * 256) / 256 * [[1], [-1]]]
        elif kind == 1:
            a, b, c = dice.uniform(0.3, 0.7, 3)
            surface, hand = _surface("hyperboloid_one_sheet", a=a, b=b, c=c), dice.choice([-1, 1], n)
            ends = [np.stack([a * (cos - v * sin), b * (sin + v * cos), hand * c * v], axis=1) for v in (s[0], -s[1])]
        elif kind == 2:
            k = dice.uniform(0.5, 1.5)
            surface = _surface("cone", k=k)
            ends = [np.stack([k * v * cos, k * v * sin, v], axis=1) for v in (s[0], -s[1])]
        else:
            R = np.rint(dice.uniform(32, 96)) / 128
            surface = _surface("cylinder", R=R)
            turn = dice.integers(0, 4, n)
            cos, sin = np.choose(turn, [1, 0, -1, 0]), np.choose(turn, [0, 1, 0, -1])
            ends = [np.stack([R * cos, R * sin, zero + v], axis=1) for v in (s[0], -s[1])]
        h, e = (end + off for end, off in zip(ends, (_off(dice, n), _off(dice, n)), strict=True))
        other = dice.random(n) < 0.1  # these give the part its scale
        h[other], e[other] = _directions(dice, int(other.sum())), _directions(dice, int(other.sum()))
        return surface, h, e

    return _parts(dice, count, make)


def parallel(dice, count):
    """Direction with one or two components exactly 0."""

    def make(n):
        h, e = _directions(dice, n), _directions(dice, n)
        fixed = dice.random((n, 3)) < 0.5
        return random_surface(dice), h, np.where(fixed, h, e)

    return _parts(dice, count, make)


def inside(dice, count):
    """The segment begins inside of the surface, or on it."""

    def make(n):
        R = dice.uniform(0.4, 0.7)
        r = R * dice.uniform(0.2, 0.9)
        turn, tilt = dice.uniform(0, 2 * np.pi, (2, n))
        deep = r * dice.choice([0, 0.5, 0.9999, 1.0], n)
        ring = R + deep * np.cos(tilt)
        h = np.stack([ring * np.cos(turn), ring * np.sin(turn), deep * np.sin(tilt)], axis=1)
        return _surface("torus", R=R, r=r), h, _directions(dice, n) * 1.2

    return _parts(dice, count, make)


def scales(dice, count):
    """Axes that differ by up to 10^6, and segments 10^-2 to 10^6 times the surface."""

    def make(n):
        axes = 10.0 ** dice.uniform(-6, 6, 3) if dice.random() < 0.5 else np.full(3, 10.0 ** dice.uniform(-6, 6))
        size = 10.0 ** dice.uniform(-2, 6)
        h, e = _about(dice, _directions(dice, n) * dice.uniform(0, 1.1, (n, 1)), size)
        return _surface("ellipsoid", a=axes[0], b=axes[1], c=axes[2]), h * axes, e * axes

    return _parts(dice, count, make)


def quartic_scales(dice, count):
    """Tori of 10^-6 to 10^6 units, segments 10^-2 to 10^6 times as long as they are large."""

    def make(n):
        R = 10.0 ** dice.uniform(-6, 6)
        r = R * dice.uniform(0.05, 0.95)
        turn, tilt = dice.uniform(0, 2 * np.pi, (2, n))
        off = r * dice.uniform(0, 1.2, n)
        ring = R + off * np.cos(tilt)
        points = np.stack([ring * np.cos(turn), ring * np.sin(turn), off * np.sin(tilt)], axis=1)
        return _surface("torus", R=R, r=r), *_about(dice, points, R * 10.0 ** dice.uniform(-2, 6))

    return _parts(dice, count, make)


def thin(dice, count):
    """Thin torus: a tube of 10^-1 to 10^-6 of the ring."""

    def make(n):
        R = 0.8
        r = R * 10.0 ** dice.uniform(-6, -1)
        turn, tilt = dice.uniform(0, 2 * np.pi, (2, n))
        off = r * dice.uniform(0, 1.2, n)
        ring = R + off * np.cos(tilt)
        points = np.stack([ring * np.cos(turn), ring * np.sin(turn), off * np.sin(tilt)], axis=1)
        return _surface("torus", R=R, r=r), *_about(dice, points, 1)

    return _parts(dice, count, make)


def grazing(dice, count):
    """Tangents of a sphere, a torus or an ellipsoid, and lines beside them at 2^-4 … 2^-44."""

    def make(n):
        if dice.random() < 0.5:
            R = dice.uniform(0.4, 0.7)
            r = R * dice.uniform(0.1, 0.9)
            turn, tilt = dice.uniform(0, 2 * np.pi, (2, n))
            normal = np.stack([np.cos(turn) * np.cos(tilt), np.sin(turn) * np.cos(tilt), np.sin(tilt)], axis=1)
            points = normal * r + R * np.stack([np.cos(turn), np.sin(turn), np.zeros(n)], axis=1)
            surface = _surface("torus", R=R, r=r)
        else:
            axes = dice.uniform(0.3, 0.9, 3)
            sphere = _directions(dice, n)
            points, normal = sphere * axes, sphere / axes
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            surface = _surface("ellipsoid", a=axes[0], b=axes[1], c=axes[2])
        tangent = np.cross(normal, _directions(dice, n))
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        shift = dice.choice([-1, 0, 1], (n, 1)) * 2.0 ** -dice.uniform(4, 44, (n, 1)) * normal
        back, on = dice.uniform(0.3, 1, (2, n, 1))
        return surface, points + shift - back * tangent, points + shift + on * tangent

    return _parts(dice, count, make)


CATEGORIES = {
    "all surfaces, any chord": anywhere,
    "apex of a cone": apex,
    "centre of a torus": centre,
    "along the axis": axis,
    "along a ruling": rulings,
    "zero direction components": parallel,
    "eye inside": inside,
    "scale ratios 10^-6 to 10^6": scales,
    "torus, 10^-6 to 10^6 units": quartic_scales,
    "thin torus": thin,
    "grazing": grazing,
}
