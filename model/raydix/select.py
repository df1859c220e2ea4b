# SPDX-License-Identifier: Apache-2.0
"""Which cell next (mirrors ``rtl/rdx_select.sv``): the candidate cells of both rules.

A value counts as positive if it is above zero; zero counts as not positive. A mask has bit j for cell j.
"""

from .guess import guess
from .halve import halve
from .kernel import kernel


@kernel
def mixed(cells, at, degree):
    """A coefficient is positive and another is not: the hull property does not exclude a root."""
    first = cells[at] > 0
    for i in range(at + 1, at + degree + 1):
        if (cells[i] > 0) != first:
            return True
    return False


@kernel
def changes(cells, at, degree):
    """The cell's ends differ in sign: it holds a root."""
    return (cells[at] > 0) != (cells[at + degree] > 0)


@kernel
def paper(cells, excluded, degree, count):
    """Candidates of the paper rule among ``count`` cells: Case 2 every sign change not excluded, else Case 1."""
    mask = 0
    for j in range(count):
        if changes(cells, j * degree, degree):
            mask |= 1 << j
    if mask == 0:
        return 1 << guess(cells, degree, count)
    return mask & ~excluded


@kernel
def certified(cells, nodes, excluded, last, degree, n1):
    """The first two candidates of the certified rule, and the control points of the first.

    A candidate is a cell that is mixed (at the last level: changes sign) and not excluded. The tree of
    halves is walked from the left, and a node that is not mixed is left out with all its cells: averages
    stay within the hull of their inputs, so none of them could be mixed. ``cells`` holds the
    parent's control points, and on return those of the first candidate if there is one.

    ``nodes`` is scratch for (n1+1)*(degree+1) values: the left half at work at 0, and the right half that
    waits at tree level l from l*(degree+1) on.
    """
    size = degree + 1
    count = 1 << n1
    for i in range(size):
        nodes[i] = cells[i]
    mask = 0
    level = 0  # of the node at nodes[at]; its first cell is j
    at = 0
    j = 0
    while j < count:
        cells_of_node = ((1 << (count >> level)) - 1) << j
        if excluded & cells_of_node != cells_of_node and mixed(nodes, at, degree):
            if level < n1:
                level += 1
                right = level * size
                for i in range(size):
                    nodes[right + i] = nodes[at + i]
                halve(nodes, right, nodes, 0, degree)
                at = 0
                continue
            if not last or changes(nodes, at, degree):
                if mask != 0:
                    return mask | 1 << j
                mask = 1 << j
                for i in range(size):
                    cells[i] = nodes[at + i]
        j += count >> level
        level = n1  # the node at j is a right half; its level follows from j's trailing zeros
        while level > 0 and (j >> (n1 - level)) & 1 == 0:
            level -= 1
        at = level * size
    return mask
