# SPDX-License-Identifier: Apache-2.0
"""Run time against error: every alternative finds what the oracle finds; tables, files and the guard; bad input."""

import importlib
import json
import sys
from pathlib import Path

import numpy as np
import pytest

from raydix.oracle import ideal_frame
from raydix.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
SIZE = 48, 36
SILHOUETTE = 3  # pixels that samples may get wrong


@pytest.fixture(scope="module")
def script():
    """scripts/benchmark.py as a module; its neighbours are found as when it is run."""
    sys.path.insert(0, str(ROOT / "scripts"))
    try:
        yield importlib.import_module("benchmark")
    finally:
        sys.path.remove(str(ROOT / "scripts"))


def asked_for(method, value):
    """The error that a setting asks for, in t."""
    if method.knob == "digits":
        return 2.0**-value
    return value or 1e-9


@pytest.mark.parametrize("name", ["torus", "hyperboloid", "sphere", "cyclide", "saddle", "plane", "spiral"])
def test_alternatives_find_the_surface(script, name):
    """The finest setting of each: depth within some times of what was asked for, silhouettes to a few pixels."""
    scene = load_scene(SCENES / f"{name}.toml", *SIZE)
    problem, ideal = script.problem_of(scene), ideal_frame(scene).depth
    methods = script.methods_for(problem)
    assert len(methods) >= (3 if name == "spiral" else 7)
    for method in methods:
        value = method.values[-1]
        found = script.errors(method.renderer(value)(problem), ideal)
        length = np.linalg.norm(problem.high - problem.low) * scene.surfaces[0].scale
        # sphere tracing stops at a distance, which is less than what is left of the ray
        allowed = (200 if method.name == "sphere tracing" else 2) * asked_for(method, value) * length
        assert found["rms"] <= allowed, f"{method.name}: {found}, allowed: {allowed}"
        assert found["silhouette"] <= SILHOUETTE, f"{method.name}: {found}"


@pytest.mark.parametrize("name", ["torus", "sphere"])
def test_finer_is_nearer(script, name):
    """Each finer setting has a smaller error: the knobs do what they say."""
    scene = load_scene(SCENES / f"{name}.toml", *SIZE)
    problem, ideal = script.problem_of(scene), ideal_frame(scene).depth
    for method in script.methods_for(problem):
        rms = [script.errors(method.renderer(value)(problem), ideal)["rms"] for value in method.values]
        assert all(a > b for a, b in zip(rms, rms[1:], strict=False)), f"{method.name}: {rms}"


def test_errors_of_depths(script):
    """Errors where both hit; a pixel of the silhouette where one does; nothing where none hits."""
    inf = np.inf
    found = script.errors(np.array([[1.0, 2.5, inf, 3.0]]), np.array([[1.0, 2.0, 4.0, inf]]))
    assert found["silhouette"] == 2 and found["max"] == 0.5 and found["rms"] == pytest.approx(0.5 / 2**0.5)
    none = script.errors(np.full((1, 2), inf), np.full((1, 2), inf))
    assert none["silhouette"] == 0 and np.isnan(none["max"])


def row(script, method, variant, seconds, ratio, p999=1e-6, silhouette=0):
    """A row of a made-up scene."""
    return script.Row("made", method, variant, 100, p999, p999, p999, silhouette, list(seconds), ratio)


def test_who_is_faster_at_no_larger_error(script):
    """An alternative counts if it is faster than every certified setting as good as it, or none is as good."""
    own = [
        row(script, script.RAYDIX, "certified, n1 3, K 8", [2.0] * 3, 1.0, p999=1e-7),
        row(script, script.RAYDIX, "certified, n1 3, K 4", [1.0] * 3, 0.5, p999=1e-4),
        row(script, script.RAYDIX, "paper, n1 3, K 8", [0.1] * 3, 0.5, p999=1e-9),
    ]
    others = [
        row(script, "slow", "", [2.5] * 3, 1.25, p999=1e-6),
        row(script, "quick", "", [1.5] * 3, 0.75, p999=1e-6),
        row(script, "coarse", "", [1.5] * 3, 0.75, p999=1e-3),
        row(script, "exact", "", [9.0] * 3, 4.5, p999=1e-12),
    ]
    found = script.beaten(own + others)
    assert [(r[1], r[3], r[4]) for r in found] == [
        ("quick", "certified, n1 3, K 8", "0.75"),
        ("exact", "none as good", ""),
    ]


