# SPDX-License-Identifier: Apache-2.0
"""The paper rule's Case 1 (mirrors ``rtl/rdx_guess.sv``)."""

from .kernel import kernel


@kernel
def guess(cells, degree, count):
    """Paper rule, Case 1 (equations 8, 9): a cell beside the boundary with the smallest magnitude.

    ``cells`` holds ``count`` cells with shared ends. Of the two cells beside that boundary (the lowest on a
    tie) it is the one with the smaller second difference; on a tie the right one.
    """
    best = 0
    for j in range(1, count + 1):
        if abs(cells[j * degree]) < abs(cells[best * degree]):
            best = j
    if best == 0:
        return 0
    if best == count:
        return count - 1
    right = abs(cells[best * degree] - cells[(best + 1) * degree])
    left = abs(cells[(best - 1) * degree] - cells[best * degree])
    return best if right <= left else best - 1
