# SPDX-License-Identifier: Apache-2.0
"""The oracle's part for spirals: all roots on a ray by dense sampling, in float64.

With s in turns from 0 to T = turns, the centre curve is C(s) = (a cos 2 pi s, a sin 2 pi s, pitch s) where
a(s) = R + R_growth s, and the tube's radius is r(s) = r + r_growth s. The solid meets the half plane of azimuth
theta (in turns, [0, 1)) in the disks of radius r(s) about C(s) for all s = m + theta in [0, T], m an integer;
a ball of radius r(0) about C(0) and one of radius r(T) about C(T) close its ends. The indicator

    f = min(hypot(rho - a(s), z - pitch s) - r(s) for all such s, |P - C(0)| - r(0), |P - C(T)| - r(T))

is negative inside. It is continuous everywhere but on the axis, with kinks where another disk or ball is nearest.

Nothing is derived from f's shape, and no turn is left out. The part of the ray inside a cylinder about the solid
is sampled (`SAMPLES`, `SPACING`, and denser near the surface, `PARTS`), every sampled minimum and maximum is
refined by golden section, and every change of sign is then bracketed down to float64. As in `oracle`, zero counts
as not positive.
"""

from math import atan2, cos, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit, prange

EPSILON = 2.0**-52
BOX_SLACK = 1e-12  # the clip box is closed: its faces count, give or take rounding (in half-extents)
SAMPLES = 512  # least number of samples on the part of a ray inside the cylinder about the solid
SPACING = 1 / 8  # between samples f changes by at most this fraction of the smallest r(s) or distance of turns
LEAST = 1 / 64  # of the largest r(s): a smaller tube or distance of turns makes the samples no denser
PARTS = 1024  # near the surface, where f could reach zero between two samples, they are up to so many times denser
MARGIN = 1 / 8  # of the largest r(s), between the solid and the cylinder about it
GOLDEN = 0.3819660112501051


class Tube(NamedTuple):
    """A spiral as numbers, in local coordinates.

    stop_x, stop_y, stop_z, stop_r  centre and radius of the ball at s = T
    size     largest a(s) + r(s)
    radius   of the cylinder about the solid, whose z goes from bottom to top
    spacing  how much f may change between two samples
    """

    R: float
    r: float
    pitch: float
    turns: float
    R_growth: float
    r_growth: float
    stop_x: float
    stop_y: float
    stop_z: float
    stop_r: float
    size: float
    radius: float
    bottom: float
    top: float
    spacing: float


def tube(surface):
    """The `Tube` of a surface with R, r, pitch, turns, R_growth, r_growth.

    Raises ValueError if the length, or a(s) or r(s) at an end, is not positive.
    """
    R, r, pitch, turns = float(surface.R), float(surface.r), float(surface.pitch), float(surface.turns)
    R_growth, r_growth = float(surface.R_growth), float(surface.r_growth)
    R_stop, r_stop, z_stop = R + R_growth * turns, r + r_growth * turns, pitch * turns
    if not all(v > 0.0 for v in (turns, R, r, R_stop, r_stop)):
        raise ValueError(f"spiral of {turns} turns, R from {R} to {R_stop}, r from {r} to {r_stop}: not all positive")
    angle = 2.0 * pi * (turns % 1.0)
    size, thick, apart = max(R + r, R_stop + r_stop), max(r, r_stop), float(np.hypot(pitch, R_growth))
    finest = min(r, r_stop, apart) if turns > 1.0 and apart > 0.0 else min(r, r_stop)
    return Tube(
        R,
        r,
        pitch,
        turns,
        R_growth,
        r_growth,
        R_stop * cos(angle),
        R_stop * sin(angle),
        z_stop,
        r_stop,
        size,
        size + MARGIN * thick,
        min(-r, z_stop - r_stop) - MARGIN * thick,
        max(r, z_stop + r_stop) + MARGIN * thick,
        SPACING * max(finest, LEAST * thick),
    )


