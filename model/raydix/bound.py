# SPDX-License-Identifier: Apache-2.0
"""Cells of a vector-sum surface that may hold a root (mirrors ``rtl/rdx_bound.sv``)."""

from .formats import COORD_FRAC, FORM_INDEX, ZONES
from .kernel import kernel

LIPSCHITZ = FORM_INDEX["lipschitz"]
CURVATURE = FORM_INDEX["curvature"]
FROM_LEVEL = FORM_INDEX["from_level"]


@kernel
def zone_of(near):
    """Number of a zone, 0 to 15: the place of the leading one of ``near``, a lower bound of the distance from the axis.

    Zone i > 0 is [2^(i-15), 2^(i-14)), s2p30; zone 0 is what is below.
    """
    zone = 0
    while zone < ZONES - 1 and near >> (COORD_FRAC - ZONES + 2 + zone) != 0:
        zone += 1
    return zone


@kernel
def possible(start, stop, lipschitz, curvature, curved):
    """A root in a cell whose ends have one sign is not excluded by either bound.

    start, stop  indicator at the cell's ends, of one sign
    lipschitz    the indicator changes at most by this over the cell
    curvature    if ``curved``: outside of the solid it lies above its chord less x*(1-x)*curvature, 0 <= x <= 1
    Source: docs/spirals.md, "Two bounds".
    """
    a, b = abs(start), abs(stop)
    may = a + b <= lipschitz
    if curved and start > 0:
        quarter = curvature >> 2
        may = may and a + b <= curvature and (a <= quarter or b <= quarter)
    return may


@kernel
def limits(form, level, zone, n1):
    """Lipschitz and curvature bound over a cell of a step, rounded up, and whether the second holds."""
    below = level - form[FROM_LEVEL + zone]
    lipschitz = (form[LIPSCHITZ + zone] >> n1 * (level + 1)) + 1
    curvature = (form[CURVATURE + zone] >> 2 * n1 * max(below, 0)) + 1
    return lipschitz, curvature, below >= 0


@kernel
def bounded(values, excluded, last, form, level, zone, n1):
    """Candidates of the certified rule among J cells whose boundary values are ``values``: mask, bit j for cell j.

    A cell whose ends differ in sign, and before the last level every cell that :func:`possible` leaves.
    """
    lipschitz, curvature, curved = limits(form, level, zone, n1)
    mask = 0
    for j in range(1 << n1):
        if (values[j] > 0) != (values[j + 1] > 0) or (
            not last and possible(values[j], values[j + 1], lipschitz, curvature, curved)
        ):
            mask |= 1 << j
    return mask & ~excluded
