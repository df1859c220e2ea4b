# SPDX-License-Identifier: Apache-2.0
"""One ray followed: its steps end where the golden model's do, the RTL's are the same, a broken design is localised."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from raydix import cli
from raydix.command import status_of
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.localise import Followed, colour_difference, difference, hit_difference
from raydix.options import config_of, scene_of
from raydix.scene import load_scene
from raydix.trace_ray import Step, alone, follow, pixel_of
from raydix.waves import Output, step_outputs
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
SIZE = 64, 48
FILE = "found a file; allowed: a folder, or a name that is not taken"


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
    one = trace_golden(alone(compiled, hits.surface, x0 + column, y0 + row), config).surfaces[0]
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


def test_first_difference():
    """A control point that enters a step comes before what leaves it; a step's wrong number is told last."""
    step = Step(1, 0, 0, [5, 6], [], 0, 1, 0, 8, -1, "run", [1, 2], 3)
    right = Output(1, [5, 6], 8, -1, "run", [1, 2], 3)
    for change, said in (
        ({}, ""),
        ({"control": []}, ""),  # not seen
        ({"control": [5, 7], "t": 9}, "b[1] before it: golden 6, RTL 7"),
        ({"t": 9, "after": [0, 2]}, "t: golden 8, RTL 9"),
        ({"after": [0, 2]}, "b[0]: golden 1, RTL 0"),
        ({"number": 2}, "steps: golden 1, RTL 2"),
    ):
        assert difference(step, replace(right, **change)) == said
    assert Followed([step, step], ["", "a"], "").first == "step 1, a"
    assert Followed([step], [""], "red: golden 1, RTL 2").first == "behind the steps, red: golden 1, RTL 2"
    assert Followed([step], [""], "").first == ""


def test_difference_behind_the_steps():
    """The first field of a hit, the first channel of a colour."""
    compiled, config, _ = frame_of("torus")
    one = alone(compiled, compiled.surfaces[0], 38, 18)
    golden, rtl = trace_golden(one, config), trace_golden(one, config)
    assert hit_difference(golden, rtl) == ""
    rtl.surfaces[0].point[0, 0, 0, 2] ^= 1
    assert hit_difference(golden, rtl).startswith("point of hit 1: golden [")
    colours = np.array([[[[9, 8, 7]]], [[[9, 6, 5]]]], np.uint8)
    assert colour_difference(*colours) == "green: golden 8, RTL 6" and colour_difference(*colours[[0, 0]]) == ""


STEPS = """$timescale 1ps $end $scope module u_ring $end {units} $upscope $end $enddefinitions $end
#0\nb1 s0\nb0 n0\nb0 t0\n0p0\nb11 b0\nb0 d0
#1\nb1 s1\nb1 n1\nb1 t1\n0p1\nb10 b1\nb0 d1\n#2\nb11 s2\nb10 n2\nb11 t2\n0p2\nb1 b2\nb0 d2\n#3\n"""


def test_output_of_a_unit_is_input_of_the_next(tmp_path):
    """They have one code in a waveform; both steps are found, each with what enters it."""
    fields = ("control_{}.status 3 s", "control_{}.steps 20 n", "control_{}.t 24 t", "control_{}.pending 1 p",
              "segment_{}.b[0] 8 b", "segment_{}.ends.depth_start 8 d")  # fmt: skip
    units = ""
    for unit in range(2):
        ports = [f.format(side).split() + [str(unit + at)] for at, side in enumerate("io") for f in fields]
        variables = " ".join(
            f"$var wire {width} {code}{at} {name} [{int(width) - 1}:0] $end" for name, width, code, at in ports
        )
        units += (
            f"$scope module gen_unit[{unit}] $end $scope module u_step $end {variables} $upscope $end $upscope $end "
        )
    (wave := tmp_path / "w.vcd").write_text(STEPS.format(units=units))
    assert step_outputs(wave) == [Output(1, [3], 1, -1, "run", [2], 0), Output(2, [2], 3, -1, "hit", [1], 0)]


@pytest.fixture
def broken(tmp_path):
    """Breaks a copy of the design and gives its folder: ``broken(file, old, new)``."""
    root = tmp_path / "broken"
    for part in ("model", "rtl", "scenes", "scripts", "tb/frame"):
        shutil.copytree(ROOT / part, root / part, ignore=shutil.ignore_patterns("__pycache__"))
    for path in (ROOT / "tb").glob("*.vlt"):
        shutil.copy(path, root / "tb")

    def at(name, old, new):
        text = (root / "rtl" / name).read_text()
        assert text.count(old) == 1, f"{name} has another form: mend this test"
        (root / "rtl" / name).write_text(text.replace(old, new))
        return root

    return at


def run(command, root):
    """A command in a copy of the design; one that is a text by the shell."""
    environment = os.environ | {"PYTHONPATH": str(root / "model")}
    shell = isinstance(command, str)
    return subprocess.run(command, shell=shell, cwd=root, env=environment, capture_output=True, text=True)


@pytest.mark.long
def test_localises_a_broken_design(broken):
    """An average that rounds down in place of up: the command names the first step and control point that differ."""
    root = broken("rdx_halve.sv", "+ (W + 1)'(1)) >>> 1", ") >>> 1")
    command = [sys.executable, "scripts/trace_ray.py", "scenes/torus.toml", "--size", "64x48", "--pixel", "38,18"]
    done = run(command, root)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "RTL and golden model differ: step 1, b[" in done.stdout


