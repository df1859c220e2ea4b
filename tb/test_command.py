# SPDX-License-Identifier: Apache-2.0
"""What every program does with bad input, a refusal of the system and Ctrl-C: a line on stderr, no traceback."""

import argparse
import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from raydix import command
from raydix.blocks import write_table
from raydix.config import ConfigError
from raydix.rtl import RtlError, simulate

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = sorted(p for p in (ROOT / "scripts").glob("*.py") if "__main__" in p.read_text())
SPHERE = "scenes/sphere.toml"


def script(*arguments, **keywords):
    """A script with its arguments, started."""
    line = [sys.executable, "-m", "raydix.entry", f"scripts/{arguments[0]}", *map(str, arguments[1:])]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "cwd": ROOT}
    return subprocess.Popen(line, **pipes | keywords)


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_every_script_ends_by_it(path):
    """Ctrl-C and what a user did wrong are told in one place."""
    assert path.read_text().endswith("    sys.exit(status_of(main))\n")


def test_whole_numbers():
    """With no limit, with one, with two: what is none, or beyond them, is told."""
    assert [command.INTEGER("-7"), command.SEED("0"), command.whole(1, 4)("4")] == [-7, 0, 4]
    for kind, text, allowed in (
        (command.INTEGER, "3.5", "whole numbers"),
        (command.SEED, "-1", "whole numbers, 0 or more"),
        (command.whole(1, 4), "5", "whole numbers, 1 to 4"),
    ):
        with pytest.raises(argparse.ArgumentTypeError) as error:
            kind(text)
        assert str(error.value) == f"found '{text}'; allowed: {allowed}"


def test_seed_of_the_environment():
    """A SEED that is none is refused before any test, with what is allowed."""
    words = [sys.executable, "-m", "pytest", "--collect-only", "-q", "tb/test_delay.py"]
    done = subprocess.run(words, cwd=ROOT, env=os.environ | {"SEED": "abc"}, text=True, capture_output=True)
    assert done.returncode == pytest.ExitCode.USAGE_ERROR
    assert done.stderr.strip() == "ERROR: SEED: found 'abc'; allowed: whole numbers, 0 or more"


@pytest.mark.parametrize(
    "error, status, said",
    [
        (ConfigError("n1: found 9; allowed: 1 to 4"), 2, "tool: n1: found 9; allowed: 1 to 4\n"),
        (RtlError("two\nlines"), 2, "tool: two\ntool: lines\n"),
        (FileExistsError(17, "File exists", "build"), 2, "tool: build: File exists\n"),
        (KeyboardInterrupt(), 130, "tool: interrupted; nothing half written\n"),
        (BrokenPipeError(), 0, ""),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, BaseException) else "",
)
def test_status(monkeypatch, capsys, error, status, said):
    """Exit status and text of each kind of end; others are mistakes of ours and pass."""

    def main():
        raise error

    monkeypatch.setattr(sys, "argv", ["scripts/tool.py"])
    assert command.status_of(main) == status and capsys.readouterr().err == said
    assert command.status_of(lambda: 1) == 1
    with pytest.raises(ZeroDivisionError):
        command.status_of(lambda: 1 // 0)


def test_numbers():
    """Whole numbers between limits; all else is refused with what was found and what is allowed."""
    assert command.whole(1, 4)("4") == 4 and command.whole(0)("0") == 0 and command.whole(-3)("-3") == -3
    for kind, text in ((command.whole(1, 4), "5"), (command.COUNT, "0"), (command.COUNT, "nan"), (command.SEED, "-1"),
                       (command.COUNT, ""), (command.COUNT, "1e3"), (command.COUNT, "9" * 30)):  # fmt: skip
        with pytest.raises(argparse.ArgumentTypeError, match=re.escape(f"found '{text}'; allowed: whole numbers")):
            kind(text)
    assert command.above(0)("1e-9") == 1e-9
    for text in ("0", "nan", "inf", "-1", "x"):
        with pytest.raises(argparse.ArgumentTypeError, match=f"found '{text}'; allowed: finite numbers above 0"):
            command.above(0)(text)
    assert command.image_size("640x480") == (640, 480)
    for text in ("8", "8x6x4", "x", "-8x6", "nan", ""):
        with pytest.raises(argparse.ArgumentTypeError, match="WIDTHxHEIGHT"):
            command.image_size(text)


BAD = [
    ("speed.py", SPHERE, "--units", 99),
    ("rules.py", "--width", 99),
    ("rules.py", "--chords", 0),
    ("rules.py", "--radius", "nan"),
    ("realtime.py", SPHERE, "--size", "8x6x4"),
    ("realtime.py", SPHERE, "--n1", 0),
    ("errors.py", "--rays", -1),
    ("spirals.py", "--spirals", 0),
    ("search.py", "--rays", 0),
    ("stress.py", "--seed", -1),
    ("accuracy.py", SPHERE, "--size", "nan"),
    ("accuracy.py", SPHERE, "--n1", 9),
    ("accuracy.py", SPHERE, "--max-ulp", "nan"),
    ("accuracy.py", SPHERE, "--json", "scenes"),
    ("second.py", "register", "--seed", "abc"),
    ("benchmark.py", "--repeats", 0),
    ("mutants.py", "select", "--list", "--mutant", 99999),
    ("mutants.py", "select", "--list", "--mutant", 0),
    ("explore.py", "--scheduler", "foo"),
    ("explore.py", "--scheduler", "tcp://host:99999"),
    ("trace_ray.py", SPHERE, "--pixel", "9,9", "--no-rtl", "--steps", 0),
]


@pytest.mark.parametrize("arguments", BAD, ids=lambda a: "-".join(map(str, a[:-1])).replace("/", "."))
def test_bad_arguments(arguments):
    """Status 2; the last line says what was found and what is allowed."""
    run = script(*arguments)
    said = run.communicate()[1]
    last = said.splitlines()[-1]
    assert run.returncode == 2 and "Traceback" not in said, said
    assert "found" in last and "allowed" in last or "cannot be written" in last, last


@pytest.mark.parametrize("arguments", [("stress.py", "--jobs", 2), ("rules.py",), ("exact_spirals.py",)], ids=str)
def test_interrupted(arguments):
    """Ctrl-C, as a terminal sends it to the whole group: status 130 and one line, from worker processes nothing."""
    run = script(
        *arguments, start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler)
    )
    time.sleep(6)
    assert run.poll() is None, run.communicate()
    os.killpg(run.pid, signal.SIGINT)
    said = run.communicate(timeout=60)[1]
    assert run.returncode == 130, said
    assert said.strip() == f"{Path(arguments[0]).stem}: interrupted; nothing half written"


