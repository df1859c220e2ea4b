# SPDX-License-Identifier: Apache-2.0
"""The rays of a scene with one surface, in float64: each is cut to the surface's box and given to a solver."""

from collections.abc import Callable
from math import radians, tan
from typing import NamedTuple

import numpy as np
from numba import njit

from raydix.scene import Scene
from raydix.surfaces import bounding_box, form

NOTHING = -1.0  # what a solver returns where there is no root
SLACK = 1e-9  # by which a box about a closed surface is wider, in half-extents


Rendered = tuple[float, Callable[[], np.ndarray]]  # seconds; how to get the depth (height, width), inf = no hit


class Problem(NamedTuple):
    """A surface and the rays of a camera, in the surface's local coordinates.

    kind       type of the surface
    degree     of its polynomial on a ray: 1, 2 or 4
    quadrics   (3, 10) Q1, Q2, Q3 of F = Q1*Q2 + Q3; zeros for a spiral
    sizes      (6,) R, r, pitch, turns, R_growth, r_growth, as far as the surface has them
    eye        (3,); forward, right, up (3,): the ray of pixel centre (a, b) is eye + depth*(forward + a*right + b*up)
    low, high  (3,) the box
    width, height   pixels
    """

    kind: str
    degree: int
    quadrics: np.ndarray
    sizes: np.ndarray
    eye: np.ndarray
    forward: np.ndarray
    right: np.ndarray
    up: np.ndarray
    low: np.ndarray
    high: np.ndarray
    width: int
    height: int


def problem_of(scene: Scene) -> Problem:
    """The problem of a scene. Raises ValueError where it has not exactly one surface, or that has no box."""
    if len(scene.surfaces) != 1:
        raise ValueError(f"{scene.path}: found {len(scene.surfaces)} surfaces; allowed: one")
    surface, camera = scene.surfaces[0], scene.camera
    box = surface.clip or bounding_box(surface)
    if box is None:
        raise ValueError(f"{scene.path}: surface[0].clip: found none; allowed: a box")
    low, high = (np.array([float(v) for v in corner]) for corner in box)
    margin = 0.0 if surface.clip else SLACK * float(np.max(high - low))
    quadrics, degree = np.zeros((3, 10)), 2
    if surface.type != "spiral":
        parts = form(surface)
        for i, quadric in enumerate(parts):
            if quadric is not None:
                quadrics[i] = [float(v) for v in quadric]
        degree = 4 if parts.q1 is not None else 2 if quadrics[2, :6].any() else 1
    names = ("R", "r", "pitch", "turns", "R_growth", "r_growth")
    sizes = np.array([float(getattr(surface, name, 0.0) or 0.0) for name in names])

    eye = np.asarray(camera.eye, np.float64)
    forward = np.asarray(camera.look_at, np.float64) - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, np.asarray(camera.up, np.float64))
    right /= np.linalg.norm(right)
    pixel = 2 * tan(radians(camera.vfov) / 2) / camera.height
    axes = forward, pixel * right, pixel * np.cross(right, forward)
    to_local = np.asarray(surface.matrix, np.float64).T / surface.scale
    return Problem(
        surface.type, degree, quadrics, sizes, to_local @ (eye - np.asarray(surface.center, np.float64)),
        *(np.ascontiguousarray(to_local @ axis) for axis in axes), low - margin, high + margin,
        camera.width, camera.height,
    )  # fmt: skip


@njit(error_model="numpy")
def cut(eye, ray, low, high):
    """Depths at which the ray enters and leaves the box; the first is the larger where it does not meet it."""
    enter, leave = 0.0, np.inf
    for axis in range(3):
        inverse = 1.0 / ray[axis]
        a, b = (low[axis] - eye[axis]) * inverse, (high[axis] - eye[axis]) * inverse
        enter, leave = max(enter, min(a, b)), min(leave, max(a, b))
    return enter, leave


@njit(error_model="numpy")
def ray_of(forward, right, up, a, b):
    """Direction of the ray of pixel centre (a, b), in pixels from the middle; a tuple: nothing is allocated."""
    return (
        forward[0] + a * right[0] + b * up[0],
        forward[1] + a * right[1] + b * up[1],
        forward[2] + a * right[2] + b * up[2],
    )


@njit(error_model="numpy")
def along(p, d, t):
    """p + t*d."""
    return p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]


@njit(error_model="numpy")
def times(d, t):
    """t*d."""
    return t * d[0], t * d[1], t * d[2]


