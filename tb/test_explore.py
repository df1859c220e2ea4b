# SPDX-License-Identifier: Apache-2.0
"""The sweep of design points: its designs, fronts and goals, what is kept, the executors, and bad input."""

import json
import os
import subprocess
import sys
import time
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from raydix.compile import compile_scene
from raydix.files import RTL
from raydix.golden import trace_golden
from raydix.oracle import ideal_frame
from raydix.scene import load_scene
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = ROOT / "scripts"


@pytest.fixture(scope="module")
def script():
    """scripts/explore.py and its neighbours, found as when it is run."""
    with scripts(*(f"exploration.{n}" for n in ("designs", "measure", "pareto")), "explore") as modules:
        yield modules


@pytest.fixture
def explore(script, monkeypatch):
    """The command with a measurement that is made up: which designs were asked for, and which fail."""
    asked, failing = [], set()

    def measure(fields, name, pnr):
        asked.append(fields)
        if len(asked) in failing:
            raise RuntimeError("made to fail")
        figures = {"lut4": 100, "ff": 1, "dsp": 0, "bram": 0, "rays": 10, "cycles": 20, "latency": 5}
        return {"design": fields, "p999": 1e-7, "silhouette": 0, **figures} | ({"fmax": 100.0} if pnr else {})

    monkeypatch.setattr(sys.modules["explore"], "measure", measure)
    return SimpleNamespace(main=script.main, asked=asked, failing=failing)


def test_designs(script):
    """Forty at least, each once, with parameters that its module has; every parameter of the trade-off is swept."""
    designs = script.all_designs()
    assert len(set(designs)) == len(designs) >= 40
    for design in designs:
        top, values = design.module
        text = (RTL / f"{top}.sv").read_text()
        assert all(f" {name} =" in text for name in values), f"{design}: {top} has not all of {values}"
        assert design.config.digits == design.n1 * design.steps
    swept = {name: {asdict(d)[name] for d in designs} for name in asdict(designs[0])}
    assert swept["n1"] == {1, 2, 3, 4} and swept["rules"] == {"certified", "paper", "both"}
    assert all(len(swept[name]) > 1 for name in ("family", "steps", "width", "units", "rings", "lanes"))


def test_figures_of_a_result(script):
    """100 MHz, ten rays in twenty clocks, five clocks for one, 2,000 LUT4; 1080 rows have 20.25 times the rays."""
    figures = {"lut4": 2000, "ff": 7, "dsp": 3, "bram": 1, "rays": 10, "cycles": 20, "latency": 5, "fmax": 100.0}
    p = script.point_of("name", {"design": {"family": "quadric"}, "p999": 1e-7, "silhouette": 2, **figures})
    assert (p.family, p.lut4, p.ff, p.dsp, p.bram, p.error, p.silhouette) == ("quadric", 2000, 7, 3, 1, 1e-7, 2)
    assert p.frames == pytest.approx(100e6 / 20 / 20.25)
    assert p.rate == pytest.approx(50) and p.per_klut == pytest.approx(25) and p.latency == pytest.approx(50)


def made(script, name, lut4, rate, latency, error=1e-7, silhouette=0):
    """A placed design with chosen figures."""
    figures = 100.0, rate, rate / 2, 1e3 * rate / lut4, latency, error, silhouette
    return script.Point(name, "quadric", lut4, 0, 0, 0, *figures)


def test_fronts_and_goals(script):
    """Who is beaten in both figures is on no front; a goal is met by the best of those that are right."""
    small, fast, bad = (
        made(script, "small", 10, 5, 90),
        made(script, "fast", 99, 150, 40),
        made(script, "bad", 50, 5, 95),
    )
    wrong = made(script, "wrong", 1, 900, 1, silhouette=1)
    coarse = made(script, "coarse", 2, 900, 2, error=1e-3)
    points = [small, fast, bad]
    assert script.front(points, script.FRONTS["rate"]) == [small, fast]
    assert script.front([*points, wrong], script.FRONTS["rate"]) == [wrong]
    goals = {goal: p and p.name for goal, p in script.recommended([*points, wrong, coarse]).items()}
    assert goals == {
        "least area": "small",
        "1080p60, least area": "fast",
        "lowest latency": "fast",
        "most rays": "fast",
        "most rays for the area": "fast",
    }
    assert script.recommended([small])["1080p60, least area"] is None


