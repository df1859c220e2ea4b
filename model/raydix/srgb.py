# SPDX-License-Identifier: Apache-2.0
"""Linear to sRGB-encoded intensity by a table (mirrors ``rtl/rdx_srgb.sv``; IEC 61966-2-1).

The table's steps are 2^-14 below 1/16, 2^-12 below 1/4 and 2^-11 above. An address of 12 bits is 0 and ten bits of the
intensity, or 1 in the second bit and ten, or 1 in the first and eleven; an entry is the code of its interval's middle.
Intensity 1 itself has the address at which the third part would begin with 0, which no other intensity has.
"""

import mpmath as mp

from .formats import UNIT_FRAC
from .kernel import kernel, words

ADDRESS_BITS = 12
ONE_ADDRESS = 1 << (ADDRESS_BITS - 1)


def encoded(value: mp.mpf) -> mp.mpf:
    """255 times the sRGB-encoded intensity of a linear one."""
    return 255 * (
        mp.mpf("12.92") * value
        if value <= 0.0031308
        else mp.mpf("1.055") * value ** (1 / mp.mpf("2.4")) - mp.mpf("0.055")
    )


def _code(address: int) -> int:
    """The entry at ``address``."""
    with mp.workprec(128):
        if address == ONE_ADDRESS:
            return 255
        low = address & (ONE_ADDRESS - 1 if address >= ONE_ADDRESS else ONE_ADDRESS // 2 - 1)
        step = 11 if address >= ONE_ADDRESS else 12 if address >= ONE_ADDRESS // 2 else 14
        return int(mp.nint(encoded(mp.ldexp(low + mp.mpf(1) / 2, -step))))


CODES = words(_code(address) for address in range(1 << ADDRESS_BITS))


@kernel
def srgb(value):
    """Code, 0 to 255, of a linear intensity, u1p16 and at most 1.

    At most 0.61 codes from the exact encoding (``tb/test_srgb.py``).
    """
    if value >= 1 << (UNIT_FRAC - 2):
        return CODES[ONE_ADDRESS | ((value >> 5) & (ONE_ADDRESS - 1))]
    if value >= 1 << (UNIT_FRAC - 4):
        return CODES[ONE_ADDRESS // 2 | value >> 4]
    return CODES[value >> 2]
