# SPDX-License-Identifier: Apache-2.0
"""Waveforms for the eye: groups, real numbers, files of viewers, a picture."""

import importlib
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from vcd.reader import TokenKind, tokenize

import bench
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
        assert number("segment_i.ends.stop[1]", 32) == number("segment_i.ends.start[1]", 32) == (True, COORD_FRAC)
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
        "thing-fixed.vcd",
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


class Surfer:
    """What Surfer makes of a command file, by its sources (0.4, 0.5): the items, each with its format.

    A line is a word and what is left (fzcmd.rs); "#" and ";" end a command (batch_commands.rs). An item is focused by
    its place, in digits from a to p (util.rs), and a new one comes behind the focused one (wave_data.rs).
    """

    FORMATS = {"Signed fixed point": True, "Unsigned fixed point": False}  # translation/numeric_translators.rs

    def __init__(self, wave, commands):
        self.variables = {}  # name and index -> signal, as Surfer's own reader has them
        pywellen = pytest.importorskip("pywellen", reason="pywellen, Surfer's reader, has no wheel here")
        for variable in pywellen.Waveform(str(wave)).all_vars():
            self.variables.setdefault(variable.full_name, variable)
        self.items, self.focus = [], None
        for command in (part for line in commands.splitlines() for part in line.split("#")[0].split(";") if part):
            word, rest = re.fullmatch(r"(\w+) ?(.*)", command).groups()
            getattr(self, word)(rest)

    def divider_add(self, name):
        """Its name is a single word."""
        assert re.fullmatch(r"\w+", name) and self.focus is None, name
        self.items.append([name, None])

    def variable_add(self, path):
        """A trailing index in brackets is none of the name, unless it is all of it (wave_container.rs)."""
        assert re.sub(r"(?<=[^.])\[\d+\]$", "", path) in self.variables and self.focus is None, path
        self.items.append([path, None])

    def item_focus(self, item):
        """What follows the place and a line is for the eye; it names the item here."""
        digits, _, name = item.partition("_")
        self.focus = int(digits.translate(str.maketrans("abcdefghijklmnop", "0123456789abcdef")), 16)
        assert self.items[self.focus][0].replace(".[", "[").endswith(f".{name}"), item

    def item_set_format(self, form):
        """A name of the list, of the focused item."""
        self.items[self.focus][1] = self.FORMATS[form]

    def item_unfocus(self, rest):
        """Without a parameter."""
        assert not rest
        self.focus = None

    def zoom_fit(self, rest):
        """Without a parameter."""
        assert not rest


def test_surfer(wave):
    """Surfer finds every signal of the command file; fixed-point numbers have their format, other signals none."""
    assert command("--file", wave).returncode == 0
    opened = Surfer(wave.with_name("thing-fixed.vcd"), wave.with_suffix(".sucl").read_text())
    assert opened.items == [
        ["clock", None], ["rdx_thing.clk_i", None], ["rdx_thing.rst_ni", None],
        ["inputs", None], ["rdx_thing.item_i.t", False], ["rdx_thing.item_i.level", None],
        ["rdx_thing.point_i.[1]", True], ["rdx_thing.valid_i", None],
        ["outputs", None], ["rdx_thing.b_o.[0]", True],
        ["stage_1", None], ["rdx_thing.depth_q", True], ["stage_2", None], ["rdx_thing.sum_qq", None],
        ["between_registers", None], ["rdx_thing.sum", None],
        ["u_part", None], ["rdx_thing.u_part.ready_o", None], ["rdx_thing.u_part.valid_i[2]", None],
    ]  # fmt: skip
    with scripts("viewing.viewers") as viewers:
        assert [viewers.surfer_index(place) for place in (0, 9, 15, 16, 0x1AF)] == ["a", "j", "p", "ba", "bkp"]


def test_surfer_point(wave):
    """Surfer reads a fixed-point number by the least index of its range; all else is the waveform as it was."""
    assert command("--file", wave).returncode == 0
    fixed = wave.with_name("thing-fixed.vcd")
    with fixed.open("rb") as file:
        declared = [token.var for token in tokenize(file) if token.kind is TokenKind.VAR]
    with scripts("viewing.formats") as formats:
        for var in declared:
            number = formats.number_of(var.reference, var.size)
            if isinstance(var.bit_index, tuple):
                least = -number.fraction if number else 0
                assert var.bit_index == (least + var.size - 1, least), var
            else:
                assert number is None, var
    ranges = {var.reference: var.bit_index for var in declared}
    assert ranges["t"] == (-1, -24) and ranges["point_i[1]"] == (31 - COORD_FRAC, -COORD_FRAC)
    assert ranges["level"] == (4, 0)
    zero = [re.sub(r"\[-?\d+:-?\d+\]", "[]", path.read_text()) for path in (wave, fixed)]
    assert zero[0] == zero[1]


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


