# SPDX-License-Identifier: Apache-2.0
"""A picture of one ray's descent: the indicator along the ray, and the cells that each step cuts its cell into."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch

from .trace_ray import Step

POINTS = 200  # of the curve in a cell
CANDIDATE, CHOSEN, LINE = "#fde0c5", "#f4a261", "#264653"


def curve(control: Sequence[int]) -> np.ndarray:
    """Values at POINTS even places of the polynomial with these Bernstein coefficients, by de Casteljau."""
    t = np.linspace(0.0, 1.0, POINTS)
    row = [np.full(POINTS, float(v)) for v in control]
    while len(row) > 1:
        row = [(1 - t) * a + t * b for a, b in zip(row, row[1:], strict=False)]
    return row[0]


def plot_ray(steps: Sequence[Step], n1: int, count: int, title: str, path: Path) -> None:
    """Draw a row for each step, from the whole ray down to the last digits.

    count  steps to a hit
    path   .png or .svg
    """
    figure = Figure(figsize=(9, max(0.7, min(1.3, 16 / len(steps))) * len(steps) + 0.6), layout="constrained")
    rows = figure.subplots(len(steps), 1, squeeze=False)[:, 0]
    cells = 1 << n1
    for axes, step in zip(rows, steps, strict=True):
        size = float(max(1, *map(abs, step.values)))
        edges = np.arange(cells + 1)
        for j in range(cells):
            if step.pick == j:
                axes.axvspan(j, j + 1, color=CHOSEN, lw=0)
            elif step.candidates >> j & 1:
                axes.axvspan(j, j + 1, color=CANDIDATE, lw=0)
            elif step.excluded >> j & 1:
                axes.axvspan(j, j + 1, color="0.93", lw=0)
        axes.axhline(0, color="0.4", lw=0.8)
        axes.vlines(edges, -1.1, 1.1, color="0.8", lw=0.6)
        if len(step.control) > 2:
            axes.plot(np.linspace(0, cells, POINTS), curve(step.control) / size, color=LINE, lw=1.3)
        axes.plot(edges, np.array(step.values) / size, "o" if len(step.control) > 2 else "o-", color=LINE, ms=3, lw=1.0)
        axes.set_xlim(0, cells)
        axes.set_ylim(-1.1, 1.1)
        axes.set_yticks([])
        if step is steps[0]:
            axes.set_xticks(edges[:-1] + 0.5, range(cells), fontsize=7)
        else:
            axes.set_xticks([])
        axes.tick_params(length=0, top=True, bottom=False, labeltop=True, labelbottom=False)
        digit = f"digit {step.pick}" if step.pick >= 0 else "no cell"
        axes.set_ylabel(f"step {step.number}\n{digit}", fontsize=7, rotation=0, ha="right", va="center")
        for side in ("top", "right", "left", "bottom"):
            axes.spines[side].set_color("0.8")
    for above, below, step, following in zip(rows, rows[1:], steps, steps[1:], strict=False):
        if following.level == step.level + 1 and step.pick >= 0:
            for edge in (0, 1):
                start, stop = (step.pick + edge, -1.1), (cells * edge, 1.1)
                line = ConnectionPatch(start, stop, "data", "data", axesA=above, axesB=below, color=CHOSEN, lw=0.9)
                figure.add_artist(line)
    figure.suptitle(f"{title}; each row is the chosen cell of the row above, {n1 * count} digits in all", fontsize=9)
    figure.savefig(path, dpi=110)
