# SPDX-License-Identifier: Apache-2.0
"""The exact oracle for spirals against exact roots, closed forms and the float64 oracle; then it judges the model."""

import random
import sys
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import mpmath as mp
import numpy as np
import pytest
from flint import arb, ctx, fmpq, fmpq_poly

from raydix.chords_spiral import chords_through, compile_chords, random_spiral, spiral_config, trace_spiral
from raydix.exact_chord import Line, Solid, value_over
from raydix.exact_spiral import certify, ends_of_words, indicator, judge, rational, roots
from raydix.formats import FORM_INDEX, ZONES
from raydix.oracle_spiral import spiral_chord_roots, spiral_value
from test_oracle_spiral import GROWN, HELIX, RING, chords, spiral

sys.path.append(str(Path(__file__).resolve().parents[1] / "scripts"))
import exact_spirals  # noqa: E402  (scripts/ is not installed)

TINY = 2.0**-60


def places(found):
    """Roots as floats."""
    return [float(root.t) for root in found]


def only_roots(shape, h, e):
    """Roots of a chord without gaps, as wide as is promised, with their signs before and after."""
    found, gaps = roots(shape, h, e)
    assert not gaps
    for root in found:
        assert root.t.rad() < TINY / 16
        for t, sign in ((root.before, 1), (root.after, -1)):
            value = at(shape, h, e, t)
            assert value * sign > 0 if root.enters else value * sign < 0
    return found


def at(shape, h, e, t):
    """The indicator at a place of a chord, by its definition alone."""
    with ctx.workprec(200):
        start, stop = ([arb(rational(v)) for v in end] for end in (h, e))
        return indicator(shape, [a + arb(t) * (b - a) for a, b in zip(start, stop, strict=True)])


# ---------------------------------------------------------------- the indicator


def defined(shape, point):
    """f with 400 digits, written down from its definition, with mpmath; the azimuth from the cosine."""
    with mp.workdps(400):
        x, y, z = (mp.mpf(v) for v in point)
        rho = mp.hypot(x, y)
        theta = mp.acos(x / rho) / (2 * mp.pi)
        theta = theta if y >= 0 else 1 - theta
        R, r, p, T, g, k = (mp.mpf(getattr(shape, n)) for n in ("R", "r", "pitch", "turns", "R_growth", "r_growth"))
        balls = [
            mp.sqrt((x - (R + g * s) * mp.cos(2 * mp.pi * s)) ** 2 + (y - (R + g * s) * mp.sin(2 * mp.pi * s)) ** 2
                    + (z - p * s) ** 2) - r - k * s for s in (0, T)
        ]  # fmt: skip
        disks = [mp.hypot(rho - R - g * s, z - p * s) - r - k * s for s in (theta + m for m in range(101)) if s <= T]
        return min(balls + disks)


@pytest.mark.parametrize("name", GROWN)
def test_indicator_is_as_precise_as_asked(name):
    """1000 bits: the ball holds the value, and is 900 bits narrow; with 64 bits it is 50 bits narrow."""
    shape = spiral(**GROWN[name])
    dice = random.Random(1)
    for _ in range(40):
        point = [dice.uniform(-1.5, 1.5) for _ in range(3)]
        exact = defined(shape, point)
        for precision, narrow in ((1000, 900), (64, 50)):
            with ctx.workprec(precision):
                value = indicator(shape, point)
                assert value.rad() < arb(2) ** -narrow
            with ctx.workprec(1200), mp.workprec(1200):
                assert abs(value - arb(rational(exact))) < arb(2) ** -narrow
                assert value.overlaps(arb(rational(exact), arb(10) ** -390))


