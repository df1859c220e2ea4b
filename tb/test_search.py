# SPDX-License-Identifier: Apache-2.0
"""Directed cases: the worst rays that the search has found stay right, and cost no more than they did."""

import sys
from pathlib import Path

import numpy as np
import pytest

from raydix import stress
from raydix.config import Config
from raydix.formats import STEPS_MAX
from raydix.scene import Spiral
from raydix.segments import Segments, trace_segments, whole

sys.path.append(str(Path(__file__).resolve().parents[1] / "scripts"))
import search  # noqa: E402  (a script, found by the path above)

CONFIG = Config(units=1)
CASES = search.load_cases()


def test_items():
    """The same error, at most 2 ulp, and the same steps as when they were found."""
    b = np.array([case["b"] for case in CASES["item"]], np.int64)
    assert len(b) >= 8
    error, steps = search.error_score(b, CONFIG), search.steps_score(b, CONFIG)
    for case, e, s in zip(CASES["item"], error, steps, strict=True):
        assert e <= 2
        assert (e if case["search"] == "error" else s) == pytest.approx(case["found"], rel=1e-6)
    segments = Segments(b, whole(len(b)))
    assert not stress.judge(segments, trace_segments(segments, CONFIG)[0][:, 0], CONFIG).failed.any()


@pytest.mark.parametrize("case", CASES["spiral"], ids=lambda c: f"{c['search']}={c['found']:g}")
def test_spirals(case):
    """No failure, the same error, no more steps than when it was found; given up only where it was then."""
    surface = Spiral(type="spiral", **{key: case[key] for key in search.FIELDS})
    chord = surface, np.array([case["h"]]), np.array([case["e"]])
    judged = search.judge_chords(*chord)
    assert not judged.failed.any()
    if case["search"] == "error":
        assert search.spiral_error(*chord)[0] == pytest.approx(case["found"], rel=1e-6)
    else:
        assert case["found"] == STEPS_MAX or not judged.given_up.any()
        assert search.spiral_steps(*chord)[0] <= case["found"]


def test_cases_are_apart():
    """No case of a search is nearly another one, and a doubled item is kept once."""
    for name in ("error", "steps"):
        b = np.array([case["b"] for case in CASES["item"] if case["search"] == name], np.int64)
        assert len(search.apart(b, np.ones(len(b)))) == len(b) == search.KEPT
    b = np.array([[100, -3, 5], [101, -3, 5], [1, 90, 5]])
    assert search.apart(b, np.array([1.0, 2.0, 0.5])).tolist() == [1, 2]


def test_search_climbs():
    """Forty generations find a larger error than the first has, and than as many items drawn anew have."""
    b, s, begin = search.evolve(search.error_score, CONFIG, 40, 800, 3, lambda: None)
    anew = search.first_items(np.random.default_rng(4), 41 * 800, CONFIG)
    assert s[0] > max(begin, search.error_score(anew, CONFIG).max())
    assert np.isfinite(s).all()
    assert np.abs(b).max() <= 1 << 35
