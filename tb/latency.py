# SPDX-License-Identifier: Apache-2.0
"""The latencies of ``rtl/rdx_pkg.sv``, in clocks."""

from raydix.formats import SWIRL_ITERATIONS
from raydix.vecsum import iterations

CERTIFIED = 1  # the mask of rules with which the paper rule is not built
TURN = 6
QUARTIC = 7
SETTLE = 3
BOUND = 3
CONSTANT = 2
SWIRL_SIDE, SWIRL_TURN, SWIRL_LEGS, SWIRL_SLOPE, SWIRL_CHORD, SWIRL_END, SWIRL_GRADIENT = 3, 6, 6, 3, 3, 13, 8
SWIRL = SWIRL_ITERATIONS + 1 + SWIRL_TURN + SWIRL_END + 1 + SWIRL_GRADIENT


def tube(drop):
    """Of rdx_tube that leaves ``drop`` digits away."""
    return iterations(drop)[2] + 6


def ball(drop):
    """Of rdx_ball."""
    return 2 * iterations(drop)[2] + 4


def vecsum(drop):
    """Of rdx_vecsum."""
    return iterations(drop)[0] + 1 + TURN + tube(drop) + 6


def phases(points, lanes):
    """Clocks in which a number of lanes evaluates a number of points."""
    return -(-points // lanes)


def product(degree):
    """Of rdx_product, an empty one."""
    return (QUARTIC if degree == 4 else 0) + 4 + 2


def select(n1, rules):
    """Of rdx_select."""
    return 3 if rules == CERTIFIED else 3 + (n1 + 2) // 2


def cells(n1, degree, halve_stages, lanes, drop=0):
    """Of the first part of a step; degree 1: coordinates, evaluator that leaves ``drop`` digits away, bounds."""
    if degree > 1:
        return n1 * halve_stages
    return n1 * halve_stages + vecsum(drop) + phases((1 << n1) - 1, lanes) - 1 + BOUND


def follow(degree, halve_stages):
    """Clocks in which the chosen cell is halved."""
    return min(halve_stages or 4, (degree + 1) // 2)


def moves(degree, halve_stages):
    """Moves of its ends a clock."""
    return max(2, degree // follow(degree, halve_stages))


def pick(n1, degree, halve_stages):
    """From the choice to the chosen cell."""
    return n1 * follow(degree, halve_stages)


def moving(n1, moves=2):
    """Clocks of rdx_descend that are over when the control points of the chosen cell are there."""
    return -(-(n1 + 1) // moves)


def step(n1, degree, halve_stages, lanes, rules, drop=0):
    """Of rdx_step."""
    return cells(n1, degree, halve_stages, lanes, drop) + select(n1, rules) + pick(n1, degree, halve_stages) + SETTLE