def spiral_value(surface, points):
    """f at local points (..., 3) in the unit of the lengths; float64 (...)."""
    points = np.asarray(points, dtype=np.float64)
    return _values(tube(surface), points.reshape(-1, 3)).reshape(points.shape[:-1])


def spiral_chord_roots(surface, h, e, max_roots=16):
    """Roots of f on chords h + t (e - h), 0 <= t < 1, and how far the chords are from another number of roots.

    h, e  (N, 3) ends in local coordinates
    Returns (roots, clearance).
      roots      float64 (N, max_roots), increasing, nan-padded; of a chord with more roots the first ones
      clearance  float64 (N,) in the unit of the lengths: the smallest |f| at any minimum or maximum of f on the
                 chord and at those of its ends that are inside the cylinder about the solid (`MARGIN`); inf for a
                 chord that is outside of it
    """
    h, e = np.ascontiguousarray(h, dtype=np.float64), np.ascontiguousarray(e, dtype=np.float64)
    roots, clearance = np.full((len(h), max_roots), np.nan), np.full(len(h), np.inf)
    _chords(tube(surface), h, e, roots, clearance)
    return roots, clearance


@njit(parallel=True, cache=True, error_model="numpy")
def trace(tube, eye, axes, centre, half, depth, count, clearance):
    """Fill the arrays of an `oracle.IdealHits`; everything in local coordinates, box = centre +- half (or inf)."""
    height, width = count.shape
    for row in prange(height):
        for column in range(width):
            ray = axes[0] + (column + 0.5 - width / 2) * axes[1] + (height / 2 - row - 0.5) * axes[2]
            count[row, column], clearance[row, column] = _roots_on_ray(
                tube, eye, ray, np.inf, tube.size, centre, half, depth[row, column]
            )


@njit(parallel=True, cache=True, error_model="numpy")
def _chords(tube, h, e, roots, clearance):
    """Fill roots and clearance."""
    for i in prange(len(h)):
        centre, half = np.zeros(3), np.full(3, np.inf)
        _, clearance[i] = _roots_on_ray(tube, h[i], e[i] - h[i], 1.0, 1.0, centre, half, roots[i])


@njit(cache=True, error_model="numpy")
def _values(tube, points):
    """f at points (N, 3)."""
    out = np.empty(len(points))
    for i in range(len(points)):
        out[i] = _value(tube, points[i, 0], points[i, 1], points[i, 2])
    return out


@njit(cache=True, error_model="numpy")
def _value(tube, x, y, z):
    """f at a point, by trying every turn."""
    start = _length(x - tube.R, y, z) - tube.r
    stop = _length(x - tube.stop_x, y - tube.stop_y, z - tube.stop_z) - tube.stop_r
    best = min(start, stop)
    rho, theta = sqrt(x * x + y * y), atan2(y, x) / (2.0 * pi)
    if theta < 0.0:
        theta += 1.0
    if theta >= 1.0:  # a negative angle smaller than the rounding
        theta = 0.0
    m = 0
    while m + theta <= tube.turns:
        s = m + theta
        across, along = rho - (tube.R + tube.R_growth * s), z - tube.pitch * s
        best = min(best, sqrt(across * across + along * along) - (tube.r + tube.r_growth * s))
        m += 1
    return best


@njit(cache=True, error_model="numpy")
def _length(x, y, z):
    """Length of a vector."""
    return sqrt(x * x + y * y + z * z)


@njit(cache=True, error_model="numpy")
def _at(tube, base, ray, s):
    """f at base + s ray."""
    return _value(tube, base[0] + s * ray[0], base[1] + s * ray[1], base[2] + s * ray[2])


