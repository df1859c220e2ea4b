# SPDX-License-Identifier: Apache-2.0
"""A fixed subset of `make stress`: the certified rule fails nowhere outside of the band; the checks see failures."""

import sys
from fractions import Fraction
from math import comb
from pathlib import Path

import numpy as np
import pytest

from raydix import stress, stress_spirals
from raydix.chords_spiral import compile_chords, spiral_config, trace_spiral
from raydix.config import Config
from raydix.exact import changes
from raydix.formats import STEPS_MAX
from raydix.oracle_spiral import spiral_chord_roots
from raydix.segments import Segments, trace_segments, whole

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "scripts"))
import stress as script  # noqa: E402  (a script, found by the path above)

REFERENCE = Config(units=1)
ALGEBRAIC = list(stress.categories(4))


@pytest.fixture(scope="module")
def joined():
    """Results of the subset, both rules, by (category, rule)."""
    todo = [script.Job(name, 0, 1500, REFERENCE, 11) for name in ALGEBRAIC]
    todo += [script.Job(name, 0, 300, REFERENCE, 11) for name in stress_spirals.CATEGORIES]
    return script.collect(todo, 1)


@pytest.mark.parametrize("name", [*ALGEBRAIC, *stress_spirals.CATEGORIES])
def test_certified(joined, name):
    """Nothing missed, false or wrong outside of the band; errors of well-conditioned roots below 2 ulp."""
    part = joined[name, "certified"]
    assert part["counts"][0] > 0
    assert part["counts"][script.FAILED].tolist() == [0] * 5
    assert np.concatenate(part["well"]).max(initial=0) <= 2


@pytest.mark.parametrize("name", ["any coefficients", "centre of a torus", "eye inside", "thin spiral"])
def test_most_roots_are_compared(joined, name):
    """The limit of 2 ulp is for well-conditioned roots: those are most of the hits."""
    part = joined[name, "certified"]
    assert len(np.concatenate(part["well"])) > 0.5 * part["counts"][1]


def test_paper_rule_loses(joined):
    """What the paper's rule loses is seen by the same checks."""
    lost = sum(joined[name, "paper"]["counts"][script.FAILED] for name in ALGEBRAIC)
    assert lost[0] > 10
    assert lost[2] > 50


def test_judge_sees_failures():
    """A hit taken away, one added, a later root and a digit off: each is counted as what it is."""
    b = np.array([[40, -30, 20, -30, 40], [9, 8, 7, 6, 5], [40, -30, 20, -30, 41]]) << 28
    segments = Segments(b, whole(len(b)))
    t, _ = trace_segments(segments, REFERENCE)
    exact = changes(b)
    assert np.isnan(exact[1]).all()
    assert not stress.judge(segments, t[:, 0], REFERENCE).failed.any()
    later = int(exact[2][1] * 2**24)
    judged = stress.judge(segments, np.array([-1, 5, later]), REFERENCE)
    assert judged.missed.tolist() == [True, False, False]
    assert judged.false.tolist() == [False, True, False]
    assert judged.wrong.tolist() == [False, False, True]
    assert judged.failed.all()
    off = stress.judge(segments, t[:, 0] + np.array([3, 0, 0]), REFERENCE)
    assert 2.4 < off.error[0] < 3.6
    assert not off.wrong[0]
    assert off.off.tolist() == off.failed.tolist() == [True, False, False]


def taken(b, *found, config=REFERENCE):
    """The judge's opinion of cells that are said to be found on one segment; -1 = none."""
    b = np.repeat(np.array([b], np.int64), len(found), axis=0)
    return stress.judge(Segments(b, whole(len(b))), np.array(found), config)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("depth", "explained"), [(0.5, True), (0.95, True), (1.1, False), (20, False)])
