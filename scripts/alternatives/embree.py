# SPDX-License-Identifier: Apache-2.0
"""The same rays in Embree, through embreex: the surface is tessellated. Rays and vertices are single precision.

Time is that of the intersections of all pixels' rays on one thread; making the mesh and its tree is not in it.
"""

import time
from functools import lru_cache
from importlib.util import find_spec
from math import pi
from typing import NamedTuple

import numpy as np

from .frame import Problem, Rendered

FAR = 1e20  # and beyond: no hit
KINDS = ("sphere", "torus", "hyperboloid_two_sheet", "spiral")


class Frozen(NamedTuple):
    """A problem as a key: two are the same where they are one object."""

    of: Problem

    def __hash__(self):
        return id(self.of)

    def __eq__(self, other):
        return self.of is other.of


def missing() -> str:
    """Why Embree cannot be had, or nothing."""
    return "" if find_spec("embreex") else "Embree is not installed (pip install embreex)"


def grid(points: np.ndarray) -> np.ndarray:
    """Triangles (N, 3, 3) of a grid of points (rows, columns, 3)."""
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[:-1, 1:], points[1:, 1:]
    return np.stack([np.stack([a, b, d], axis=-2), np.stack([a, d, c], axis=-2)]).reshape(-1, 3, 3)


def ball(center, radius: float, count: int) -> np.ndarray:
    """A sphere of about ``2 * count**2`` triangles."""
    v, u = np.meshgrid(np.linspace(0, pi, count + 1), np.linspace(0, 2 * pi, 2 * count + 1), indexing="ij")
    return grid(center + radius * np.stack([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)], axis=-1))


def tube(ring: float, radius: float, pitch: float, turns: float, around: int, along: int) -> np.ndarray:
    """A torus, or with a pitch a spiral's tube: circles in the half planes through the axis."""
    u, v = np.meshgrid(np.linspace(0, turns, along + 1), np.linspace(0, 2 * pi, around + 1), indexing="ij")
    rho, angle = ring + radius * np.cos(v), 2 * pi * u
    return grid(np.stack([rho * np.cos(angle), rho * np.sin(angle), pitch * u + radius * np.sin(v)], axis=-1))


def sheets(quadric: np.ndarray, low, high, count: int) -> np.ndarray:
    """Both sheets of x²/a² + y²/b² − z²/c² = −1, a fan of rings up to the box's faces in z."""
    a, b, c = 1 / np.sqrt([quadric[0], quadric[1], -quadric[2]])
    parts = []
    for side, end in ((-1, low[2]), (1, high[2])):
        reach = np.arccosh(max(1.0, side * end / c))
        s, u = np.meshgrid(np.linspace(0, reach, count + 1), np.linspace(0, 2 * pi, 4 * count + 1), indexing="ij")
        x, y = a * np.sinh(s) * np.cos(u), b * np.sinh(s) * np.sin(u)
        parts.append(grid(np.stack([x, y, side * c * np.cosh(s)], axis=-1)))
    triangles = np.concatenate(parts)
    middle = triangles.mean(axis=1)
    return triangles[((middle >= low) & (middle <= high)).all(axis=1)]


def tessellate(problem: Problem, triangles: float) -> np.ndarray:
    """About so many triangles (N, 3, 3) of the surface, in its local coordinates."""
    ring, radius, pitch, turns = problem.sizes[:4]
    if problem.kind == "sphere":
        return ball(0.0, ring, round((triangles / 4) ** 0.5))
    if problem.kind == "torus":  # triangles about as long as wide
        around = round((triangles / 2 * radius / ring) ** 0.5)
        return tube(ring, radius, 0.0, 1.0, around, round(triangles / 2 / around))
    if problem.kind == "spiral":
        around = round((triangles / 2 * radius / ring / turns) ** 0.5)
        ends = [np.array([ring * np.cos(2 * pi * u), ring * np.sin(2 * pi * u), pitch * u]) for u in (0.0, turns)]
        balls = [ball(end, radius, around // 2) for end in ends]
        return np.concatenate([tube(ring, radius, pitch, turns, around, round(triangles / 2 / around)), *balls])
    return sheets(problem.quadrics[2], problem.low, problem.high, round((triangles / 16) ** 0.5))


@lru_cache(maxsize=16)
def prepare(problem: Frozen, triangles: float):
    """The scene in Embree, origins and directions of all rays (N, 3)."""
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    p = problem.of
    scene = EmbreeScene()
    TriangleMesh(scene, tessellate(p, triangles).astype(np.float32))
    a, b = np.arange(p.width) + 0.5 - 0.5 * p.width, 0.5 * p.height - np.arange(p.height) - 0.5
    rays = (p.forward + a[:, None] * p.right + b[:, None, None] * p.up).reshape(-1, 3).astype(np.float32)
    origins = np.broadcast_to(p.eye.astype(np.float32), rays.shape).copy()
    scene.run(origins[:1], rays[:1])  # builds the tree
    return scene, origins, rays


def render(problem: Problem, triangles: float) -> Rendered:
    """Seconds of intersecting, and how to get the depth."""
    scene, origins, rays = prepare(Frozen(problem), triangles)
    begun = time.perf_counter()
    found = scene.run(origins, rays, query="DISTANCE")
    seconds = time.perf_counter() - begun
    shape = problem.height, problem.width
    return seconds, lambda: np.where(found < FAR, found.astype(np.float64), np.inf).reshape(shape)
