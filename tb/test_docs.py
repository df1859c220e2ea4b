# SPDX-License-Identifier: Apache-2.0
"""Every command that README and docs name is there, its options are those of the program, and it runs: in a small form
here, or in the test that is named, or it stands in the list of those that are not run, with the reason."""

import json
import os
import re
import shlex
import subprocess
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
PYTHON = r"(?:\S*/)?python3? +"
PROGRAM = rf"{PYTHON}-m +raydix\S*|(?:{PYTHON})?scripts/\w+\.py|make|raydix|\.venv/bin/\w+|\.ci/run"
COMMAND = re.compile(rf"(?:[A-Z_]+=\S* +)*({PROGRAM})(?: +|$)")
TINY = 'SCENE=scenes/sphere.toml ARGS="--size 48x36'

# A command by its first words, as key_of gives them: how it is run here. Those of SLOW in make regress only.
SMALL = {
    "make help": "make help",
    "make accuracy": f'make accuracy {TINY}"',
    "make rules": 'make rules ARGS="--chords 2000"',
    "make types": 'make types ARGS="--chords 200"',
    "make spirals": 'make spirals ARGS="--spirals 2 --chords 200"',
    "make errors": 'make errors ARGS="--rays 4"',
    "make stress": 'make stress ARGS="--only grazing --rays 2000 --jobs 1"',
    "make exact-spirals": 'make exact-spirals ARGS="--spirals 1 --chords 20 --processes 1"',
    "make explore": 'make explore ARGS="--kept --out {out}"',
    "make trace-ray": 'make trace-ray SCENE=scenes/torus.toml PIXEL=320,200 ARGS="--no-rtl --out {out}"',
    "make report": 'make report ARGS="--render {out} --results {out} --out {out}/report.html"',
    "make figures": 'make figures ARGS="--out {out}"',
    "make csr": ".venv/bin/python -m raydix.csr",
    "make formats": ".venv/bin/python -m raydix.formats",
    "make mutants": "make mutants T=select ARGS=--list",
    "raydix render": ".venv/bin/raydix render scenes/sphere.toml --size 48x36 --out {out}",
    "raydix export": ".venv/bin/raydix export scenes/sphere.toml --size 24x18 --out {out}",
    "raydix configure": ".venv/bin/raydix configure scenes/gallery.toml",
    "raydix compare": ".venv/bin/raydix compare docs/images/torus.png docs/images/torus.png",
    ".venv/bin/raydix": ".venv/bin/raydix --help",
}
SLOW = {
    "make render": f'make render {TINY} --units 1" OUT={{out}}',
    "make lint": "make lint",
    "make speed": 'make speed SCENE=scenes/sphere.toml ARGS="--runs 1 --units 1"',
    "make realtime": f'make realtime {TINY} --rings 1"',
    "make bench": f'make bench {TINY} --repeats 1 --out {{out}}"',
    "make bench-full": 'make bench-full ARGS="--size 32x24 --repeats 1 --out {out}"',
    "make search": 'make search ARGS="--generations 1 --rays 200"',
    "make formal": "make formal POINT=select-n1",
    "make synth": "make synth POINT=count",
    "make pnr": "make pnr POINT=count",
    "make coverage": "make coverage T=delay",
    "make second": 'make second T=register ARGS="--seed 1"',
    "scripts/synth.py": ".venv/bin/python scripts/synth.py count --no-pnr",
}
# Those that need more than a command: the test that runs them.
ELSEWHERE = {
    "make scaling": "test_scaling.py::test_command",
    "make waves": "test_waves.py::test_of_a_test",
    "raydix verify": "test_cli.py::test_verify",
    "scripts/formal_proofs.py": "test_formal.py::test_fast_proofs",
}
# Those that no test runs: why, and the test of what can be told without.
UNRUN = {
    "make setup": ("would make .venv anew, in which the tests run", "test_docs.py::test_set_up_is_this"),
    "make test": ("is what runs here", "test_docs.py::test_regression_is_this"),
    "make regress": ("takes hours", "test_docs.py::test_regression_is_this"),
    ".ci/run": ("is what runs here", "test_docs.py::test_regression_is_this"),
    "make bench-check": ("times five whole scenes against the baseline's", "test_benchmark.py::test_guard"),
    ".venv/bin/dask": ("waits for other machines", "test_explore.py::test_on_a_cluster"),
}
# Options that are named without a command and are those of other programs.
FOREIGN = {
    "--x-initial": "Verilator", "--x-assign": "Verilator",
    "--out-of-context": "nextpnr", "--placer-heap-beta": "nextpnr", "--placer": "nextpnr",
    "--top": "yosys",
    "--setup": "FuseSoC", "--tool": "FuseSoC", "--count": "git rev-list",
}  # fmt: skip
# Programs of others, whose commands are not checked.
OTHERS = ("git", "apt-get", "gtkwave", "surfer", "verilator", "fusesoc")
# What stands in documented commands for a value of the reader's.
PLACEHOLDERS = {"<module>": "ring", "=…": "=ring", "X,Y": "320,200"}


