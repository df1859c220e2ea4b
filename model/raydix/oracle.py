# SPDX-License-Identifier: Apache-2.0
"""The ideal scene in float64: what the images are judged by.

Nothing here is shared with the golden model. There is no segment, no fixed point and no Bernstein form: a
ray is the line ``eye + t * direction`` with the depth ``t`` along the view axis as its parameter, the surface
on it is a polynomial of degree <= 4 in the distance from a point of the ray near the object, and its roots
come from the derivative chain: the roots of each derivative cut the line into pieces on which the one before
is monotone, and each piece is searched by Newton steps kept inside a bracket.

Every algebraic surface is written as ``F = Q1 * Q2 + Q3`` with quadrics of ten coefficients each, in the
order of the scene file: xx, yy, zz, xy, yz, zx, x, y, z, 1. A root is a change of the sign of F along the
ray, where zero counts as not positive: a ray that only touches from one side has no root or two equal ones.
The spiral is not algebraic: `raydix.oracle_spiral` samples its indicator along the ray.
"""

from dataclasses import dataclass
from math import radians, tan

import numpy as np
from numba import njit, prange

from raydix import oracle_spiral

MAX_ROOTS = 4
EPSILON = 2.0**-52
BOX_SLACK = 1e-12  # the clip box is closed: its faces count, give or take rounding (in half-extents)


class NotPolynomial(ValueError):
    """The surface is not a polynomial of degree <= 4 on a ray (spiral, for `quadrics`)."""


@dataclass(frozen=True)
class IdealHits:
    """All hits of one surface, for every pixel.

    depth: float64 (H, W, 4), distances of the accepted roots along the view axis, increasing, then inf; the
    nearest four where a spiral has more.
    count: int8 (H, W), how many of them there are, at most four.
    clearance: float64 (H, W), how far the ray is from another number of roots, relative and dimensionless,
    inf where nothing is near. It is the smallest of
      - for each extremum of F in front of the eye: |F| over the sum of the magnitudes of its terms (at the
        point or at the corner of the clip box, whichever is larger), or, if larger, the distance of the
        extremum outside the box in half-extents;
      - for each root in front of the eye: its distance from the surface of the box, in half-extents.
    For a spiral |F| is the indicator in local units over the largest a(s) + r(s), R + r if nothing grows. The
    extrema and roots behind the fourth root count, too, and the eye as if it were an extremum; rays that pass
    by the surface at more than an eighth of its largest r(s) may have inf.
    It serves to explain disagreements, never to decide one.
    """

    depth: np.ndarray
    count: np.ndarray
    clearance: np.ndarray


@dataclass(frozen=True)
class IdealFrame:
    """The nearest hit of all surfaces: depth float64 (H, W), inf = miss; surface int16 (H, W), -1 = miss."""

    depth: np.ndarray
    surface: np.ndarray


def camera_rays(camera):
    """Eye and the vectors (forward, right, up) of the ray ``forward + dx * right + dy * up``, in the world.

    dx = x + 0.5 - W/2 and dy = H/2 - (y + 0.5) in pixels: right and up are as long as one pixel at depth 1.
    """
    eye = np.asarray(camera.eye, dtype=np.float64)
    forward = _unit(np.asarray(camera.look_at, dtype=np.float64) - eye)
    right = _unit(np.cross(forward, np.asarray(camera.up, dtype=np.float64)))
    up = np.cross(right, forward)
    pixel = 2.0 * tan(radians(camera.vfov) / 2.0) / camera.height
    return eye, forward, right * pixel, up * pixel


