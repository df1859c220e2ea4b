# SPDX-License-Identifier: Apache-2.0
"""Run time against error: every alternative finds what the oracle finds; tables, files and the guard; bad input."""

import json
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from raydix.oracle import ideal_frame
from raydix.scene import load_scene
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
SIZE = 48, 36
SILHOUETTE = 3  # pixels that samples may get wrong


@pytest.fixture(scope="module")
def script():
    """scripts/benchmark.py and its neighbours, found as when it is run."""
    names = "alternatives", "picture_error", *(f"benchmarks.{n}" for n in ("rows", "tables", "guard", "clocks"))
    with scripts(*names, "benchmark") as modules:
        yield modules


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
        found = script.depth_errors(method.renderer(value)(problem), ideal)
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
        rms = [script.depth_errors(method.renderer(value)(problem), ideal)["rms"] for value in method.values]
        assert all(a > b for a, b in zip(rms, rms[1:], strict=False)), f"{method.name}: {rms}"


def test_errors_of_depths(script):
    """Errors where both hit; a pixel of the silhouette where one does; nothing where none hits."""
    inf = np.inf
    found = script.depth_errors(np.array([[1.0, 2.5, inf, 3.0]]), np.array([[1.0, 2.0, 4.0, inf]]))
    assert found["silhouette"] == 2 and found["max"] == 0.5 and found["rms"] == pytest.approx(0.5 / 2**0.5)
    assert found["p999"] == pytest.approx(0.5, abs=1e-3)
    none = script.depth_errors(np.full((1, 2), inf), np.full((1, 2), inf))
    assert none["silhouette"] == 0 and np.isnan(none["max"])


def row(script, method, variant, seconds, ratio, p999=1e-6, silhouette=0):
    """A row of a made-up scene."""
    errors = dict(rms=p999, p999=p999, max=p999, silhouette=silhouette, psnr=60.0, flip=0.001)
    return script.Row("made", method, variant, 100, **errors, seconds=list(seconds), ratio=ratio)


def test_who_is_faster_at_no_larger_error(script):
    """An alternative counts if it is faster than every certified setting as good as it, or than the reference."""
    own = [
        row(script, script.RAYDIX, "certified, n1 3, K 8", [2.0] * 3, 1.0, p999=1e-7),
        row(script, script.RAYDIX, "certified, n1 3, K 4", [1.0] * 3, 0.5, p999=1e-4),
        row(script, script.RAYDIX, "paper, n1 3, K 8", [0.1] * 3, 0.5, p999=1e-9),
    ]
    others = [
        row(script, "slow", "", [2.5] * 3, 1.25, p999=1e-6),
        row(script, "quick", "", [1.5] * 3, 0.75, p999=1e-6),
        row(script, "coarse", "", [1.5] * 3, 0.75, p999=1e-3),
        row(script, "exact", "", [1.9] * 3, 0.95, p999=1e-12),
        row(script, "exact and slow", "", [9.0] * 3, 4.5, p999=1e-12),
    ]
    found = script.beaten(own + others)
    assert [(r[1], r[3], r[4]) for r in found] == [
        ("quick", "certified, n1 3, K 8", "0.75"),
        ("exact", "none as good", ""),
    ]


