# SPDX-License-Identifier: Apache-2.0
"""Which cell next (mirrors ``rtl/rdx_select.sv``): the candidate cells of both rules.

A value counts as positive if it is above zero; zero counts as not positive. A mask has bit j for cell j.
"""

from .guess import guess
from .halve import halves
from .kernel import kernel


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
def mixed(cell):
    """Of five control points less one, some have the sign bit set and some not: the hull does not exclude a root."""
    a, b, c, d, e = cell
    return ((a | b | c | d | e) ^ (a & b & c & d & e)) < 0


@kernel
def open_cells(j, size, excluded):
    """Whether one of ``size`` cells from j on is not excluded."""
    span = ((1 << size) - 1) << j
    return excluded & span != span


@kernel
def certified(cells, nodes, excluded, last, degree, n1):
    """The first two candidates of the certified rule as (first, second), J where there is none.

    A candidate is a cell that is mixed (at the last level: changes sign) and not excluded. The tree of
    halves is walked from the left, and a node that is not mixed is left out with all its cells: averages
    stay within the hull of their inputs, so none of them could be mixed. ``cells`` holds the
    parent's control points, and on return those of the first candidate if there is one.

    The walk is done on control points less one: what is not positive then has its sign bit set, and averages are the
    same less one. ``nodes`` is scratch for (n1+1)*5 values: right halves that wait, by their level.
    """
    count = 1 << n1
    i, k, m = min(2, degree), min(3, degree), min(4, degree)
    node = (cells[0] - 1, cells[1] - 1, cells[i] - 1, cells[k] - 1, cells[m] - 1)
    first = count
    waiting = 0  # bit l: a right half waits at level l
    level = 0
    j = 0
    found = mixed(node) and (excluded == 0 or open_cells(0, count, excluded))
    while True:
        while found and level < n1:
            left, right = halves(node, degree)
            level += 1
            size = count >> level
            in_left, in_right = mixed(left), mixed(right)
            if excluded != 0:
                in_left = in_left and open_cells(j, size, excluded)
                in_right = in_right and open_cells(j + size, size, excluded)
            if in_left and in_right:
                waiting |= 1 << level
                at = 5 * level
                nodes[at], nodes[at + 1], nodes[at + 2], nodes[at + 3], nodes[at + 4] = right
            found = in_left or in_right
            if in_left:
                node = left
            else:
                node = right
                j += size
        if found and (not last or (node[0] ^ node[4]) < 0):
            if first != count:
                return first, j
            first = j
            cells[m], cells[k], cells[i] = node[4] + 1, node[3] + 1, node[2] + 1
            cells[1], cells[0] = node[1] + 1, node[0] + 1
        if waiting == 0:
            return first, count
        level = n1
        while (waiting >> level) & 1 == 0:
            level -= 1
        waiting ^= 1 << level
        at = 5 * level
        node = (nodes[at], nodes[at + 1], nodes[at + 2], nodes[at + 3], nodes[at + 4])
        size = count >> level
        j = (j & -2 * size) + size
        found = True