@njit(cache=True, error_model="numpy")
def _roots_on_ray(tube, eye, ray, last, unit, centre, half, found):
    """The roots at eye + t ray, 0 <= t < last, inside the box, the first of them in found.

    Returns how many are in found, and the clearance: |f| / unit or, if larger, the distance outside the box, of the
    extrema and ends, and the distances of the roots from the faces of the box.
    """
    # t counts from the closest approach, to the centre of the box if there is one
    boxed = half[0] < np.inf
    middle = centre[2] if boxed else 0.5 * (tube.bottom + tube.top)
    square = ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]
    nearest = ((centre[0] - eye[0]) * ray[0] + (centre[1] - eye[1]) * ray[1] + (middle - eye[2]) * ray[2]) / square
    nearest = min(max(nearest, 0.0), last)
    base = eye + nearest * ray
    low, high = _window(tube, base, ray, -nearest, last - nearest)
    if boxed:
        low, high = _near_box(base - centre, ray, 1.01 * half, low, high)
    if not low < high:
        return 0, np.inf
    count, clear = _scan(tube, base, ray, low, high, unit, centre, half, found)
    for k in range(count):
        found[k] += nearest
    if low == -nearest:
        clear = min(clear, _nearness(base, ray, low, _at(tube, base, ray, low), unit, centre, half))
    if high == last - nearest:
        clear = min(clear, _nearness(base, ray, high, _at(tube, base, ray, high), unit, centre, half))
    return count, clear


@njit(cache=True, error_model="numpy")
def _window(tube, base, ray, low, high):
    """The part of [low, high] in which base + s ray is inside the cylinder about the solid."""
    square = ray[0] * ray[0] + ray[1] * ray[1]
    product = base[0] * ray[0] + base[1] * ray[1]
    excess = base[0] * base[0] + base[1] * base[1] - tube.radius * tube.radius
    if square > 0.0:
        discriminant = product * product - square * excess
        if discriminant < 0.0:
            return np.inf, -np.inf
        low = max(low, (-product - sqrt(discriminant)) / square)
        high = min(high, (-product + sqrt(discriminant)) / square)
    elif excess > 0.0:
        return np.inf, -np.inf
    return _slab(base[2], ray[2], tube.bottom, tube.top, low, high)


@njit(cache=True, error_model="numpy")
def _near_box(base, ray, half, low, high):
    """The part of [low, high] in which base + s ray is inside the box +- half."""
    for axis in range(3):
        low, high = _slab(base[axis], ray[axis], -half[axis], half[axis], low, high)
    return low, high


@njit(cache=True, error_model="numpy")
def _slab(base, ray, bottom, top, low, high):
    """The part of [low, high] in which base + s ray is between bottom and top."""
    if ray == 0.0:
        return (low, high) if bottom <= base <= top else (np.inf, -np.inf)
    one, other = (bottom - base) / ray, (top - base) / ray
    return max(low, min(one, other)), min(high, max(one, other))


@njit(cache=True, error_model="numpy")
def _scan(tube, base, ray, low, high, unit, centre, half, found):
    """Sign changes and extrema of f at base + s ray for low <= s <= high; the result is that of `_roots_on_ray`.

    The step keeps the change of f below the spacing and, down to a fraction of that, below |f| / 2. f changes by at
    most 1 per length within a half plane, and by `steep` per turn of azimuth, which close to the axis takes no time.
    """
    length = _length(ray[0], ray[1], ray[2])
    steep = sqrt(tube.pitch * tube.pitch + tube.R_growth * tube.R_growth) + abs(tube.r_growth)
    swirl = steep * abs(base[0] * ray[1] - base[1] * ray[0]) / (2.0 * pi)
    reach = max(abs(low), abs(high))
    coarse, least = (high - low) / SAMPLES, max(1e-10 * (high - low), 4.0 * EPSILON * reach)

    count, clear = 0, np.inf
    b, fb = low, _at(tube, base, ray, low)
    a, fa = b, fb
    while b < high:
        x, y = base[0] + b * ray[0], base[1] + b * ray[1]
        square = max(x * x + y * y, 1e-30 * tube.size * tube.size)
        rate = length + swirl / square
        step = min(coarse, tube.spacing / rate)
        step = max(min(step, 0.5 * abs(fb) / rate), step / PARTS, least)
        c = min(b + step, high)
        fc = _at(tube, base, ray, c)
        if (fb < fa and fb <= fc) or (fb > fa and fb >= fc):
            b, fb = _extremum(tube, base, ray, a, fa, b, fb, c, fc)
            clear = min(clear, _nearness(base, ray, b, fb, unit, centre, half))
        if (fa > 0.0) != (fb > 0.0):
            count, clear = _crossing(tube, base, ray, a, fa, b, fb, reach, centre, half, found, count, clear)
        a, fa, b, fb = b, fb, c, fc
    if (fa > 0.0) != (fb > 0.0):
        count, clear = _crossing(tube, base, ray, a, fa, b, fb, reach, centre, half, found, count, clear)
    return count, clear


