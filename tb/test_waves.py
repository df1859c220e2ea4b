# SPDX-License-Identifier: Apache-2.0
"""Waveforms for the eye: groups, real numbers, files of viewers, a picture."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from raydix.formats import COORD_FRAC, VECTOR_FRAC, VECTOR_WIDTH
from raydix.image import read_image
from scripting import SCRIPTS, scripts

HEAD = """$timescale 1 ps $end
$scope module $rootio $end $var wire 1 a clk_i $end $upscope $end
$scope module rdx_pkg $end $var wire 32 p CoordFrac $end $upscope $end
$scope module rdx_thing $end
$var wire 1 a clk_i $end $var wire 1 r rst_ni $end $var wire 1 v valid_i $end $var wire 32 W W $end
$scope module item_i $end $var wire 24 t t [23:0] $end $var wire 5 l level [4:0] $end $upscope $end
$var wire 32 c point_i[1] [31:0] $end $var wire 32 d depth_q [31:0] $end
$var wire 8 e sum $end $var wire 8 g sum_qq $end
$var wire 36 o b_o[0] [35:0] $end
$scope module u_part $end $var wire 1 x ready_o $end $var wire 4 y hidden_q $end
$var wire 1 z valid_i[2] $end $upscope $end
$upscope $end
$enddefinitions $end
"""
BODY = """#0\n0a\n0r\n0v\nb0 t\nb0 c\n#5\n1a\n#10\n0a\n1r\n#15\n1a\n1v
b110000000000000000000000 t\nb11100000000000000000000000000000 c\nb1 d
#20\n0a\n#25\n1a\nb11 l\n#30\n0a\nbx e\n#35\n1a\n"""


@pytest.fixture
def wave(tmp_path):
    """A small waveform with a struct, an array, a package, parameters and a module within."""
    path = tmp_path / "thing.vcd"
    path.write_text(HEAD + BODY)
    return path


def command(*arguments):
    """The program's result."""
    return subprocess.run([sys.executable, SCRIPTS / "waves.py", *map(str, arguments)], capture_output=True, text=True)


def test_numbers():
    """Formats by name and width; what is no fixed-point number has none."""
    with scripts("viewing.formats") as formats:
        number = formats.number_of
        assert number("point_i[2]", 32) == (True, COORD_FRAC) and number("control.point", 32) == (True, COORD_FRAC)
        assert number("control_i.t_next", 24) == (False, 24) and number("depth_start", 32) == (True, 31)
        assert number("b_qq[0]", 36) == (True, 34) and number("clearance", VECTOR_WIDTH) == (True, VECTOR_FRAC)
        none = ("steps", 20), ("valid_i", 1), ("t", 1), ("x", 12)
        assert [number(*signal) for signal in none] == [None] * 4
        assert number("b", 36).value((1 << 36) - (1 << 33), 36) == -0.5
        assert number("t", 24).value(3 << 22, 24) == 0.75


def test_groups(wave):
    """Clock, inputs, outputs, stages in order, then the module within by its ports; no parameters, no package."""
    with scripts("viewing.signals") as signals:
        groups = signals.groups_of(signals.read_signals(wave))
        assert {g.name: [s.short for s in g.signals] for g in groups} == {
            "clock": ["clk_i", "rst_ni"],
            "inputs": ["item_i.t", "item_i.level", "point_i[1]", "valid_i"],
            "outputs": ["b_o[0]"],
            "stage 1": ["depth_q"],
            "stage 2": ["sum_qq"],
            "between registers": ["sum"],
            "u_part": ["ready_o", "valid_i[2]"],
        }
        assert groups[0].signals[0].path == "rdx_thing.clk_i"


