# SPDX-License-Identifier: Apache-2.0
"""What rounding explains of the result of one descent of the certified rule: docs/error-analysis.md, "The band".

Two statements hold for every ray, whatever its f. They are checked on the exact f, near the place that was found only:

passed over  at the ends of all cells before that found (of all, if none was) f is above -A, or at all not above 0;
found        one end of the cell has f <= 0, the other one f > -A.

A is the bound of the halving, cells are those of the last level. With a box the first statement is for the part of the
ray that is certainly inside of it.
"""

import math

import numpy as np

from .error_bounds import coordinates, halving
from .exact import extrema, value
from .formats import COORD_FRAC
from .segments import Segments


def bernstein(b: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Polynomials (N, degree + 1) at t (N), float64."""
    degree = b.shape[1] - 1
    total, power, binomial = np.zeros(len(b)), np.ones(len(b)), 1.0
    for i in range(degree + 1):
        total = total * (1 - t) + binomial * power * b[:, i]
        power = power * t
        binomial = binomial * (degree - i) / (i + 1)
    return total


def inside(segments: Segments, digits: int) -> np.ndarray:
    """The part of each segment that is certainly inside of the box: (N, 2) float64, t; empty where low > high.

    Its faces are taken nearer by the error of a hit point and two cells.
    """
    low, high = np.zeros(len(segments.b)), np.ones(len(segments.b))
    for axis in np.flatnonzero(segments.box):
        start, stop = (segments.ends[:, k + axis].astype(float) for k in (0, 3))
        way = stop - start
        face = 2.0 ** (COORD_FRAC + 1 - segments.box[axis])
        face = face - 2 * 2.0**-digits * np.abs(way) - coordinates(digits) - 1
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (-face - start) / way, (face - start) / way
        still = way == 0
        low = np.maximum(low, np.where(still, np.where(np.abs(start) < face, 0.0, 2.0), np.fmin(a, b)))
        high = np.minimum(high, np.where(still, 1.0, np.fmax(a, b)))
    return np.stack([low, high], axis=1)


def reach(b: list[int], first: int, last: int, digits: int) -> tuple[float, float]:
    """How far f goes below 0 and above it at multiples ``first`` to ``last`` of 2^-digits, ulp of f.

    Exact but for the rounding to float64. Between extrema f is monotonous: the multiples next to them are enough.
    """
    places = {first, last}
    for place, _ in extrema(b):
        near = int(place * 2.0**digits)
        places.update(p for p in range(near - 1, near + 3) if first < p < last)
    values = [value(b, p, digits) / (1 << digits * (len(b) - 1)) for p in places]
    return max(0.0, -min(values)), max(0.0, max(values))


def passed(segments: Segments, t: np.ndarray, digits: int, rows: np.ndarray) -> np.ndarray:
    """(rows, 2): how far f goes below 0 and above it at the ends of the cells that were passed over, ulp of f.

    t      (N) int64, number of the cell that was found, -1 = none
    rows   those to be looked at
    """
    out, part = np.zeros((len(rows), 2)), inside(segments, digits)
    for k, i in enumerate(rows):
        first, last = math.ceil(part[i, 0] * 2.0**digits), math.floor(part[i, 1] * 2.0**digits)
        last = last if t[i] < 0 else min(last, int(t[i]))
        if first <= last:
            out[k] = reach(segments.b[i].tolist(), first, last, digits)
    return out


def explained(segments: Segments, t: np.ndarray, exact: np.ndarray, config) -> np.ndarray:
    """(N) bool: whether both statements hold for the cells ``t`` (N) int64, -1 = none; ``exact`` has f's changes."""
    digits, degree, width = config.digits, config.degree, config.width
    above = halving(config.n1, config.steps, degree, width)
    # a change that float64 puts on the wrong side of the cell's end is passed over by less than A where f is so flat
    slack = 0.0 if degree * 2.0 ** (width - 36) < above / 2 else 2.0**-36
    stop = np.where(t < 0, 1.0, t * 2.0**-digits) + slack
    with np.errstate(invalid="ignore"):
        rows = np.flatnonzero((exact < stop[:, None]).any(axis=1))
    dip, hump = passed(segments, t, digits, rows).T
    good = np.ones(len(t), bool)
    good[rows] = (dip < above) | (hump == 0)
    return good & (_cell(segments.b, t, digits, above) | (t < 0))


def _cell(b: np.ndarray, t: np.ndarray, digits: int, above: float) -> np.ndarray:
    """The second statement: by float64 where that is certain, in integers where not."""
    degree = b.shape[1] - 1
    one, other = (bernstein(b, (t + k) * 2.0**-digits) for k in (0, 1))
    unsure = 2.0**-46 * np.abs(b).max(axis=1)
    good = np.zeros(len(t), bool)
    certain = np.zeros(len(t), bool)
    for low, high in ((one, other), (other, one)):
        good |= (low <= -unsure) & (high > unsure - above)
        certain |= (low > unsure) & (high > unsure)  # both ends positive: no cell of the last level
    for i in np.flatnonzero(~good & ~certain & (t >= 0)):
        row, scale = b[i].tolist(), 1 << digits * degree
        ends = [value(row, int(t[i]) + k, digits) for k in (0, 1)]
        good[i] = min(ends) <= 0 and max(ends) > -above * scale
    return good
