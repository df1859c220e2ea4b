# SPDX-License-Identifier: Apache-2.0
"""Every command that README and docs name is there, and runs: in a small form here, or in the test that is named."""

import os
import re
import shlex
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
COMMAND = re.compile(r"(PYTHONPATH=\S+ +)?(make|raydix|\.venv/bin/\w+|scripts/\w+\.py|\.ci/run)( +|$)")
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
    "make realtime": f'make realtime {TINY}"',
    "make bench": f'make bench {TINY} --repeats 1 --out {{out}}"',
    "make bench-full": 'make bench-full ARGS="--size 32x24 --repeats 1 --out {out}"',
    "make scaling": "make scaling ARGS=--help",
    "make search": 'make search ARGS="--generations 1 --rays 200"',
    "make formal": "make formal POINT=select-n1",
    "make synth": "make synth POINT=count",
    "make pnr": "make pnr POINT=count",
    "make coverage": "make coverage T=delay",
    "make second": 'make second T=register ARGS="--seed 1"',
    "scripts/realtime.py": "scripts/realtime.py scenes/sphere.toml --size 48x36 --rings 1 --work",
    "scripts/synth.py": ".venv/bin/python scripts/synth.py count --no-pnr",
}
# Those that need more than a command: the test that runs them.
ELSEWHERE = {
    "make setup": "test_docs.py::test_set_up_is_this",
    "make test": "test_docs.py::test_regression_is_this",
    "make regress": "test_docs.py::test_regression_is_this",
    ".ci/run": "test_docs.py::test_regression_is_this",
    "make bench-check": "test_benchmark.py::test_guard",
    "make waves": "test_waves.py::test_of_a_test",
    "raydix verify": "test_cli.py::test_verify",
    ".venv/bin/dask": "test_explore.py::test_on_a_cluster",
    "scripts/formal_proofs.py": "test_formal.py::test_fast_proofs",
}


def commands() -> dict[str, str]:
    """Commands of the pages, those of fenced blocks and those in backquotes: (command, where it stands)."""
    found = {}
    for page in PAGES:
        text = page.read_text()
        lines = re.findall(r"`([^`\n]+)`", text)
        for _, body in re.findall(r"^```(sh|)\n(.*?)^```$", text, re.M | re.S):
            lines += body.splitlines()
        for line in lines:
            line = re.split(r" +#", line.strip())[0]
            if COMMAND.match(line):
                found.setdefault(line, page.relative_to(ROOT))
    return found


def key_of(command: str) -> str:
    """The first words, which the tables go by."""
    words = [w for w in shlex.split(command) if not w.startswith("PYTHONPATH=")]
    if words[0] == ".venv/bin/raydix" and len(words) > 1:
        words[0] = "raydix"
    return " ".join(words[:2]) if words[0] in ("make", "raydix") and len(words) > 1 else words[0]


def test_commands_are_known():
    """Each is in one of the tables, and each of the tables' is still in the docs."""
    found = {key_of(command): (command, page) for command, page in commands().items()}
    assert len(found) > 30
    known = [*SMALL, *SLOW, *ELSEWHERE]
    assert len(set(known)) == len(known)
    missing = {key: where for key, where in found.items() if key not in known and key not in ("make", "raydix")}
    assert not missing, f"run by no test: {missing}"
    assert set(known) <= {*found, "make help"}, set(known) - set(found)
    for test in ELSEWHERE.values():
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
            assert setting.split("=")[0] in re.findall(r"[A-Z]+", line), f"{page}: {command}: {line}"


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
    """`make test`, `make regress` and `.ci/run` start pytest, with the seed that they are given."""
    for command, wanted in (("make -n test SEED=5", "not long"), ("make -n regress SEED=5", "regress.xml")):
        said = subprocess.run(shlex.split(command), cwd=ROOT, capture_output=True, text=True).stdout
        assert "-m pytest" in said and wanted in said and 'SEED="5"' in said
    assert "make test SEED=" in (ROOT / ".ci" / "run").read_text()