@cache
def pieces() -> list[tuple[str, Path, bool]]:
    """All code of the pages, as a line each: (text, page, whether it is a line of a block of shell commands)."""
    found = []
    for page in PAGES:
        text, name = page.read_text(), page.relative_to(ROOT)
        for kind, body in re.findall(r"^```(\w*)[^\n]*\n(.*?)^```$", text, re.M | re.S):
            if kind in ("", "sh", "bash", "console", "shell"):
                found += [(line.strip(), name, kind != "") for line in body.replace("\\\n", " ").splitlines()]
        prose = re.sub(r"^```.*?^```$", "\n", text, flags=re.M | re.S)
        for paragraph in re.split(r"\n\s*\n", prose):  # code may go on in the next line
            found += [(" ".join(code.split()), name, False) for code in re.findall(r"`([^`]+)`", paragraph)]
    return found


def commands() -> dict[str, Path]:
    """Commands of the pages, those of blocks and those in backquotes: (command, where it stands)."""
    found: dict[str, Path] = {}
    for text, page, _ in pieces():
        for line in re.split(r" (?:&&|\|\|?|;) ", re.split(r" +#", text)[0]):
            if COMMAND.match(line.strip()):
                found.setdefault(line.strip(), page)
    return found


def without_python(words: list[str]) -> list[str]:
    """The words of a command behind the interpreter, and behind the module by which make runs scripts."""
    if words[0].endswith(("python", "python3")):
        words = words[1:]
    return words[2:] if words[:2] == ["-m", "raydix.entry"] else words


def key_of(command: str) -> str:
    """The first words, which the tables go by."""
    words = shlex.split(command)
    while re.match(r"[A-Z_]+=", words[0]):
        words.pop(0)
    words = without_python(words)
    if words[0] == "-m":
        return f"make {words[1].rpartition('.')[2]}"
    if words[0] == ".venv/bin/raydix" and len(words) > 1:
        words[0] = "raydix"
    return " ".join(words[:2]) if words[0] in ("make", "raydix") and len(words) > 1 else words[0]


def test_commands_are_known():
    """Each is in one of the tables, and each of the tables' is still in the docs."""
    found = {key_of(command): (command, page) for command, page in commands().items()}
    assert len(found) > 30
    known = [*SMALL, *SLOW, *ELSEWHERE, *UNRUN]
    assert len(set(known)) == len(known)
    missing = {key: where for key, where in found.items() if key not in known and key not in ("make", "raydix")}
    assert not missing, f"run by no test: {missing}"
    assert set(known) <= {*found, "make help"}, set(known) - set(found)
    for test in (*ELSEWHERE.values(), *(test for _, test in UNRUN.values())):
        file, _, name = test.partition("::")
        assert f"def {name}(" in (ROOT / "tb" / file).read_text(), test


def test_targets_and_variables():
    """make accepts each command as it stands; what it sets is named in the line of `make help` of that target."""
    listed = subprocess.run(["make", "help"], cwd=ROOT, capture_output=True, text=True).stdout
    for command, page in commands().items():
        words = shlex.split(command)
        if words[0] != "make" or len(words) < 2:
            continue
        (line,) = [text for text in listed.splitlines() if text.split()[:2] == ["make", words[1]]]
        for setting in words[2:]:
            name, _, value = setting.partition("=")
            assert name in re.findall(r"[A-Z]+", line), f"{page}: {command}: {line}"
            module = PLACEHOLDERS.get(value, value.partition("[")[0]).replace("…", "ring")
            assert name != "T" or (ROOT / "tb" / f"test_{module}.py").exists(), f"{page}: {command}"