@pytest.mark.parametrize("name", GROWN)
def test_indicator_holds_every_value_of_a_box(name):
    """Boxes of all sizes, a third about the axis and a third in the half planes of an end: no value is outside."""
    shape = spiral(**GROWN[name])
    dice = np.random.default_rng(2)
    cut = 0
    for number in range(150):
        middle, half = dice.uniform(-1, 1, 3), 10 ** dice.uniform(-6, 0, 3)
        if number % 3 == 0:
            middle[:2] *= half[:2]
        if number % 3 == 1:
            angle = 2 * np.pi * dice.choice((0, shape.turns))
            middle[:2] = np.hypot(*middle[:2]) * np.array([np.cos(angle), np.sin(angle)])
        box = indicator(shape, [arb(float(m), float(w)) for m, w in zip(middle, half, strict=True)])
        points = middle + half * np.concatenate([dice.uniform(-1, 1, (60, 3)), dice.choice((-1, 1), (8, 3))])
        values = spiral_value(shape, points)
        assert float(box.lower()) <= values.min() + 1e-12 and values.max() - 1e-12 <= float(box.upper())
        cut += float(box.rad()) < 2 * (values.max() - values.min()) + 1e-9
    assert cut > 50  # and balls are not much too large


def test_indicator_on_the_axis():
    """Where the azimuth is not defined the ball holds the value of every azimuth."""
    for z in (0.3, 1.0, -0.2):
        box = indicator(spiral(**HELIX), (0, 0, z))
        near = [(1e-9 * np.cos(a), 1e-9 * np.sin(a), z) for a in np.linspace(0, 2 * np.pi, 100)]
        values = spiral_value(spiral(**HELIX), near)
        assert box.lower() < values.min() + 1e-8 and values.max() - 1e-8 < box.upper()


@pytest.mark.parametrize("name", GROWN)
def test_value_over_a_part_of_a_chord(name):
    """No value is outside of the ball, on intervals of all lengths; on short ones it is not much too large."""
    shape = spiral(**GROWN[name])
    dice, narrow = np.random.default_rng(5), 0
    with ctx.workprec(160):
        for h, e in zip(*chords(shape, 80, 6), strict=True):
            line = Line(Solid(shape), [rational(v) for v in h], [rational(v) for v in e])
            low, width = dice.uniform(0, 0.9), 10 ** dice.uniform(-5, -1)
            box = value_over(line, line.place(arb(low)), line.place(arb(low + width)))
            values = spiral_value(shape, h + np.linspace(low, low + width, 40)[:, None] * (e - h))
            assert box.lower() < values.min() + 1e-12 and values.max() - 1e-12 < box.upper()
            narrow += width < 1e-3 and 2 * float(box.rad()) < 3 * np.ptp(values) + 1e-6
    assert narrow > 20


# ---------------------------------------------------------------- exact roots


def torus_roots(R, r, h, e):
    """Enclosures of the real roots in [0, 1) of the torus's quartic, whose coefficients are fractions."""
    R, r = rational(R), rational(r)
    x, y, z = (fmpq_poly([rational(a), rational(b) - rational(a)]) for a, b in zip(h, e, strict=True))
    square = x * x + y * y + z * z + fmpq_poly([R * R - r * r])
    quartic = square * square - 4 * R * R * (x * x + y * y)
    real = [v.real for v, _ in quartic.numer().complex_roots() if v.imag == 0]
    return sorted((v for v in real if v >= 0 and v < 1), key=float)


def test_one_flat_turn_is_a_torus():
    """As many roots as the quartic, and in the same places to 60 binary digits; no chord is undecided."""
    h, e = chords(spiral(**RING), 150, 1)
    counts = []
    for start, stop in zip(h, e, strict=True):
        found, exact = only_roots(spiral(**RING), start, stop), torus_roots(**RING, h=start, e=stop)
        counts.append(len(found))
        assert len(found) == len(exact)
        assert all(abs(a.t - b) < arb(2) ** -60 for a, b in zip(found, exact, strict=True))
    assert counts.count(4) > 5 and counts.count(2) > 30 and counts.count(0) > 10


