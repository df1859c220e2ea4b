# SPDX-License-Identifier: Apache-2.0
"""Light on a surface from its gradient (mirrors ``rtl/rdx_light.sv``).

N = T G            s2p34 products, their sum below 3: s3p34, 37 bits; rounded half up to s3p29, 32 bits,
                   then scaled by a power of two so that the largest component fills 18 bits (floor)
s = |N|^2          at least 2^32, or 0; at most 3*2^34: u36p0
cos = N3 / sqrt(s) the product of N3 and the root, 35 bits, negated where the ray does not enter,
                   doubled where the root needs it; u1p16 half up, from 0 to 1
"""

from .blend import times
from .formats import MATERIAL_INDEX, UNIT_FRAC
from .gradient import NARROW, WIDE, half_up
from .kernel import kernel
from .normalize import normalize
from .rsqrt import ROOT_BITS, doubled, rsqrt

NORMAL_DROP = 5  # s3p34 to s3p29
ONE = 1 << UNIT_FRAC
AT_LIGHT, AT_COLOR = (MATERIAL_INDEX[name] for name in ("light", "color"))


@kernel
def cosine(material, gradient, enters, work):
    """Cosine of the angle between normal and light, u1p16; 0 where the light is behind.

    work  three words of room
    """
    for row in range(3):
        total = 0
        for column in range(3):
            total += material[AT_LIGHT + 3 * row + column] * gradient[column]
        work[row] = half_up(total, NORMAL_DROP)
    normalize(work, 0, 3, WIDE, NARROW, WIDE - 1)
    square = work[0] * work[0] + work[1] * work[1] + work[2] * work[2]
    product = work[2] * rsqrt(square)
    if not enters:
        product = -product
    return min(max(half_up(product << doubled(square), 2 * ROOT_BITS - UNIT_FRAC), 0), ONE)


@kernel
def color(material, ambient, cos, out):
    """Linear colour of a layer to ``out[0:3]``, u1p16: (ambient + (1 - ambient) cos) times the material's."""
    level = ambient + times(ONE - ambient, cos)
    for channel in range(3):
        out[channel] = times(level, material[AT_COLOR + channel])