def test_every_scene_at_a_glance(script):
    """The least ratio of a group, over the fastest setting as good; others in brackets; the fastest engine."""
    own = [
        row(script, script.RAYDIX, "certified, n1 3, K 8", [2.0] * 3, 1.0, p999=1e-7),
        row(script, script.RAYDIX, "certified, n1 3, K 4", [1.0] * 3, 0.5, p999=1e-4),
    ]
    others = [
        row(script, "closed form", "", [1.5] * 3, 0.75, p999=1e-12),
        row(script, "64 samples, bisection", "12", [1.5] * 3, 0.75, p999=1e-3),
        row(script, "64 samples, Newton", "12", [3.4] * 3, 1.7, p999=1e-6),
        row(script, "64 samples, Newton", "16", [5.0] * 3, 2.5, p999=1e-12),
        row(script, "64 samples, regula falsi", "16", [4.0] * 3, 2.0, p999=1e-11),
    ]
    engines = [[scene, "", "", "", "", "", time, *[""] * 4] for scene, time in (("made", "10.5"), ("made", "9.80"))]
    (line,) = script.glance(own + others, [*engines, ["other", *engines[0][1:6], "1.00", *[""] * 4]])
    found = dict(zip(script.EVERY, line, strict=True))
    assert found.pop("scene") == "made" and found.pop("ms") == "2000.0" and found.pop("99.9 % error") == "1.0e-07"
    given = {name: text for name, text in found.items() if text}
    wanted = {"silhouette": "0", "closed form": "(0.75)", "samples": "1.50 (2.00)", "placed engine, ms": "9.80"}
    assert given == wanted
    assert script.glance(own, [])[0][-1] == ""


@pytest.mark.parametrize("slower, bad", [(0.8, False), (1.09, False), (1.11, True), (1.3, True)])
def test_guard(script, slower, bad):
    """Without noise the golden model slower by a tenth is the limit, however fast the machine is.

    Programs of others do not count; a scene or a size that the baseline has not is told.
    """

    def rows(factor, machine):
        own = row(script, script.RAYDIX, script.REFERENCE, [machine * factor] * 3, 1.0)
        return [own, *(row(script, f"m{i}", "", [machine * i] * 3, i / factor) for i in (1, 2, 3))]

    before = json.loads(json.dumps([asdict(r) for r in rows(1.0, 1.0)]))
    program = row(script, "program", "", [1e-3] * 3, 1e-3)
    program.program = True
    before = [script.Row(**r) for r in before]
    assert bool(script.lost([*rows(slower, 5.0), program], before)) == bad
    others = rows(1.0, 1.0)
    for r in others:
        r.pixels = 99
    assert "nothing to compare with" in script.lost(others, before)[0]


def test_command(script, monkeypatch, tmp_path, capsys):
    """One scene, small: status 0, a row for every configuration and method, JSON, CSV and both pictures.

    Some configurations only: each compiles a kernel of its own.
    """
    out, every = tmp_path / "bench", script.configurations
    some = (script.REFERENCE, "certified, n1 3, K 4", "certified, n1 4, K 6", "paper, n1 3, K 8")

    def chosen(scene):
        return {name: config for name, config in every(scene).items() if name in some}

    monkeypatch.setattr(sys.modules["benchmarks.rows"], "configurations", chosen)
    arguments = [str(SCENES / "sphere.toml"), "--size", "32x24", "--repeats", "2", "--out", str(out)]
    assert script.main(arguments) == 0
    said = capsys.readouterr()
    rows = json.loads((out / "benchmarks.json").read_text())
    assert {r["method"] for r in rows} >= {script.RAYDIX, "closed form", "Bézier clipping", "sphere tracing"}
    assert all(r["psnr"] is None or r["psnr"] > 20 for r in rows if r["method"] == "closed form")
    reference = next(r for r in rows if r["variant"] == script.REFERENCE)
    for r in rows:
        turns = [a / b for a, b in zip(r["seconds"], reference["seconds"], strict=True)]
        assert len(turns) == 2 and r["ratio"] == pytest.approx(np.median(turns))
        assert min(r["seconds"]) > 0
    assert "certified, n1 4, K 6" in said.out and "Bézier clipping" in said.out
    assert len((out / "benchmarks.csv").read_text().splitlines()) == len(rows) + 1
    assert (out / "sphere.png").stat().st_size > 10_000 and "<svg" in (out / "sphere.svg").read_text()
    assert script.main(["--full", "--kept", "--out", str(out)]) == 0  # what was kept makes the same tables
    assert capsys.readouterr().out == said.out
    page = tmp_path / "page.md"
    page.write_text("<!-- BEGIN generated: every -->\n<!-- END generated: every -->\n")
    monkeypatch.setattr(sys.modules["benchmark"], "PAGE", page)
    before = page.read_text()
    none, clocks = "[]", json.dumps([["sphere", *["1.50"] * (len(script.CLOCKS) - 1)]])
    for text, count in ((none, 0), (clocks, 1)):
        (out / "clocks.json").write_text(text)
        assert script.main(["--full", "--kept", "--write", "--out", str(out)]) == 2  # one scene is not all
        assert f"found 1 scenes, {count} clocks" in capsys.readouterr().err and page.read_text() == before
    monkeypatch.setattr(sys.modules["benchmark"], "measurable", lambda scene: scene.name == "sphere")
    (out / "clocks.json").write_text(none)
    assert script.main(["--full", "--kept", "--write", "--out", str(out)]) == 2  # all scenes, no clocks
    (out / "clocks.json").write_text(clocks)
    assert script.main(["--full", "--kept", "--write", "--out", str(out)]) == 0
    (line,) = (line for line in page.read_text().splitlines() if line.startswith("| sphere"))
    line = [cell.strip() for cell in line.strip("|").split("|")]
    assert line[1] == f"{1e3 * np.median(reference['seconds']):.1f}" and line[-1] == "1.50"