@pytest.mark.parametrize("turns", [1.0, 2.5])
def test_chords_in_the_half_plane_of_the_ends(turns):
    """y = 0: ball and disk, and with more turns every disk, have the same root everywhere."""
    ring = spiral(**(RING | {"turns": turns}))
    for h, e in (((2.0, 0.0, 0.1), (-2.0, 0.0, 0.1)), ((0.75, 0.0, 2.0), (0.7, 0.0, -2.0))):
        found, exact = only_roots(ring, h, e), torus_roots(**RING, h=h, e=e)
        assert len(found) == len(exact) in (2, 4)
        assert all(abs(a.t - b) < arb(2) ** -60 for a, b in zip(found, exact, strict=True))


def test_along_the_axis():
    """On the axis there is nothing; parallel to it, through all centres at azimuth 0, roots at round places."""
    helix = spiral(**HELIX)
    assert roots(helix, (0, 0, -1), (0, 0, 3)) == ([], [])
    found = only_roots(helix, (0.75, 0, -1), (0.75, 0, 3))
    for k, root in enumerate(found):
        assert root.t.contains(fmpq(7 + 2 * k, 32)) and root.enters == (k % 2 == 0)
    assert len(found) == 8


def test_through_the_axis():
    """Along a diagonal through the middle: the azimuth jumps by half a turn there."""
    found = only_roots(spiral(**RING), (-1, -1, 0), (1, 1, 0))
    with ctx.workprec(160):
        far, near = arb(0.7) + arb(0.25), arb(0.7) - arb(0.25)
        exact = [(1 + rho / arb(2).sqrt()) / 2 for rho in (-far, -near, near, far)]
    assert len(found) == 4 and all(root.t.overlaps(t) for root, t in zip(found, exact, strict=True))


def test_through_the_axis_of_a_growing_screw():
    """As the float64 oracle has it, though radii and height jump at the axis as far as half a turn takes them."""
    screw = spiral(R=0.2, r=0.19, pitch=1.0, turns=2.3, R_growth=1.0, r_growth=0.6)
    dice, counted = np.random.default_rng(8), 0
    for _ in range(40):
        ahead, low, high = dice.normal(size=2).astype(np.float32), *dice.uniform(-0.5, 3, 2)
        h, e = (*-3 * ahead, low), (*2 * ahead, high)  # on a line through the axis, exactly
        exact, clearance = spiral_chord_roots(screw, np.array([h], float), np.array([e], float))
        found = places(only_roots(screw, h, e))
        assert clearance[0] < 1e-9 or np.allclose(found, exact[0][~np.isnan(exact[0])], rtol=0, atol=1e-12)
        counted += len(found)
    assert counted > 60


def test_touching_one_turn_where_another_is_entered():
    """Two parts are zero there, one of them without a slope: the sign changes all the same, and nowhere else."""
    coil = spiral(R=1.0, r=5 / 16, pitch=6 / 16, turns=3.5)
    point, ahead = np.array([1.25, 0, 9 / 16]), np.array([-3, 0, 4]) / 16
    (found,) = only_roots(coil, point - ahead, point + ahead / 2)
    with ctx.workprec(100):
        assert found.t.overlaps(arb(fmpq(2, 3))) and found.enters


def test_through_the_centre_of_an_end():
    """From outside along the tangent of the curve: the pole of the ball at the start, and of that at the end."""
    arc = spiral(R=1.0, r=0.25, pitch=0.0, turns=0.25, R_growth=-0.5, r_growth=0.25)
    start = only_roots(arc, (1, -1, 0), (1, 0, 0))
    assert len(start) == 1 and start[0].t.contains(fmpq(3, 4)) and start[0].enters
    stop = only_roots(arc, (-1, 0.875, 0), (0, 0.875, 0))
    assert len(stop) == 1 and stop[0].t.contains(1 - fmpq(5, 16)) and stop[0].enters


