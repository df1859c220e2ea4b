# SPDX-License-Identifier: Apache-2.0
"""The curve of run time against error of one scene."""

from collections.abc import Sequence
from itertools import cycle
from pathlib import Path

from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

FLOOR = 1e-16  # errors below are drawn here
COLOURS = {"1": "#fdae6b", "2": "#f16913", "3": "#a63603", "4": "#5b1a02"}  # by n1


def plot(rows: Sequence, own: str, path: Path) -> None:
    """Nanoseconds a pixel against the error of 99.9 % of the pixels, a line for each method.

    rows   of one scene, with method, variant, p999, median, pixels, silhouette
    path   .png or .svg
    own    name of the method whose rules and digits have lines of their own
    A hollow mark has silhouette pixels that are wrong.
    """
    figure = Figure(figsize=(8, 5.5))
    axes = figure.subplots()
    lines: dict[str, list] = {}
    for row in rows:
        rule, *rest = row.variant.split(", ")
        name = f"{rule}, {rest[0]}" if row.method == own and "W" not in row.variant else row.method
        if row.method == own and "W" in row.variant:
            continue
        lines.setdefault(name, []).append(row)
    markers, colours = cycle("sD^v<>ph*XPd"), cycle(colormaps["tab20"].colors[::2] + colormaps["tab20"].colors[1::2])
    handles = []
    for name, some in lines.items():
        mine = some[0].method == own
        x = [max(row.p999, FLOOR) for row in some]
        y = [1e9 * row.median / row.pixels for row in some]
        certified = name.startswith("certified")
        colour = (COLOURS[name[-1]] if certified else "0.6") if mine else next(colours)
        marker, order, width = ("o", 3, 1.8) if mine else (next(markers), 2, 0.9)
        axes.plot(x, y, color=colour, lw=width, zorder=order)
        for a, b, row in zip(x, y, some, strict=True):
            axes.plot(a, b, marker, color=colour, mfc="white" if row.silhouette else colour, ms=5, zorder=order)
        handles.append(Line2D([], [], color=colour, marker=marker, lw=width, ms=5, label=name))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("error of the depth, 99.9 % of the pixels, scene units")
    axes.set_ylabel("ns a pixel, one thread")
    axes.set_title(
        f"{rows[0].scene}: run time against error (hollow: wrong silhouette pixels)", fontsize=10, loc="left"
    )
    axes.grid(True, which="major", color="0.9")
    axes.legend(handles=handles, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.savefig(path, dpi=110, bbox_inches="tight")
