# SPDX-License-Identifier: Apache-2.0
"""The J cells of a step (mirrors ``rtl/rdx_cells.sv``)."""

from .halve import halve
from .kernel import kernel


@kernel
def subdivide(cells, degree, n1):
    """Halve ``n1`` times: ``cells[0 : degree+1]`` becomes J cells that share their ends.

    On return cell j is ``cells[j*degree : j*degree + degree + 1]``; ``cells`` needs J*degree + 1 places.
    """
    count = 1
    for _ in range(n1):
        for j in range(count - 1, -1, -1):
            for i in range(degree, -1, -1):
                cells[(2 * j + 1) * degree + i] = cells[j * degree + i]
            halve(cells, (2 * j + 1) * degree, cells, 2 * j * degree, degree)
        count *= 2
