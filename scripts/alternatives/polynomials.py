# SPDX-License-Identifier: Apache-2.0
"""Solvers of a polynomial of degree 1, 2 or 4 on [0, 1): the first root, or NOTHING.

Each maker takes what trades time for accuracy and gives a compiled function of (coefficients (5), degree).
"""

import numpy as np
from numba import njit

from . import samples
from .frame import NOTHING

SAMPLES = 64
TINY = 1e-200  # instead of a first coefficient of zero
ROUNDING = 1e-14  # of an interval bound, of the sum of its terms


@njit(error_model="numpy")
def value(t, c, degree):
    """The polynomial at t."""
    v = c[degree]
    for i in range(degree - 1, -1, -1):
        v = v * t + c[i]
    return v


@njit(error_model="numpy")
def slope(c, degree, t):
    """Its derivative at t."""
    v = degree * c[degree]
    for i in range(degree - 1, 0, -1):
        v = v * t + i * c[i]
    return v


@njit(error_model="numpy")
def inside(t, best):
    """The smaller of two candidates that is a root in [0, 1)."""
    return t if 0.0 <= t < 1.0 and (best < 0.0 or t < best) else best


@njit(error_model="numpy")
def quadratic(a, b, c):
    """Both roots of a t^2 + b t + c without cancellation; NaN where there are none."""
    root = np.sqrt(b * b - 4 * a * c)
    q = -0.5 * (b + (root if b >= 0.0 else -root))
    return q / a, c / q


@njit(error_model="numpy")
def quartic(c):
    """First root in [0, 1) by Ferrari: the quartic as a product of two quadratics, one cubic on the way."""
    b3, b2, b1, b0 = c[3] / c[4], c[2] / c[4], c[1] / c[4], c[0] / c[4]
    shift = 0.25 * b3
    p = b2 - 6 * shift * shift
    q = b1 - 2 * b2 * shift + 8 * shift**3
    r = b0 - b1 * shift + b2 * shift * shift - 3 * shift**4
    # largest root m of m^3 + p m^2 + (p^2/4 - r) m - q^2/8
    e, f, g = p, 0.25 * p * p - r, -0.125 * q * q
    s, t = (e * e - 3 * f) / 9, (2 * e**3 - 9 * e * f + 27 * g) / 54
    if t * t < s**3:
        m = -2 * np.sqrt(s) * np.cos((np.arccos(max(-1.0, min(1.0, t / np.sqrt(s**3)))) + 2 * np.pi) / 3) - e / 3
    else:
        k = -np.sign(t) * np.cbrt(abs(t) + np.sqrt(t * t - s**3))
        m = k + (s / k if k != 0.0 else 0.0) - e / 3
    for _ in range(2):
        m -= (((m + e) * m + f) * m + g) / ((3 * m + 2 * e) * m + f)
    best = NOTHING
    if m <= 0.0:  # a biquadratic
        for square in quadratic(1.0, p, r):
            if square >= 0.0:
                best = inside(-np.sqrt(square) - shift, inside(np.sqrt(square) - shift, best))
        return best
    w = np.sqrt(2 * m)
    for sign in (-1.0, 1.0):
        low, high = quadratic(1.0, sign * w, 0.5 * p + m - sign * q / (2 * w))
        best = inside(low - shift, inside(high - shift, best))
    return best


def closed_form(_):
    """The formula for the degree."""

    @njit(error_model="numpy")
    def solve(c, degree):
        if degree == 4:
            return quartic(c)
        if degree == 1 or c[2] == 0.0:
            return inside(-c[0] / c[1], NOTHING)
        low, high = quadratic(c[2], c[1], c[0])
        return inside(low, inside(high, NOTHING))

    return solve


def companion(_):
    """Eigenvalues of the companion matrices of all rays by LAPACK; real where the imaginary part is rounding."""

    def solve(c, degree):
        matrices = np.zeros((len(c), degree, degree))
        matrices[:, range(1, degree), range(degree - 1)] = 1.0
        first = c[:, degree : degree + 1]
        matrices[:, :, degree - 1] = -c[:, :degree] / np.where(first == 0.0, TINY, first)
        roots = np.linalg.eigvals(matrices)
        wanted = (abs(roots.imag) < 1e-7 * (1.0 + abs(roots.real))) & (roots.real >= 0.0) & (roots.real < 1.0)
        t = np.where(wanted, roots.real, 2.0).min(axis=1)
        return np.where(t < 1.0, t, NOTHING)

    return solve


def bisection(digits):
    """The first change of sign of 64 samples, halved until ``digits`` digits are known."""
    return samples.bisection(value, SAMPLES, digits)