def test_from_inside():
    """No root within the solid, one on the way out; a chord that begins on the surface is not decided there."""
    ring = spiral(**RING)
    assert roots(ring, (0.7, 0, 0), (0.75, 0.01, 0)) == ([], [])
    found = only_roots(ring, (0.7, 0, 0), (0.2, 0, 0))
    assert len(found) == 1 and found[0].t.contains(fmpq(1, 2)) is False and not found[0].enters
    assert abs(float(found[0].t) - 0.5) < 1e-15  # 0.7 - 0.25 is not 0.45 in binary
    found, gaps = roots(spiral(R=0.75, r=0.25), (0.75, 0, 0.25), (0.75, 0, -0.75))
    assert len(found) == len(gaps) == 1 and found[0].t.contains(fmpq(1, 2)) and gaps[0].t.contains(0)


def test_a_hundred_turns():
    """Along the tube of a tall spring: an entry and an exit in every turn, the ball at the end included."""
    spring = spiral(R=0.75, r=0.0625, pitch=0.25, turns=100.0)
    found = only_roots(spring, (0.75, 0, -1), (0.75, 0, 31))
    assert len(found) == 202
    for k in range(101):
        for root, side in zip(found[2 * k : 2 * k + 2], (-1, 1), strict=True):
            assert root.t.contains((1 + fmpq(k, 4) + side * fmpq(1, 16)) / 32)


def test_tangents():
    """Touching the ring from above, and from the side in a flat point: undecided. Off by 2^-70: decided."""
    ring = spiral(R=0.75, r=0.25)
    for y in (0, 0.25, 0.75):
        found, gaps = roots(ring, (-2, y, 0.25), (2, y, 0.25))
        assert not found and len(gaps) == (1 if y == 0.75 else 2)
        assert all(abs(gap.indicator) < TINY and gap.t.rad() < 2.0**-20 for gap in gaps)
        verdict = certify(ring, (-2, y, 0.25), (2, y, 0.25), None)
        assert verdict.kind == "undecided" and verdict.clearance < TINY
        for side, count in ((1, 0), (-1, 4 if y < 0.75 else 2)):
            z = Fraction(1, 4) + side * Fraction(1, 2**70)
            assert len(only_roots(ring, (-2, y, z), (2, y, z))) == count


# ---------------------------------------------------------------- the float64 oracle


def test_random_chords():
    """Random spirals: the float64 oracle finds as many roots, in the same places."""
    dice, counted = random.Random(3), 0
    for number in range(40):
        shape = random_spiral(dice)
        h, e = chords_through(shape, 25, number)
        exact, clearance = spiral_chord_roots(shape, h, e)
        for i in np.flatnonzero(clearance > 1e-12):
            found = places(only_roots(shape, h[i], e[i]))
            assert np.allclose(found, exact[i][~np.isnan(exact[i])], rtol=0, atol=1e-13), (shape, i)
            counted += len(found)
    assert counted > 300


@pytest.mark.parametrize("name", GROWN)
def test_near_the_axis(name):
    """Chords of which a quarter passes the axis at 1e-9 and more, and half hits the tube."""
    shape = spiral(**GROWN[name])
    h, e = chords(shape, 60, 4)
    exact, clearance = spiral_chord_roots(shape, h, e)
    for i in np.flatnonzero(clearance > 1e-12):
        found = places(only_roots(shape, h[i], e[i]))
        assert np.allclose(found, exact[i][~np.isnan(exact[i])], rtol=0, atol=1e-12), i


# ---------------------------------------------------------------- verdicts

LID = (-2, 0.25, 0.25 - 2.0**-20), (2, 0.25, 0.25 - 2.0**-20)  # four roots, 2^-20 deep at most


