# SPDX-License-Identifier: Apache-2.0
"""Pictures of a descent: the indicator along the ray, the cell chosen in each step, and the last cells."""

from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np

from .config import Config
from .oracle_spiral import spiral_value
from .stress import bernstein

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402  (after the choice of the backend)

ROW = 1.7  # inches
POSITIVE, NEGATIVE, CHOSEN = "#dbe9f6", "#8fb3d9", "#d95f02"


class Case(NamedTuple):
    """One ray: control points ``b`` of an algebraic item, or a spiral and a chord h to e; what was found, and the root.

    t     digits, -1: none
    root  nearest exact root, nan: none
    """

    b: np.ndarray | None
    surface: object
    h: np.ndarray | None
    e: np.ndarray | None
    t: int
    root: float


def indicator(case: Case, t: np.ndarray) -> np.ndarray:
    """The case's indicator at parameters t (N) float64."""
    if case.b is not None:
        return bernstein(np.tile(np.asarray(case.b, np.int64), (len(t), 1)), t)
    assert case.h is not None and case.e is not None  # without control points there is a chord
    return spiral_value(case.surface, case.h + t[:, None] * (case.e - case.h))


def plot_case(axes, name: str, case: Case, config: Config) -> None:
    """Three axes: whole ray; one row of J cells for each step; some ulp about what was found."""
    whole, digits, last = axes
    ulp = 2.0**-config.digits
    t = np.linspace(0, 1, 801)
    f = indicator(case, t)
    found = (case.t + 0.5) * ulp if case.t >= 0 else case.root
    whole.axhline(0, color="0.7", lw=0.8)
    whole.plot(t, f, lw=1)
    whole.axvline(found, color=CHOSEN, lw=0.8)
    whole.set_yscale("symlog", linthresh=max(float(np.abs(f).max()) * 1e-4, 1e-300))
    whole.set_title(name, fontsize=8, loc="left")
    if np.isnan(found):
        return
    # the cells of each step, coloured by the sign at their ends
    cells, start = config.cells, 0.0
    prefix = int(found / ulp)
    for level in range(config.steps):
        size = float(cells) ** -(level + 1)
        ends = start + size * np.arange(cells + 1)
        positive = indicator(case, np.clip(ends, 0, 1)) > 0
        pick = prefix >> config.n1 * (config.steps - 1 - level) & (cells - 1)
        for j in range(cells):
            change = positive[j] != positive[j + 1]
            color = "#fdd0a2" if change else POSITIVE if positive[j] else NEGATIVE
            digits.barh(level, 1, left=j, color=color, edgecolor="white", height=0.9)
        digits.plot([pick, pick + 1], [level, level], color=CHOSEN, lw=2.5, solid_capstyle="butt")
        start += pick * size
    digits.set_ylim(config.steps - 0.5, -0.5)
    digits.set_title("step, cells: blue one sign, orange a change; chosen", fontsize=7, loc="left")
    near = np.linspace(-6, 6, 241)
    at = np.clip(found + near * ulp, 0, 1)
    g = indicator(case, at)
    last.axhline(0, color="0.7", lw=0.8)
    last.axvspan(-0.5, 0.5, color="#fdd0a2")
    last.plot(near, g, lw=1)
    if not np.isnan(case.root):
        off = (case.root - found) / ulp
        last.set_title(f"ulp about the hit; the root is at {off:+.3f}", fontsize=7, loc="left")
        if abs(off) < 6:
            last.axvline(off, color="k", lw=0.8)
    for axis in axes:
        axis.tick_params(labelsize=6)
    for axis in (whole, last):
        axis.yaxis.get_offset_text().set_fontsize(6)


def plot_cases(path: Path, cases: list[tuple[str, Case]], config: Config) -> None:
    """A row of :func:`plot_case` for each (name, case) into one PNG."""
    figure, rows = plt.subplots(len(cases), 3, figsize=(10, ROW * len(cases)), squeeze=False)
    for axes, (name, case) in zip(rows, cases, strict=True):
        plot_case(axes, name, case, config)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)