# Runs the programs of scripts/ and raydix up to where they have read their arguments: what each said where it refused
# them; and the options that it has. A process for each, because some names of scripts/ are those of tb/, too.
PARSE = """
import argparse, contextlib, importlib.util, io, json, os, sys
import matplotlib.figure, raydix.cli, raydix.render
class Read(BaseException):
    pass
def options(parser):
    inner = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    return [*parser._option_string_actions, *(o for a in inner for p in a.choices.values() for o in options(p))]
def read(self, arguments=None, namespace=None):
    known.update(options(self))
    self.original(arguments, namespace)
    raise Read
def program(name):
    if "." in name:
        return importlib.import_module(name)
    spec = importlib.util.spec_from_file_location(f"program_{name}", f"scripts/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
def said_to(module, name, arguments):
    said, sys.argv = io.StringIO(), [name, *arguments]
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        try:
            module.main()
            return "it read no arguments"
        except Read:
            return ""
        except SystemExit as end:
            return said.getvalue().strip() if end.code else ""
known, refused = set(), {}
argparse.ArgumentParser.original = argparse.ArgumentParser.parse_args
argparse.ArgumentParser.parse_args = read
sys.path.insert(0, "scripts")
for name, each in json.load(sys.stdin).items():
    end, begin = os.pipe()
    if not os.fork():
        module = program(name)
        lines = [said_to(module, name, arguments) for arguments in each]
        os.write(begin, json.dumps([lines, sorted(known)]).encode())
        os._exit(0)
    os.close(begin)
    with open(end) as file:
        refused[name], new = json.load(file)
    known.update(new)
print(json.dumps([refused, sorted(known)]))
"""


