# SPDX-License-Identifier: Apache-2.0
"""Reciprocal square root by a table with linear interpolation (mirrors ``rtl/rdx_rsqrt.sv``).

An argument in [1/4, 1) has its interval of 2^-9 in a table of 512 words of 36 bits, of which the first quarter is not
used: the function at the interval's start and how much it falls to the interval's end. The chord lies above the
function; the table's start is lowered by half of what that makes at most.
"""

import mpmath as mp

from .kernel import kernel, words

SQUARE_WIDTH = 36  # of the argument, u0p36 after the shift
INDEX_BITS = 9
FRACTION_BITS = 17  # of the place within an interval
BASE_BITS = 18  # u0p18
FALL_BITS = 18  # u-8p26
ROOT_BITS = 17  # of the result, u0p17


def _entry(index: int) -> tuple[int, int]:
    """Start (with half an ulp of the result) and fall of the interval ``index``; 0 where no argument is."""
    if index < 1 << (INDEX_BITS - 2):
        return 0, 0
    with mp.workprec(128):
        size = mp.ldexp(1, -INDEX_BITS)
        left, right = (1 / (2 * mp.sqrt(i * size)) for i in (index, index + 1))
        slope = (left - right) / size
        touch = (4 * slope) ** (-mp.mpf(2) / 3)  # where the function, m^(-1/2)/2, is as steep as the chord
        above = left - (touch - index * size) * slope - 1 / (2 * mp.sqrt(touch))
        base = int(mp.nint(mp.ldexp(left - above / 2, BASE_BITS))) + (1 << (BASE_BITS - ROOT_BITS - 1))
        fall = int(mp.nint(mp.ldexp(left - right, FALL_BITS + 8)))
        return min(base, (1 << BASE_BITS) - 1), min(fall, (1 << FALL_BITS) - 1)


ENTRIES = tuple(_entry(index) for index in range(1 << INDEX_BITS))
BASE = words(base for base, _ in ENTRIES)
FALL = words(fall for _, fall in ENTRIES)


@kernel
def doubled(square):
    """Whether the argument, u36p0 from 2^32 on, needs the even shift: 1 where it is below 2^34."""
    return int(square < (1 << (SQUARE_WIDTH - 2)))


@kernel
def rsqrt(square):
    """2^17 times 2^17 / (2^doubled * sqrt(square)), u0p17 and at least one half; square is 2^32 at least, or 0.

    Relative error at most 2^-16 (``tb/test_rsqrt.py``). Of 0 the result is 0.
    """
    shifted = square << (2 * doubled(square))
    index = shifted >> (SQUARE_WIDTH - INDEX_BITS)
    place = (shifted >> (SQUARE_WIDTH - INDEX_BITS - FRACTION_BITS)) & ((1 << FRACTION_BITS) - 1)
    fallen = (FALL[index] * place) >> FRACTION_BITS
    return ((BASE[index] << 8) - fallen) >> (8 + BASE_BITS - ROOT_BITS)
