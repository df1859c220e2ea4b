# SPDX-License-Identifier: Apache-2.0
"""Stress categories given by their roots: control points of items, made where descents are known to be difficult.

Each function takes a numpy Generator, the number of polynomials and their degree (2 to 4) and gives coefficients
(count, degree + 1) in any scale; integers where roots are to be exact, else float64. :func:`fitted` makes words of
them. What the roots of the words are the exact oracle says: rounding may move them.
"""

from functools import partial
from math import comb

import numpy as np

DIGITS = 24  # of the reference configuration


def fitted(b: np.ndarray, width: int) -> np.ndarray:
    """Control points sWp0: all of an item by one power of two, so that the largest uses the width; int64.

    Exact for integers that fit, half to even otherwise. What is all zero stays so.
    """
    largest = np.abs(b).max(axis=1)
    shift = width - 1 - np.frexp(largest.astype(np.float64))[1]
    shift = np.where(largest == 0, 0, shift)
    if b.dtype == np.int64:
        up, down = np.maximum(shift, 0)[:, None], np.maximum(-shift, 0)[:, None]
        half = np.where(down > 0, 1 << np.maximum(down - 1, 0), 0)
        words = (b << up) + half >> down
    else:
        words = np.rint(np.ldexp(b, shift[:, None])).astype(np.int64)
    limit = 1 << (width - 1)
    return np.clip(words, -limit, limit - 1)


def times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Product in Bernstein form, in the factors' type; of integers the multiple that has no denominators."""
    n, m = a.shape[1] - 1, b.shape[1] - 1
    whole = 12 if n + m == 4 else n + m  # a common multiple of the binomials
    out = np.zeros((len(a), n + m + 1), np.result_type(a, b))
    for k in range(n + m + 1):
        factor = whole // comb(n + m, k) if out.dtype == np.int64 else 1 / comb(n + m, k)
        for i in range(max(0, k - m), min(n, k) + 1):
            out[:, k] += comb(n, i) * comb(m, k - i) * factor * a[:, i] * b[:, k - i]
    return out


def through(roots: np.ndarray) -> np.ndarray:
    """Monic polynomial with the roots (count, d), float64."""
    out = np.stack([-roots[:, 0], 1 - roots[:, 0]], axis=1)
    for i in range(1, roots.shape[1]):
        out = times(out, np.stack([-roots[:, i], 1 - roots[:, i]], axis=1))
    return out


def dyadic(dice, count: int, bits) -> np.ndarray:
    """Integer polynomials (count, 2) whose root is an odd multiple of 2**-bits; bits: int or (count)."""
    bits = np.broadcast_to(bits, count)
    p = (dice.random(count) * 2.0 ** (bits - 1)).astype(np.int64) * 2 + 1
    return np.stack([-p, (1 << bits) - p], axis=1)


def _rest(dice, count, degree, bits=None):
    """Any cofactor of a degree: float64, or integers of so many bits, never all zero."""
    if bits is None:
        return dice.normal(size=(count, degree + 1)) * dice.choice([1, 1, 0.01], (count, degree + 1))
    top = np.maximum(1 << np.broadcast_to(bits, count), 2)
    out = np.floor((dice.random((count, degree + 1)) * 2 - 1) * top[:, None]).astype(np.int64)
    out[:, 0] |= 1
    return out


def anything(dice, count, degree):
    """Coefficients of any signs and magnitudes."""
    return dice.normal(size=(count, degree + 1)) * 2.0 ** dice.uniform(-20, 0, (count, degree + 1))


def boundaries(dice, count, degree, first=1, last=DIGITS):
    """A root exactly on a boundary of each level: an odd multiple of 2^-first … 2^-last."""
    bits = dice.integers(first, last + 1, count)
    return times(dyadic(dice, count, bits), _rest(dice, count, degree - 1, np.maximum(29 - bits, 3)))


def first_and_last(dice, count, degree):
    """A root at 0, at 1, or within the first or the last few cells of the last level."""
    near = 2.0 ** -dice.uniform(DIGITS - 3, DIGITS + 4, count)
    kind = dice.integers(0, 4, count)
    root = np.choose(kind, [np.zeros(count), np.ones(count), near, 1 - near])
    b = times(np.stack([-root, 1 - root], axis=1), _rest(dice, count, degree - 1))
    b[kind == 0, 0] = 0.0
    b[kind == 1, -1] = 0.0
    return b