def test_two_runs_measure_once(explore, tmp_path, capsys):
    """The second run finds everything that the first one kept, and prints the same."""
    said = []
    for _ in range(2):
        assert explore.main(["quadric", "--limit", "3", "--out", str(tmp_path)]) == 0
        said.append(capsys.readouterr().out)
    assert len(explore.asked) == 3 and said[0] == said[1]
    assert "3 design points, 3 of them placed" in said[0]
    assert len(json.loads((tmp_path / "explore.json").read_text())) == 3
    assert len((tmp_path / "explore.csv").read_text().splitlines()) == 4
    assert (tmp_path / "explore.png").stat().st_size > 10_000


def test_resumes_after_a_failure(explore, tmp_path, capsys):
    """A point that fails: the others are measured and kept, status 2 with its name; the next run measures it alone."""
    explore.failing.add(3)
    arguments = ["quadric", "--limit", "4", "--jobs", "1", "--out", str(tmp_path)]
    assert explore.main(arguments) == 2
    said = capsys.readouterr()
    assert "quadric n1 2 K 12" in said.err and "made to fail" in said.err and "Traceback" not in said.err
    explore.failing.clear()
    failed = explore.asked[2]
    explore.asked.clear()
    assert explore.main(arguments) == 0
    assert explore.asked == [failed]


