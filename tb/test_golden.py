# SPDX-License-Identifier: Apache-2.0
"""The golden model by itself: compiled against interpreted, and against exact rational arithmetic.

Run as a program (``RAYDIX_INTERPRET=1 python tb/test_golden.py OUT.npz``) this file traces the same frames, polynomials
and products with the interpreted model and writes all results to OUT.npz.
"""

import importlib.util
import os
import random
import shutil
import subprocess
import sys
from fractions import Fraction
from itertools import pairwise, product
from math import comb
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, example, given, seed, settings
from hypothesis import strategies as st

import spirals
from raydix import golden, kernel
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.ends import ends
from raydix.formats import COORD_FRAC, FORM_WORDS, STEPS_MAX
from raydix.halve import average
from raydix.hits import differing_bits
from raydix.item import BOX, DEPTH, PAPER, ROOTS, SIZE, STEPS, B, C, T
from raydix.kernel import words, zeros
from raydix.normalize import norm_limit, normalize
from raydix.product import product as form
from raydix.ring import trace
from raydix.step import new_work
from raydix.vecsum import evaluate, new_lanes

ROOT = Path(__file__).resolve().parents[1]
SEED = int(os.environ.get("SEED") or 1)


def examples(count):
    """Settings of the property tests: so many examples, the same every time for one SEED, no time limit for each."""
    return settings(max_examples=count, deadline=None, database=None)


# One numba compilation for each n1, and one for spirals.
# Sizes: interpreted, a step of the paper rule at n1 = 4 takes most of a millisecond.
CONFIGS = (Config(n1=1, steps=24, units=1), Config(n1=4, steps=6, units=1))
FRAMES = {
    f"{scene}-{config.n1}-{rule}": (scene, config.with_(rule=rule), *size[rule])
    for config in CONFIGS
    for scene, size in {
        "torus": {"certified": (48, 36), "paper": (24, 18)},
        "gallery": {"certified": (48, 36), "paper": (24, 18)},
        "glass": {"certified": (32, 24), "paper": (16, 12)},
    }.items()
    for rule in ("certified", "paper")
}
SPIRALS = CONFIGS[0].with_(vecsum="general")
FRAMES |= {
    f"{scene}-1-{rule}": (scene, SPIRALS.with_(rule=rule), *size)
    for scene, size in {spirals.MIXED: (32, 24), "shell": (24, 18)}.items()
    for rule in ("certified", "paper")
}


def compiled_frame(scene, config, width, height):
    """Words of a scene in ``scenes/`` or ``tb/scenes/`` at another size."""
    return compile_scene(spirals.load(scene, width, height), config)


# ---- one polynomial through the ring ----


def ring(b, n1, steps, width, roots=4, rule="certified", box=(0, 0, 0), ends=(0,) * 6):
    """(t of the hits, depths, points, steps, last t) of the polynomial with Bernstein coefficients ``b``."""
    degree = len(b) - 1
    item, first = zeros(SIZE), zeros(SIZE)
    item[PAPER] = int(rule == "paper")
    item[ROOTS] = roots
    for axis in range(3):
        item[BOX + axis] = box[axis]
    first[C : C + 6] = words(ends)
    first[DEPTH : DEPTH + 2] = words((1 << 20, (1 << 31) - 1))
    first[B : B + degree + 1] = words(b)
    return traced(item, first, zeros(FORM_WORDS), n1, steps, width, degree, 0)


def traced(item, first, form, n1, steps, width, degree, general):
    """(t of the hits, depths, points, steps, last t) of an item."""
    fixed = form, new_work(n1, degree), n1, steps, width, degree, general
    t, depth, point = np.full(4, -1, np.int64), np.zeros(4, np.int32), np.zeros((4, 3), np.int32)
    hits = trace(item, first, *fixed, t, depth, point, np.zeros(4, np.uint8), 0)
    return [int(v) for v in t[:hits]], depth[:hits].tolist(), point[:hits].tolist(), int(item[STEPS]), int(item[T])