def quadrics(surface):
    """(3, 10) coefficients of Q1, Q2, Q3 with F = Q1 * Q2 + Q3, in local coordinates."""
    s, zero = surface, [0.0] * 10

    def diagonal(xx, yy, zz, one):
        return [xx, yy, zz, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, one]

    match s.type:
        case "quartic":
            return np.array([s.Q1, s.Q2, s.Q3], dtype=np.float64)
        case "torus":
            ring = diagonal(1.0, 1.0, 1.0, s.R**2 - s.r**2)
            return np.array([ring, ring, diagonal(-4 * s.R**2, -4 * s.R**2, 0.0, 0.0)])
        case "cyclide":
            ring = diagonal(1.0, 1.0, 1.0, s.b**2 - s.d**2)
            c = np.sqrt(s.a**2 - s.b**2)
            rest = diagonal(-4 * s.a**2, -4 * s.b**2, 0.0, -4 * (c * s.d) ** 2)
            rest[6] = 8 * s.a * c * s.d
            return np.array([ring, ring, rest])
        case "quadric":
            q = s.coefficients
        case "plane":
            q = [0.0] * 8 + [1.0, 0.0]
        case "sphere":
            q = diagonal(1.0, 1.0, 1.0, -(s.R**2))
        case "ellipsoid":
            q = diagonal(s.a**-2, s.b**-2, s.c**-2, -1.0)
        case "cylinder":
            q = diagonal(1.0, 1.0, 0.0, -(s.R**2))
        case "cone":
            q = diagonal(1.0, 1.0, -(s.k**2), 0.0)
        case "paraboloid":
            q = [s.a**-2, s.b**-2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0]
        case "hyperbolic_paraboloid":
            q = [s.a**-2, -(s.b**-2), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0]
        case "hyperboloid_one_sheet":
            q = diagonal(s.a**-2, s.b**-2, -(s.c**-2), -1.0)
        case "hyperboloid_two_sheet":
            q = diagonal(s.a**-2, s.b**-2, -(s.c**-2), 1.0)
        case _:
            raise NotPolynomial(f"surface type {s.type!r} is not a polynomial of degree <= 4 on a ray")
    return np.array([zero, zero, q], dtype=np.float64)


def ideal_hits(scene, surface_index):
    """All accepted roots of one surface for the whole image (`IdealHits`).

    A root is accepted if its depth is positive and its local point is inside the clip box.
    Raises `NotPolynomial` for a surface that is neither a polynomial nor a spiral, ValueError for a spiral
    whose radii are not positive at both ends.
    """
    surface, camera = scene.surfaces[surface_index], scene.camera
    to_local = np.linalg.inv(np.asarray(surface.matrix, dtype=np.float64)) / surface.scale
    eye, *axes = camera_rays(camera)
    eye = to_local @ (eye - np.asarray(surface.center, dtype=np.float64))
    axes = np.array([to_local @ axis for axis in axes])

    centre, half, corner = np.zeros(3), np.full(3, np.inf), np.zeros(3)
    if surface.clip is not None:
        low, high = np.asarray(surface.clip, dtype=np.float64)
        centre, half = (low + high) / 2, (high - low) / 2
        half = np.maximum(half, BOX_SLACK * half.max())
        corner = np.maximum(np.abs(low), np.abs(high))

    shape = camera.height, camera.width
    hits = IdealHits(np.full((*shape, MAX_ROOTS), np.inf), np.zeros(shape, np.int8), np.full(shape, np.inf))
    if surface.type == "spiral":
        tube = oracle_spiral.tube(surface)
        oracle_spiral.trace(tube, eye, axes, centre, half, hits.depth, hits.count, hits.clearance)
    else:
        _trace(quadrics(surface), eye, axes, centre, half, corner, hits.depth, hits.count, hits.clearance)
    return hits


def chord_roots(q, h, e):
    """Roots of F = Q1*Q2 + Q3 on chords h + t (e - h), 0 <= t < 1.

    q     (3, 10) coefficients of Q1, Q2, Q3, as from `quadrics`
    h, e  (N, 3) ends in local coordinates
    Returns (N, 4), increasing, nan-padded.
    """
    out = np.full((len(h), MAX_ROOTS), np.nan)
    _chords(np.ascontiguousarray(q), np.ascontiguousarray(h), np.ascontiguousarray(e), out)
    return out