def test_on_a_cluster(explore, tmp_path, capsys):
    """Through the scheduler of a cluster of two workers the same results come as from threads."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        arguments = ["quadric", "--limit", "4", "--scheduler", cluster.scheduler_address, "--out"]
        assert explore.main([*arguments, str(tmp_path / "cluster")]) == 0
    assert not explore.asked  # the workers have copies of it
    assert explore.main(["quadric", "--limit", "4", "--out", str(tmp_path / "threads")]) == 0
    one, other = ((tmp_path / name / "explore.json").read_text() for name in ("cluster", "threads"))
    assert one == other and len(explore.asked) == 4
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["sphere"], "found 'sphere'; allowed: quadric, quartic, spiral"),
        (["--jobs", "0"], "--jobs: found '0'; allowed: whole numbers, 1 or more"),
        (["--limit", "0"], "--limit: found '0'; allowed: whole numbers, 1 or more"),
        (["--scheduler", "foo"], "--scheduler: found 'foo'; allowed: tcp://HOST:PORT"),
        (["--scheduler", "tcp://host"], "--scheduler: found 'tcp://host'; allowed: tcp://HOST:PORT"),
        (["quadric", "--write"], "allowed: with all of it"),
    ],
)
def test_refuses(explore, tmp_path, capsys, arguments, words):
    """Bad arguments: status 2, what was found and what is allowed; nothing written."""
    out = tmp_path / "out"
    with pytest.raises(SystemExit) as ended:
        explore.main([*arguments, "--out", str(out)])
    assert ended.value.code == 2 and words in capsys.readouterr().err and not out.exists()


def test_no_scheduler(explore, tmp_path, capsys):
    """A cluster that is not there: status 2 and a line, no traceback."""
    arguments = ["quadric", "--limit", "1", "--scheduler", "tcp://127.0.0.1:9", "--out", str(tmp_path)]
    assert explore.main(arguments) == 2
    said = capsys.readouterr().err
    assert "explore: " in said and "127.0.0.1:9" in said and "Traceback" not in said


def test_other_files_are_refused(script):
    """A worker whose files differ says so and measures nothing."""
    with pytest.raises(RuntimeError, match="one checkout"):
        script.measure(script.Design("quadric").as_dict(), "another key", False)


def test_key_has_what_a_result_depends_on(script, monkeypatch, tmp_path):
    """Design, device, versions, content of any file; of the golden model what is imported, not the tools beside it."""
    measure = sys.modules["exploration.measure"]
    design, extra = script.Design("quadric"), tmp_path / "rdx_extra.sv"
    extra.write_text("one")
    real = measure.parts
    monkeypatch.setattr(measure, "parts", lambda top: (real(top)[0] + [extra], real(top)[1]))
    keys = [script.key(design, True), script.key(design, False), script.key(script.Design("quadric", 1, 24), True)]
    extra.write_text("two")
    keys.append(script.key(design, True))
    monkeypatch.setattr(measure.synth, "DEVICE", ["--25k"])
    keys.append(script.key(design, True))
    monkeypatch.setattr(measure.synth, "package", lambda name: "another version")
    keys.append(script.key(design, True))
    assert len(set(keys)) == len(keys)
    names = {path.name for path in script.modules("compile", "golden", "oracle", "rtl", "scene", "shade")}
    assert names >= {"select.py", "halve.py", "normalize.py", "formats.py", "surfaces.py"}
    assert not names & {"cli.py", "trace_ray.py", "stress.py"}


def test_camera_of_one_pixel(script):
    """It looks at a point of the surface: the golden model hits at the depth of the oracle."""
    scene = load_scene(ROOT / "scenes" / "torus.toml", 64, 48)
    design = script.Design("quartic")
    alone = script.one_pixel(scene, ideal_frame(scene).depth)
    hits = trace_golden(compile_scene(alone, design.config), design.config)
    assert hits.surfaces[0].t.shape[:2] == (1, 1) and hits.surfaces[0].t[0, 0, 0] >= 0
    assert np.isfinite(ideal_frame(alone).depth).all()


def test_page_has_what_was_measured(script):
    """The page's tables are those of docs/exploration.json; no engine with all digits has a wrong silhouette pixel."""
    kept = json.loads((ROOT / "docs" / "exploration.json").read_text())
    results = {script.Design(**result["design"]): result for result in kept}
    points = script.placed(results)
    text = (ROOT / "docs" / "exploration.md").read_text()
    families = dict.fromkeys(p.family for p in points)
    for family in families:
        for row in script.rows_of([p for p in points if p.family == family]):
            assert f"| {' | '.join(row)} |" in text
        for row in script.goals_of([p for p in points if p.family == family], family):
            assert f"| {' | '.join(row)} |" in text
    right = [r for d, r in results.items() if d.rules == "certified" and d.n1 * d.steps == 24 and d.width == 36]
    assert len(right) >= 8 and all(r["silhouette"] == 0 for r in right)


@pytest.mark.long
def test_two_workers_measure(tmp_path):
    """Two worker processes with this checkout measure two design points, without place and route."""
    address = tmp_path / "scheduler.json"
    silent = dict(
        env=os.environ | {"PYTHONPATH": str(SCRIPTS)},
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )

    def start(what, *arguments):
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", "--no-dashboard", *arguments]
        return subprocess.Popen(command, **silent)

    started = [start("scheduler", "--port", "0", "--scheduler-file", str(address))]
    try:
        for _ in range(100):
            if address.exists() and address.read_text():
                break
            time.sleep(0.2)
        tcp = json.loads(address.read_text())["address"]
        started += [start("worker", tcp, "--nthreads", "1") for _ in range(2)]
        command = [sys.executable, str(SCRIPTS / "explore.py"), "quadric", "--limit", "2", "--no-pnr"]
        run = subprocess.run([*command, "--scheduler", tcp, "--out", str(tmp_path)], capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        results = json.loads((tmp_path / "explore.json").read_text())
        assert [r["design"]["n1"] for r in results] == [3, 1]
        assert all(r["lut4"] > 1000 and r["cycles"] >= r["steps"] and r["silhouette"] == 0 for r in results)
    finally:
        for process in started:
            process.terminate()
        for process in started:
            process.wait()
