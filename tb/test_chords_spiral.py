# SPDX-License-Identifier: Apache-2.0
"""Random spirals against dense sampling: the certified rule misses nothing, and sees nothing that is not there."""

import functools
import random

import numpy as np
import pytest

from raydix.chords_spiral import (
    chords_through,
    compile_chords,
    judge,
    random_spiral,
    slopes,
    spiral_config,
    trace_spiral,
)
from raydix.config import Config
from raydix.formats import FORM_INDEX, STEPS_MAX, ZONES
from raydix.oracle_spiral import spiral_chord_roots
from raydix.scene import Spiral

SPIRALS, CHORDS, SEED = 100, 1000, 7
BAND = 1 / 64  # |cosine| between chord and normal below which t is ill-conditioned
HELIX = Spiral(type="spiral", R=0.6, r=0.1, pitch=0.35, turns=3)


@functools.cache
def cases():
    """Random spirals, ends of chords as the words have them, exact roots and clearance."""
    dice = random.Random(SEED)
    made = []
    for number in range(SPIRALS):
        surface = random_spiral(dice)
        compiled = compile_chords(surface, *chords_through(surface, CHORDS, number), Config())
        made.append((surface, compiled.h, compiled.e, *spiral_chord_roots(surface, compiled.h, compiled.e)))
    return made


def config_of(surface, n1=3, steps=8, rule="certified"):
    """The configuration that the surface needs; other n1 are tried with the general evaluator only."""
    config = spiral_config(surface, n1, steps, rule)
    return config if (n1, steps) == (3, 8) else config.with_(vecsum="general")


@pytest.mark.parametrize(("n1", "steps"), [(2, 10), (3, 8), (4, 6)])
def test_certified(n1, steps):
    """No root missed, none false, none wrong; t within 4 ulp where it is not ill-conditioned; no item given up."""
    hits = 0
    for surface, h, e, exact, clearance in cases():
        config = config_of(surface, n1, steps)
        compiled = compile_chords(surface, h, e, config)
        found = trace_spiral(compiled, config)
        r = judge(surface, compiled, found, exact, clearance, config.digits)
        assert (r.missed, r.false, r.wrong) == (0, 0, 0), surface
        assert r.error[r.slope >= BAND].max(initial=0) <= 4, surface
        assert found.steps.max() < STEPS_MAX, surface
        assert r.left_out <= 2, surface
        hits += r.hit
    assert hits > SPIRALS * CHORDS / 10


def test_every_root():
    """Up to four roots are found, in order, as many as there are, but for a few items that are given up.

    A chord that runs just below the surface has only the Lipschitz bound to exclude cells, and may take all steps.
    """
    counted = given_up = 0
    for surface, h, e, exact, clearance in cases():
        config = config_of(surface)
        compiled = compile_chords(surface, h, e, config)
        found, steps = trace_spiral(compiled, config, roots=4)
        wanted = np.minimum((~np.isnan(exact)).sum(axis=1), 4)
        clear = (clearance >= compiled.epsilon) & (steps < STEPS_MAX)
        given_up += int((steps == STEPS_MAX).sum())
        assert ((found >= 0).sum(axis=1) == wanted)[clear].all(), surface
        for k in range(4):
            both = clear & (wanted > k)
            at = exact[both, k]
            error = np.abs((found[both, k] + 0.5) - at * 2.0**config.digits)
            steep = slopes(surface, compiled.h[both], compiled.e[both], at) >= BAND
            assert error[steep].max(initial=0) <= 4, surface
        counted += int(wanted[clear].sum())
    print(f"\n{counted} roots, {given_up} of {SPIRALS * CHORDS} items given up")
    assert counted > 20_000
    assert given_up < SPIRALS * CHORDS / 2000


def test_paper_rule_is_worse():
    """The paper's rule on the same chords: the same steps for all, and some roots missed or wrong."""
    lost = 0
    for surface, h, e, exact, clearance in cases():
        config = config_of(surface, rule="paper")
        compiled = compile_chords(surface, h, e, config)
        found = trace_spiral(compiled, config)
        r = judge(surface, compiled, found, exact, clearance, config.digits)
        assert (found.steps <= config.steps).all()
        assert r.false == 0, surface
        lost += r.missed + r.wrong
    assert lost > 20


def test_steps_of_the_helix():
    """J = 8: at most 10 steps per hit and 2.1 per miss on random chords, restarts counted."""
    config = config_of(HELIX)
    compiled = compile_chords(HELIX, *chords_through(HELIX, 20_000, 1), config)
    r = judge(HELIX, compiled, trace_spiral(compiled, config), *spiral_chord_roots(HELIX, compiled.h, compiled.e), 24)
    print(f"\n{r.steps_hit.mean():.2f} steps per hit, {r.steps_miss.mean():.2f} per miss, at most {r.steps_hit.max()}")
    assert (r.missed, r.false, r.wrong) == (0, 0, 0)
    assert r.steps_hit.mean() < 10
    assert r.steps_miss.mean() < 2.1


@pytest.mark.parametrize("field", ["lipschitz", "curvature"])
def test_bounds_are_needed(field):
    """With a bound of an eighth of what is derived roots are missed: the test sees what it is for."""
    missed = 0
    for surface, h, e, exact, clearance in cases()[:20]:
        config = config_of(surface)
        compiled = compile_chords(surface, h, e, config)
        words = compiled.form.copy()
        words[FORM_INDEX[field] : FORM_INDEX[field] + ZONES] >>= 3
        found = trace_spiral(compiled._replace(form=words), config)
        missed += judge(surface, compiled, found, exact, clearance, config.digits).missed
    assert missed > 0