def ideal_frame(scene):
    """The nearest accepted root over all surfaces (`IdealFrame`); at equal depth the lower surface number."""
    shape = scene.camera.height, scene.camera.width
    frame = IdealFrame(np.full(shape, np.inf), np.full(shape, -1, np.int16))
    for index in range(len(scene.surfaces)):
        depth = ideal_hits(scene, index).depth[..., 0]
        nearer = depth < frame.depth
        frame.depth[nearer] = depth[nearer]
        frame.surface[nearer] = index
    return frame


def _unit(v):
    return v / np.linalg.norm(v)


@njit(parallel=True, cache=True, error_model="numpy")
def _trace(q, eye, axes, centre, half, corner, depth, count, clearance):
    """Fill depth, count and clearance; everything in local coordinates, box = centre +- half (or inf)."""
    height, width = count.shape
    size = np.sqrt(np.sum(half * half))
    for row in prange(height):
        roots, extrema = np.empty(MAX_ROOTS), np.empty(MAX_ROOTS)  # in depth, from the closest approach
        for column in range(width):
            ray = axes[0] + (column + 0.5 - width / 2) * axes[1] + (height / 2 - row - 0.5) * axes[2]
            length = np.sqrt(np.sum(ray * ray))
            nearest = np.sum((centre - eye) * ray) / (length * length)  # depth of the closest approach
            base = eye + nearest * ray
            if np.sqrt(np.sum((base - centre) ** 2)) > 1.01 * size:
                continue
            c = _on_ray(q, base, ray)
            reach = 1.01 * size / length if size < np.inf else _root_bound(c)
            n_roots, n_extrema = _real_roots(c, -reach, reach, roots, extrema)

            clear = np.inf
            for s in extrema[:n_extrema]:
                if nearest + s > 0.0:
                    p = base + s * ray
                    value, terms = _value_and_terms(q, p, np.maximum(np.abs(p), corner))
                    relative = abs(value) / terms if terms > 0.0 else 0.0
                    clear = min(clear, max(relative, _box_radius(p, centre, half) - 1.0))
            for s in roots[:n_roots]:
                if nearest + s > 0.0:
                    radius = _box_radius(base + s * ray, centre, half)
                    clear = min(clear, abs(radius - 1.0)) if size < np.inf else clear
                    if radius <= 1.0 + BOX_SLACK:
                        depth[row, column, count[row, column]] = nearest + s
                        count[row, column] += 1
            clearance[row, column] = clear


@njit(cache=True, error_model="numpy")
def _chords(q, h, e, out):
    """Fill out with the roots in [0, 1) of each chord, from coefficients about its middle."""
    roots, extrema = np.empty(MAX_ROOTS), np.empty(MAX_ROOTS)
    for i in range(len(h)):
        ray = e[i] - h[i]
        n_roots, _ = _real_roots(_on_ray(q, h[i] + 0.5 * ray, ray), -0.5, 0.5, roots, extrema)
        for k in range(n_roots):
            out[i, k] = roots[k] + 0.5


@njit(cache=True, error_model="numpy")
def _box_radius(p, centre, half):
    """Largest distance of p from the centre of the box in half-extents: 1 on the faces; 0 without a box."""
    return np.max(np.abs(p - centre) / half)


@njit(cache=True)
def _quadric_on_ray(q, p, d):
    """Coefficients of 1, s, s^2 of the quadric q at p + s d."""
    x, y, z = p
    u, v, w = d
    constant = (
        (q[0] * x + q[3] * y + q[6]) * x + (q[1] * y + q[4] * z + q[7]) * y + (q[2] * z + q[5] * x + q[8]) * z + q[9]
    )
    linear = (
        (2 * q[0] * x + q[3] * y + q[5] * z + q[6]) * u
        + (2 * q[1] * y + q[3] * x + q[4] * z + q[7]) * v
        + (2 * q[2] * z + q[4] * y + q[5] * x + q[8]) * w
    )
    square = (q[0] * u + q[3] * v) * u + (q[1] * v + q[4] * w) * v + (q[2] * w + q[5] * u) * w
    return constant, linear, square


