# SPDX-License-Identifier: Apache-2.0
"""Halving of a cell by de Casteljau's scheme (mirrors ``rtl/rdx_halve.sv``)."""

from .kernel import kernel


@kernel
def average(a, b):
    """(a + b) / 2 rounded half up: never outside [min(a, b), max(a, b)]."""
    return (a + b + 1) >> 1


@kernel
def halve(cell, at, left, to, degree):
    """Split a cell at its middle with averages only.

    ``cell[at : at+degree+1]`` holds the Bernstein coefficients; it becomes the right half in place, and
    the left half goes to ``left[to : to+degree+1]``. The outer ends are copied exactly and the inner end is shared.
    Every new value lies within the hull of the old ones. Source: docs/method.md, "Bernstein form".
    """
    for row in range(degree):
        left[to + row] = cell[at]
        for i in range(at, at + degree - row):
            cell[i] = (cell[i] + cell[i + 1] + 1) >> 1
    left[to + degree] = cell[at]
