# SPDX-License-Identifier: Apache-2.0
"""Product of two 36-bit operands (mirrors ``rtl/rdx_multiply.sv``)."""

from .formats import OPERAND_WIDTH, PRODUCT_DROP
from .kernel import kernel


@kernel
def multiply(a, b):
    """floor(a * b / 2^12) of two s36p0 operands, formed from halves of 18 bits so that 64 bits suffice."""
    half = OPERAND_WIDTH // 2
    mask = (1 << half) - 1
    a1, a0 = a >> half, a & mask
    b1, b0 = b >> half, b & mask
    high = (a1 * b1) << (2 * half - PRODUCT_DROP)
    middle = (a1 * b0 + a0 * b1) << (half - PRODUCT_DROP)
    return high + middle + ((a0 * b0) >> PRODUCT_DROP)


@kernel
def scaled(a, b, drop):
    """floor(a * b / 2^drop) of two s36p0 operands, ``drop`` at least 12."""
    return multiply(a, b) >> (drop - PRODUCT_DROP)
