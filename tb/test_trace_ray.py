# SPDX-License-Identifier: Apache-2.0
"""One ray followed: its steps end where the golden model's do, the RTL's are the same, a broken design is localised."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from raydix.compile import compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.scene import load_scene
from raydix.trace_ray import follow, pixel_of
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
SIZE = 64, 48


@pytest.fixture(scope="module")
def script():
    """scripts/trace_ray.py as a module."""
    with scripts("trace_ray") as modules:
        yield modules


def frame_of(name, **choices):
    """A small frame of a scene: compiled, configuration, hits of the golden model."""
    scene = load_scene(SCENES / f"{name}.toml", *SIZE)
    config = Config(**dict(units=1) | families(scene) | choices)
    compiled = compile_scene(scene, config)
    return compiled, config, trace_golden(compiled, config)


@pytest.mark.parametrize(
    "name, choices",
    [
        ("torus", {}),
        ("torus", dict(n1=2, steps=12, rule="paper")),
        ("hyperboloid", dict(k_stop=5)),
        ("glass", {}),
        ("spiral", {}),
        ("shell", dict(n1=1, steps=24)),
    ],
)
def test_every_kind_of_ray(name, choices):
    """Rays that hit and that miss: as many steps, the same digits, no digit that is not a candidate, all roots."""
    compiled, config, frame = frame_of(name, **choices)
    for hits in frame.surfaces:
        x0, y0, *_ = hits.surface.rect
        steps = hits.steps.astype(int)
        chosen = [np.argwhere(hits.t[..., 0] >= 0)[::97], np.argwhere(hits.t[..., 0] < 0)[::211]]
        chosen.append(np.argwhere(steps == steps.max())[:1])
        assert len(chosen[0]) and len(chosen[1])
        for row, column in np.concatenate(chosen).tolist():
            found = follow(hits.surface, config, x0 + column, y0 + row)
            assert [s.number for s in found] == list(range(1, int(steps[row, column]) + 1))
            assert [s.t for s in found if s.status == "hit"] == [int(t) for t in hits.t[row, column] if t >= 0]
            for s in found:
                assert s.pick < 0 or s.candidates >> s.pick & 1 and not s.candidates & ((1 << s.pick) - 1)
                assert not s.excluded & s.candidates


@pytest.mark.parametrize("name", ["torus", "sphere", "spiral"])
def test_one_pixel_is_the_same_ray(name):
    """A rectangle of one pixel gives that pixel's hit in every bit; a pixel outside of the rectangle is refused."""
    compiled, config, frame = frame_of(name)
    hits = frame.surfaces[0]
    x0, y0, x1, y1 = hits.surface.rect
    row, column = (int(v) for v in np.argwhere(hits.t[..., 0] >= 0)[50])
    alone = compiled._replace(surfaces=(pixel_of(hits.surface, x0 + column, y0 + row),))
    one = trace_golden(alone, config).surfaces[0]
    for field in ("t", "depth", "point", "steps"):
        assert np.array_equal(getattr(one, field)[0, 0], getattr(hits, field)[row, column]), field
    with pytest.raises(ValueError, match=f"allowed: {x0},{y0} to {x1},{y1}"):
        pixel_of(hits.surface, x1 + 1, y0)


def test_command_without_rtl(script, tmp_path, capsys):
    """A table with a row for each step, and a picture."""
    arguments = [str(SCENES / "torus.toml"), "--size", "64x48", "--pixel", "38,18", "--no-rtl", "--out", str(tmp_path)]
    assert script.main(arguments) == 0
    said = capsys.readouterr().out
    assert "torus, pixel 38,18, surface 0 (torus), certified rule" in said
    assert sum("run" in line for line in said.splitlines()) == 7 and said.count("hit") == 1
    assert (tmp_path / "torus-38-18-surface0.png").stat().st_size > 20_000


@pytest.mark.long
@pytest.mark.parametrize("name, pixel", [("torus", "38,18"), ("spiral", "34,20"), ("glass", "30,24")])
def test_rtl_takes_the_same_steps(script, tmp_path, capsys, name, pixel):
    """Every step of the RTL's unit is the golden model's."""
    arguments = [str(SCENES / f"{name}.toml"), "--size", "64x48", "--pixel", pixel, "--out", str(tmp_path)]
    assert script.main(arguments) == 0
    said = capsys.readouterr().out
    assert "same" in said and "differ" not in said


@pytest.mark.long
def test_localises_a_broken_design(tmp_path):
    """An average that rounds down in place of up: the command names the first step and control point that differ."""
    for part in ("model", "rtl", "scenes", "scripts", "tb/frame"):
        shutil.copytree(ROOT / part, tmp_path / part, ignore=shutil.ignore_patterns("__pycache__"))
    for path in (ROOT / "tb").glob("*.vlt"):
        shutil.copy(path, tmp_path / "tb")
    halve = tmp_path / "rtl" / "rdx_halve.sv"
    text = halve.read_text()
    up = "+ (W + 1)'(1)) >>> 1"
    assert up in text, "the average has another form: mend this test"
    halve.write_text(text.replace(up, ") >>> 1"))
    run = subprocess.run(
        [sys.executable, "scripts/trace_ray.py", "scenes/torus.toml", "--size", "64x48", "--pixel", "38,18"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(tmp_path / "model")},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1, run.stdout + run.stderr
    assert "RTL and golden model differ: step 1, b[" in run.stdout


@pytest.mark.parametrize(
    "name, arguments, words",
    [
        ("torus", ["--pixel", "64,0"], "allowed: 0,0 to 63,47"),
        ("spiral", ["--pixel", "0,0"], "another pixel"),
        ("torus", ["--pixel", "38,18", "--surface", "3"], "surfaces there: 0"),
        ("torus", ["--pixel", "38,18", "--n1", "5"], "n1: found 5; allowed: 1 to 4"),
    ],
)
def test_refuses(script, tmp_path, capsys, name, arguments, words):
    """A pixel or a parameter that cannot be: status 2, what was found and what is allowed, no traceback."""
    out = ["--size", "64x48", "--no-rtl", "--out", str(tmp_path)]
    assert script.main([str(SCENES / f"{name}.toml"), *arguments, *out]) == 2
    said = capsys.readouterr().err
    assert words in said and "Traceback" not in said


def test_no_pixel(script, capsys):
    """Something else than a pixel: status 2."""
    with pytest.raises(SystemExit) as ended:
        script.main([str(SCENES / "torus.toml"), "--pixel", "middle"])
    assert ended.value.code == 2 and "allowed: X,Y" in capsys.readouterr().err
