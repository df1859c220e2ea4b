# SPDX-License-Identifier: Apache-2.0
"""Layers of a pixel from front to back (mirrors ``rtl/rdx_blend.sv``). All numbers are u1p16.

A layer takes part = T a of the light, rounded half up, and lets T (1 - a) through, rounded down: from layer to layer
there is one clock, which has no time for more than the product. Both are whole numbers, so that together they are T at
most, and a share of a part, whose colour is at most 1, is no more than the part: a pixel never sums up to more than 1.
"""

from .formats import UNIT_FRAC
from .kernel import kernel

ONE = 1 << UNIT_FRAC


@kernel
def times(a, b):
    """Product of two u1p16, half up."""
    return (a * b + (1 << (UNIT_FRAC - 1))) >> UNIT_FRAC


@kernel
def add_layer(total, through, color, opacity):
    """Add a layer of ``color`` to ``total[0:3]``, ``through`` of which is seen; what is seen of the next one."""
    part = times(through, opacity)
    for channel in range(3):
        total[channel] += times(part, color[channel])
    return (through * (ONE - opacity)) >> UNIT_FRAC


@kernel
def finish(total, through, background):
    """Add the background."""
    for channel in range(3):
        total[channel] += times(through, background[channel])
