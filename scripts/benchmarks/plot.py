# SPDX-License-Identifier: Apache-2.0
"""The curve of run time against error of one scene."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

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
    markers = iter("sD^v<>ph*XPd")
    for name, some in lines.items():
        mine = some[0].method == own
        x = [max(row.p999, FLOOR) for row in some]
        y = [1e9 * row.median / row.pixels for row in some]
        certified = name.startswith("certified")
        colour = (COLOURS[name[-1]] if certified else "0.6") if mine else None
        (line,) = axes.plot(x, y, color=colour, lw=1.8 if mine else 0.9, zorder=3 if mine else 2, label=name)
        marker = "o" if mine else next(markers)
        for a, b, row in zip(x, y, some, strict=True):
            face = "white" if row.silhouette else line.get_color()
            axes.plot(a, b, marker, color=line.get_color(), mfc=face, ms=5, zorder=4 if mine else 2)
        if len(some) == 1 or not mine:
            line.set_marker(marker)
            line.set_markersize(0)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("error of the depth, 99.9 % of the pixels, scene units")
    axes.set_ylabel("ns a pixel, one thread")
    axes.set_title(
        f"{rows[0].scene}: run time against error (hollow: wrong silhouette pixels)", fontsize=10, loc="left"
    )
    axes.grid(True, which="major", color="0.9")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.savefig(path, dpi=110, bbox_inches="tight")