def test_verdicts():
    """A chord with four roots, found right, late, not at all; one without a root."""
    ring = spiral(R=0.75, r=0.25)
    first, second, third, _ = only_roots(ring, *LID)
    cell = Fraction(int(float(first.t) * 2**24), 2**24)
    width = Fraction(1, 2**24)
    right = certify(ring, *LID, cell, width)
    assert right.kind == "certified" and right.clearance is None and right.root.t.overlaps(first.t)
    for steps, margin, kind in ((3, 3, "certified"), (3, 2, "wrong"), (-3, 3, "certified"), (-3, 2, "wrong")):
        assert certify(ring, *LID, cell + steps * width, width, margin * width).kind == kind
    early = certify(ring, *LID, cell - 5 * width, width)
    ends = [abs(at(ring, *LID, rational(cell + k * width))) for k in (-5, -4)]
    assert early.kind == "wrong" and float(early.clearance) == pytest.approx(float(min(ends, key=float)), rel=1e-9)
    late = certify(ring, *LID, cell + 1000 * width, width)  # no value before that place is larger than the one there
    assert late.kind == "wrong"
    assert float(late.clearance) == pytest.approx(-float(at(ring, *LID, rational(cell + 1000 * width))), rel=0.05)
    inside = certify(ring, (0.75, 0, 0.25 - 2.0**-20), (0.75, 0, 1), None)  # what was not seen is that it begins inside
    assert inside.kind == "missed" and float(inside.clearance) == pytest.approx(2.0**-20, rel=0.05)
    for t in (float(second.t), float(third.t), None):
        verdict = certify(ring, *LID, t, width)
        assert verdict.kind == ("missed" if t is None else "wrong")
        depth = 2.0**-20 if t != float(second.t) else float(verdict.clearance)
        assert verdict.root.t.overlaps(first.t)
        assert depth * 0.95 < float(verdict.clearance) < depth * 1.05 and verdict.clearance > 2.0**-22
    over = (-2, 0.25, 0.25 + 2.0**-20), (2, 0.25, 0.25 + 2.0**-20)
    assert certify(ring, *over, None) == ("certified", None, None)
    closest = float(first.t + second.t) / 2
    verdict = certify(ring, *over, closest, width)
    assert verdict.kind == "false" and verdict.root is None
    assert 2.0**-20 * 0.9 < float(verdict.clearance) < 2.0**-20 * 1.2


def test_clearance_of_what_was_missed():
    """It is what the float64 oracle says where that is small: the depth of the chord between both roots."""
    dice, counted = random.Random(5), 0
    for number in range(60):
        shape = random_spiral(dice)
        h, e = chords_through(shape, 200, number)
        exact, clearance = spiral_chord_roots(shape, h, e)
        for i in np.flatnonzero((clearance < 1e-2) & ((~np.isnan(exact)).sum(axis=1) == 2)):
            found = certify(shape, h[i], e[i], None).clearance
            assert found.upper() > clearance[i] * (1 - 1e-9) - 1e-12
            counted += found < clearance[i] * 1.04
    assert counted > 10


def test_judge_counts():
    """Each kind of verdict is counted once; epsilon takes out what has less clearance, but nothing undecided."""
    ring = spiral(R=0.75, r=0.25)
    first, _, third, _ = [int(t * 2**24) for t in places(only_roots(ring, *LID))]
    error = first + 0.5 - places(only_roots(ring, *LID))[0] * 2**24
    beside, touching = ((-2, 0.25, 0.5), (2, 0.25, 0.5)), ((-2, 0.25, 0.25), (2, 0.25, 0.25))
    cases = [(LID, first), (LID, first + 5), (LID, -1), (LID, third), (beside, 1 << 23), (beside, -1), (touching, -1)]
    h, e, found = [c[0][0] for c in cases], [c[0][1] for c in cases], [c[1] for c in cases]
    for epsilon, counts in ((0, (7, 4, 0, 1, 1, 2, 1)), (1e-5, (7, 4, 3, 0, 1, 0, 1))):
        result = judge(ring, h, e, found, 24, 4, epsilon)
        assert result[:7] == counts
        assert [i for i, _ in result.uncertified] == [1, 2, 3, 4, 6]
        assert np.flatnonzero(~np.isnan(result.error)).tolist() == [0]
        assert result.error[0] == pytest.approx(error, abs=1e-7)
    assert judge(ring, h, e, found, 24, 5).error[1] == pytest.approx(result.error[0] + 5)