@pytest.mark.long
def test_replays_what_verify_has_found(broken):
    """The second step unit of a narrow ring is wrong, where there is one: the command that verify prints finds that."""
    wrong = "segment_t'((u == 1 && W == 30) ? segment[u] ^ (segment_t'(1) << 25) : segment[u])"
    root = broken("rdx_ring.sv", ".segment_i(segment[u])", f".segment_i({wrong})")
    scene = root / "scenes" / "the sphere's.toml"
    shutil.copy(root / "scenes" / "sphere.toml", scene)
    options = ["--size", "24x18", "--width", "30", "--units", "2", "--rule", "paper", "--n1", "2", "--steps", "6"]
    command = [sys.executable, "-m", "raydix.cli", "verify", scene, *options, "--k-stop", "4", "--out", root / "out"]
    done = run(command, root)
    assert done.returncode == 1, done.stdout + done.stderr
    (line,) = [line for line in done.stdout.splitlines() if "step by step: " in line]
    printed = line.split("step by step: ")[1]
    assert "--k-stop 4" in printed
    where = re.search(
        r"RTL and golden model differ: surface 0, (step 2, .*: golden \S+, RTL \S+); waveform: (.*)\n", done.stdout
    )
    assert where and Path(where[2]).exists()
    for left_out, status in (("--none", 1), ("--width 30", 0)):
        done = run(printed.replace(left_out, ""), root)
        assert done.returncode == status, done.stdout + done.stderr
        assert (f"RTL and golden model differ: {where[1]}\n" in done.stdout) == bool(status)


@pytest.mark.parametrize(
    "name, options",
    [
        ("torus", ""),
        ("torus", "--size 64x48 --n1 2 --steps 10 --k-stop 7 --width 30 --units 5 --rings 3 --rule paper --beat 4"),
        ("spiral", "--n1 2 --lanes 2 --vector-units 3 --vector-rings 2 --threads 1"),
    ],
)
def test_verify_names_the_same_design(script, name, options):
    """The command that verify prints is read as the same scene, size, configuration, pixel and surface."""
    path = SCENES / f"{name}.toml"
    args = cli._parser().parse_args(["verify", str(path), *options.split()])
    scene = scene_of(args, path)
    config = cli._config(args, scene)
    said = cli._replay(SimpleNamespace(first_ray=lambda: (31, 17, 2)), config, scene, args)
    again = script.parse(shlex.split(said.split("step by step: ")[1])[2:])
    assert (again.scene, again.pixel, again.surface, again.size) == (path, (31, 17), 2, args.size)
    assert config_of(again, scene_of(again, path)) == config


@pytest.mark.parametrize(
    "name, arguments, words",
    [
        ("torus", ["--pixel", "64,0"], "allowed: 0,0 to 63,47"),
        ("spiral", ["--pixel", "0,0"], "another pixel"),
        (
            "torus",
            ["--pixel", "38,18", "--surface", "3"],
            "--surface: found 3, which cannot be at 38,18; allowed there: 0",
        ),
        ("torus", ["--pixel", "38,18", "--n1", "5"], "n1: found 5; allowed: 1 to 4"),
        ("torus", ["--pixel", "38,18", "--steps", "0"], "steps: found 0; allowed: 1 to 10"),
        ("torus", ["--pixel", "38,18", "--k-stop", "9"], "k_stop: found 9; allowed: 1 to 8"),
    ],
)
def test_refuses(script, tmp_path, capsys, name, arguments, words):
    """A pixel or a parameter that cannot be: status 2, what was found and what is allowed; nothing is written."""
    out = tmp_path / "out"
    command = [str(SCENES / f"{name}.toml"), *arguments, "--size", "64x48", "--no-rtl", "--out", str(out)]
    assert status_of(lambda: script.main(command), "trace_ray") == 2
    said = capsys.readouterr().err
    assert said.startswith("trace_ray: ") and words in said and said.count("\n") == 1 and not out.exists()


def test_folder(script, tmp_path, capsys):
    """The folder is made; a file in its place is refused."""
    command = [str(SCENES / "torus.toml"), "--size", "64x48", "--pixel", "38,18", "--no-rtl", "--out"]
    assert script.main([*command, str(tmp_path / "new" / "folder")]) == 0
    assert [p.name for p in (tmp_path / "new" / "folder").iterdir()] == ["torus-38-18-surface0.png"]
    (tmp_path / "file").write_text("")
    assert status_of(lambda: script.main([*command, str(tmp_path / "file" / "folder")]), "trace_ray") == 2
    assert capsys.readouterr().err == f"trace_ray: {tmp_path}/file: {FILE}\n"


def test_picture_is_whole_or_not_there(script, tmp_path, monkeypatch, capsys):
    """Interrupted while it is drawn, the picture that was there stays, and nothing is beside it."""
    picture = tmp_path / "torus-38-18-surface0.png"
    picture.write_text("old")

    def half(*arguments):
        arguments[-1].write_text("half")
        raise KeyboardInterrupt

    monkeypatch.setattr(sys.modules["trace_ray"], "plot_ray", half)
    command = [str(SCENES / "torus.toml"), "--size", "64x48", "--pixel", "38,18", "--no-rtl", "--out", str(tmp_path)]
    assert status_of(lambda: script.main(command), "trace_ray") == 130
    assert picture.read_text() == "old" and list(tmp_path.iterdir()) == [picture]


def test_no_pixel(script, capsys):
    """Something else than a pixel: status 2."""
    with pytest.raises(SystemExit) as ended:
        script.main([str(SCENES / "torus.toml"), "--pixel", "middle"])
    assert ended.value.code == 2 and "allowed: X,Y" in capsys.readouterr().err
