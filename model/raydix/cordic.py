# SPDX-License-Identifier: Apache-2.0
"""CORDIC in vectoring mode (mirrors ``rtl/rdx_cordic.sv``): length and angle of plane vectors by shifts and additions.

The vectors of all lanes are turned step by step, so that the compiler can do the lanes side by side.
"""

import mpmath as mp

from .formats import ANGLE_WIDTH, LARGEST_ITERATIONS
from .kernel import kernel


def _angles():
    with mp.workprec(128):
        turn = mp.ldexp(1, ANGLE_WIDTH) / (2 * mp.pi)
        return tuple(int(mp.nint(mp.atan(mp.ldexp(1, -i)) * turn)) for i in range(LARGEST_ITERATIONS))


ANGLES = _angles()  # atan(2^-i) in turns, u0p32


def gain(iterations: int) -> mp.mpf:
    """K, by which the length of a vector grows: the product of sqrt(1 + 4^-i)."""
    return mp.fprod(mp.sqrt(1 + mp.ldexp(1, -2 * i)) for i in range(iterations))


@kernel
def turned(x, y, angle, i, drop):
    """Iteration ``i`` for one vector: towards the axis by atan(2^-i), which has ``drop`` digits fewer."""
    below = y >> 63  # -1: the vector is below the axis and turns to the left
    dx, dy, by = y >> i, x >> i, (ANGLES[i] + ((1 << drop) >> 1)) >> drop
    return x + ((dx ^ below) - below), y - ((dy ^ below) - below), angle + ((by ^ below) - below)


@kernel
def right_half(x, y, angle, count, drop):
    """Vectors of the left half plane: half a turn first."""
    for j in range(count):
        back = x[j] >> 63
        x[j] = (x[j] ^ back) - back
        y[j] = (y[j] ^ back) - back
        angle[j] = back & (1 << (ANGLE_WIDTH - drop - 1))


@kernel
def vectoring(x, y, angle, count, iterations, still, drop):
    """Turn ``count`` vectors (x, y) onto the positive x axis.

    x      on return K times the length
    y      on return what is left of it, about 2^(1-iterations) of the length
    angle  on return the vectors' angle in turns, u0p32 modulo one turn, of which the last ``drop`` digits are 0
    From iteration ``still`` on x stays as it is: it would change by less than an ulp where 2*still is above its width.
    The numbers have any fixed point; each iteration rounds down once in x and once in y. x needs one bit more than the
    length. ``iterations`` and ``still`` are multiples of 4.
    Source: J. E. Volder, The CORDIC trigonometric computing technique, 1959.
    """
    right_half(x, y, angle, count, drop)
    for i in range(0, still, 4):  # by fours, which stay in registers
        for j in range(count):
            u, v, w = turned(x[j], y[j], angle[j], i, drop)
            u, v, w = turned(u, v, w, i + 1, drop)
            u, v, w = turned(u, v, w, i + 2, drop)
            x[j], y[j], angle[j] = turned(u, v, w, i + 3, drop)
    for i in range(still, iterations, 4):
        for j in range(count):
            _, v, w = turned(x[j], y[j], angle[j], i, drop)
            _, v, w = turned(x[j], v, w, i + 1, drop)
            _, v, w = turned(x[j], v, w, i + 2, drop)
            _, y[j], angle[j] = turned(x[j], v, w, i + 3, drop)
    for j in range(count):
        angle[j] = (angle[j] << drop) & ((1 << ANGLE_WIDTH) - 1)


@kernel
def lengths(x, y, count, iterations):
    """The same without the angle: K times the length of (x, y) into ``x``; ``y`` is destroyed.

    The length is right to 2^-(2*iterations-1) of itself, so half as many iterations do as for the angle.
    """
    for j in range(count):
        x[j] = abs(x[j])
    for i in range(0, iterations, 4):
        for j in range(count):
            u, v, _ = turned(x[j], y[j], 0, i, 0)
            u, v, _ = turned(u, v, 0, i + 1, 0)
            u, v, _ = turned(u, v, 0, i + 2, 0)
            x[j], y[j], _ = turned(u, v, 0, i + 3, 0)
