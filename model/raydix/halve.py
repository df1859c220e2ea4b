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


@kernel
def halves(cell, degree):
    """Both halves of a cell of five numbers, the same as :func:`halve` gives; below degree 4 the last one is repeated.

    Numbers stay in registers where a vector would go through the memory: the walk of the certified rule takes a third
    less time with it.
    """
    a, b, c, d, e = cell
    ab, bc = average(a, b), average(b, c)
    if degree == 1:
        return (a, ab, ab, ab, ab), (ab, b, b, b, b)
    abc, cd = average(ab, bc), average(c, d)
    if degree == 2:
        return (a, ab, abc, abc, abc), (abc, bc, c, c, c)
    bcd, de = average(bc, cd), average(d, e)
    abcd, cde = average(abc, bcd), average(cd, de)
    if degree == 3:
        return (a, ab, abc, abcd, abcd), (abcd, bcd, cd, d, d)
    bcde = average(bcd, cde)
    middle = average(abcd, bcde)
    return (a, ab, abc, abcd, middle), (middle, bcde, cde, de, e)