def test_interrupted_while_it_is_loaded(tmp_path):
    """Ctrl-C while a script that make starts still loads its libraries, one of them beside it: the same line."""
    (tmp_path / "early.py").write_text("import slow\n")
    (tmp_path / "slow.py").write_text("import sys, time\nprint(*sys.argv, __name__, flush=True)\ntime.sleep(60)\n")
    run = subprocess.Popen(
        [sys.executable, "-m", "raydix.entry", tmp_path / "early.py", "--some", "option"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert run.stdout.readline() == f"{tmp_path}/early.py --some option slow\n"
    run.send_signal(signal.SIGINT)
    said = run.communicate(timeout=60)[1]
    assert (run.returncode, said) == (130, "early: interrupted; nothing half written\n")


def test_make_starts_scripts_by_the_entry_point():
    """No other way, which would show a traceback; what is no script is refused."""
    text = (ROOT / "Makefile").read_text()
    assert "$(BIN)/python scripts/" not in text and text.count("$(RUN) scripts/") > 20
    for words in ([], ["nothing.py"]):
        done = subprocess.run([sys.executable, "-m", "raydix.entry", *words], capture_output=True, text=True)
        assert done.returncode == 2 and re.fullmatch("entry: found '.*'; allowed: the file of a script\n", done.stderr)


@pytest.mark.parametrize("end", ["ends", "fails", "is interrupted"])
def test_waveform_is_whole_or_not_there(tmp_path, end):
    """A bench that ends, or fails, leaves its waveform; one that is interrupted leaves the one that was there."""
    wave, bench = tmp_path / "w.vcd", tmp_path / "bench"
    wave.write_text("old")
    last = {"ends": "echo '{}'", "fails": "exit 3", "is interrupted": f"kill -INT {os.getpid()}; sleep 1"}[end]
    bench.write_text(f'#!/bin/sh\nwhile [ "$1" != --trace ]; do shift; done\necho new > "$2"\n{last}\n')
    bench.chmod(0o755)
    expected = {"ends": None, "fails": RtlError, "is interrupted": KeyboardInterrupt}[end]
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job ignores it
    try:
        with pytest.raises(expected) if expected else contextlib.nullcontext():
            simulate([bench], 1, None, wave, None)
    finally:
        signal.signal(signal.SIGINT, before)
    assert wave.read_text() == ("old" if end == "is interrupted" else "new\n")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bench", "w.vcd"]


def test_failed_assertion_is_named(tmp_path):
    """Of a simulation that an assertion stops not the last line is told, which is the same for all, but its own."""
    bench = tmp_path / "bench"
    bench.write_text(
        "#!/bin/sh\necho '[7] %Error: a.sv:1: failed in top.u_a'; echo '%Error: stop'; echo Aborting...; exit 1\n"
    )
    bench.chmod(0o755)
    with pytest.raises(RtlError, match=r"simulation failed: \[7\] %Error: a.sv:1: failed in top.u_a$"):
        simulate([bench], 1, None, None, None)


def test_table_is_whole(tmp_path, monkeypatch):
    """A page whose table cannot be written stays as it was, and nothing is beside it."""
    page = tmp_path / "page.md"
    page.write_text(text := "<!-- BEGIN generated: a -->\n<!-- END generated: a -->\n")

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_table(page, "a", ["b"], [["c"]])
    assert page.read_text() == text and list(tmp_path.iterdir()) == [page]
