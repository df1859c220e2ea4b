# SPDX-License-Identifier: Apache-2.0
"""Layers of a pixel from front to back (mirrors ``rtl/rdx_blend.sv``). All numbers are u1p16.

A layer takes part = T a of the light, rounded half up, and lets T (1 - a) through, rounded down: from layer to layer
there is one clock, which has no time for more than the product. So part and what is let through are together at most T
and half an ulp, and a pixel of n layers sums up to 1 and n ulp at most, which is cut to 1.
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
    """Add the background and cut to 1."""
    for channel in range(3):
        total[channel] = min(total[channel] + times(through, background[channel]), ONE)
