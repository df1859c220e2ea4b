# SPDX-License-Identifier: Apache-2.0
"""Indicator of a vector-sum surface at both ends of a new ray's segment (mirrors ``rtl/rdx_ends.sv``)."""

from .item import B, C
from .kernel import kernel
from .vecsum import evaluate


@kernel
def ends(first, lanes, form, general):
    """Values at the ends ``first[C : C+6]`` into ``first[B]`` and ``first[B+1]``, s5p33."""
    for end in range(2):
        lanes.x[end] = first[C + 3 * end]
        lanes.y[end] = first[C + 3 * end + 1]
        lanes.z[end] = first[C + 3 * end + 2]
    evaluate(lanes, 2, form, general)
    first[B] = lanes.value[0]
    first[B + 1] = lanes.value[1]