@pytest.mark.parametrize("scene, words", [("gallery", "allowed: one picture of one"), ("nowhere", "nowhere.toml")])
def test_bad_input(script, tmp_path, capsys, scene, words):
    """Several surfaces, or no file: status 2, one line that says what is allowed, nothing written."""
    out = tmp_path / "bench"
    assert script.main([str(SCENES / f"{scene}.toml"), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert words in said and "Traceback" not in said and not out.exists()


def test_transparent_surface_is_refused(script, tmp_path, capsys):
    """Its picture is not that of its nearest hit: status 2."""
    text = (SCENES / "sphere.toml").read_text().replace('type = "sphere"', 'type = "sphere"\nopacity = 0.5')
    (tmp_path / "clear.toml").write_text(text)
    assert script.main([str(tmp_path / "clear.toml"), "--out", str(tmp_path / "bench")]) == 2
    assert "one opaque surface" in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--size", "320"], "found '320'; allowed: WIDTHxHEIGHT"),
        (["--size", "320x240x3"], "allowed: WIDTHxHEIGHT"),
        (["--repeats", "0"], "allowed: whole numbers, 1 or more"),
        (["--write", "--check"], "allowed: as the page has it"),
        (["torus.toml", "--write"], "allowed: as the page has it"),
        (["--kept", "--check"], "allowed: with --full, --out and --write"),
        (["--kept", "--size", "64x48"], "allowed: with --full, --out and --write"),
        (["--kept", "--write"], "allowed: with --full"),
        (["--full", "--write"], "allowed: with --rtl or --kept"),
        (["--full", "--write", "--only-rtl"], "allowed: with --rtl or --kept"),
    ],
)
def test_bad_arguments(script, capsys, arguments, words):
    """Status 2, what was found and what is allowed."""
    with pytest.raises(SystemExit) as ended:
        script.main(arguments)
    assert ended.value.code == 2 and words in capsys.readouterr().err


def test_nothing_kept(script, tmp_path, capsys):
    """What is kept is asked for where nothing is, or something else: status 2 and a line."""
    rows = json.dumps([asdict(row(script, script.RAYDIX, script.REFERENCE, [1.0], 1.0))])
    others = json.dumps([asdict(row(script, script.RAYDIX, "certified, n1 1, K 12", [1.0], 1.0))])
    wrong = [(None, "[]"), ("[", "[]"), ('[{"scene": "sphere"}]', "[]"), (others, "[]")]
    wrong += [(rows, text) for text in (None, "5", "[", "[1]", '[["made"]]', '[["made", "", "", "", "", "", "x"]]')]
    for found, clocks in wrong:
        for name, text in (("benchmarks.json", found), ("clocks.json", clocks)):
            (tmp_path / name).write_text(text) if text is not None else (tmp_path / name).unlink(missing_ok=True)
        assert script.main(["--kept", "--out", str(tmp_path)]) == 2
        assert "benchmarks.json, clocks.json: found no rows of this form" in capsys.readouterr().err


