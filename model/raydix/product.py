# SPDX-License-Identifier: Apache-2.0
"""Control points of an item from those of its quadrics (mirrors ``rtl/rdx_product.sv``)."""

from .formats import QUAD_ACC_WIDTH
from .kernel import kernel
from .normalize import normalize
from .quartic import quartic_form


@kernel
def product(quads, quartic, out, at, width, degree):
    """Bernstein coefficients of F = Q1*Q2 + Q3 (``quartic``) or F = Q3 on the segment, normalised to W bits.

    quads   nine accumulators: q(h,h), q(h,e), q(e,e) of Q3, then of Q1, then of Q2
    out     gets degree + 1 values from ``at`` on, sWp0
    Source: docs/method.md, "Quartics".
    """
    if degree == 2:
        for i in range(3):
            out[at + i] = quads[i]
    else:
        quartic_form(quads, quartic, out, at)
    normalize(out, at, degree + 1, QUAD_ACC_WIDTH, width, QUAD_ACC_WIDTH - 1)