@pytest.mark.parametrize("slower, bad", [(1.05, False), (1.3, True)])
def test_guard(script, slower, bad):
    """The golden model slower by a twentieth passes, by three tenths it does not, however fast the machine is."""

    def rows(factor, machine):
        own = row(script, script.RAYDIX, script.REFERENCE, [machine * factor] * 3, 1.0)
        return [own, *(row(script, f"m{i}", "", [machine * i] * 3, i / factor) for i in (1, 2, 3))]

    before = json.loads(json.dumps([script.asdict(r) for r in rows(1.0, 1.0)]))
    assert bool(script.lost(rows(slower, 5.0), before)) == bad


def test_command(script, tmp_path, capsys):
    """One scene, small: status 0, a row for every configuration and method, JSON, CSV and both pictures."""
    out = tmp_path / "bench"
    arguments = [str(SCENES / "sphere.toml"), "--size", "32x24", "--repeats", "2", "--out", str(out)]
    assert script.main(arguments) == 0
    said = capsys.readouterr()
    rows = json.loads((out / "benchmarks.json").read_text())
    assert {r["method"] for r in rows} >= {script.RAYDIX, "closed form", "Bézier clipping", "sphere tracing"}
    assert all(len(r["seconds"]) == 2 and min(r["seconds"]) > 0 and r["ratio"] > 0 for r in rows)
    assert "certified, n1 4, K 6" in said.out and "Bézier clipping" in said.out
    assert len((out / "benchmarks.csv").read_text().splitlines()) == len(rows) + 1
    assert (out / "sphere.png").stat().st_size > 10_000 and "<svg" in (out / "sphere.svg").read_text()


@pytest.mark.parametrize("scene, words", [("gallery", "allowed: one"), ("nowhere", "nowhere.toml")])
def test_bad_input(script, tmp_path, capsys, scene, words):
    """Several surfaces, or no file: status 2, one line that says what is allowed, nothing written."""
    out = tmp_path / "bench"
    assert script.main([str(SCENES / f"{scene}.toml"), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert words in said and "Traceback" not in said and not out.exists()


def test_scenes_of_the_full_run(script):
    """One picture of one surface: no scene with several, no sequence."""
    names = {p.stem for p in SCENES.glob("*.toml") if script.measurable(load_scene(p))}
    assert names >= {"torus", "spiral", "shell", "quartic"} and not names & {
        "gallery",
        "families",
        "glass",
        "turntable",
    }


@pytest.mark.long
def test_clocks(script):
    """Clocks of the smallest processor, by simulation: a pixel of the rectangle takes one at least."""
    scene = load_scene(SCENES / "sphere.toml", 64, 48)
    ((name, parameters, cycles, ratio, steps),) = script.clocks(scene, (3,))
    assert (name, parameters) == ("sphere", "3, 8")
    assert int(cycles.replace(",", "")) > 500 and 0.2 < float(ratio) < 20 and int(steps.replace(",", "")) > 1000


def test_page_has_what_was_measured(script):
    """The page's tables are those of the baseline; certified settings of 24 digits have no wrong silhouette pixel."""
    rows = [script.Row(**r) for r in json.loads(script.BASELINE.read_text())]
    text = script.PAGE.read_text()
    for r in rows:
        assert f"| {' | '.join(script.cells(r))} |" in text
    exact = [r for r in rows if r.variant in (script.REFERENCE, "certified, n1 4, K 6")]
    assert exact and all(r.silhouette == 0 for r in exact)