def program_of(command: str) -> tuple[str, list[str]] | None:
    """Module and arguments of the program that a command starts; None where that is none of ours, or a mere name."""
    words = shlex.split(command)
    while re.match(r"[A-Z_]+=", words[0]):
        words.pop(0)
    if words[0] == "make":
        if len(words) < 3:
            return None
        done = subprocess.run(["make", "-n", *words[1:]], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 0, f"{command}: {done.stderr}"
        whole = done.stdout.replace("\\\n", " ").splitlines()
        lines = [line for line in whole if line.startswith(".venv/bin/") or "pytest" in line]
        assert len(lines) == 1, f"{command}: {done.stdout}"
        return program_of(lines[0])
    words = without_python(words)
    if words[0] == "-m":
        return (words[1], words[2:]) if words[1].startswith("raydix") else None
    if words[0] in ("raydix", ".venv/bin/raydix"):
        return "raydix.cli", words[1:] if len(words) > 2 else [*words[1:], "--help"]
    path = ROOT / words[0]
    if path.parent == ROOT / "scripts" and "\ndef main(" in path.read_text():
        return path.stem, words[1:] or ["--help"]
    return None


def parsed() -> tuple[dict[str, str], set[str]]:
    """What a program says against a documented command, if anything; and all options that the programs have."""
    asked = {}
    for command in commands():
        plain = command
        for name, value in PLACEHOLDERS.items():
            plain = plain.replace(name, value)
        program = program_of(plain)
        if program:
            asked[command] = program
    for script in sorted((ROOT / "scripts").glob("*.py")):  # the examples that it gives itself
        text = script.read_text()
        if "\ndef main(" not in text:
            continue
        asked[f"scripts/{script.name}"] = script.stem, ["--help"]
        for line in re.findall(rf"^    (scripts/{script.name}.*)", text.split('"""')[1], re.M):
            example = re.split(r" {2,}", line)[0].replace("X,Y", PLACEHOLDERS["X,Y"])
            asked[line] = script.stem, shlex.split(example)[1:]
    assert len(asked) > 80
    of_program: dict[str, list[list[str]]] = {}
    for name, arguments in asked.values():
        of_program.setdefault(name, []).append(arguments)
    call = [ROOT / ".venv/bin/python", "-c", PARSE]
    done = subprocess.run(call, input=json.dumps(of_program), cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers, known = json.loads(done.stdout)
    said = {command: answers[name].pop(0) for command, (name, _) in asked.items()}
    return {command: line.splitlines()[-1] for command, line in said.items() if line}, set(known)


def test_options_are_there():
    """Each command's arguments are accepted by the parser of the program that it starts, as far as they can be read.

    An option that is named without a command is that of a program of ours, or of the one that is told above.
    """
    refused, known = parsed()
    assert not refused, {f"{commands().get(command, 'its own help')}: {command}": s for command, s in refused.items()}
    found = {}
    for text, page, _ in pieces():
        if not COMMAND.match(text) and not text.startswith(OTHERS):
            for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text):
                found.setdefault(option, f"{page}: {text}")
    missing = {option: where for option, where in found.items() if option not in known and option not in FOREIGN}
    assert len(found) > 15 and not missing
    assert set(FOREIGN) <= set(found), set(FOREIGN) - set(found)


def test_blocks_of_commands():
    """A line of a block of shell commands is a command that is known here, or another program's."""
    lines = [(text, page) for text, page, shell in pieces() if shell and text and not text.startswith("#")]
    assert len(lines) > 10
    assert not [(t, str(p)) for t, p in lines if not COMMAND.match(t) and t.split()[0] not in OTHERS]


@pytest.mark.parametrize(
    "text, found",
    [
        ("`make test\nT=ring`", ["make test T=ring"]),
        (
            "`SEED=1 make test` or `.venv/bin/python -m raydix.csr`",
            ["SEED=1 make test", ".venv/bin/python -m raydix.csr"],
        ),
        ("```\nmake setup && make lint   # both\nmaker x\n```", ["make setup", "make lint"]),
        ("```sh out=2\nscripts/stress.py \\\n  --rays 2\n```", ["scripts/stress.py    --rays 2"]),
        ("`raydix.formats`, `makefile`, `scripts/viewing/formats.py`\n\n```python\nmake x\n```", []),
    ],
)
def test_what_a_command_is(tmp_path, monkeypatch, text, found):
    """Commands are found in the middle of a paragraph, across lines, after variables and behind others."""
    (tmp_path / "page.md").write_text(f"Before, {text}\n" if text[:3] != "```" else f"{text}\n")
    monkeypatch.setitem(globals(), "PAGES", [tmp_path / "page.md"])
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    monkeypatch.setitem(globals(), "pieces", pieces.__wrapped__)
    assert list(commands()) == found


def run(command: str, out: Path) -> None:
    """Run it as a reader would."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST")}
    environment["PATH"] = f"{ROOT / '.venv' / 'bin'}:{environment['PATH']}"
    done = subprocess.run(
        command.format(out=out), shell=True, cwd=ROOT, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0 and "Traceback" not in done.stderr, f"{command}\n{done.stdout}\n{done.stderr}"


@pytest.mark.parametrize("key", SMALL)
def test_small(key, tmp_path):
    """It ends well."""
    run(SMALL[key], tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("key", SLOW)
def test_slow(key, tmp_path):
    """It ends well."""
    run(SLOW[key], tmp_path)


def test_set_up_is_this():
    """The set-up that `make setup` makes is the one that runs here, with the versions of the lock."""
    lock = [line for line in (ROOT / "requirements.lock").read_text().splitlines() if not line.startswith("#")]
    done = subprocess.run([ROOT / ".venv/bin/python", "-m", "pip", "freeze", "--all"], capture_output=True, text=True)
    installed = {line.lower().replace("_", "-") for line in done.stdout.splitlines()}
    missing = [line for line in lock if line.split(";")[0].strip().lower().replace("_", "-") not in installed]
    assert not missing


def test_regression_is_this():
    """`make test`, `make regress` and `.ci/run` start pytest, with the seed that they are given; what takes long is run
    by regress and by ALL=1."""
    for command, file, short in (
        ("make -n test SEED=5", "test.xml", True),
        ("make -n test SEED=5 ALL=1", "test.xml", False),
        ("make -n test SEED=5 T=ring", "ring.xml -v tb/test_ring.py", True),
        ("make -n test SEED=5 T=rdx_ring ALL=1", "ring.xml -v tb/test_ring.py", False),
        ("make -n regress SEED=5", "regress.xml", False),
    ):
        said = subprocess.run(shlex.split(command), cwd=ROOT, capture_output=True, text=True).stdout
        said = said.replace("\\\n", "")
        assert "-m pytest" in said and 'SEED="5"' in said and f"build/results/{file} " in f"{' '.join(said.split())} "
        assert ('-m "not long"' in said, 'RAYDIX_SHORT="1"' in said) == (short, short), command
    assert "make test SEED=" in (ROOT / ".ci" / "run").read_text()
