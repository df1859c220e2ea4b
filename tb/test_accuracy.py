# SPDX-License-Identifier: Apache-2.0
"""Golden model against the ideal scene in float64, and the two rules against each other."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from raydix.accuracy import depth_errors
from raydix.chords import chord_quads, paper_float, random_chords, rates, trace_chords
from raydix.config import Config
from raydix.oracle import chord_roots, ideal_frame, quadrics
from raydix.render import render_golden
from raydix.scene import load_scene
from raydix.surfaces import form

SCENES = Path(__file__).resolve().parents[1] / "scenes"
EVERY = sorted(path.stem for path in SCENES.glob("*.toml"))
TORUS = SimpleNamespace(type="torus", R=0.7, r=0.25)


def errors(scene):
    """Error figures of the golden model in the reference configuration."""
    return depth_errors(render_golden(scene, Config(vecsum="general"), 2), ideal_frame(scene))


def test_torus_figures():
    """Torus at 640x480: no silhouette pixel different, depth rms <= 2e-7, max <= 5e-6."""
    found = errors(load_scene(SCENES / "torus.toml"))
    print(found)
    assert found.hit == 114903
    assert found.silhouette == 0
    assert found.rms <= 2e-7
    assert found.max <= 5e-6


@pytest.mark.parametrize("name", EVERY)
def test_every_scene_within_a_few_ulp(name):
    """No silhouette pixel different, rms below 0.35 ulp of t, largest error below 5 ulp."""
    found = errors(load_scene(SCENES / f"{name}.toml", 320, 240))
    print(found)
    assert found.hit > 5000
    assert (found.silhouette, found.other) == (0, 0)
    assert found.ulp_rms < 0.35
    assert found.ulp_max < 5


def test_rules_on_random_chords():
    """The paper rule fails as often as known for the method, the certified rule never; one in 20 steps more at most."""
    h, e = random_chords(60_000, 1.0, 7)
    exact = chord_roots(quadrics(TORUS), h, e)
    quads = chord_quads(form(TORUS), h, e)

    def golden(rule):
        config = Config(3, 8, 36, rule=rule, units=1)
        t, steps = trace_chords(quads, True, config)
        return rates(t[:, 0], exact, config.digits, steps)

    certified, paper = golden("certified"), golden("paper")
    assert certified.chords > 30_000
    assert (certified.missed, certified.wrong, certified.false) == (0, 0, 0)
    assert certified.steps_per_hit < 8.01 and certified.steps_per_miss < 1.02
    assert 0.00002 < paper.missed < 0.002 and 0.0005 < paper.wrong < 0.005
    assert paper.steps_per_hit == paper.steps_per_miss == 8

    def distance(p):
        return np.hypot(np.hypot(p[..., 0], p[..., 1]) - TORUS.R, p[..., 2]) - TORUS.r

    coarse = rates(paper_float(distance, h, e, 1, 24), exact, 24)
    assert 0.0001 < coarse.missed < 0.002 and 0.01 < coarse.wrong < 0.06


def test_all_roots_on_random_chords():
    """Roots wanted = 4: the number of roots found is right on every chord."""
    h, e = random_chords(20_000, 1.0, 11)
    exact = chord_roots(quadrics(TORUS), h, e)
    t, _ = trace_chords(chord_quads(form(TORUS), h, e), True, Config(3, 8, 36, units=1), roots=4)
    assert ((t >= 0).sum(axis=1) == (~np.isnan(exact)).sum(axis=1)).all()
    assert np.nanmax(np.abs((t + 0.5) * 2.0**-24 - exact)[t >= 0]) < 16 * 2.0**-24