def test_long_title(wave):
    """The title of a test with many parameters stands in lines that fit: nothing of it reaches the picture's edges."""
    with scripts("viewing.signals", "viewing.picture") as waves:
        groups, out = waves.groups_of(waves.read_signals(wave)), wave.with_suffix(".png")
        waves.draw(wave, groups, 0, 30, 10, "test_top-rdx_top" + "-Parameter=16" * 16 + ", clocks 2 to 32", out)
    top = read_image(out)[:60, :, :3].min(axis=2)
    assert top.min() < 100 and (top[:, [*range(8), *range(-8, 0)]] == 255).all()


def test_rows_of_a_picture():
    """Of too many ports those that stand still are left out first, then inputs; the order stays that of the ports."""
    with scripts("viewing.signals", "viewing.picture") as waves:
        ports = [waves.Signal((), f"port_{i}", 1, str(i), False, 0) for i in range(waves.ROWS + 5)]
        outputs = {port.code for port in ports[-4:]}
        known = {port.code: [(0, 0), (3, 1), *([(20, 0)] if i >= 3 else [])] for i, port in enumerate(ports)}
        chosen = waves.important(ports, outputs, known, 10)
        assert chosen == ports[3:-6] + ports[-4:]  # what changed before the start stands still
        assert waves.important(ports[:9], outputs, known, 10) == ports[:9]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nothing"], "T: found 'nothing'; allowed: accuracy, advance"),
        (["settle[N1=9"], "T: found 'settle[N1=9'; allowed of this module: test_settle[N1=3-K=8-W=36-D=4]"),
        (["settle", "--check", "nothing"], "CHECK: found 'nothing'; allowed: first, all, or a part of equals_model"),
        (["../../x"], "T: found '../../x'; allowed: accuracy, advance"),
        (["--file", "up.vcd"], "up.vcd: found no waveform"),
        (["--file", "still.vcd", "--start", "-5"], "--start: found '-5'; allowed: whole numbers, 0 or more"),
        (["--file", "missing.vcd"], "missing.vcd: No such file or directory"),
        (["--file", "bad.vcd"], "bad.vcd: found no waveform"),
        (["--file", "still.vcd"], "still.vcd: found a clock that does not run"),
        (["--file", "none.vcd"], "none.vcd: found no clk_i"),
        ([], "found both or none of TEST and --file"),
        (["--file", "still.vcd", "--clocks", "0"], "--clocks: found '0'; allowed: whole numbers, 1 or more"),
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


@pytest.mark.parametrize(
    "checks, text, found",
    [
        (None, "", None),
        (None, "all", None),
        (None, "first", ["equals_model"]),
        (None, "bound", ["within_bound"]),
        (["within_bound", "other"], "first", ["within_bound"]),
    ],
)
def test_chosen_check(checks, text, found):
    """CHECK: all checks of a file, the first of those that are meant, or the first with a part of its name."""
    importlib.import_module("test_settle")
    assert bench.chosen("test_settle", checks, text) == found


def test_of_a_test():
    """The first test of a module, and of its checks the first: its signals are in the files, the picture is there."""
    done = command("settle", "--seed", "3")
    assert done.returncode == 0, done.stderr
    wave = next(Path(line) for line in done.stdout.splitlines() if line.endswith(".vcd"))
    assert wave.stem.endswith("-equals_model")
    with scripts("viewing.signals") as signals:
        paths = {s.path for s in signals.read_signals(wave)}
    saved = re.findall(r"^\+\{.*?\} (\S+)$", wave.with_suffix(".gtkw").read_text(), re.M)
    named = {re.sub(r"\[\d+:0\]$", "", name) for name in saved}
    assert len(named) > 40 and named <= paths
    opened = Surfer(wave.with_name(f"{wave.stem}-fixed.vcd"), wave.with_suffix(".sucl").read_text())
    assert {name.replace(".[", "[") for name, _ in opened.items if "." in name} == named
    assert 20 < sum(form is not None for _, form in opened.items) < len(named)
    assert np.ptp(read_image(wave.with_suffix(".png"))) == 255