@pytest.mark.parametrize("option, name", [("--rtl", "PLACED"), ("--check", "BASELINE")])
def test_missing_files_are_told_at_once(script, monkeypatch, tmp_path, capsys, option, name):
    """Without what an option needs: status 2 and a line before anything is measured."""
    monkeypatch.setattr(sys.modules["benchmarks.clocks" if option == "--rtl" else "benchmark"], name, tmp_path / "none")
    monkeypatch.setattr(sys.modules["benchmark"], "measure", None)
    assert script.main([str(SCENES / "sphere.toml"), option, "--out", str(tmp_path)]) == 2
    assert "allowed: " in capsys.readouterr().err


def test_helix_of_a_wide_pitch(script, tmp_path):
    """POV-Ray's isosurface loses nothing where rays pass near the axis, where the helix' indicator is steep."""
    lines = ['type = "spiral"', "R = 0.6", "r = 0.1", "pitch = 2.0", "turns = 1.0"]
    text = (SCENES / "spiral.toml").read_text()
    head = text[: text.index("[[surface]]")]
    (tmp_path / "wide.toml").write_text(head + "\n".join(["[[surface]]", *lines, "color = [1.0, 1.0, 1.0]", ""]))
    scene = load_scene(tmp_path / "wide.toml", 160, 120)
    problem, ideal = script.problem_of(scene), ideal_frame(scene).depth
    programs, missing = script.programs_for(problem)
    by_name = {program.name: program for program in programs}
    if "POV-Ray, isosurface" not in by_name:
        pytest.skip("; ".join(missing))
    _, depth_of = by_name["POV-Ray, isosurface"].render(problem, 1e-5)
    found = script.depth_errors(depth_of(), ideal)
    assert np.isfinite(ideal).sum() > 500 and found["silhouette"] == 0 and found["rms"] < 2e-5


def test_configurations(script):
    """n1 from 1 to 4 with 12 to 24 digits, both rules, and three widths where there are control points."""
    found = script.configurations(load_scene(SCENES / "torus.toml", *SIZE))
    assert {(c.n1, c.digits) for c in found.values() if c.rule == "certified"} >= {(1, 12), (2, 16), (3, 24), (4, 24)}
    assert {c.n1 for c in found.values() if c.rule == "paper"} == {1, 2, 3, 4}
    assert {c.width for c in found.values()} == {24, 28, 32, 36}
    assert len(script.configurations(load_scene(SCENES / "spiral.toml", *SIZE))) == len(found) - 3


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
def test_clocks(script, monkeypatch, tmp_path):
    """Clocks of the engines that were placed, by simulation: as many rays, three steps a miss at least."""
    scene = load_scene(SCENES / "sphere.toml", 64, 48)
    fine, coarse = (script.Design("quadric", 3, steps) for steps in (8, 4))
    kept = tmp_path / "exploration.json"
    kept.write_text(json.dumps([{"design": asdict(d), "fmax": 100.0} for d in (fine, coarse)]))
    monkeypatch.setattr(sys.modules["benchmarks.clocks"], "PLACED", kept)
    (row,) = script.clocks(scene)  # coarse has not all digits
    found = dict(zip(script.CLOCKS, row, strict=True))
    cycles = int(found["clocks"].replace(",", ""))
    assert (found["scene"], found["engine"]) == ("sphere", str(fine))
    assert cycles > 1000 and float(found["projected, ms"]) == pytest.approx(cycles / 1e5, abs=0.006)
    assert found["silhouette"] == "0" and float(found["99.9 %"]) < 1e-6


