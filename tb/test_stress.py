# SPDX-License-Identifier: Apache-2.0
"""A fixed subset of `make stress`: the certified rule fails nowhere outside of the band; the checks see failures."""

import sys
from pathlib import Path

import numpy as np
import pytest

from raydix import stress, stress_spirals
from raydix.config import Config
from raydix.exact import changes
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
    return script.collect(todo, 1, quiet=True)


@pytest.mark.parametrize("name", [*ALGEBRAIC, *stress_spirals.CATEGORIES])
def test_certified(joined, name):
    """Nothing missed, false or wrong outside of the band; errors of well-conditioned roots below 2 ulp."""
    part = joined[name, "certified"]
    assert part["counts"][0] > 0
    assert part["counts"][2:5].tolist() == [0, 0, 0]
    assert np.concatenate(part["well"]).max(initial=0) <= 2


def test_paper_rule_loses(joined):
    """What the paper's rule loses is seen by the same checks."""
    lost = sum(joined[name, "paper"]["counts"][2:5] for name in ALGEBRAIC)
    assert lost[0] > 10
    assert lost[2] > 50


def test_judge_sees_failures():
    """A hit taken away, one added, a later root and a digit off: each is counted as what it is."""
    b = np.array([[40, -30, 20, -30, 40], [9, 8, 7, 6, 5], [40, -30, 20, -30, 41]]) << 20
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
