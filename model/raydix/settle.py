# SPDX-License-Identifier: Apache-2.0
"""The end of a descent (mirrors ``rtl/rdx_settle.sv``)."""

from .halve import average
from .item import BOX, DEPTH, C
from .kernel import kernel
from .outside import HIGH, LOW, beyond


@kernel
def settle(item, form, degree):
    """After the last digit: shrink the cell to its middle, the hit point; say whether that is inside the box."""
    inside = True
    for axis in range(3):
        middle = average(item[C + axis], item[C + 3 + axis])
        item[C + axis] = middle
        item[C + 3 + axis] = middle
        if degree == 1:
            outside = middle < form[LOW + axis] or middle > form[HIGH + axis]
        else:
            outside = beyond(middle, middle, item[BOX + axis])
        if outside:
            inside = False
    middle = average(item[DEPTH], item[DEPTH + 1])
    item[DEPTH] = middle
    item[DEPTH + 1] = middle
    return inside
