# SPDX-License-Identifier: Apache-2.0
"""The spiral tube in float64: indicator and gradient in local coordinates.

The tube grows along the centre curve C(s) = (R(s) cos 2*pi*s, R(s) sin 2*pi*s, pitch*s), 0 <= s <= turns, with
R(s) = R + R_growth*s and its own radius r(s) = r + r_growth*s. Its section with the half plane of azimuth theta
(in turns, [0, 1)) is the union of the disks of radius r(s) about C(s), s = m + theta, m = 0, 1, …; a ball closes
each end. The indicator f is the smallest of the signed distances to these disks, within the half plane, and to
the two balls: negative inside, positive outside.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from raydix.scene import Spiral


class _Nearest(NamedTuple):
    """The disk or ball with the smallest signed distance from each point; arrays (...)."""

    distance: np.ndarray
    s: np.ndarray  # where on the centre curve it has its centre, turns
    is_ball: np.ndarray


def value(surface: "Spiral", points: np.ndarray) -> np.ndarray:
    """f in float64 at local points (..., 3); shape (...), in the unit of the lengths."""
    return _nearest(surface, np.asarray(points, dtype=np.float64)).distance


def gradient(surface: "Spiral", points: np.ndarray) -> np.ndarray:
    """Gradient of f in float64 at local points (..., 3); shape (..., 3), not normalised.

    0 where f has none: at the centre of the nearest disk or ball, and on the axis.
    """
    points = np.asarray(points, dtype=np.float64)
    _, s, is_ball = _nearest(surface, points)
    return np.where(is_ball[..., None], _ball_gradient(surface, points, s), _disk_gradient(surface, points, s))


def _radius(surface: "Spiral", s: np.ndarray | float) -> np.ndarray | float:
    return surface.r + surface.r_growth * s


def _centre(surface: "Spiral", s: np.ndarray | float) -> np.ndarray:
    """C(s); shape of s, then 3."""
    angle = 2 * np.pi * (s % 1.0)
    a = surface.R + surface.R_growth * s
    return np.stack(np.broadcast_arrays(a * np.cos(angle), a * np.sin(angle), surface.pitch * s), axis=-1)


def _offsets(surface: "Spiral", points: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distance of the points from the axis, then their distances from C(s) across and along the axis."""
    rho = np.hypot(points[..., 0], points[..., 1])
    return rho, rho - (surface.R + surface.R_growth * s), points[..., 2] - surface.pitch * s


def _azimuth(points: np.ndarray) -> np.ndarray:
    """In turns, 0 to 1; just below 0 it rounds to 1, where the ball stands in for the disk of s = 0."""
    return np.arctan2(points[..., 1], points[..., 0]) / (2 * np.pi) % 1.0


def _nearest(surface: "Spiral", points: np.ndarray) -> _Nearest:
    shape = points.shape[:-1]
    best = _Nearest(np.full(shape, np.inf), np.zeros(shape), np.zeros(shape, bool))

    def closer(distance: np.ndarray, s: np.ndarray | float, is_ball: bool) -> _Nearest:
        less = distance < best.distance
        pairs = zip((distance, s, is_ball), best, strict=True)
        return _Nearest(*(np.where(less, new, old) for new, old in pairs))

    for end in (0.0, surface.turns):
        ball = np.linalg.norm(points - _centre(surface, end), axis=-1) - _radius(surface, end)
        best = closer(ball, end, True)
    theta = _azimuth(points)
    for m in range(int(surface.turns) + 1):
        s = m + theta
        _, across, along = _offsets(surface, points, s)
        disk = np.hypot(across, along) - _radius(surface, s)
        best = closer(np.where(s <= surface.turns, disk, np.inf), s, False)
    return best


def _ball_gradient(surface: "Spiral", points: np.ndarray, s: np.ndarray) -> np.ndarray:
    offset = points - _centre(surface, s)
    length = np.linalg.norm(offset, axis=-1, keepdims=True)
    return offset / np.where(length > 0, length, 1)


def _disk_gradient(surface: "Spiral", points: np.ndarray, s: np.ndarray) -> np.ndarray:
    """With rho, A, B from `_offsets` and D = hypot(A, B): f = D - r(s), ds = dtheta.

    df/drho = A/D, df/dz = B/D, df/dtheta = -(A*R_growth + B*pitch)/D - r_growth, per turn.
    """
    rho, across, along = _offsets(surface, points, s)
    length = np.hypot(across, along)
    good = (rho > 0) & (length > 0)
    rho, length = np.where(good, rho, 1), np.where(good, length, 1)
    outwards = across / length
    turning = (across * surface.R_growth + along * surface.pitch) / length + surface.r_growth
    sideways = -turning / (2 * np.pi * rho)
    x, y = points[..., 0] / rho, points[..., 1] / rho
    parts = outwards * x - sideways * y, outwards * y + sideways * x, along / length
    return np.where(good[..., None], np.stack(parts, axis=-1), 0.0)
