# SPDX-License-Identifier: Apache-2.0
"""The first change of sign between equally spaced samples, and how it is refined.

``value`` is a compiled function of (t, …) and what a maker gives one of (…): the first root t in [0, 1), or NOTHING.
"""

from collections.abc import Callable

from numba import njit

from .frame import NOTHING


def first_change(value: Callable, samples: int) -> Callable:
    """A compiled function of (…): ends of the first of ``samples`` cells whose sign changes, and the values there."""

    @njit(error_model="numpy")
    def bracket(*of):
        before = value(0.0, *of)
        for i in range(1, samples + 1):
            after = value(i / samples, *of)
            if (before > 0.0) != (after > 0.0):
                return (i - 1) / samples, i / samples, before, after
            before = after
        return NOTHING, 0.0, 0.0, 0.0

    return bracket


def bisection(value: Callable, samples: int, digits: int) -> Callable:
    """Halved until ``digits`` digits of t are known; ``samples`` is a power of two."""
    bracket = first_change(value, samples)
    halvings = digits - samples.bit_length() + 1

    @njit(error_model="numpy")
    def solve(*of):
        a, b, fa, _ = bracket(*of)
        if a < 0.0:
            return NOTHING
        for _ in range(halvings):
            middle = 0.5 * (a + b)
            if (value(middle, *of) > 0.0) == (fa > 0.0):
                a = middle
            else:
                b = middle
        return 0.5 * (a + b)

    return solve


def regula_falsi(value: Callable, samples: int, tolerance: float) -> Callable:
    """The Illinois method, until an end moves by less than ``tolerance``."""
    bracket = first_change(value, samples)

    @njit(error_model="numpy")
    def solve(*of):
        a, b, fa, fb = bracket(*of)
        if a < 0.0:
            return NOTHING
        side, t = 0, a
        for _ in range(100):
            t = (a * fb - b * fa) / (fb - fa)
            f = value(t, *of)
            if (f > 0.0) == (fb > 0.0):
                done = abs(b - t) < tolerance
                b, fb, fa = t, f, 0.5 * fa if side == 1 else fa
                side = 1
            else:
                done = abs(t - a) < tolerance
                a, fa, fb = t, f, 0.5 * fb if side == -1 else fb
                side = -1
            if done or f == 0.0:
                break
        return t

    return solve
