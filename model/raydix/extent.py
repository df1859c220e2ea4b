# SPDX-License-Identifier: Apache-2.0
"""How far a surface reaches on the screen and in depth: bounds that hold, close enough to leave out what is empty.

The box of a surface is divided into cells, and those are kept that may have a part of it. In a cell with centre p and
half sides d, |F(p + u) - F(p) - G·u| <= E: the surface lies in the strip |F(p) + G·u| <= E. What a linear function o·u
can reach within cell and strip is bounded by duality: for any m

    o·u  <=  sum |o_i - m G_i| d_i  +  max(m (-F - E), m (-F + E)),

and the best m is 0 or one of o_i / G_i. E falls with the square of the cell, so cells of 1/32 of the box give bounds to
about a pixel of a thousand. A spiral lies within balls about its centre curve. Source: docs/method.md, "Set-up".

Float64 with margins for its rounding; nothing here need be exact, only outside.
"""

from typing import NamedTuple

import numpy as np

from .scene import Spiral, Surface
from .surfaces import Form, form

LEVELS = 5  # halvings of the box along each axis
ROUNDING = 2.0**-36  # relative; a value has some 50 terms, each rounded to 2^-53
PROJECTION = 2.0**-48  # relative, of a camera coordinate: four terms, and coordinates that were rounded to float64
BALLS = 256  # in a turn of a spiral
NOWHERE = (-np.inf, np.inf)


class Extent(NamedTuple):
    """Slopes to the right and upwards, and depth, of all that is to be seen: least and most of each."""

    right: tuple[float, float]
    up: tuple[float, float]
    depth: tuple[float, float]


class Quadratic(NamedTuple):
    """x'Ax + b'x + c in float64, and the largest sum of the sizes of its terms in the box."""

    a: np.ndarray
    b: np.ndarray
    c: float
    size: float

    def at(self, p):
        """Values (N) and gradients (N, 3) at points (N, 3)."""
        product = p @ self.a
        return (product * p).sum(1) + p @ self.b + self.c, 2 * product + self.b


def _quadratic(coefficients, low, high) -> Quadratic:
    xx, yy, zz, xy, yz, zx, x, y, z, one = map(float, coefficients)
    a = np.array([[xx, xy / 2, zx / 2], [xy / 2, yy, yz / 2], [zx / 2, yz / 2, zz]])
    b, most = np.array([x, y, z]), np.maximum(abs(low), abs(high))
    return Quadratic(a, b, one, most @ abs(a) @ most + abs(b) @ most + abs(one))


def _strip(quadratics, p, d):
    """F (N), G (N, 3) and E (N) of cells with centres p (N, 3) and half sides d (3)."""
    *factors, last = quadratics
    value, slope = last.at(p)
    if not factors:
        return value, slope, np.full(len(p), d @ abs(last.a) @ d + ROUNDING * last.size)
    (one, two), (v1, g1), (v2, g2) = factors, factors[0].at(p), factors[1].at(p)
    both = g1[:, :, None] * g2[:, None, :]
    second = v1[:, None, None] * two.a + v2[:, None, None] * one.a + last.a + (both + both.transpose(0, 2, 1)) / 2
    bend1, bend2 = d @ abs(one.a) @ d, d @ abs(two.a) @ d
    error = np.einsum("i,nij,j->n", d, abs(second), d)
    error += (abs(g1) @ d) * bend2 + (abs(g2) @ d) * bend1 + bend1 * bend2
    error += ROUNDING * (one.size * two.size + last.size)
    return v1 * v2 + value, v1[:, None] * g2 + v2[:, None] * g1 + slope, error


