# SPDX-License-Identifier: Apache-2.0
"""Every step of docs/tutorial.md, in a fresh clone: files are made, changes applied, commands run, outputs compared."""

import os
import re
import subprocess
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "tutorial.md"
BLOCK = re.compile(r"^```(\w+)(?: (\w+)=(\S+))?\n(.*?)^```$", re.M | re.S)


class Block(NamedTuple):
    """A fenced block: its language, one option and its value, its text."""

    kind: str
    option: str
    value: str
    text: str


def blocks() -> list[Block]:
    """Those of the page, in order."""
    return [Block(*match) for match in BLOCK.findall(PAGE.read_text())]


def matches(wanted: str, found: str) -> bool:
    """Whether an output is as the page has it: … stands for anything, a line of its own for any lines."""
    lines = [
        r"(?:.*\n)*?" if line == "…" else ".*".join(map(re.escape, re.sub(r" +", " ", line).split("…"))) + r"\n"
        for line in wanted.splitlines()
    ]
    return bool(re.fullmatch("".join(lines), re.sub(r" +", " ", found)))


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A clone of what is committed, with the files as they are now; set-up and builds are this checkout's."""
    folder = tmp_path_factory.mktemp("tutorial") / "raydix"
    subprocess.run(["git", "clone", "-q", ROOT, folder], check=True)
    changed = subprocess.run(["git", "diff", "HEAD", "--binary"], cwd=ROOT, capture_output=True, check=True).stdout
    if changed:
        subprocess.run(["git", "apply", "--index"], cwd=folder, input=changed, check=True)
    (folder / ".venv").symlink_to(ROOT / ".venv")
    os.utime(folder / "requirements.lock", (0, 0))  # older than the set-up, which stays as it is
    os.utime(folder / "scripts" / "preflight.sh", (0, 0))
    for part in ("rtl", "tb"):
        (ROOT / "build" / part).mkdir(parents=True, exist_ok=True)
        (folder / "build").mkdir(exist_ok=True)
        (folder / "build" / part).symlink_to(ROOT / "build" / part)
    return folder


def test_the_page(clone):
    """All of it, from top to bottom."""
    last = None
    assert PAGE.read_text().count("\n```") == 2 * len(blocks())
    assert len([b for b in blocks() if b.kind == "sh"]) >= 8
    # not told that make test runs them: their make would say so
    own = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    environment = {**own, "PYTHONPATH": str(clone / "model"), "COLUMNS": "120", "NO_COLOR": "1"}
    for block in blocks():
        if block.option == "file":
            (clone / block.value).write_text(block.text)
        elif block.kind == "diff":
            done = subprocess.run(["git", "apply", "-"], cwd=clone, input=block.text, text=True, capture_output=True)
            assert done.returncode == 0, f"{block.text}\n{done.stderr}"
        elif block.kind == "sh":
            last = subprocess.run(block.text, shell=True, cwd=clone, env=environment, text=True, capture_output=True)
            assert last.returncode == int(block.value or 0), f"{block.text}{last.stdout}{last.stderr}"
        elif block.kind == "text":
            said = last.stdout if not last.returncode else last.stderr
            assert matches(block.text, said), f"{block.text}\n--- found:\n{said}"
        else:
            pytest.fail(f"a block that is not run: {block}")
    # what ran was the clone's model, with the change that the page makes
    assert (clone / "build" / "render" / "peanut" / "golden" / "peanut.png").exists()
    assert not (ROOT / "scenes" / "peanut.toml").exists()


def test_comparison():
    """What differs in a word, lacks a line or has one more is seen; wildcards and widths of tables are not."""
    assert matches("a … c\n…\nend\n", "a bb  c\nmore\nstill more\nend\n") and matches("…\nend\n", "end\n")
    assert not matches("a b\n", "a c\n") and not matches("a\nb\n", "a\n") and not matches("a\n", "a\nb\n")
