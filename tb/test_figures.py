# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/method.md show what the golden model computes."""

from pathlib import Path

import numpy as np

from raydix.config import Config
from raydix.fit import families
from raydix.image import read_image
from raydix.scene import load_scene
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]
SCENE = load_scene(ROOT / "scenes" / "torus.toml")
CONFIG = Config(**families(SCENE))


def test_step():
    """Cells join at their ends, those of the candidates have both signs, and the first candidate is taken."""
    with scripts("figures") as figures:
        whole, cells, candidates, pick = figures.cells_of(SCENE, CONFIG, *figures.PIXEL)
    assert len(whole) == 5 and len(cells) == 8
    assert cells[0][0] == whole[0] and cells[-1][-1] == whole[-1]
    assert all(a[-1] == b[0] for a, b in zip(cells, cells[1:], strict=False))
    mixed = [(cell > 0).any() and (cell <= 0).any() for cell in cells]
    assert sum(mixed) == 2 and candidates == sum(1 << j for j, may in enumerate(mixed) if may)
    assert pick == mixed.index(True)


def test_pictures(tmp_path):
    """They are drawn; the torus is within the rectangle of its box."""
    with scripts("figures") as figures:
        figures.draw_step(SCENE, CONFIG, tmp_path / "step.png")
        figures.draw_rectangle(SCENE, CONFIG, tmp_path / "rectangle.png")
    assert np.ptp(read_image(tmp_path / "step.png")) == 255
    picture = read_image(tmp_path / "rectangle.png")[..., :3].astype(int)

    def reach(color, near):
        rows, columns = np.nonzero(abs(picture - color).max(axis=2) < near)
        shown = rows < 0.8 * len(picture)  # not the legend
        return columns[shown].min(), columns[shown].max()

    torus, yellow = reach((203, 156, 98), 20), reach((242, 193, 78), 30)
    assert yellow[0] < torus[0] < torus[1] < yellow[1]