def test_band_is_as_deep_as_the_bound(side, depth, explained):
    """A dip that is passed over is excused where it is less deep than A, and only if f dips from above."""
    config = Config(units=1, degree=2)
    deep = int(depth * stress.halving(config.n1, config.steps, 2, config.width))
    b = [side * ((1 << 33) - deep), side * (-(1 << 33) - deep), side * ((1 << 33) - deep)]
    judged = taken(b, -1, config=config)
    assert judged.missed[0]
    assert judged.band[0] == (explained and side > 0)
    assert judged.failed[0] != judged.band[0]


def test_band_is_local():
    """A double root elsewhere on the ray excuses nothing: f = (t - 1/4)(t - 1/2)(t - 3/4)^2."""
    power = [Fraction(9, 128), Fraction(-39, 64), Fraction(29, 16), Fraction(-9, 4), Fraction(1)]
    b = [sum(c * Fraction(comb(i, k), comb(4, k)) for k, c in enumerate(power[: i + 1])) for i in range(5)]
    b = [int(v * (1 << 37)) for v in b]
    quarter, half, last = 1 << 22, 1 << 23, 3 << 22
    judged = taken(b, -1, half, 5, last, quarter)
    assert judged.missed.tolist() == [True, False, False, False, False]
    assert judged.wrong.tolist() == [False, True, False, True, False]
    assert judged.off.tolist() == [False, False, True, False, False]
    assert judged.failed.tolist() == [True, True, True, True, False]


@pytest.mark.parametrize("config", [REFERENCE, Config(1, 1, 16, 4, 1), Config(4, 1, 36, 4, 1)], ids=["24", "1", "4"])
@pytest.mark.parametrize("name", ["tangent", "triple and quadruple roots", "eye inside", "saturating coefficients"])
def test_missing_hits_are_failures(name, config):
    """All hits taken away: most are failures, also where the ray has a tangency as well, or the cells are large."""
    segments = next(iter(stress.categories(4)[name](np.random.default_rng(3), 400, config)))
    t = trace_segments(segments, config)[0][:, 0]
    judged = stress.judge(segments, np.full(len(t), -1), config)
    part = 0.75 if config.digits > 1 else 0.4  # with words of 16 bits more is in the band
    assert judged.failed.sum() > part * (judged.hit & (t >= 0)).sum() > 5


def test_giving_up_is_a_failure(monkeypatch):
    """Hits of spirals that are given up in their place, although their roots are outside of the band."""

    def given_up(compiled, config):
        found = trace(compiled, config)
        return found._replace(t=np.full_like(found.t, -1), steps=np.full_like(found.steps, STEPS_MAX))

    trace = script.trace_spiral
    monkeypatch.setattr(script, "trace_spiral", given_up)
    part = script.collect([script.Job("thin spiral", 0, 60, REFERENCE, 11)], 1)
    counts = part["thin spiral", "certified"]["counts"]
    assert script.failures(part) == counts[script.COUNTS.index("with a root outside")] > 0.8 * counts[1]


def test_moved_hits_end_the_script(monkeypatch):
    """Each t three cells on: the counts that decide the exit status are not zero."""

    def moved(segments, config):
        t, steps = trace_segments(segments, config)
        return np.where(t < 0, t, np.minimum(t + 3, (1 << config.digits) - 1)), steps

    monkeypatch.setattr(script, "trace_segments", moved)
    part = script.run(script.Job("centre of a torus", 0, 300, REFERENCE, 11)).rules["certified"]
    assert part["counts"][script.FAILED].sum() > 100


def test_moved_spiral_hits_are_failures(monkeypatch):
    """The same for spirals, whose hits are judged by the indicator at the ends of the cell."""

    def moved(compiled, config):
        found = trace(compiled, config)
        return found._replace(t=np.where(found.t < 0, found.t, np.minimum(found.t + 3, (1 << config.digits) - 1)))

    trace = script.trace_spiral
    monkeypatch.setattr(script, "trace_spiral", moved)
    part = script.run(script.Job("thin spiral", 0, 60, REFERENCE, 11)).rules["certified"]
    assert part["counts"][script.FAILED].sum() > 0.8 * part["counts"][1]