def test_unusable():
    """A chord without length, a tube without radius, one that reaches the axis."""
    with pytest.raises(ValueError, match="without length"):
        roots(spiral(**RING), (1, 2, 3), (1, 2, 3))
    for wrong in ({"r": 0.0}, {"r": 0.7}, {"turns": 0.0}, {"r_growth": -0.25}):
        bare = SimpleNamespace(**(dict(pitch=0.0, turns=1.0, R_growth=0.0, r_growth=0.0) | RING | wrong))
        with pytest.raises(ValueError):
            roots(bare, (1, 2, 3), (1, 2, 4))


# ---------------------------------------------------------------- the golden model


def judged(surface, h, e, rule="certified", weaken=None):
    """The golden model, n1 = 3, K = 8, on chords: what is proved about it, with a margin of 64 ulp."""
    config = spiral_config(surface, 3, 8, rule)
    compiled = compile_chords(surface, h, e, config)
    if weaken:
        words = compiled.form.copy()
        words[FORM_INDEX[weaken] : FORM_INDEX[weaken] + ZONES] >>= 3
        compiled = compiled._replace(form=words)
    local = [ends_of_words(row, compiled.factors, compiled.middle) for row in compiled.coordinates]
    starts, stops = zip(*local, strict=True)
    for exact, rounded in ((starts, compiled.h), (stops, compiled.e)):
        assert np.allclose([[v.p / v.q for v in map(as_fraction, p)] for p in exact], rounded, rtol=0, atol=1e-14)
    return judge(surface, starts, stops, trace_spiral(compiled, config).t[:, 0], 24, 64, compiled.epsilon)


def as_fraction(value):
    """For an exact division to float."""
    return SimpleNamespace(p=int(value.p), q=int(value.q))


def test_golden_model():
    """Random spirals and chords: all certified, and t is within the last digit and a bit."""
    dice, errors = random.Random(6), []
    for number in range(12):
        surface = random_spiral(dice)
        result = judged(surface, *chords_through(surface, 30, number))
        assert not result.uncertified, (surface, result.uncertified)
        errors.append(result.error[~np.isnan(result.error)])
    errors = np.concatenate(errors)
    assert len(errors) > 40 and np.abs(errors).max() < 8 and np.sqrt(np.mean(errors**2)) < 0.5


def test_what_is_wrong_is_seen():
    """The paper's rule, and a bound of an eighth of what it should be, lose roots: more than the evaluator's error."""
    dice, lost = random.Random(7), dict.fromkeys(("paper", "lipschitz"), 0)
    for number in range(10):
        surface = random_spiral(dice)
        h, e = chords_through(surface, 120, number)
        for what in lost:
            result = judged(surface, h, e, *(("paper",) if what == "paper" else ("certified", what)))
            lost[what] += result.missed + result.wrong
            assert result.false == result.undecided == 0
    assert all(lost.values()), lost


@pytest.mark.parametrize("column, n1, failure", [
    ("missed", "1, 24", True), ("false", "3, 8", True), ("wrong", "4, 6", True), ("left out", "3, 8", False),
    ("of these missed", "3, 8", True), ("of these missed", "2, 12", True), ("of these missed", "1, 24", False),
    ("given up", "3, 8", False),
])  # fmt: skip
def test_failures_of_the_table(column, n1, failure):
    """Which rows of ``make exact-spirals`` end it with status 1; the paper's rule never does."""
    for rule in ("certified", "paper"):
        row = {name: "0" for name in exact_spirals.HEADER} | {"rule": rule, "n1, K": n1, column: "1"}
        assert exact_spirals.bad([row[name] for name in exact_spirals.HEADER]) == (failure and rule == "certified")