def _reach(o, strip, d):
    """A bound of o·u over each cell's part of its strip; o (N, 3) or (3)."""
    value, slope, error = strip
    o = np.broadcast_to(o, slope.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        m = np.nan_to_num(o / slope, nan=0.0, posinf=0.0, neginf=0.0)
    m = np.concatenate([np.zeros((len(m), 1)), m], axis=1)
    sides = abs(o[:, None, :] - m[:, :, None] * slope[:, None, :]) @ d
    ends = np.maximum(m * (-value - error)[:, None], m * (error - value)[:, None])
    return (sides + ends).min(1)


def _cells(quadratics, low, high):
    """Centres (N, 3), half sides (3) and strips of the smallest cells that may have a part of the surface."""
    p, d = (low + high)[None] / 2, (high - low) / 2
    strip = _strip(quadratics, p, d)
    corners = np.array(np.meshgrid(*[(-1, 1)] * 3)).reshape(3, -1).T
    for _ in range(LEVELS):
        d = d / 2
        p = (p[:, None, :] + corners * d).reshape(-1, 3)
        value, slope, error = _strip(quadratics, p, d)
        kept = abs(value) <= abs(slope) @ d + error
        p, strip = p[kept], (value[kept], slope[kept], error[kept])
    return p, d, strip


def _ratio_reach(x, z, p, d, strip, matrix, eye):
    """Least and most of the ratio of two camera coordinates, the second of which is positive."""
    center = p @ matrix.T + eye
    ratio = center[:, x] / center[:, z]
    o = matrix[x] - ratio[:, None] * matrix[z]
    half = abs(matrix[z]) @ d
    near, far = center[:, z] - half, center[:, z] + half
    most, least = (_reach(sign * o, strip, d) for sign in (1, -1))
    return (
        (ratio - least / np.where(least > 0, near, far)).min(),
        (ratio + most / np.where(most > 0, near, far)).max(),
    )


def algebraic_extent(shape: Form, low, high, matrix, eye) -> Extent | None:
    """Of F = 0 within the box from ``low`` to ``high``, all of which is before the camera; None if nothing is in it.

    matrix, eye   camera coordinates (right, up, forward) of a local point p: matrix p + eye; float64 (3, 3), (3)
    """
    quadratics = [_quadratic(q, low, high) for q in shape if q is not None]
    p, d, strip = _cells(quadratics, low, high)
    if not len(p):
        return None
    right, up = (_ratio_reach(axis, 2, p, d, strip, matrix, eye) for axis in (0, 1))
    depth = p @ matrix[2] + eye[2]
    return Extent(
        right,
        up,
        ((depth - _reach(-matrix[2], strip, d)).min(), (depth + _reach(matrix[2], strip, d)).max()),
    )


def spiral_extent(spiral: Spiral, matrix, eye) -> Extent | None:
    """Of a spiral within balls about its centre curve; None where one of them is not wholly before the camera."""
    count = int(np.ceil(BALLS * spiral.turns)) + 1
    s = np.linspace(0, spiral.turns, count)
    radius = spiral.R + spiral.R_growth * s
    centers = np.stack([radius * np.cos(2 * np.pi * s), radius * np.sin(2 * np.pi * s), spiral.pitch * s], 1)
    # a ball has to hold the tube half a step to both sides: the curve is no longer than its speed at the widest
    speed = np.hypot(2 * np.pi * radius.max(), np.hypot(spiral.R_growth, spiral.pitch))
    step = spiral.turns / (count - 1)
    size = spiral.r + spiral.r_growth * s + (speed + abs(spiral.r_growth)) * step / 2
    seen = centers @ matrix.T + eye
    size = size * np.linalg.norm(matrix, 2) * (1 + ROUNDING)  # an affine placement makes ellipsoids: balls about them
    x, y, z = seen.T
    if (z <= size).any():
        return None

    def slopes(side):
        angle, width = np.arctan2(side, z), np.arcsin(size / np.hypot(side, z))
        return np.tan(angle - width).min(), np.tan(angle + width).max()

    return Extent(slopes(x), slopes(y), ((z - size).min(), (z + size).max()))


def _widened(found: Extent, low, high, matrix, eye) -> Extent:
    """With what the projection of points within the box may be off by."""
    off = PROJECTION * (abs(matrix) @ np.maximum(abs(low), abs(high)) + abs(eye))
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1)
    near = (matrix[2] @ corners + eye[2]).min() - off[2]
    if near <= 0:
        return Extent(NOWHERE, NOWHERE, NOWHERE)
    right, up = (
        (least - (off[i] + off[2] * abs(least)) / near, most + (off[i] + off[2] * abs(most)) / near)
        for i, (least, most) in enumerate((found.right, found.up))
    )
    return Extent(right, up, (found.depth[0] - off[2], found.depth[1] + off[2]))


def extent(surface: Surface, low, high, matrix, eye) -> Extent | None:
    """Of a surface within its box, all of which is before the camera; None if nothing of it is there.

    Infinite where nothing is known. Arguments as those of :func:`algebraic_extent`.
    """
    found: Extent | None
    if surface.type == "spiral":
        found = spiral_extent(surface, matrix, eye) or Extent(NOWHERE, NOWHERE, NOWHERE)
    else:
        found = algebraic_extent(form(surface), low, high, matrix, eye)
    return found and _widened(found, low, high, matrix, eye)
