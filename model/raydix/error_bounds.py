# SPDX-License-Identifier: Apache-2.0
"""Bounds of the rounding errors, as docs/error-analysis.md derives them.

Lengths of error are in units of the item's first control points (one of ``sWp0``), of t in ulp (2**-n).
"""

from math import comb

from .formats import OPERAND_SHIFT, PRODUCT_DROP, QUAD_ACC_WIDTH


def word(x: int, y: int, quadratic: bool) -> float:
    """How far a lane's value at the pixel (x, y) can be from that of exact words; docs/error-analysis.md, "Words"."""
    s = x + y
    return (s * s + s + 2) / 4 if quadratic else (s + 1) / 2


def halving(n1: int, steps: int, degree: int, width: int) -> float:
    """How far a control point of any cell that a descent visits can lie above the exact one; never below.

    docs/error-analysis.md, "Halving"
    """
    weights = sum(min(1.0, 4 * degree * 2.0 ** (-n1 * k)) for k in range(steps))
    return n1 * degree / 2 * weights / (1 - 2 * n1 * steps * degree * 2.0**-width)


def product_error(shift: int, largest: float, width: int) -> float:
    """How far a control point of a quartic can be from Q1*Q2 + Q3 of its accumulators, units of sWp0.

    shift    of the first normalisation, to the left
    largest  magnitude among the accumulators of Q1 and Q2
    docs/error-analysis.md, "Product"
    """
    one = (largest * 2.0**-OPERAND_SHIFT + 0.25) * 2.0**-PRODUCT_DROP + 1
    return 6 * one * 2.0 ** (shift - (QUAD_ACC_WIDTH - width)) + 1


def resolution(digits: int, degree: int, width: int) -> float:
    """How high f can rise between two roots in one cell of the last level; docs/error-analysis.md, "Resolution"."""
    return comb(degree, 2) / 4 * 2.0 ** (width + 1 - 2 * digits)


def coordinates(digits: int) -> float:
    """How far the hit point can lie above the exact one, units of s2p30; docs/error-analysis.md, "Coordinates"."""
    return (digits + 1) / 2