@pytest.mark.parametrize(("n1", "steps"), [(1, 1), (4, 1), (3, 8)])
@pytest.mark.parametrize("name", ["spiral, seam of tube and ball", "thin spiral"])
def test_second_root_of_a_spiral_is_a_failure(name, n1, steps):
    """The cell of the second root in place of the first one's: counted, however near they are."""
    counted, chords = 0, 150 if steps > 1 else 4000  # with few digits few second roots are in a cell of their own
    for surface, h, e in stress_spirals.CATEGORIES[name](np.random.default_rng(5), chords):
        config = spiral_config(surface, n1, steps)
        compiled = compile_chords(surface, h, e, config)
        found = trace_spiral(compiled, config)
        exact, clearance = spiral_chord_roots(surface, compiled.h, compiled.e)
        left = stress.seen(surface, compiled, exact, config.digits)
        assert not stress.judge_spiral(surface, compiled, found, exact, clearance, config).failed.any()
        sure = (clearance >= compiled.epsilon) & ~np.isnan(left[:, 1])
        t = np.where(sure, np.floor(np.nan_to_num(left[:, 1]) * 2.0**config.digits), found.t[:, 0]).astype(np.int64)
        later = found._replace(t=np.concatenate([t[:, None], found.t[:, 1:]], axis=1))
        judged = stress.judge_spiral(surface, compiled, later, exact, clearance, config)
        assert judged.failed[sure].all()
        counted += sure.sum()
    assert counted > 10


@pytest.mark.parametrize("n1", [1, 4])
def test_spiral_root_beside_an_unsure_end_is_left_out(n1):
    """Eyes inside, few digits: a root in the first cell counts only where the sign at the chord's start is sure."""
    left_out = 0
    for surface, h, e in stress_spirals.CATEGORIES["spiral, eye inside"](np.random.default_rng(11), 4000):
        config = spiral_config(surface, n1, 1)
        compiled = compile_chords(surface, h, e, config)
        exact, clearance = spiral_chord_roots(surface, compiled.h, compiled.e)
        left = stress.seen(surface, compiled, exact, n1)
        pairs = stress.resolved(exact, n1)
        changed = ~np.array([np.array_equal(a, b, equal_nan=True) for a, b in zip(left, pairs, strict=True)])
        left_out += changed.sum()
        near = np.abs(stress.spiral_value(surface, compiled.h)) < compiled.epsilon
        assert changed.sum() <= near.sum() + 2  # and hardly any by a boundary inside
        found = trace_spiral(compiled, config)
        assert not stress.judge_spiral(surface, compiled, found, exact, clearance, config).failed.any()
    assert left_out > 0


def test_pair_in_one_cell_is_left_out():
    """Two roots in one cell of the last level do not count; three count as one."""
    ulp = 2.0**-24
    exact = np.array([[0.1, 0.5, 0.5 + ulp / 2, np.nan], [0.5, 0.5 + ulp / 4, 0.5 + ulp / 2, np.nan]])
    left = stress.resolved(exact, 24)
    assert left[0, 0] == 0.1
    assert np.isnan(left[0, 1:]).all()
    assert left[1, 0] == 0.5 + ulp / 2
    assert np.isnan(left[1, 1:]).all()


def test_pictures(joined, tmp_path):
    """A row for each category."""
    cases = [(n, joined[n, "certified"]["worst"][1]) for n in ("grazing", "thin spiral")]
    script.plot_cases(tmp_path / "worst.png", cases, REFERENCE)
    assert (tmp_path / "worst.png").stat().st_size > 10_000


def test_seed_repeats(joined):
    """The same seed gives the same rays."""
    again = script.run(script.Job("grazing", 0, 1500, REFERENCE, 11)).rules["certified"]
    assert again["counts"].tolist() == joined["grazing", "certified"]["counts"].tolist()
