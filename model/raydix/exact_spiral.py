# SPDX-License-Identifier: Apache-2.0
"""Exact oracle for spirals: the indicator and its sign changes on chords by ball arithmetic (docs/exact.md).

Everything follows from the definition of the surface (docs/scenes.md, docs/spirals.md). Nothing is shared with the
golden model or with the float64 oracle. The surface's float64 parameters are taken as exact, and so are the ends of a
chord in local coordinates, given as integers, floats, ``fractions.Fraction``, ``flint.fmpq`` or mpmath's numbers;
:func:`ends_of_words` makes such ends of an item's words. A sign that is given here is proved: the balls of
python-flint hold every rounding.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import wraps
from typing import NamedTuple

import numpy as np
from flint import arb, ctx, fmpq
from mpmath import mpf

from .exact_chord import Line, Place, Solid, length, nearest, pieces, refine, sampled, turns_of, value_over

PRECISION = 160  # bits of the balls' midpoints wherever signs on a chord are decided
CERTIFIED, MISSED, FALSE, WRONG, UNDECIDED = "certified", "missed", "false", "wrong", "undecided"
TIGHT = 1 + 2.0**-5  # a largest value is known when its upper bound is at most this times the lower one
EFFORT = 2000  # cells tried for it


class Root(NamedTuple):
    """A sign change of the indicator on a chord.

    t       enclosure, at most 2^-64 wide, but for a change within what would else be a :class:`Gap`
    before  a point (exact ball) at which the indicator has its sign before the change, for certain
    after   one at which it has the sign after it; between them there is no other change, unless they are as close to
            each other as the enclosure is wide
    enters  from outside (positive) to inside
    """

    t: arb
    before: arb
    after: arb
    enters: bool


class Gap(NamedTuple):
    """An interval of ``t`` of which it is not known whether it holds roots.

    t          the interval
    indicator  its enclosure there: how near to tangent the chord is
    """

    t: arb
    indicator: arb


class Verdict(NamedTuple):
    """What :func:`certify` proved about what the golden model found on a chord.

    kind       certified: the first root lies in the cell, or there is none and none was found
               missed: there is a root and none was found
               false: there is no root at all
               wrong: the first root is not in the cell
               undecided: the first event on the chord is a :class:`Gap`
    root       the first :class:`Root` of the chord, None if there is none or it is not known
    clearance  None where certified; else an enclosure (local units) of the least error of an evaluator of the
               indicator with which this could have been found on the chord
    """

    kind: str
    root: Root | None
    clearance: arb | None


class Judged(NamedTuple):
    """What was proved about N chords.

    hit        chords with a root, as far as known
    left_out   neither certified nor undecided, but with a clearance below ``epsilon``: not among the next three
    missed, false, wrong, undecided  see :class:`Verdict`
    error      (N) float64, found minus exact first root in ulp of t (middle of the cell); nan unless certified hit
    uncertified  (number of the chord, verdict) of each that is not certified
    """

    chords: int
    hit: int
    left_out: int
    missed: int
    false: int
    wrong: int
    undecided: int
    error: np.ndarray
    uncertified: list[tuple[int, Verdict]]


def _precise(function):
    @wraps(function)
    def run(*args, **options):
        with ctx.workprec(PRECISION):
            return function(*args, **options)

    return run


def rational(value) -> fmpq:
    """A number as an exact fraction: int, float (numpy's too), Fraction, fmpq or mpmath's mpf."""
    if isinstance(value, fmpq):
        return value
    if isinstance(value, mpf):
        man, exp = value.man_exp
        return fmpq(int(man) * (-1 if value < 0 else 1) << max(exp, 0), 1 << max(-exp, 0))
    if isinstance(value, Fraction):
        return fmpq(value.numerator, value.denominator)
    if isinstance(value, int | np.integer):
        return fmpq(int(value))
    return fmpq(*float(value).as_integer_ratio())


def ends_of_words(coordinates: Sequence[int], factors: Sequence, middle, fraction: int = 30):
    """Ends h, e of a chord in local coordinates, as exact fractions.

    coordinates  x, y, z at h, then at e: words with ``fraction`` bits after the point
    factors      of the axes: scaled = factor * (local - origin); any exact number
    middle       height (local z) of the scaled coordinates' origin, whose x and y are 0
    """
    origin = fmpq(0), fmpq(0), rational(middle)
    units = [1 / (rational(factor) * (1 << fraction)) for factor in factors]
    ends = [unit * int(word) + shift for word, unit, shift in zip(coordinates, [*units] * 2, origin * 2, strict=True)]
    return ends[:3], ends[3:]


def indicator(surface, point: Sequence) -> arb:
    """The indicator over a box of points.

    surface  anything with R, r, pitch, turns, R_growth, r_growth
    point    x, y, z in local coordinates: arb, or what an arb can be made of (a float is exact)
    Returns a ball that encloses all values there, in the unit of the lengths, as good as ``flint.ctx.prec`` allows. On
    the axis, where the azimuth is not defined, it encloses the values for each azimuth.
    """
    solid = Solid(surface)
    x, y, z = (v if isinstance(v, arb) else arb(v) for v in point)
    found = []  # (enclosure, whether it counts for certain)
    for centre, radius in solid.balls:
        found.append((length(x - centre[0], y - centre[1], z - centre[2]) - radius, True))
    rho = length(x, y)
    theta = turns_of(x, y) if rho > 0 else arb(0.5, 0.5)
    found += solid.disks(rho, theta, z)
    return nearest(found)


def _events(line: Line):
    """Roots and gaps of a chord in order of t; the work is done as far as they are asked for."""
    sign = 0  # the one proved last
    start: Place | None = None  # of the open gap after it
    stop: Place | None = None

    def closed(following):
        assert start is not None and stop is not None
        if sign and following and sign != following:
            return Root(start.t.union(stop.t), start.t, stop.t, sign > 0)
        return Gap(start.t.union(stop.t), value_over(line, start, stop))

    for piece in pieces(line):
        if not piece.before:
            start, stop = start or piece.low, piece.high
            continue
        if start:
            yield closed(piece.before)
            start = None
        elif sign and sign != piece.before:
            raise ArithmeticError(f"signs contradict each other at t = {piece.low.t}")
        if piece.before != piece.after:
            yield Root(refine(line, piece), piece.low.t, piece.high.t, piece.before > 0)
        sign = piece.after
    if start:
        yield closed(0)


def _line(surface, h, e) -> Line:
    return Line(Solid(surface), [rational(v) for v in h], [rational(v) for v in e])


@_precise
def roots(surface, h: Sequence, e: Sequence) -> tuple[list[Root], list[Gap]]:
    """All sign changes of the indicator on the chord h + t (e - h), 0 <= t < 1, and the intervals not decided.

    If the second list is empty the first one is complete, and each enclosure isolates its root.
    """
    events = list(_events(_line(surface, h, e)))
    return [v for v in events if isinstance(v, Root)], [v for v in events if isinstance(v, Gap)]


@_precise
def certify(surface, h: Sequence, e: Sequence, t, width=0, margin=0) -> Verdict:
    """Judge what was found on the chord h + t (e - h), 0 <= t < 1.

    t, width  the cell [t, t + width) that was found to hold the first root; t None: no root was found
    margin    by which the cell is widened on either side
    All exact, as the ends. Raises ValueError if the chord has no length.
    """
    return _certify(_line(surface, h, e), t, width, margin)


def _certify(line: Line, t, width, margin) -> Verdict:
    events = _events(line)
    first = next(events, None)
    if isinstance(first, Gap):
        return Verdict(UNDECIDED, None, abs(first.indicator))
    if t is None:
        if first is None:
            return Verdict(CERTIFIED, None, None)
        return Verdict(MISSED, first, _pattern(line, first, next(events, None)))
    cell = [arb(rational(t)), arb(rational(t) + rational(width))]
    widened = [arb(rational(t) - rational(margin)), arb(rational(t) + rational(width) + rational(margin))]
    if first is None:
        return Verdict(FALSE, None, _least(line, cell))
    if first.t >= widened[0] and first.t <= widened[1]:
        return Verdict(CERTIFIED, first, None)
    if first.t < cell[0]:
        return Verdict(WRONG, first, _pattern(line, first, next(events, None), cell[0]))
    return Verdict(WRONG, first, _least(line, cell))


def _least(line: Line, places) -> arb:
    """The least |indicator| of some places: one of them must have got the wrong sign."""
    values = [abs(sampled(line, place)) for place in places]
    return values[0].min(values[1])


def _pattern(line: Line, first: Root, second, end=None) -> arb:
    """How far off an evaluator was that saw no sign change where ``first`` is the first one.

    The lesser of the largest |indicator| before and after it, up to the next root, or to ``end`` if that comes before.
    """
    last = arb(1) if second is None else second.t.lower()
    if end is not None:
        last = min(last, end.lower())
    before = _largest(line, arb(0), first.t.lower())
    after = _largest(line, first.t.upper(), last)
    return before.min(after)


def _largest(line: Line, low: arb, high: arb) -> arb:
    """Enclosure of the largest |indicator| between two places: cells with the largest upper bounds are cut."""
    if not low < high:
        return abs(sampled(line, low))
    ends = line.place(low.mid()), line.place(high.mid())
    cells = [(abs(value_over(line, *ends)).upper(), *ends)]
    least = max(abs(sampled(line, end.t)).lower() for end in ends)
    for _ in range(EFFORT):
        cells.sort(key=lambda cell: float(cell[0]))
        upper, a, b = cells[-1]
        if upper <= least * TIGHT:
            break
        cells.pop()
        middle = line.place(((a.t + b.t) / 2).mid())
        least = max(least, abs(sampled(line, middle.t)).lower())
        cells += [(abs(value_over(line, *half)).upper(), *half) for half in ((a, middle), (middle, b))]
    return least.union(max(cell[0] for cell in cells))


@_precise
def judge(surface, h: Sequence, e: Sequence, t_found: Sequence[int], digits: int, margin: int, epsilon=0.0) -> Judged:
    """Judge what was found on N chords.

    h, e     ends of each, in local coordinates: (N, 3), any exact numbers
    t_found  (N) the digits of t as an integer, of the cell's lower end; -1: no root was found
    margin   in ulp of t
    epsilon  what is not certified and has a clearance below it, for certain, is left out
    """
    solid, error = Solid(surface), np.full(len(t_found), np.nan)
    counts, hit, left_out, uncertified = dict.fromkeys((CERTIFIED, MISSED, FALSE, WRONG, UNDECIDED), 0), 0, 0, []
    for i, found in enumerate(int(v) for v in t_found):
        line = Line(solid, [rational(v) for v in h[i]], [rational(v) for v in e[i]])
        unit = fmpq(1, 1 << digits)
        verdict = _certify(line, None if found < 0 else found * unit, unit, margin * unit)
        hit += verdict.root is not None
        if verdict.kind == CERTIFIED:
            if verdict.root and found >= 0:
                error[i] = float((arb((2 * found + 1) * unit / 2) - verdict.root.t) * (1 << digits))
        else:
            uncertified.append((i, verdict))
        if verdict.kind in (MISSED, FALSE, WRONG) and verdict.clearance < epsilon:
            left_out += 1
        else:
            counts[verdict.kind] += 1
    missed, false, wrong, undecided = (counts[kind] for kind in (MISSED, FALSE, WRONG, UNDECIDED))
    return Judged(len(t_found), hit, left_out, missed, false, wrong, undecided, error, uncertified)
