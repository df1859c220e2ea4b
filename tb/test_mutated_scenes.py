# SPDX-License-Identifier: Apache-2.0
"""Scene files with a mistake in them: each is rendered, or refused with one clear line and nothing written."""

import os
import random
import re
import secrets
from pathlib import Path

import numpy as np
import pytest

from raydix.cli import main

ROOT = Path(__file__).resolve().parents[1]
SCENES = sorted((ROOT / "scenes").glob("*.toml"))
COUNT = 1000
PARTS = 10  # so that workers share them
NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")
VALUES = (
    "0", "0.0", "-1", "-1.0", "1", "1e300", "-1e300", "1e-300", "1e18", "nan", "inf", "-inf", "true", '"text"', "[]",
    "{}", "[1.0]", "9223372036854775807", "1e-9", "0.5", "2", "1000000",
)  # fmt: skip


def number(draw, text):
    """One number is another value."""
    places = list(NUMBER.finditer(text))
    if not places:  # an earlier change has left none
        return text
    place = draw.choice(places)
    value = draw.choice((*VALUES, f"{draw.uniform(-10, 10):.3f}", f"{float(place[0]) * draw.choice((0.1, 10, -1)):g}"))
    return text[: place.start()] + value + text[place.end() :]


def line_gone(draw, text):
    """A line is missing."""
    lines = text.splitlines() or [""]
    del lines[draw.randrange(len(lines))]
    return "\n".join(lines)


def line_twice(draw, text):
    """A line stands twice."""
    lines = text.splitlines() or [""]
    at = draw.randrange(len(lines))
    return "\n".join(lines[: at + 1] + lines[at:])


def name(draw, text):
    """A key or a type has a letter too much, or is another one."""
    words = list(re.finditer(r"[A-Za-z_]+", text))
    if not words:
        return text
    place, other = draw.choice(words), draw.choice(words)
    new = draw.choice((place[0] + "x", place[0][:-1], other[0], place[0].upper()))
    return text[: place.start()] + new + text[place.end() :]


def letter(draw, text):
    """A character is another one, or gone."""
    at = draw.randrange(len(text))
    return text[:at] + draw.choice(("", "[", "]", "=", '"', "\n", "\0", "é", "#", ",")) + text[at + 1 :]


def cut(draw, text):
    """The file ends early."""
    return text[: draw.randrange(len(text))]


def two_scenes(draw, text):
    """The end of another scene follows."""
    other = draw.choice(SCENES).read_text()
    return text + other[other.index("[[surface]]") :] if "[[surface]]" in other else text + other


WAYS = (number, number, number, number, line_gone, line_twice, name, name, letter, cut, two_scenes)


@pytest.mark.parametrize("part", range(PARTS))
def test_rendered_or_refused(part, tmp_path, capsys):
    """Exit status 0 and pictures, or 2, a line that names the file and what is allowed, and no output; no traceback."""
    seed = int(os.environ.get("SEED") or secrets.randbelow(1 << 31))
    print(f"replay: make test T=mutated_scenes SEED={seed}")
    draw = random.Random(f"{seed} {part}")
    refused = 0
    for i in range(COUNT // PARTS):
        source = draw.choice(SCENES)
        ways = [draw.choice(WAYS) for _ in range(draw.choice((1, 1, 2)))]
        text = source.read_text()
        for way in ways:
            text = way(draw, text) or " "
        path, out = tmp_path / f"{i}.toml", tmp_path / f"out{i}"
        path.write_text(text)
        what = f"{source.name}, {[way.__name__ for way in ways]}, {path}"
        with np.errstate(all="ignore"):
            status = main(["render", str(path), "--size", "16x12", "--out", str(out)])
        said = capsys.readouterr()
        assert status in (0, 2), what
        assert "Traceback" not in said.err + said.out, what
        if status == 2:
            refused += 1
            assert not out.exists() or not list(out.iterdir()), what
            lines = said.err.strip().splitlines()
            assert lines and all(str(path) in line for line in lines if not line.startswith(" ")), f"{what}: {said.err}"
            assert "allowed" in said.err or "TOML" in said.err, f"{what}: {said.err}"
        else:
            assert {p.suffix for p in out.iterdir()} == {".png", ".exr", ".npz"}, what
    assert COUNT // PARTS * 0.2 < refused < COUNT // PARTS * 0.95
