# SPDX-License-Identifier: Apache-2.0
"""Cells beyond a face of the surface's box (mirrors ``rtl/rdx_outside.sv``)."""

from .cells import subdivide
from .formats import COORD_FRAC, FORM_INDEX
from .item import BOX, C
from .kernel import kernel

LOW = FORM_INDEX["low"]
HIGH = FORM_INDEX["high"]


@kernel
def beyond(start, end, box):
    """One axis: both ends lie beyond the same face of the box [-2^(1-box), 2^(1-box)); s2p30."""
    face = 1 << (COORD_FRAC + 1 - box)
    return (start < -face and end < -face) or (start >= face and end >= face)


@kernel
def outside_cells(item, cells, n1):
    """Mask of the cells that lie beyond a face of the surface's box. ``cells`` is scratch."""
    mask = 0
    for axis in range(3):
        box = item[BOX + axis]
        if box == 0:
            continue  # no face cuts this axis
        cells[0] = item[C + axis]
        cells[1] = item[C + 3 + axis]
        subdivide(cells, 1, n1)
        for j in range(1 << n1):
            if beyond(cells[j], cells[j + 1], box):
                mask |= 1 << j
    return mask


@kernel
def outside_faces(item, cells, form, n1):
    """The same for a vector-sum surface, whose box has faces of its own: [low, high] on each axis, s2p30."""
    mask = 0
    for axis in range(3):
        low, high = form[LOW + axis], form[HIGH + axis]
        cells[0] = item[C + axis]
        cells[1] = item[C + 3 + axis]
        subdivide(cells, 1, n1)
        for j in range(1 << n1):
            if (cells[j] < low and cells[j + 1] < low) or (cells[j] > high and cells[j + 1] > high):
                mask |= 1 << j
    return mask
