# SPDX-License-Identifier: Apache-2.0
"""Bars: rate and remaining time where stderr is a terminal, not a sign of them where it is none."""

import contextlib
import os
import pty
import re
import subprocess
import sys
from types import SimpleNamespace

import pytest

import second
from raydix.progress import RateColumn, track
from scripting import SCRIPTS

ROOT = SCRIPTS.parent

SLOW = """import time
from raydix.progress import track
print(sum(time.sleep(0.2) or i for i in track(range(12), "items")))"""


def on_a_terminal(*command):
    """Exit status of a command, its stdout, and its stderr, a pseudo-terminal, without colours."""
    leader, follower = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    process = subprocess.Popen(
        list(map(str, command)), stderr=follower, stdout=subprocess.PIPE, text=True, env=environment, cwd=ROOT
    )
    os.close(follower)
    shown = b""
    with contextlib.suppress(OSError):  # the other end is closed
        while part := os.read(leader, 4096):
            shown += part
    os.close(leader)
    said = process.communicate()[0]
    return process.returncode, said, re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", shown.decode())


@pytest.mark.parametrize(("speed", "text"), [(None, ""), (0.25, "4 s each"), (2.34, "2.3/s"), (12345.6, "12,346/s")])
def test_rate(speed, text):
    """Steps a second, or seconds a step."""
    assert str(RateColumn().render(SimpleNamespace(speed=speed, finished_speed=None))) == text


def test_nothing_is_lost():
    """The items in their order, of a generator too."""
    assert list(track((i * i for i in range(5)), "squares", 5)) == [0, 1, 4, 9, 16]


def test_on_a_terminal():
    """A pseudo-terminal gets the label, how much of how many, a rate and the time that is left; stdout is untouched."""
    status, said, text = on_a_terminal(sys.executable, "-c", SLOW)
    assert (status, said) == (0, "66\n")
    assert re.search(r"items .*\d+/12 +[45]\.\d/s +0:00:0\d", text), text


def test_without_a_terminal():
    """Nothing on stderr where nobody looks."""
    done = subprocess.run([sys.executable, "-c", SLOW], capture_output=True, text=True)
    assert done.stdout == "66\n" and done.stderr == ""


WORK = """import time
from raydix.progress import track, working
with working("thinking", "tool"):
    time.sleep(1.4)
for _ in track(range(2), "items"):
    with working("within"):
        time.sleep(0.4)
print("done")"""


def test_length_unknown():
    """The time since the start, alone and below a bar; a line without a terminal, where a program is named."""
    status, said, shown = on_a_terminal(sys.executable, "-c", WORK)
    assert (status, said) == (0, "done\n")
    assert re.search(r"thinking … .*0:00:01", shown) and "tool:" not in shown
    assert re.search(r"items .*1/2 .*\n.*within … .*0:00:00", shown)
    done = subprocess.run([sys.executable, "-c", WORK], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("done\n", "tool: thinking …\n")


COMPILE = """import sys
from numba import njit
from raydix.command import status_of
@njit
def deep(x):
    return x * 3
@njit
def wide(x):
    return deep(x) + 1
def main():
    print(wide(4), wide(5))
    return 0
sys.exit(status_of(main))"""


def test_compilation_is_told():
    """The outermost kernel that numba compiles, once; nothing where stderr is no terminal."""
    status, said, shown = on_a_terminal(sys.executable, "-c", COMPILE)
    assert (status, said) == (0, "13 16\n")
    assert "numba compiles wide, once … " in shown and "deep" not in shown
    done = subprocess.run([sys.executable, "-c", COMPILE], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("13 16\n", "")


@pytest.mark.parametrize(
    ("command", "wanted"),
    [
        (["figures.py", "--out", "{out}"], [r"figures .* 0/2", r"figures .* 1/2"]),
        (["report.py", "--render", "{out}", "--results", "{out}", "--out", "{out}/a.html"], [r"chapters .* \d/8"]),
        (["waves.py", "delay"], [r"looking for the tests of delay … ", r"test .* 0:00:0", r"drawing \S+\.vcd … "]),
        (["second.py", "register", "--seed", "1"], [r"looking for the tests … ", r"tests .* [1-9]/\d+ "]),
        (["cover.py", "delay"], [r"tests .* [1-9]/\d+ ", r"results of modules .* 0/1"]),
    ],
    ids=lambda value: value[0] if value[0].endswith(".py") else "",
)
def test_scripts(tmp_path, command, wanted):
    """What takes seconds shows what it does, how far it is, or for how long."""
    if command[0] == "second.py" and not second.found():
        pytest.skip(second.MISSING)
    name, *arguments = (word.format(out=tmp_path) for word in command)
    status, _, shown = on_a_terminal(sys.executable, SCRIPTS / name, *arguments)
    assert status == 0, shown
    for pattern in wanted:
        assert re.search(pattern, shown), (pattern, shown)


TESTS = """import pytest, time
@pytest.mark.parametrize("n", range(4))
def test_it(n):
    time.sleep(0.3)
    assert n != BAD, "the third"
"""
RUN = """import os, sys
sys.path.insert(0, {scripts!r})
from pytests import run_pytest
print(run_pytest(["-p", "no:cacheprovider", *sys.argv[1:]], "tests", dict(os.environ)))"""


@pytest.mark.parametrize(("bad", "more"), [(9, []), (2, ["-n", "2"])], ids=["all pass", "one fails"])
def test_run_of_pytest(tmp_path, bad, more):
    """Tests done of all on a terminal, and then what failed, not what passed; else what pytest prints."""
    file = tmp_path / "test_small.py"
    file.write_text(TESTS.replace("BAD", str(bad)))
    command = [sys.executable, "-c", RUN.format(scripts=str(SCRIPTS)), *more, str(file)]
    status, said, shown = on_a_terminal(*command)
    assert status == 0 and int(said) == (bad < 4), shown
    assert re.search(r"tests .* [12]/4 ", shown) and "PASSED" not in shown
    assert ("AssertionError: the third" in shown) == ("1 failed, 3 passed" in shown) == (bad < 4)
    done = subprocess.run(command, capture_output=True, text=True)
    assert int(done.stdout) == (bad < 4)
    assert ("1 failed, 3 passed" if bad < 4 else "4 passed") in done.stderr and "PASSED" not in done.stderr