@njit(error_model="numpy")
def on_ray(q, h, d):
    """Coefficients of 1, t, t^2 of a quadric at h + t*d."""
    a = q[0] * h[0] * h[0] + q[1] * h[1] * h[1] + q[2] * h[2] * h[2] + q[3] * h[0] * h[1]
    a += q[4] * h[1] * h[2] + q[5] * h[2] * h[0] + q[6] * h[0] + q[7] * h[1] + q[8] * h[2] + q[9]
    b = 2 * (q[0] * h[0] * d[0] + q[1] * h[1] * d[1] + q[2] * h[2] * d[2]) + q[3] * (h[0] * d[1] + h[1] * d[0])
    b += q[4] * (h[1] * d[2] + h[2] * d[1]) + q[5] * (h[2] * d[0] + h[0] * d[2])
    b += q[6] * d[0] + q[7] * d[1] + q[8] * d[2]
    c = q[0] * d[0] * d[0] + q[1] * d[1] * d[1] + q[2] * d[2] * d[2]
    c += q[3] * d[0] * d[1] + q[4] * d[1] * d[2] + q[5] * d[2] * d[0]
    return a, b, c


@njit(error_model="numpy")
def polynomial(quadrics, degree, h, d, c):
    """Coefficients of 1, t, … t^degree of F at h + t*d into ``c`` (5)."""
    c[:] = 0.0
    c[0], c[1], c[2] = on_ray(quadrics[2], h, d)
    if degree == 4:
        a, b = on_ray(quadrics[0], h, d), on_ray(quadrics[1], h, d)
        for i in range(3):
            for j in range(3):
                c[i + j] += a[i] * b[j]


@njit(error_model="numpy", nogil=True)
def all_rays(degree, quadrics, eye, forward, right, up, low, high, depth, coefficients, pieces):
    """Coefficients (N, 5) of the rays that meet the box, and where each enters and leaves it; returns N."""
    rows, columns = depth.shape
    count = 0
    for y in range(rows):
        for x in range(columns):
            ray = ray_of(forward, right, up, x + 0.5 - 0.5 * columns, 0.5 * rows - y - 0.5)
            enter, leave = cut(eye, ray, low, high)
            depth[y, x] = np.inf
            if enter < leave:
                h, d = along(eye, ray, enter), times(ray, leave - enter)
                polynomial(quadrics, degree, h, d, coefficients[count])
                pieces[count, 0], pieces[count, 1] = enter, leave
                depth[y, x] = -1.0  # to be filled in
                count += 1
    return count


def batch_renderer(solve: Callable) -> Callable:
    """As :func:`renderer` for a solver of (coefficients (N, 5), degree) that gives all roots (N) at a time."""

    def run(problem: Problem) -> np.ndarray:
        p = problem
        depth = np.empty((p.height, p.width))
        coefficients, pieces = np.empty((depth.size, 5)), np.empty((depth.size, 2))
        count = all_rays(
            p.degree, p.quadrics, p.eye, p.forward, p.right, p.up, p.low, p.high, depth, coefficients, pieces
        )
        t = solve(coefficients[:count], p.degree)
        enter, leave = pieces[:count].T
        depth[depth == -1.0] = np.where(t >= 0.0, enter + t * (leave - enter), np.inf)
        return depth

    return run


def renderer(solve: Callable, algebraic: bool) -> Callable:
    """A function of a problem that gives its depth (height, width), inf where nothing is hit, by a compiled loop.

    solve   algebraic: of (coefficients (5), degree), else of (h, d, sizes); the first root t in [0, 1) or NOTHING
    """

    @njit(error_model="numpy", nogil=True)
    def render(degree, quadrics, sizes, eye, forward, right, up, low, high, depth):
        rows, columns = depth.shape
        c = np.zeros(5)
        for y in range(rows):
            for x in range(columns):
                ray = ray_of(forward, right, up, x + 0.5 - 0.5 * columns, 0.5 * rows - y - 0.5)
                enter, leave = cut(eye, ray, low, high)
                depth[y, x] = np.inf
                if enter < leave:
                    h, d = along(eye, ray, enter), times(ray, leave - enter)
                    if algebraic:
                        polynomial(quadrics, degree, h, d, c)
                        t = solve(c, degree)
                    else:
                        t = solve(h, d, sizes)
                    if t >= 0.0:
                        depth[y, x] = enter + t * (leave - enter)

    def run(problem: Problem) -> np.ndarray:
        depth = np.empty((problem.height, problem.width))
        render(*problem[1:10], depth)
        return depth

    return run