def test_pictures(script):
    """The ideal picture is the golden model's to a unit of a colour; another picture has a lower PSNR and more FLIP."""
    scene = load_scene(SCENES / "torus.toml", *SIZE)
    config = script.configurations(scene)[script.REFERENCE]
    _, picture = script.golden(scene, config)()
    depth, rgb = picture()
    ideal = script.shaded(scene, ideal_frame(scene).depth)
    assert np.abs(rgb.astype(int) - ideal).max() <= 1 and (ideal > 0).any()
    own = script.picture_errors(rgb, ideal)
    assert own["psnr"] > 60 and own["flip"] < 0.003
    assert script.picture_errors(ideal, ideal) == {"psnr": None, "flip": 0.0}
    shifted = script.picture_errors(np.roll(rgb, 1, axis=1), ideal)
    assert shifted["psnr"] < 40 and shifted["flip"] > 0.02


@pytest.mark.parametrize("name", ["torus", "hyperboloid", "sphere", "cyclide", "saddle", "spiral"])
def test_programs_find_the_surface(script, name):
    """POV-Ray's finest setting to 2e-5, Embree to a thousandth; skipped with a line where they are not installed."""
    scene = load_scene(SCENES / f"{name}.toml", *SIZE)
    problem, ideal = script.problem_of(scene), ideal_frame(scene).depth
    programs, missing = script.programs_for(problem)
    assert all("not installed" in text for text in missing)
    if not programs:
        pytest.skip("; ".join(missing))
    for program in programs:
        value = min(program.values[-1], 1e6)
        seconds, depth_of = program.render(problem, value)
        depth = depth_of()
        found = script.depth_errors(depth, ideal)
        middle = np.nanmedian(np.abs(np.where(np.isfinite(depth), depth, np.nan) - ideal))
        if "cylinders" in program.name:  # in some pixels another turn is seen
            assert middle < 5e-4, f"{program.name}: {middle}"
        else:
            allowed = 1e-3 if program.name == "Embree" else 2e-5
            assert found["rms"] <= allowed, f"{program.name}: {found}"
        assert seconds > 0
        assert found["silhouette"] <= SILHOUETTE, f"{program.name}: {found}"


@pytest.mark.parametrize(("printed", "seconds"), [("0.000", 1e-3), ("0.107", 0.107), ("12.250", 12.25)])
def test_seconds_of_a_report(script, printed, seconds):
    """POV-Ray's trace time; never 0, however small the picture is: times are divided by each other."""
    report = f"Render Time:\n  Photon Time: No photons\n  Trace Time: 0 hours 0 minutes 0 seconds ({printed} seconds)\n"
    module = sys.modules["alternatives.povray"]
    assert module.seconds_of(report) == seconds and module.seconds_of("Fatal error") is None


def test_program_that_is_not_there(script, monkeypatch):
    """Without POV-Ray and Embree: no programs, and a line for each that says how to get it."""
    monkeypatch.setattr(sys.modules["alternatives.povray"].shutil, "which", lambda name: None)
    monkeypatch.setattr(sys.modules["alternatives.embree"], "find_spec", lambda name: None)
    programs, missing = script.programs_for(script.problem_of(load_scene(SCENES / "torus.toml", *SIZE)))
    assert not programs and len(missing) == 2 and all("install" in text for text in missing)


def test_page_has_what_was_measured(script):
    """The page's tables are those of the baseline; certified settings of 24 digits have no wrong silhouette pixel."""
    rows = [script.Row(**r) for r in json.loads(script.BASELINE.read_text())]
    text = (ROOT / "docs" / "benchmarks.md").read_text()
    for r in rows:
        assert f"| {' | '.join(script.cells(r))} |" in text
    exact = [r for r in rows if r.variant in (script.REFERENCE, "certified, n1 4, K 6")]
    assert exact and all(r.silhouette == 0 for r in exact)