def test_files(wave):
    """Each viewer's file names the signals as the waveform has them; numbers are shifted as their formats say."""
    done = command("--file", wave, "--clocks", "3")
    assert done.returncode == 0, done.stderr
    assert [line.split(":")[0] for line in done.stdout.splitlines()[1:]] == [
        "thing.gtkw",
        "thing.sucl",
        "thing-reals.vcd",
        "thing.png",
    ]
    save = wave.with_suffix(".gtkw").read_text()
    assert "[fpshift_count] 24\n@40000024\n+{item_i/t} rdx_thing.item_i.t[23:0]\n" in save  # decimal, right, shifted
    assert "[fpshift_count] 30\n@40000420\n+{point_i[1]} rdx_thing.point_i[1][31:0]\n" in save  # signed, too
    assert re.findall("^-(.*)", save, re.M)[::2] == [
        "clock",
        "inputs",
        "outputs",
        "stage 1",
        "stage 2",
        "between registers",
        "u_part",
    ]
    commands = wave.with_suffix(".sucl").read_text().splitlines()
    assert commands[0] == f"load_file {wave}" and "variable_add rdx_thing.item_i.t" in commands
    assert commands.index("divider_add inputs") < commands.index("variable_add rdx_thing.valid_i")


def test_reals(wave):
    """The second waveform has the values as real numbers, at the same times, up to the end of the window."""
    assert command("--file", wave, "--clocks", "2").returncode == 0
    with scripts("viewing.signals") as signals:
        reals = wave.with_name("thing-reals.vcd")
        by_name = {s.name: s for s in signals.read_signals(reals)}
        text = reals.read_text()
        assert re.search(rf"#15\n(.*\n)*?r0.75 {re.escape(by_name['item_i.t'].code)}\n", text)
        assert f"r-0.5 {by_name['point_i[1]'].code}\n" in text
        assert re.findall(r"^#(\d+)$", text, re.M)[-2:] == ["15", "20"]  # two clocks from 0 on


def test_picture(wave):
    """A row for each port: the first valid's level is drawn from clock 1.5 of 3.5 on."""
    assert command("--file", wave, "--clocks", "3").returncode == 0
    picture = read_image(wave.with_suffix(".png"))
    shaded = (abs(picture[..., :3].astype(int) - [219, 230, 246]).max(axis=2) < 3).sum()
    assert picture.shape[1] > 1000 and 20_000 < shaded < picture[..., 0].size / 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nothing"], "T: found 'nothing'; allowed: accuracy, advance"),
        (["settle[N1=9"], "T: found 'settle[N1=9'; allowed of this module: test_settle[N1=3-K=8-W=36-D=4]"),
        (["../../x"], "T: found '../../x'; allowed: accuracy, advance"),
        (["--file", "up.vcd"], "up.vcd: found no waveform"),
        (["--file", "still.vcd", "--start", "-5"], "--start: found -5"),
        (["--file", "missing.vcd"], "missing.vcd: No such file or directory"),
        (["--file", "bad.vcd"], "bad.vcd: found no waveform"),
        (["--file", "still.vcd"], "still.vcd: found a clock that does not run"),
        (["--file", "none.vcd"], "none.vcd: found no clk_i"),
        ([], "found both or none of TEST and --file"),
        (["--file", "still.vcd", "--clocks", "0"], "--clocks: found 0"),
    ],
)
def test_bad_input(tmp_path, monkeypatch, arguments, said):
    """One line that names what was found; exit status 2, no traceback, and no file."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.vcd").write_text("this is no waveform")
    (tmp_path / "up.vcd").write_text("$upscope $end\n" + HEAD)
    (tmp_path / "still.vcd").write_text(HEAD + "#0\n0a\n")
    (tmp_path / "none.vcd").write_text(HEAD.replace("clk_i", "clock"))
    before = sorted(tmp_path.iterdir())
    done = command(*arguments)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
    assert sorted(tmp_path.iterdir()) == before


def test_of_a_test():
    """The first test of a module: its signals are in the files, and the picture is there."""
    done = command("settle", "--seed", "3")
    assert done.returncode == 0, done.stderr
    wave = next(Path(line) for line in done.stdout.splitlines() if line.endswith(".vcd"))
    with scripts("viewing.signals") as signals:
        paths = {s.path for s in signals.read_signals(wave)}
    named = re.findall(r"^variable_add (.*)", wave.with_suffix(".sucl").read_text(), re.M)
    assert len(named) > 40 and set(named) <= paths
    saved = re.findall(r"^\+\{.*?\} (\S+)$", wave.with_suffix(".gtkw").read_text(), re.M)
    assert {re.sub(r"\[\d+:0\]$", "", name) for name in saved} == set(named)
    assert np.ptp(read_image(wave.with_suffix(".png"))) == 255
