# SPDX-License-Identifier: Apache-2.0
"""What an item carries linearly along its segment: coordinates and depth (mirrors ``rtl/rdx_descend.sv``)."""

from .halve import average
from .kernel import kernel


@kernel
def descend(item, at, other, pick, n1):
    """Replace the ends ``item[at]``, ``item[other]`` of a linear value by those of cell ``pick``."""
    start, stop = item[at], item[other]
    for bit in range(n1 - 1, -1, -1):
        middle = average(start, stop)
        upper = (pick >> bit) & 1
        start, stop = (middle, stop) if upper else (start, middle)
    item[at], item[other] = start, stop
