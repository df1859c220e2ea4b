# SPDX-License-Identifier: Apache-2.0
"""Solvers that only ask how far a point is from the surface: sphere tracing, samples with bisection or regula falsi.

Each maker takes the kind of surface and what trades time for accuracy, and gives a compiled function of (h, d, sizes).
"""

from math import atan2, hypot, pi, sqrt

import numpy as np
from numba import njit

from . import samples
from .frame import NOTHING, along

SAMPLES = 256


@njit(error_model="numpy")
def sphere(p, s):
    """Distance from a sphere."""
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - s[0]


@njit(error_model="numpy")
def torus(p, s):
    """Distance from a torus."""
    return hypot(hypot(p[0], p[1]) - s[0], p[2]) - s[1]


@njit(error_model="numpy")
def ball(p, s, place):
    """Distance from the ball at a place of the centre curve."""
    radius, angle = s[0] + s[4] * place, 2 * pi * place
    x, y, z = p[0] - radius * np.cos(angle), p[1] - radius * np.sin(angle), p[2] - s[2] * place
    return sqrt(x * x + y * y + z * z) - s[1] - s[5] * place


@njit(error_model="numpy")
def spiral(p, s):
    """Indicator of a spiral tube: the nearest circle in the point's half plane, and the balls at both ends."""
    radius, turn = hypot(p[0], p[1]), atan2(p[1], p[0]) / (2 * pi)
    best = min(ball(p, s, 0.0), ball(p, s, s[3]))
    square = s[2] * s[2] + s[4] * s[4]
    near = ((radius - s[0]) * s[4] + p[2] * s[2]) / square - turn if square > 0.0 else 0.0
    first, last = np.ceil(-turn), np.floor(s[3] - turn)
    for offset in (-1.0, 0.0, 1.0):
        m = min(max(np.floor(near + 0.5) + offset, first), last)
        if first <= last:
            place = m + turn
            tube = hypot(radius - s[0] - s[4] * place, p[2] - s[2] * place) - s[1] - s[5] * place
            best = min(best, tube)
    return best


DISTANCES = {"sphere": sphere, "torus": torus, "spiral": spiral}


@njit(error_model="numpy")
def steepness(s, radius):
    """Largest change of a spiral's indicator per length at this distance from the axis and beyond; 1 without pitch."""
    return sqrt(1.0 + ((hypot(s[2], s[4]) + abs(s[5])) / (2 * pi * radius)) ** 2)


def sphere_tracing(kind, tolerance):
    """Steps as long as the distance allows, until it is below the tolerance; at most 1,000 of them."""
    distance = DISTANCES[kind]
    winds = kind == "spiral"

    @njit(error_model="numpy")
    def solve(h, d, s):
        length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
        clear = min(s[0] - s[1], s[0] + s[3] * s[4] - s[1] - s[3] * s[5]) if winds else 1.0
        steep = steepness(s, 0.5 * clear) if winds else 1.0
        t = 0.0
        for _ in range(1000):
            p = along(h, d, t)
            f = distance(p, s)
            if f < tolerance:
                return t
            step = f / steep
            if winds:  # beyond half of the way to the axis the bound does not hold; about the axis there is nothing
                radius = hypot(p[0], p[1])
                step = max(clear - radius, min(step, 0.5 * radius))
            t += step / length
            if t >= 1.0:
                return NOTHING
        return t

    return solve


def along_ray(kind):
    """The distance as a compiled function of (t, h, d, sizes)."""
    distance = DISTANCES[kind]

    @njit(error_model="numpy")
    def value(t, h, d, s):
        return distance(along(h, d, t), s)

    return value


def sampled_bisection(kind, digits):
    """The first change of sign of 256 samples, halved until ``digits`` digits are known."""
    return samples.bisection(along_ray(kind), SAMPLES, digits)


def sampled_regula_falsi(kind, tolerance):
    """The first change of sign of 256 samples, then the Illinois method."""
    return samples.regula_falsi(along_ray(kind), SAMPLES, tolerance)