@njit(cache=True)
def _on_ray(q, p, d):
    """Coefficients of 1, s ... s^4 of F = Q1 * Q2 + Q3 at p + s d."""
    q1, q2, q3 = _quadric_on_ray(q[0], p, d), _quadric_on_ray(q[1], p, d), _quadric_on_ray(q[2], p, d)
    c = np.zeros(5)
    for i in range(3):
        c[i] += q3[i]
        for j in range(3):
            c[i + j] += q1[i] * q2[j]
    return c


@njit(cache=True)
def _value_and_terms(q, p, size):
    """F at p, and the sum of the magnitudes of its terms at coordinates of the given size."""
    value, terms = _on_ray(q, p, p), _on_ray(np.abs(q), size, size)
    return value[0], terms[0]


@njit(cache=True)
def _degree(c):
    n = len(c) - 1
    while n > 0 and c[n] == 0.0:
        n -= 1
    return n


@njit(cache=True, error_model="numpy")
def _root_bound(c):
    """A bound of the magnitude of all roots (Fujiwara): at least 1, finite if the leading term is tiny."""
    n, bound = _degree(c), 1.0
    for k in range(n):
        bound = max(bound, 2.0 * abs(c[k] / c[n]) ** (1.0 / (n - k)))
    return min(bound, 1e30)


@njit(cache=True)
def _real_roots(c, low, high, roots, extrema):
    """Sign changes and extrema of the polynomial c on [low, high], increasing; returns how many of each.

    At level m the roots of derivative m + 1 are known; they cut the interval into pieces on which
    derivative m is monotone and so has at most one root.
    """
    n = _degree(c)
    derivative = c[: n + 1].copy()
    n_roots, n_extrema = 0, 0
    for m in range(n - 1, -1, -1):
        for k in range(n - m + 1):
            factor = 1.0
            for i in range(k + 1, k + m + 1):
                factor *= i
            derivative[k] = c[k + m] * factor
        n_extrema = n_roots
        extrema[:n_extrema] = roots[:n_roots]
        n_roots = 0
        a = low
        for piece in range(n_extrema + 1):
            b = extrema[piece] if piece < n_extrema else high
            rising = _horner(derivative, n - m, b)[0] > 0.0
            if rising != (_horner(derivative, n - m, a)[0] > 0.0):
                roots[n_roots] = _bracketed_root(derivative, n - m, a, b, rising)
                n_roots += 1
            a = b
    return n_roots, n_extrema


@njit(cache=True)
def _horner(c, n, x):
    """Value and slope of the polynomial of degree n."""
    value, slope = c[n], 0.0
    for k in range(n - 1, -1, -1):
        slope = slope * x + value
        value = value * x + c[k]
    return value, slope


@njit(cache=True, error_model="numpy")
def _bracketed_root(c, n, a, b, rising):
    """The sign change between a and b to the last bit of float64.

    Newton steps as long as they stay in the bracket and at least halve, bisection otherwise.
    """
    x, step = 0.5 * (a + b), b - a
    for _ in range(400):
        value, slope = _horner(c, n, x)
        if value == 0.0:
            break
        if (value > 0.0) == rising:
            b = x
        else:
            a = x
        newton = x - value / slope
        previous, step_before = x, step
        x = newton if a <= newton <= b else 0.5 * (a + b)
        if abs(x - previous) > 0.5 * step_before:
            x = 0.5 * (a + b)
        step = abs(x - previous)
        if step <= EPSILON * abs(x):
            break
    return x
