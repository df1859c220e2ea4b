# SPDX-License-Identifier: Apache-2.0
"""Six times Q1*Q2 + Q3: RTL equals the model in every bit; the model is within its bound of the exact coefficients."""

from fractions import Fraction
from math import comb

import cocotb

import bench
import latency
from raydix.formats import OPERAND_SHIFT, PRODUCT_DROP
from raydix.kernel import words, zeros
from raydix.quartic import quartic_form

# Limits of the accumulators. |Q1|, |Q2| < 2^62; at the upper end the operand, rounded half up, must fit 36 bits.
LEAST_AB, LARGEST_AB = -(1 << 62), (1 << 62) - (1 << (OPERAND_SHIFT - 1)) - 1
LIMIT_C = {True: 1 << 59, False: 1 << 60}  # |Q3|, with and without a product


def random_quads(random, quartic):
    """Nine accumulators, of Q3, Q1, Q2: of any size, corners of the documented range, small numbers."""
    quads = []
    for i in range(9):
        least, largest = (-LIMIT_C[quartic], LIMIT_C[quartic]) if i < 3 else (LEAST_AB, LARGEST_AB)
        bits = random.randint(1, 59)
        anything = (random.randint(least, largest), bench.signed(random.getrandbits(bits), bits))
        quads.append(random.choice((least, largest, random.choice((0, 1, -1)), *anything, *anything, *anything)))
    return quads


def stimuli(random, count):
    """(quads, quartic): every sign combination of the limits for whole quadrics, then random ones."""
    for sign in range(8):
        for quartic in (True, False):
            c, a, b = (sign >> i & 1 for i in range(3))
            limit = LIMIT_C[quartic]
            yield [(-limit, limit)[c]] * 3 + [(LEAST_AB, LARGEST_AB)[a]] * 3 + [(LEAST_AB, LARGEST_AB)[b]] * 3, quartic
    for _ in range(count):
        quartic = random.random() < 0.7
        yield random_quads(random, quartic), quartic


def model(quads, quartic):
    """The model's five coefficients."""
    out = zeros(5)
    quartic_form(words(quads), quartic, out, 0)
    return list(out)


def times(a, b):
    """Bernstein coefficients of degree 4 of the product of two quadratics, exact."""
    out = [Fraction(0)] * 5
    for i in range(3):
        for j in range(3):
            out[i + j] += Fraction(comb(2, i) * comb(2, j), comb(4, i + j)) * a[i] * b[j]
    return out


def exact(quads, quartic):
    """Bernstein coefficients of Q1*Q2 + Q3, of Q3 alone unless ``quartic``; 1 is one unit of Q3's accumulator."""
    c, a, b = quads[:3], quads[3:6], quads[6:]
    unit = Fraction(1, 1 << (2 * OPERAND_SHIFT + PRODUCT_DROP))  # of a product of accumulators
    products = [unit * v for v in times(a, b)] if quartic else [Fraction(0)] * 5
    return [p + q for p, q in zip(products, times(c, (1, 1, 1)), strict=True)]


def bounds(quads, quartic):
    """How far the model's six-fold coefficients may lie below and above the exact ones.

    From the roundings of the header. An operand is off by at most 1/2, so a product of operands by at most
    (|a| + |b|)/2 + 1/4 with |a|, |b| the exact operands; / 2^12 that is e. The floor takes less than 1 more, downwards.
    6 F_k is a sum of such products whose weights 6 C(2,i) C(2,j) / C(4,k) add up to 6; sums and weights are exact.
    """
    if not quartic:
        return [(Fraction(0), Fraction(0))] * 5
    a, b = ([abs(Fraction(v, 1 << OPERAND_SHIFT)) for v in q] for q in (quads[3:6], quads[6:]))
    result = []
    for k in range(5):
        e = Fraction(0)
        for i in range(3):
            if 0 <= k - i < 3:
                weight = Fraction(6 * comb(2, i) * comb(2, k - i), comb(4, k))
                e += weight * ((a[i] + b[k - i]) / 2 + Fraction(1, 4)) / (1 << PRODUCT_DROP)
        result.append((e + 6, e))
    return result


def outside_of_bound(form, quads, quartic):
    """Lines about coefficients of ``form`` that are further from the exact ones than documented."""
    lines = []
    for k, (got, f, (below, above)) in enumerate(zip(form, exact(quads, quartic), bounds(quads, quartic), strict=True)):
        if not -below <= got - 6 * f <= above:
            lines.append(f"coefficient {k}: error {float(got - 6 * f)}, allowed {float(-below)} to {float(above)}")
        if not bench.low(64) <= got <= bench.high(64):
            lines.append(f"coefficient {k}: {got} does not fit 64 bits")
    return lines


@cocotb.test
async def equals_model(dut):
    """Every bit of the five coefficients is the model's, QuarticLatency clocks later, one ray a clock."""
    await bench.start(dut)
    items = (dict(quads_i=list(quads), quartic_i=int(quartic)) for quads, quartic in stimuli(bench.rng(), 1200))
    await bench.pipeline(
        dut, items, lambda item: {"form_o": model(item["quads_i"], item["quartic_i"])}, latency.QUARTIC
    )


@cocotb.test
async def within_bound(dut):
    """The model is within its bound of the exact rational coefficients, exact without a product, and fits 64 bits."""
    for number, (quads, quartic) in enumerate(stimuli(bench.rng("bound"), 3000)):
        lines = outside_of_bound(model(quads, quartic), quads, quartic)
        if lines:
            raise bench.mismatch(number, {"quads": quads, "quartic": int(quartic)}, lines)


def test_quartic():
    """Random and corner accumulators, with and without a product."""
    bench.run(__name__, "rdx_quartic")