def regula_falsi(tolerance):
    """The first change of sign of 64 samples, then the Illinois method."""
    return samples.regula_falsi(value, SAMPLES, tolerance)


def newton(tolerance):
    """The first change of sign of 64 samples, then Newton's steps, and halves where they leave the bracket."""

    bracket = samples.first_change(value, SAMPLES)

    @njit(error_model="numpy")
    def solve(c, degree):
        a, b, fa, _ = bracket(c, degree)
        if a < 0.0:
            return NOTHING
        t = 0.5 * (a + b)
        for _ in range(100):
            f = value(t, c, degree)
            if (f > 0.0) == (fa > 0.0):
                a = t
            else:
                b = t
            following = t - f / slope(c, degree, t)
            if not a <= following <= b:
                following = 0.5 * (a + b)
            if abs(following - t) < tolerance:
                return following
            t = following
        return t

    return solve


def interval_bisection(tolerance):
    """Cells whose interval of values holds zero are halved, the first one first, down to the tolerance."""

    @njit(error_model="numpy")
    def solve(c, degree):
        ends = np.empty((64, 2))
        ends[0] = 0.0, 1.0
        count = 1
        while count:
            count -= 1
            a, b = ends[count]
            low = high = c[degree]
            size = abs(low)
            for i in range(degree - 1, -1, -1):  # Horner's scheme with intervals; 0 <= a
                low, high = c[i] + min(low * a, low * b), c[i] + max(high * a, high * b)
                size = size * b + abs(c[i])
            if low > ROUNDING * size or high < -ROUNDING * size:
                continue
            if b - a < tolerance:
                if (value(a, c, degree) > 0.0) != (value(b, c, degree) > 0.0):
                    return 0.5 * (a + b)
                continue
            middle = 0.5 * (a + b)
            ends[count] = middle, b
            ends[count + 1] = a, middle
            count += 2
        return NOTHING

    return solve


@njit(error_model="numpy")
def bernstein(c, degree, b):
    """Power to Bernstein coefficients on [0, 1]."""
    for k in range(degree + 1):
        b[k], weight = 0.0, 1.0
        for i in range(k + 1):
            b[k] += weight * c[i]
            weight *= (k - i) / (degree - i)


@njit(error_model="numpy")
def part(b, degree, t, second, out):
    """Coefficients of the part before t (after it, if ``second``) by de Casteljau's scheme into ``out``."""
    for k in range(degree + 1):
        out[k] = b[k]
    if second:
        for level in range(degree):
            for k in range(degree - level):
                out[k] = (1 - t) * out[k] + t * out[k + 1]
    else:
        for level in range(degree):
            for k in range(degree, level, -1):
                out[k] = (1 - t) * out[k - 1] + t * out[k]


@njit(error_model="numpy")
def hull(b, degree):
    """The interval in which the convex hull of the control polygon meets the axis; the first is larger: nowhere."""
    low, high = 2.0, -1.0
    for i in range(degree + 1):
        if b[i] == 0.0:
            low, high = min(low, i / degree), max(high, i / degree)
        for j in range(i + 1, degree + 1):
            if (b[i] > 0.0) != (b[j] > 0.0):
                t = (i + (j - i) * b[i] / (b[i] - b[j])) / degree
                low, high = min(low, t), max(high, t)
    return low, high


def bezier_clipping(tolerance):
    """Sederberg and Nishita: cut to where the hull meets the axis, and halve where that removes less than a fifth."""

    @njit(error_model="numpy")
    def solve(c, degree):
        stack, ends = np.empty((64, 5)), np.empty((64, 2))
        work = np.empty(5)
        bernstein(c, degree, stack[0])
        ends[0] = 0.0, 1.0
        count = 1
        while count:
            a, b = ends[count - 1]
            low, high = hull(stack[count - 1], degree)
            if low > high:
                count -= 1
                continue
            if (high - low) * (b - a) < tolerance:
                t = a + 0.5 * (low + high) * (b - a)
                before, after = max(0.0, t - tolerance), min(1.0, t + tolerance)
                if (value(before, c, degree) > 0.0) != (value(after, c, degree) > 0.0):
                    return min(t, 1.0 - 2.0**-53)
                count -= 1
                continue
            if high - low < 0.8 or count == 64:
                part(stack[count - 1], degree, high, False, work)
                part(work, degree, low / high, True, stack[count - 1])
                ends[count - 1] = a + low * (b - a), a + high * (b - a)
            else:
                part(stack[count - 1], degree, 0.5, False, stack[count])
                part(stack[count - 1], degree, 0.5, True, work)
                stack[count - 1] = work
                middle = 0.5 * (a + b)
                ends[count] = a, middle
                ends[count - 1] = middle, b
                count += 1
        return NOTHING

    return solve
