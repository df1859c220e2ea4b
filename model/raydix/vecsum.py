# SPDX-License-Identifier: Apache-2.0
"""The indicator of a spiral at a point: its distance from the surface (mirrors ``rtl/rdx_vecsum.sv``).

All points of a step are evaluated side by side. Lengths across the axis carry the gain K of a CORDIC, those of the
indicator K^2: compile puts the gain into the constants, so it costs nothing here.
"""

from typing import NamedTuple

import numpy as np

from .cordic import lengths, vectoring
from .formats import (
    ANGLE_ITERATIONS,
    COORD_FRAC,
    FORM_INDEX,
    LENGTH_ITERATIONS,
    TURN_FRAC,
    VECTOR_FRAC,
    VECTOR_WIDTH,
)
from .kernel import kernel, subroutine, zeros
from .multiply import scaled
from .turn import nearest

GUARD = FORM_INDEX["guard"]
RADIUS = FORM_INDEX["radius"]
PITCH = FORM_INDEX["pitch"]
HEIGHT = FORM_INDEX["height"]
TUBE = FORM_INDEX["tube"]
SPLIT = FORM_INDEX["split"]
START = FORM_INDEX["start"]
STOP = FORM_INDEX["stop"]
TUBE_STOP = FORM_INDEX["tube_stop"]
RADIUS_GROWTH = FORM_INDEX["radius_growth"]
TUBE_GROWTH = FORM_INDEX["tube_growth"]

UP = VECTOR_FRAC - COORD_FRAC  # coordinate s2p30 to length s5p33
GROWTH_DROP = 30 + TURN_FRAC - VECTOR_FRAC  # s6p30 times turns to a length
FAR = (1 << (VECTOR_WIDTH - 1)) - 1
DROPS = (0, 4, 8, 12)


class Lanes(NamedTuple):
    """Working vectors of the evaluator, one place for each lane, two in u and v; lengths have ``drop`` digits fewer."""

    x: np.ndarray  # the point, s2p30; z carries K
    y: np.ndarray
    z: np.ndarray
    value: np.ndarray  # the indicator, s5p33
    rho: np.ndarray
    angle: np.ndarray
    size: np.ndarray  # the tube's radius
    height: np.ndarray  # over the centre of a ball
    u: np.ndarray  # legs of triangles: with the tube's centre, then with the ball's
    v: np.ndarray
    drop: int  # digits that the evaluator leaves away, one of DROPS


def new_lanes(count: int, drop: int = 0) -> Lanes:
    """Vectors for ``count`` lanes of an evaluator that leaves ``drop`` digits away."""
    vectors = {name: zeros(2 * count if name in "uv" else count) for name in Lanes._fields if name != "drop"}
    return Lanes(**vectors, drop=drop)


@kernel
def iterations(drop):
    """Iterations of the angle's CORDIC, that from which on its radius stays, those of a length's; multiples of 4."""
    angle = ANGLE_ITERATIONS - drop
    still = ((VECTOR_WIDTH - drop) // 8 + 1) * 4
    return angle, min(still, angle), (2 * LENGTH_ITERATIONS - drop + 7) // 8 * 4


@kernel
def tube(lanes, count, form, second, general):
    """Legs of the triangle between the points and the centre of the nearest turn; the tube's radius there."""
    drop = lanes.drop
    for j in range(count):
        place = nearest(lanes.rho[j] << drop, lanes.z[j], lanes.angle[j], form, second, general)
        radius, size = form[RADIUS], form[TUBE]
        if general:
            radius += scaled(place, form[RADIUS_GROWTH], GROWTH_DROP)
            size += scaled(place, form[TUBE_GROWTH], GROWTH_DROP)
            size = size if place >= 0 else -FAR  # no turn at this azimuth
        lanes.u[j] = lanes.rho[j] - (radius >> drop)
        lanes.v[j] = ((lanes.z[j] << UP) - form[HEIGHT] - scaled(place, form[PITCH], GROWTH_DROP)) >> drop
        lanes.size[j] = size >> drop


@kernel
def ball(lanes, count, form, second, general):
    """Legs in the plane, and height, of the points over the ball at an end (without ``general``: at the nearer one)."""
    drop = lanes.drop
    for j in range(count):
        stop = second == 1 if general else lanes.z[j] >= form[SPLIT]
        lanes.u[count + j] = ((lanes.x[j] - (form[STOP] if stop else form[START])) << UP) >> drop
        lanes.v[count + j] = ((lanes.y[j] - (form[STOP + 1] if stop else form[START + 1])) << UP) >> drop
        lanes.height[j] = ((lanes.z[j] - (form[STOP + 2] if stop else form[START + 2])) << UP) >> drop


@subroutine
def evaluate(lanes, count, form, general):
    """Indicator at ``count`` points (x, y, z) into ``value``: sign of the distance from the solid, and a bound of it.

    The magnitude is K^2 times the distance, but at most half of 1.5 K times the distance from the axis (beyond that
    the bound of the indicator's change does not hold), and at least ``guard`` less the whole of it (about the axis
    there is no surface, and the azimuth means nothing). Positive outside; zero counts as inside.
    ``general``: 0 where neither radius grows and the spiral has a whole turn at least, else 1.
    Lengths are those of s5p33 without the last ``lanes.drop`` digits, which are 0 in ``value``; ``rho`` stays without.
    Source: docs/spirals.md, "The indicator".
    """
    drop = lanes.drop
    around, still, along = iterations(drop)
    for j in range(count):
        lanes.rho[j] = (lanes.x[j] << UP) >> drop
        lanes.v[j] = (lanes.y[j] << UP) >> drop
        lanes.value[j] = FAR >> drop
    vectoring(lanes.rho, lanes.v, lanes.angle, count, around, still, drop)
    for second in range(1 + general):
        tube(lanes, count, form, second, general)
        ball(lanes, count, form, second, general)
        lengths(lanes.u, lanes.v, 2 * count, along)
        for j in range(count):
            lanes.value[j] = min(lanes.value[j], lanes.u[j] - lanes.size[j])
            lanes.u[j] = lanes.u[count + j]
        lengths(lanes.u, lanes.height, count, along)
        size = (form[TUBE_STOP] if second else form[TUBE]) >> drop
        for j in range(count):
            lanes.value[j] = min(lanes.value[j], lanes.u[j] - size)
    for j in range(count):
        axis = lanes.rho[j] + (lanes.rho[j] >> 1)
        outside = lanes.value[j] > 0
        size = max((form[GUARD] >> drop) - axis, min(abs(lanes.value[j]), axis >> 1))
        lanes.value[j] = (size if outside else -size) << drop
