# SPDX-License-Identifier: Apache-2.0
"""The fronts of the sweep as a picture: a row for each family, a column for each pair of figures."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure as Picture

from benchmarks.plot import COLOURS

from .pareto import ERROR, FRONTS, Point, front


def plot(points: Sequence[Point], path: Path) -> None:
    """Each design by its figures, coloured by n1, and the front as a line. ``path``: .png or .svg."""
    families = list(dict.fromkeys(p.family for p in points))
    picture = Picture(figsize=(13, 3.6 * len(families)), layout="constrained")
    grid = picture.subplots(len(families), len(FRONTS), squeeze=False)
    for row, family in zip(grid, families, strict=True):
        mine = [p for p in points if p.family == family]
        for axes, (name, (across, up)) in zip(row, FRONTS.items(), strict=True):
            best = sorted(front(mine, (across, up)), key=across.of)
            axes.plot([across.of(p) for p in best], [up.of(p) for p in best], color="0.7", lw=1, zorder=1)
            for n1, colour in COLOURS.items():
                some = [p for p in mine if p.name.split()[1] == n1]
                if some:
                    x, y = [across.of(p) for p in some], [up.of(p) for p in some]
                    axes.scatter(x, y, s=22, color=colour, label=f"n1 {n1}", zorder=2)
            if across is ERROR:
                axes.set_xscale("log")
                least, most = (f(across.of(p) for p in mine) for f in (min, max))
                axes.set_xlim(least / 3, most * 3)
            axes.set_xlabel(across.title)
            axes.set_ylabel(up.title)
            axes.set_title(f"{family}: {name}", fontsize=9, loc="left")
            axes.grid(True, which="major", color="0.92")
        row[0].legend(fontsize=7, frameon=False)
    picture.savefig(path, dpi=100)