@njit(cache=True, error_model="numpy")
def _crossing(tube, base, ray, a, fa, b, fb, reach, centre, half, found, count, clear):
    """Add the root between a and b to found if it is inside the box and there is room; returns count and clear."""
    s = _bracketed_root(tube, base, ray, a, fa, b, fb, EPSILON * reach)
    if half[0] < np.inf:
        radius = _box_radius(base, ray, s, centre, half)
        clear = min(clear, abs(radius - 1.0))
        if radius > 1.0 + BOX_SLACK:
            return count, clear
    if count < len(found):
        found[count] = s
        count += 1
    return count, clear


@njit(cache=True, error_model="numpy")
def _nearness(base, ray, s, f, unit, centre, half):
    """|f| / unit at base + s ray or, if larger, the distance outside the box in half-extents."""
    return max(abs(f) / unit, _box_radius(base, ray, s, centre, half) - 1.0)


@njit(cache=True, error_model="numpy")
def _box_radius(base, ray, s, centre, half):
    """Largest distance of base + s ray from the centre of the box in half-extents: 1 on the faces; 0 without a box."""
    radius = 0.0
    for axis in range(3):
        radius = max(radius, abs(base[axis] + s * ray[axis] - centre[axis]) / half[axis])
    return radius


@njit(cache=True, error_model="numpy")
def _extremum(tube, base, ray, a, fa, b, fb, c, fc):
    """Place and value of the minimum (fb <= fa, fc) or maximum of f between a and c, by golden section.

    It ends when f at a and c differs from that between them by rounding only.
    """
    sign = 1.0 if fb < fa else -1.0
    fa, fb, fc = sign * fa, sign * fb, sign * fc
    noise = 2.0 * EPSILON * tube.size
    for _ in range(200):
        if max(fa, fc) - fb <= noise or c - a <= 2.0 * EPSILON * max(abs(a), abs(c)):
            break
        if c - b > b - a:
            x = b + GOLDEN * (c - b)
            fx = sign * _at(tube, base, ray, x)
            if fx < fb:
                a, fa, b, fb = b, fb, x, fx
            else:
                c, fc = x, fx
        else:
            x = b - GOLDEN * (b - a)
            fx = sign * _at(tube, base, ray, x)
            if fx < fb:
                c, fc, b, fb = b, fb, x, fx
            else:
                a, fa = x, fx
    return b, sign * fb


@njit(cache=True, error_model="numpy")
def _bracketed_root(tube, base, ray, a, fa, b, fb, tolerance):
    """The sign change between a and b: inverse quadratic interpolation where it is safe, else bisection.

    Source: T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear
    function without using derivatives, 1997.
    """
    part = 0.5
    for _ in range(200):
        x = a + part * (b - a)
        fx = _at(tube, base, ray, x)
        if (fx > 0.0) == (fa > 0.0):
            c, fc = a, fa
        else:
            c, fc, b, fb = b, fb, a, fa
        a, fa = x, fx
        if fa == 0.0 or abs(b - a) <= tolerance:
            break
        part = 0.5
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        if phi * phi < xi and (1.0 - phi) * (1.0 - phi) < 1.0 - xi:
            part = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        least = 0.5 * tolerance / abs(b - a)
        part = min(max(part, least), 1.0 - least)
    return a if abs(fa) < abs(fb) else b
