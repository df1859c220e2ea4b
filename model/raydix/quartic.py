# SPDX-License-Identifier: Apache-2.0
"""Six times the Bernstein coefficients of Q1*Q2 + Q3 (mirrors ``rtl/rdx_quartic.sv``)."""

from .formats import OPERAND_SHIFT
from .kernel import kernel
from .multiply import multiply


@kernel
def operand(value):
    """Accumulator to operand of the product: s64p0 / 2^27 rounded half up, s36p0."""
    return (value + (1 << (OPERAND_SHIFT - 1))) >> OPERAND_SHIFT


@kernel
def quartic_form(quads, quartic, out, at):
    """6*(Q1*Q2 + Q3), or 6*Q3 unless ``quartic``, as five coefficients from ``out[at]`` on, s64p0.

    quads   nine accumulators: q(h,h), q(h,e), q(e,e) of Q3, then of Q1, then of Q2
    Times 6 the weights 1/2 and 1/6 of the product of two quadratics and of degree elevation are whole numbers, so
    that nothing but the operands and their products is rounded.
    """
    c0, c1, c2 = quads[0], quads[1], quads[2]
    f0 = c0
    f1 = c0 + c1
    f2 = c0 + 4 * c1 + c2
    f3 = c1 + c2
    f4 = c2
    if quartic:
        a0, a1, a2 = operand(quads[3]), operand(quads[4]), operand(quads[5])
        b0, b1, b2 = operand(quads[6]), operand(quads[7]), operand(quads[8])
        f0 += multiply(a0, b0)
        f1 += multiply(a0, b1) + multiply(a1, b0)
        f2 += multiply(a0, b2) + 4 * multiply(a1, b1) + multiply(a2, b0)
        f3 += multiply(a1, b2) + multiply(a2, b1)
        f4 += multiply(a2, b2)
    out[at] = 6 * f0
    out[at + 1] = 3 * f1
    out[at + 2] = f2
    out[at + 3] = 3 * f3
    out[at + 4] = 6 * f4
