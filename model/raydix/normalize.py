# SPDX-License-Identifier: Apache-2.0
"""Common scaling of control points (mirrors ``rtl/rdx_normalize.sv``)."""

from .kernel import kernel


@kernel
def redundant_bits(values, at, count, width, limit):
    """Sign bits that all of ``values[at : at+count]`` (``width`` bits each) can lose, at most ``limit``."""
    used = 0
    for i in range(at, at + count):
        used |= values[i] ^ (values[i] >> 63)
    shift = 0
    for stage in (32, 16, 8, 4, 2, 1):
        if stage <= limit and used < (1 << max(0, width - 1 - shift - stage)):
            shift += stage
    return shift


@kernel
def norm_limit(n1):
    """Largest shift of the step's normaliser: it covers a double root, which loses 2*n1 bits a step."""
    limit = 1
    while limit < 2 * n1:
        limit = 2 * limit + 1
    return limit


@kernel
def normalize(values, at, count, width_in, width_out, limit):
    """Shift left by the common redundant sign bits, at most ``limit``; keep the top ``width_out`` bits (floor).

    The roots of the polynomial do not move when all coefficients are scaled by one positive factor, so
    no exponent is kept. Exact for ``width_in == width_out``; otherwise each value drops less than one ulp.
    """
    shift = redundant_bits(values, at, count, width_in, limit)
    for i in range(at, at + count):
        values[i] = (values[i] << shift) >> (width_in - width_out)
