# SPDX-License-Identifier: Apache-2.0
"""Gradient of an algebraic surface at a point, from the constants of its material (mirrors ``rtl/rdx_gradient.sv``).

With p the point, s2p16, and a quadric's matrix M, linear part m and constant c, s1p17:

    g = M p + m              each product s3p33, their sum below 3*2 + 1 = 7: s4p33, 37 bits
    w = g + m                below 8: s4p33
    q = w p / 2 + c          w rounded to s2p16; below 3*2*2/2 + 1 = 7: s4p33
    G = q1 g2 + q2 g1 + g3   g1, g2, q1, q2 rounded to s2p16, products s4p32; below 4 + 4 + 7 = 15: s5p33, 38 bits

Each rounding is half up and saturates; compile scales g, w and q to be below 2. G is rounded half up to s5p27 and then
scaled by a power of two so that the largest component fills 18 bits (floor).
"""

from .formats import COORD_FRAC, MATERIAL_INDEX
from .kernel import kernel
from .normalize import normalize

POINT_FRAC = 16  # of a point, s2p16
CONSTANT_FRAC = 17  # of a constant, s1p17
NARROW = 18  # bits of what is multiplied
WIDE = 32  # bits of a vector before it is scaled
GRADIENT_DROP = 6  # s5p33 to s5p27

AT_Q1, AT_Q2, AT_Q3 = (MATERIAL_INDEX[name] for name in ("q1_matrix", "q2_matrix", "q3_matrix"))
LINEAR = 6  # place of the linear part after the matrix
CONSTANT = 9  # and of the constant


@kernel
def half_up(value, drop):
    """``value`` without its last ``drop`` bits, half up."""
    return (value + (1 << (drop - 1))) >> drop


@kernel
def narrow(value, drop):
    """``value`` without its last ``drop`` bits, half up and saturated to 18 bits."""
    return min(max(half_up(value, drop), -(1 << (NARROW - 1))), (1 << (NARROW - 1)) - 1)


@kernel
def slope(material, at, p, axis):
    """Component ``axis`` of M p, s4p33, of the quadric whose constants begin at ``at``."""
    x = axis
    y, z = (x + 1) % 3, (x + 2) % 3
    xy, zx = 3 + x, 3 + z  # xy, yz, zx stand at 3, 4, 5
    return material[at + x] * p[x] + material[at + xy] * p[y] + material[at + zx] * p[z]


@kernel
def quadric(material, at, p, g):
    """Value of a quadric, s2p16; its gradient goes to ``g[0:3]``, s2p16."""
    total = material[at + CONSTANT] << POINT_FRAC
    for axis in range(3):
        linear = material[at + LINEAR + axis]
        steep = slope(material, at, p, axis)
        g[axis] = narrow(steep + (linear << POINT_FRAC), CONSTANT_FRAC)
        total += narrow(steep + (linear << (POINT_FRAC + 1)), CONSTANT_FRAC) * p[axis]
    return narrow(total, CONSTANT_FRAC)


@kernel
def gradient(material, point, work, degree):
    """The gradient at ``point`` (s2p30), scaled to fill 18 bits, to ``work[0:3]``.

    material  the constants of the surface, in the places of ``formats.MATERIAL``
    work      twelve words: the gradient, then room
    degree    2: Q1 and Q2 are not looked at; 4
    """
    p, g1, g2 = work[3:6], work[6:9], work[9:12]
    for axis in range(3):
        p[axis] = narrow(point[axis], COORD_FRAC - POINT_FRAC)
    q1 = q2 = 0
    if degree > 2:
        q1 = quadric(material, AT_Q1, p, g1)
        q2 = quadric(material, AT_Q2, p, g2)
    for axis in range(3):
        total = slope(material, AT_Q3, p, axis) + (material[AT_Q3 + LINEAR + axis] << POINT_FRAC)
        if degree > 2:
            total += (q1 * g2[axis] + q2 * g1[axis]) << 1
        work[axis] = half_up(total, GRADIENT_DROP)
    normalize(work, 0, 3, WIDE, NARROW, WIDE - 1)