def tangent(dice, count, degree):
    """An exact double root at a multiple of 2^-1 … 2^-11, from either side."""
    root = dyadic(dice, count, dice.integers(1, 12, count))
    return (
        times(times(root, root), _rest(dice, count, degree - 2, 6))
        if degree > 2
        else times(root, root) * _sign(dice, count)
    )


def _sign(dice, count):
    return dice.choice([-1, 1], (count, 1))


def near_tangent(dice, count, degree, most=8, least=40):
    """A double root split or lifted by 2^-most … 2^-least of the largest coefficient."""
    root = dice.random((count, 1))
    b = through(np.concatenate([root, root], axis=1))
    if degree > 2:
        b = times(b, 0.2 + dice.random((count, degree - 1)))
    b /= np.abs(b).max(axis=1, keepdims=True)
    return (b + _sign(dice, count) * 2.0 ** -dice.uniform(most, least, (count, 1))) * _sign(dice, count)


def multiple(dice, count, degree):
    """A triple or quadruple root at a multiple of 2^-1 … 2^-7, exact or with one coefficient an ulp off."""
    root = dyadic(dice, count, dice.integers(1, 8, count))
    square = times(root, root)
    if degree == 2:
        b = square
    else:
        triple = times(square, root)
        again = np.where(dice.random((count, 1)) < 0.5, root, _rest(dice, count, 1, 7))
        b = triple if degree == 3 else times(triple, again)
    b = b * _sign(dice, count)
    shift = np.maximum(35 - np.frexp(np.abs(b).max(axis=1).astype(np.float64))[1], 0)
    b = b << shift[:, None]
    off = dice.integers(0, 2 * (degree + 1), count)  # half of them stay exact
    place = off <= degree
    b[np.flatnonzero(place), off[place]] += dice.choice([-1, 1], int(place.sum()))
    return b


def close(dice, count, degree):
    """Two roots 2^-4 … 2^-26 apart: in one cell down to the last levels."""
    first, apart = dice.random(count), 2.0 ** -dice.uniform(4, 26, count)
    b = through(np.stack([first, first + apart], axis=1))
    return times(b, _rest(dice, count, degree - 2)) if degree > 2 else b * _sign(dice, count)


def neighbours(dice, count, degree):
    """Two roots on both sides of a boundary of each level, in the two cells beside it."""
    bits = dice.integers(1, 18, count)
    boundary = np.floor(dice.random(count) * 2.0**bits) / 2.0**bits
    off = dice.random((2, count)) * 2.0**-bits * 2.0 ** -dice.uniform(0, 6, (2, count))
    b = through(np.stack([boundary - off[0], boundary + off[1]], axis=1))
    return times(b, _rest(dice, count, degree - 2)) if degree > 2 else b * _sign(dice, count)


def many(dice, count, degree):
    """As many roots as the degree, spread or in a cluster of 2^-1 … 2^-8."""
    spread = 2.0 ** -dice.uniform(0, 8, (count, 1)) * dice.choice([0.9, 1.0], (count, 1))
    return through(dice.random((count, 1)) * (1 - spread) + spread * dice.random((count, degree))) * _sign(dice, count)


def extremes(dice, count, degree):
    """Coefficients that are the least, the largest, zero, one or minus one: saturation, zeros, all zero."""
    top = (1 << 35) - 1
    return dice.choice(np.array([-top - 1, top, -top, 0, 0, 1, -1], np.int64), (count, degree + 1))


CATEGORIES = {
    "any coefficients": anything,
    "root on a boundary, each level": boundaries,
    "root at 0 and at 1-": first_and_last,
    "tangent": tangent,
    "near-tangent, 2^-8 to 2^-40": near_tangent,
    "triple and quadruple roots": multiple,
    "two close roots in a cell": close,
    "roots in neighbouring cells": neighbours,
    "as many roots as the degree": many,
    "saturating coefficients": extremes,
}

# Two categories one by one: the boundaries of each of the reference configuration's 8 levels, distances 2^-8 … 2^-40
EACH = {f"root on a boundary of level {i + 1}": partial(boundaries, first=3 * i + 1, last=3 * i + 3) for i in range(8)}
EACH |= {f"near-tangent, 2^-{k}": partial(near_tangent, most=k, least=k) for k in range(8, 41, 4)}