# ---- one chord of a spiral through the ring ----


def random_chords(count=9):
    """Arguments of :func:`traced`: rays of every spiral and n1 by both rules, some between any points within reach."""
    rng = random.Random(SEED)
    reach = 7 << COORD_FRAC - 2
    for general, surfaces in enumerate((spirals.HELIX, spirals.GENERAL)):
        for (name, index), n1 in product(surfaces, (1, 2, 3, 4)):
            found = spirals.surface(name, index, n1)
            for _, _, item, first in rng.sample(list(spirals.rays(found)), count):
                item[PAPER], item[ROOTS] = rng.getrandbits(1), rng.randint(1, 4)
                if rng.random() < 0.3:
                    first[C : C + 6] = words(rng.choice((-reach, reach, rng.randint(-reach, reach))) for _ in range(6))
                ends(first, new_lanes(2), spirals.form(found), general)
                yield item, first, spirals.form(found), n1, rng.randint(1, 32 // n1), 0, 1, general


def random_polynomials(count=400):
    """Arguments of :func:`ring`: random, with corners of the range, of every n1 and both degrees."""
    rng = random.Random(SEED)
    for _ in range(count):
        n1 = rng.randint(1, 4)
        width = rng.choice((16, 36, 48))
        top = (1 << (width - 1)) - 1
        corners = (top, -top - 1, 0, 1, -1, top // 3)
        size = rng.choice((3, 5))
        b = [rng.choice(corners) if rng.random() < 0.4 else rng.randint(-top - 1, top) for _ in range(size)]
        yield dict(
            b=b,
            n1=n1,
            steps=rng.randint(1, 32 // n1),
            width=width,
            roots=rng.randint(1, 4),
            rule=rng.choice(("certified", "paper")),
            box=[rng.choice((0, 0, 1, 2, 5)) for _ in range(3)],
            ends=[rng.choice((rng.randint(-(1 << 31), (1 << 31) - 1), -(1 << 31), (1 << 31) - 1)) for _ in range(6)],
        )


def random_products(count=300):
    """Arguments (quads, quartic, width, degree) of the product, corners of the documented range among them."""
    rng = random.Random(SEED)
    for _ in range(count):
        degree, quartic, width = rng.choice((2, 4, 4)), rng.random() < 0.7, rng.choice((16, 36, 48))
        big = (1 << 62) - (1 << 28)
        limits = [1 << 59 if quartic else 1 << 60] * 3 + [big] * 6
        quads = [rng.choice((m, -m, rng.randint(-m, m), rng.randint(-9, 9))) for m in limits]
        yield quads, quartic, width, degree


def indicators(count=300):
    """(name, values) of each spiral: at the corners of what a segment reaches, on the axis, and anywhere."""
    rng = random.Random(SEED)
    reach = 7 << COORD_FRAC - 2
    points = [*product((-reach, reach), repeat=3), *product((-1, 0, 1), (-1, 0, 1), (-reach, 0, reach))]
    points += [[rng.randint(-reach, reach) for _ in range(3)] for _ in range(count)]
    lanes = new_lanes(len(points))
    for axis, lane in enumerate((lanes.x, lanes.y, lanes.z)):
        lane[:] = words(p[axis] for p in points)
    for general, surfaces in enumerate((spirals.HELIX, spirals.GENERAL)):
        for name, index in surfaces:
            evaluate(lanes, len(points), spirals.form(spirals.surface(name, index, 3)), general)
            yield f"{name} {index} {general}", np.array(lanes.value, np.int64)


def results():
    """Everything that both ways of running the model are compared in, by name."""
    out = {}
    for name, (scene, config, width, height) in FRAMES.items():
        frame = golden.trace_golden(compiled_frame(scene, config, width, height), config)
        for index, hits in enumerate(frame.surfaces):
            for array in ("t", "depth", "point", "enters", "steps"):
                out[f"frame {name} {index} {array}"] = getattr(hits, array)
    for index, arguments in enumerate(random_polynomials()):
        out[f"polynomial {index}"] = np.array([repr(ring(**arguments))])
    for index, (quads, quartic, width, degree) in enumerate(random_products()):
        values = zeros(degree + 1)
        form(words(quads), quartic, values, 0, width, degree)
        out[f"product {index}"] = np.array([int(v) for v in values], np.int64)
    for index, arguments in enumerate(random_chords()):
        out[f"chord {index}"] = np.array([repr(traced(*arguments))])
    for name, values in indicators():
        out[f"indicator {name}"] = values
    return out


def interpreted_results(path):
    """Write the results of the interpreted model; every word of its working state must be a Python integer."""
    assert kernel.INTERPRETED
    vectors = []
    plain = golden.scratch

    def watched(config, degree):
        vectors.append(plain(config, degree))
        return vectors[-1]

    golden.scratch = watched
    out = results()
    assert vectors
    for state, item, first, quads, work in vectors:
        *lanes, _ = work.lanes  # the last is a number, the digits left away
        for vector in (state.ravel(), item, first, quads, work.cells, work.nodes, *lanes):
            assert vector.dtype == object
            assert {type(v) for v in vector} <= {int, bool}, {type(v) for v in vector}
    assert max(max(map(abs, state.ravel())) for state, *_ in vectors) > 1 << 56  # the state is in there
    np.savez(path, **out)


def test_interpreted_equals_compiled(tmp_path):
    """Compiled to 64 bits and interpreted with unbounded integers the model gives the same bits everywhere."""
    out = tmp_path / "interpreted.npz"
    run = subprocess.Popen(
        [sys.executable, __file__, str(out)],
        env={**os.environ, "RAYDIX_INTERPRET": "1", "SEED": str(SEED)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    compiled = results()
    text = run.communicate()[0]
    assert run.returncode == 0, text
    interpreted = np.load(out)
    assert set(interpreted.files) == set(compiled)
    different = [name for name in compiled if not np.array_equal(interpreted[name], compiled[name])]
    first = different[0] if different else ""
    assert not different, f"{len(different)} differ, first {first}: {interpreted[first]} and {compiled[first]}"
    # the comparison is worth something: hits, misses, further roots, restarts
    for name, (scene, *_) in FRAMES.items():
        t = compiled[f"frame {name} 0 t"]
        assert (t >= 0).any() and (t < 0).any()
        assert scene != "glass" or (t[..., 1:] >= 0).any()


# ---- threads ----


def test_threads_and_pieces(monkeypatch):
    """The result depends neither on the number of threads nor on how the rows are shared out."""
    _, config, *_ = next(iter(FRAMES.values()))
    frame = compiled_frame("gallery", config, 96, 72)
    monkeypatch.setattr(golden, "ROWS", 1000)
    wanted = golden.trace_golden(frame, config, threads=1)
    assert wanted.counts()["hits"] > 500
    for rows, threads in product((1, 7), (1, 2, 5)):
        monkeypatch.setattr(golden, "ROWS", rows)
        assert differing_bits(golden.trace_golden(frame, config, threads=threads), wanted) == 0, (rows, threads)


# ---- averages and scaling ----

VALUES = st.integers(-(1 << 47), (1 << 47) - 1)


def test_average_exhaustive():
    """Every pair of 6-bit values: the mean rounded half up, never outside of the two."""
    for a, b in product(range(-32, 32), repeat=2):
        assert average(a, b) == -((-(a + b)) // 2)
        assert min(a, b) <= average(a, b) <= max(a, b)


@seed(SEED)
@examples(200)
@given(VALUES, VALUES)
@example((1 << 47) - 1, (1 << 47) - 1)
@example(-(1 << 47), -(1 << 47))
def test_average_within(a, b):
    """The average lies in the interval, at most half above the mean and never below it."""
    assert min(a, b) <= average(a, b) <= max(a, b)
    assert 0 <= average(a, b) - Fraction(a + b, 2) <= Fraction(1, 2)


@seed(SEED)
@examples(300)
@given(
    st.sampled_from((16, 36, 48)),
    st.lists(st.tuples(st.integers(0, 47), st.booleans(), st.integers(0, (1 << 47) - 1)), min_size=3, max_size=5),
    st.integers(1, 4),
)
def test_normalize_keeps_signs(width, raw, n1):
    """Scaling in a step multiplies by one power of two: no sign changes, no zero appears, nothing is lost."""
    drop = 48 - width
    values = [(magnitude >> drop >> size) * (-1 if negative else 1) for size, negative, magnitude in raw]
    out = words(values)
    normalize(out, 0, len(values), width, width, norm_limit(n1))
    out = [int(v) for v in out]
    factors = {Fraction(o, v) for o, v in zip(out, values, strict=True) if v}
    assert len(factors) <= 1 and all(f.denominator == 1 and f.numerator & (f.numerator - 1) == 0 for f in factors)
    for o, v in zip(out, values, strict=True):
        assert (o > 0) == (v > 0) and (o == 0) == (v == 0)
        assert -(1 << (width - 1)) <= o < 1 << (width - 1)
    shift = max(factors, default=Fraction(1))
    assert shift <= 1 << norm_limit(n1)
    # as far as the limit allows, all bits are used
    assert (
        not factors
        or shift == 1 << norm_limit(n1)
        or any(2 * v * shift >= 1 << (width - 1) or 2 * v * shift < -(1 << (width - 1)) for v in values)
    )


@seed(SEED)
@examples(300)
@given(
    st.lists(st.integers(-(1 << 63), (1 << 63) - 1), min_size=3, max_size=5),
    st.integers(0, 62),
    st.sampled_from((16, 36, 48)),
)
def test_normalize_floor(raw, small, width):
    """From 64 bits to W: one power of two for all, each value at most one ulp lower, the sign bit as it was."""
    values = [v >> small for v in raw]
    out = words(values)
    normalize(out, 0, len(values), 64, width, 63)
    used = max(v if v >= 0 else ~v for v in values).bit_length()
    for o, v in zip((int(o) for o in out), values, strict=True):
        assert 0 <= Fraction(v) * Fraction(2) ** (width - 1 - used) - o < 1
        assert (o < 0) == (v < 0)


# ---- certified rule, judged by exact values of the polynomial ----
#
# Tolerance. An average lies 0 to 1/2 above the mean, so each of the D rows of a halving adds an error of 0 to 1/2, and
# a value inherits at most the largest error of its inputs. After n halvings a control point lies therefore 0 to n*D/2
# above the exact one, in units of the first segment's last bit: what is scaled up between the steps makes later
# roundings smaller in that unit, not larger. So with E = n*D/2 a value above zero counts as positive for certain, one
# of at most -E as not positive for certain, and a returned cell brackets a sign change of p + e, 0 <= e <= E.


def exact(b, digits):
    """The polynomial at g/2^digits, g an integer: exact, as a fraction."""
    degree = len(b) - 1
    full = 1 << digits

    def value(g):
        terms = (comb(degree, i) * c * g**i * (full - g) ** (degree - i) for i, c in enumerate(b))
        return Fraction(sum(terms), full**degree)

    return value


def tolerance(b, digits):
    """E of the comment above."""
    return Fraction(digits * (len(b) - 1), 2)


def judge(b, digits, hits, complete, points):
    """Returned cells bracket a sign change within the tolerance, and none between ``points`` is left out."""
    p, e = exact(b, digits), tolerance(b, digits)
    assert all(0 <= t < 1 << digits for t in hits)
    assert all(one < other for one, other in pairwise(hits)), f"{hits}: not in order"
    for t in hits:
        ends = p(t), p(t + 1)
        assert min(ends) <= 0 and max(ends) > -e, f"{b}: no sign change at {t}: {ends}"
    starts = [0, *(t + 1 for t in hits)]
    stops = [*hits, 1 << digits]
    if not complete:
        starts.pop()
        stops.pop()
    for start, stop in zip(starts, stops, strict=True):
        values = [p(g) for g in points if start <= g <= stop]
        positive, negative = any(v > 0 for v in values), any(v <= -e for v in values)
        assert not (positive and negative), f"{b}: a root between {start} and {stop} was missed; hits {hits}"


def coefficients(width, degree):
    """Bernstein coefficients: any, and such that several roots are likely."""
    top = (1 << (width - 1)) - 1
    anything = st.lists(st.integers(-top - 1, top), min_size=degree + 1, max_size=degree + 1)
    size = st.integers(top >> 6, top)
    waves = st.lists(size, min_size=degree + 1, max_size=degree + 1).map(
        lambda values: [-v if i % 2 else v for i, v in enumerate(values)]
    )
    return st.one_of(anything, waves, waves.map(lambda values: [-v for v in values]))


SMALL = st.sampled_from((2, 4)).flatmap(
    lambda degree: st.tuples(
        st.sampled_from(((1, 8), (2, 4), (3, 3), (4, 2))), coefficients(16, degree), st.integers(1, 4)
    )
)
LARGE = st.sampled_from((2, 4)).flatmap(
    lambda degree: st.tuples(
        st.sampled_from(((1, 24), (2, 16), (3, 8), (4, 8))), coefficients(36, degree), st.integers(1, 4)
    )
)


@seed(SEED)
@examples(250)
@given(SMALL)
def test_certified_small(case):
    """W = 16, 8 or 9 digits: every hit brackets a sign change, and none at any of the grid's points is missed."""
    (n1, steps), b, roots = case
    hits, _, _, taken, _ = ring(b, n1, steps, 16, roots)
    digits = n1 * steps
    judge(b, digits, hits, len(hits) < roots and taken < STEPS_MAX, range((1 << digits) + 1))


@seed(SEED)
@examples(250)
@given(LARGE)
def test_certified_large(case):
    """W = 36, 24 or 32 digits: the same at points close to each hit and at 257 equal steps."""
    (n1, steps), b, roots = case
    hits, _, _, taken, _ = ring(b, n1, steps, 36, roots)
    digits = n1 * steps
    full = 1 << digits
    near = {t + s * (1 << k) for t in hits for k in range(digits) for s in (-1, 1)} | set(hits) | {t + 1 for t in hits}
    points = sorted({g for g in near if 0 <= g <= full} | set(range(0, full + 1, full >> 8)))
    judge(b, digits, hits, len(hits) < roots and taken < STEPS_MAX, points)


def with_roots(places, lead):
    """Exact Bernstein coefficients (scaled) of lead * prod(128 t - m), m in ``places``."""
    b = [lead]
    for m in places:
        degree = len(b)
        scaled = [comb(degree - 1, i) * c for i, c in enumerate(b)]
        out = [0] * (degree + 1)
        for i, c in enumerate(scaled):
            out[i] -= m * c
            out[i + 1] += (128 - m) * c
        b = [Fraction(c, comb(degree, i)) for i, c in enumerate(out)]
    assert all(c.denominator == 1 for c in b)
    return [int(c) for c in b]


@seed(SEED)
@examples(200)
@given(
    st.sampled_from((2, 4)).flatmap(
        lambda count: st.lists(st.integers(-40, 40), min_size=count, max_size=count, unique=True)
    ),
    st.sampled_from((-1, 1)),
    st.sampled_from(((1, 16), (2, 8), (3, 5), (4, 4), (1, 8), (2, 4), (3, 3), (4, 2))),
)
def test_certified_finds_separated_roots(raw, sign, shape):
    """Polynomials with known simple roots that have clearance: all of them are found, each within 1 ulp of t."""
    n1, steps = shape
    digits = n1 * steps
    places = sorted(2 * v + 65 for v in raw)  # at least 2/128 apart, some outside of the segment
    b = with_roots(places, 12 * sign)
    room = 46 - max(abs(c) for c in b).bit_length()
    b = [c << room for c in b]
    p, e = exact(b, digits), tolerance(b, digits)
    wanted = [m << (digits - 7) for m in places if 0 < m < 128]
    for g in wanted:
        assert p(g) == 0
        assume(abs(p(g - 1)) > e and abs(p(g + 1)) > e)  # clearance
    for roots in range(1, 5):
        hits, *_ = ring(b, n1, steps, 48, roots)
        expected = wanted[:roots]
        assert len(hits) == len(expected), f"{places}: hits {hits}, roots at {wanted}"
        assert all(t in (g - 1, g) for t, g in zip(hits, expected, strict=True)), f"{hits}, roots at {wanted}"


@seed(SEED)
@examples(150)
@given(SMALL, st.sampled_from(("certified", "paper")), st.sampled_from(((0, 0, 0), (1, 0, 0), (1, 2, 0))))
def test_roots_wanted_prefix(case, rule, box):
    """The first r hits of the answer for four roots are the answer for r, with points and depths, boxes too."""
    (n1, steps), b, _ = case
    ends = (-(1 << 31), -(1 << 30), 0, (1 << 31) - 1, 1 << 30, 5)
    every = ring(b, n1, steps, 16, 4, rule, box, ends)
    for roots in range(1, 4):
        some = ring(b, n1, steps, 16, roots, rule, box, ends)
        for one, other in zip(some[:3], every[:3], strict=True):
            assert one == other[:roots]


# ---- paper rule: the text of the paper in the plainest way, with exact fractions ----


def paper_text(indicator, n1, steps):
    """All (t, hit) of the paper's method for a transparent surface, in order; an opaque one has the first.

    Equations (5) to (11): step k cuts the cell at t into J cells and takes the indicator at the J+1 boundaries. It is a
    hit if a sign change was seen at any step; a ray without one has a single t, where its guesses have led.
    """
    cells_of_step = 2**n1

    def follow(t, k, seen):
        if k > steps:
            yield t, seen
            return
        delta = Fraction(1, 2 ** (n1 * k))
        r = [indicator(t + j * delta) for j in range(cells_of_step + 1)]
        with_change = [j for j in range(cells_of_step) if (r[j] > 0) != (r[j + 1] > 0)]
        if with_change:  # Case 2
            for j in with_change:
                yield from follow(t + j * delta, k + 1, True)
            return
        smallest = min(abs(v) for v in r)  # Case 1
        j = [abs(v) for v in r].index(smallest)
        if j == 0:
            chosen = 0
        elif j == cells_of_step:
            chosen = cells_of_step - 1
        elif abs(r[j] - r[j + 1]) <= abs(r[j - 1] - r[j]):
            chosen = j
        else:
            chosen = j - 1
        yield from follow(t + chosen * delta, k + 1, seen)

    yield from follow(Fraction(0), 1, False)


def plain_coefficients(degree, top):
    """Small whole numbers (ties and zeros), and any up to ``top``."""
    few = st.lists(st.integers(-4, 4), min_size=degree + 1, max_size=degree + 1)
    some = st.lists(st.integers(-top, top), min_size=degree + 1, max_size=degree + 1)
    waves = st.lists(st.integers(1, top), min_size=degree + 1, max_size=degree + 1).map(
        lambda values: [-v if i % 2 else v for i, v in enumerate(values)]
    )
    return st.one_of(few, some, waves)


PAPER_CASES = st.one_of(
    st.tuples(st.sampled_from(((1, 8), (2, 4), (4, 2))), plain_coefficients(4, 32000)),
    st.tuples(st.sampled_from(((1, 12), (3, 4), (4, 3), (2, 6))), plain_coefficients(2, 8000000)),
)


@seed(SEED)
@examples(400)
@given(PAPER_CASES, st.integers(1, 4))
@example(((2, 4), [1, -1, 1, -1, 1]), 4)
@example(((4, 2), [4, -2, 4, 0, 4]), 3)
@example(((3, 4), [1, -1, 1]), 1)  # touches zero: not positive there
@example(((3, 4), [1, 1, 1]), 1)  # everything ties
def test_paper_text(case, roots):
    """The paper rule finds what the paper's text says, bit for bit, and goes the same way where it finds nothing.

    The coefficients are multiples of 2^(n*D), so that no average rounds (each of the n halvings divides by 2^D at most)
    and the indicator values of the model are those of the exact polynomial.
    """
    (n1, steps), small = case
    degree, digits = len(small) - 1, n1 * steps

    def indicator(t):
        return sum(comb(degree, i) * c * t**i * (1 - t) ** (degree - i) for i, c in enumerate(small))

    wanted = [(int(t * 2**digits), hit) for t, hit in paper_text(indicator, n1, steps)][:roots]
    hits, _, _, _, last = ring([c << (digits * degree) for c in small], n1, steps, 48, roots, "paper")
    assert ([(t, True) for t in hits] or [(last, False)]) == wanted


# ---- numba's cache ----


@pytest.fixture
def package(tmp_path):
    """A copy of the model's sources."""
    target = tmp_path / "model" / "raydix"
    shutil.copytree(ROOT / "model" / "raydix", target, ignore=shutil.ignore_patterns("__pycache__"))
    return target


@pytest.mark.skipif(kernel.INTERPRETED, reason="no numba in interpreted mode")
def test_cache_folder_follows_sources(package, monkeypatch):
    """Each source file of the model counts for the name of numba's cache folder; the same sources give the same."""
    import numba

    monkeypatch.setattr(numba.config, "CACHE_DIR", numba.config.CACHE_DIR)

    def folder():
        spec = importlib.util.spec_from_file_location("kernel_copy", package / "kernel.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return Path(numba.config.CACHE_DIR)

    seen = {folder()}
    assert seen == {folder()}
    assert next(iter(seen)).is_relative_to(package.parents[1] / "build" / "numba")
    for source in sorted(package.glob("*.py")):
        text = source.read_text()
        source.write_text(text + "# changed\n")
        assert folder() not in seen, f"{source.name} does not count"
        seen.add(folder())
        source.write_text(text)
        assert folder() in seen
    (package / "another.py").write_text("X = 1\n")
    assert folder() not in seen


@pytest.mark.skipif(kernel.INTERPRETED, reason="no numba in interpreted mode")
def test_cache_is_never_stale(package):
    """After a change in halve.py a kernel of another file that calls it is compiled anew."""
    program = (
        "import raydix.cells as m; from raydix.kernel import words; v = words([0, 7, 0]); m.subdivide(v, 1, 1); "
        "print(m.__file__, int(v[1]), sum(m.subdivide.stats.cache_hits.values()))"
    )

    def run():
        env = {**os.environ, "PYTHONPATH": str(package.parent), "PYTHONDONTWRITEBYTECODE": "1"}
        out = subprocess.run([sys.executable, "-c", program], env=env, capture_output=True, text=True, check=True)
        path, value, cached = out.stdout.split()
        assert Path(path).parent == package
        return int(value), int(cached)

    assert run() == (4, 0)
    assert run() == (4, 1)  # the cache works
    source = package / "halve.py"
    text = source.read_text()
    changed = text.replace("cell[i + 1] + 1) >> 1", "cell[i + 1]) >> 1")
    assert changed != text
    source.write_text(changed)
    assert run() == (3, 0)
    source.write_text(text)
    assert run() == (4, 1)


if __name__ == "__main__":
    interpreted_results(Path(sys.argv[1]))
