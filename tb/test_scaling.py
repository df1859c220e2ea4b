# SPDX-License-Identifier: Apache-2.0
"""How time grows: the scenes that are measured, the tables, and bad input."""

import sys
from pathlib import Path

import numpy as np
import pytest

from raydix.oracle import ideal_frame, ideal_hits
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def script():
    """scripts/scaling.py as a module."""
    with scripts("scaling") as modules:
        yield modules


def test_spheres_beside_each_other(script, tmp_path):
    """Whatever their number they cover about the same part of the picture, and no pixel shows two."""
    covered = []
    for count in script.COUNTS:
        scene = script.scene_of(script.beside(count), tmp_path)
        layers = sum(np.isfinite(ideal_hits(scene, i).depth[..., 0]).astype(int) for i in range(count))
        assert layers.max() == 1, count
        covered.append(int(layers.sum()))
    assert max(covered) < 1.1 * min(covered), covered


@pytest.mark.parametrize("nearest_first", [True, False])
def test_spheres_behind_each_other(script, tmp_path, nearest_first):
    """Every pixel that is hit has as many layers as there are spheres; the first slot is the nearest, or the last."""
    scene = script.scene_of(script.behind(8, nearest_first), tmp_path)
    layers = sum(np.isfinite(ideal_hits(scene, i).depth[..., 0]).astype(int) for i in range(8))
    assert layers.max() == 8 and np.count_nonzero(layers == 8) > 0.95 * np.count_nonzero(layers)
    frame = ideal_frame(scene)
    assert set(frame.surface[layers == 8].tolist()) == {0 if nearest_first else 7}


def test_unneeded_parts(script, tmp_path):
    """Each processor has all that the smallest has, and something more; the last has all of it."""
    some = list(script.tasks(["unneeded"], tmp_path))
    first, *others = [task.config for task in some]
    assert first.degree == 4 and first.vecsum == "none" and not first.clip and first.surfaces == 1
    changed = [{name for name, value in vars(c).items() if value != getattr(first, name)} for c in others]
    assert all(changed) and changed[-1] == set.union(*changed[:-1])


@pytest.mark.long
def test_command(script, monkeypatch, capsys):
    """Clocks of two kinds: depth complexity costs less than in proportion where the nearest comes first."""
    monkeypatch.setattr(sys.modules["scaling"], "COUNTS", (1, 8))
    assert script.main(["depth", "--repeats", "1"]) == 0
    lines = [line.split("│") for line in capsys.readouterr().out.splitlines() if "nearest first" in line]
    clocks = [int(cells[5].replace(",", "")) for cells in lines]
    assert clocks[0] < clocks[1] < 8 * clocks[0]


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["colours"], "found 'colours'; allowed: pixels, surfaces, depth, unneeded"),
        (["--repeats", "0"], "found '0'; allowed: whole numbers, 1 or more"),
        (["depth", "--write"], "allowed: with all four tables"),
    ],
)
def test_refuses(script, capsys, arguments, words):
    """Bad arguments: status 2, what was found and what is allowed."""
    with pytest.raises(SystemExit) as ended:
        script.main(arguments)
    assert ended.value.code == 2 and words in capsys.readouterr().err
