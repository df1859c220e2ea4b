#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/method.md, drawn from what the golden model computes.

    scripts/figures.py             into build/figures
    scripts/figures.py --write     into docs/images

Exit status 0: written; 2: a file cannot be written.
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from raydix.cells import subdivide
from raydix.command import status_of
from raydix.compile import camera_of, clip_box, compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.image import write_files
from raydix.kernel import zeros
from raydix.progress import bars
from raydix.render import render_golden
from raydix.scene import load_scene
from raydix.trace_ray import follow

ROOT = Path(__file__).resolve().parents[1]
DARK, LIGHT, INK, RED = "#24406e", "#dbe6f6", "#1b1f27", "#c0392b"
PIXEL = 200, 130  # of the ray whose first step is drawn
WIDE = 44.0  # degrees: the whole of the box is in the picture


def cells_of(scene, config: Config, x: int, y: int):
    """The first step of a ray: control points of its segment and of each cell, the candidates, the choice."""
    (surface,) = compile_scene(scene, config).surfaces
    first = follow(surface, config, x, y)[0]
    degree = len(first.control) - 1
    values = zeros((degree << config.n1) + 1)
    values[: degree + 1] = first.control
    subdivide(values, degree, config.n1)
    cells = [values[j * degree : (j + 1) * degree + 1].astype(float) for j in range(config.cells)]
    return np.array(first.control, float), cells, first.candidates, first.pick


def draw_step(scene, config: Config, out: Path) -> None:
    """The control polygon of a ray, and those of its cells: which may hold a root, and which is chosen."""
    whole, cells, candidates, pick = cells_of(scene, config, *PIXEL)
    degree, count, scale = len(whole) - 1, config.cells, abs(whole).max()
    figure = Figure(figsize=(9, 6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(np.linspace(0, 1, degree + 1), whole / scale, "o--", color=DARK, linewidth=1, label="control points")
    above.set_title("the ray's segment: five control points, and the polynomial within their hull", fontsize=10)
    below.set_title("eight cells, by averages: only where signs differ can a root be; the first is taken", fontsize=10)
    for axes in (above, below):
        axes.axhline(0, color=INK, linewidth=0.8)
        for j in range(count + 1):
            axes.axvline(j / count, color="#cccccc", linewidth=0.6)
    for j, cell in enumerate(cells):
        t = np.linspace(j, j + 1, degree + 1) / count
        u = np.linspace(0, 1, 40)[:, None]
        weights = [1.0]
        for i in range(1, degree + 1):
            weights.append(weights[-1] * (degree - i + 1) / i)
        basis = np.hstack([w * u**i * (1 - u) ** (degree - i) for i, w in enumerate(weights)])
        above.plot((j + u[:, 0]) / count, basis @ cell / scale, color=RED, linewidth=1.5)
        may = candidates >> j & 1
        color = DARK if j == pick else "#6f93cf" if may else "#999999"
        if may:
            below.axvspan(j / count, (j + 1) / count, color=LIGHT, alpha=1.0 if j == pick else 0.5, zorder=0)
        below.plot(t, cell / scale, "o-", color=color, markersize=3.5, linewidth=1)
        below.text((j + 0.5) / count, 1.02, str(j), ha="center", va="bottom", fontsize=9, color=color,
                   transform=below.get_xaxis_transform())  # fmt: skip
    reach = 1.3 * max(abs(cell[[0, -1]]).max() for cell in cells) / scale
    below.set_ylim(-reach, reach)
    below.set_xlabel("t")
    below.title.set_position((0.5, 1.08))
    below.set_title(below.get_title(), pad=18, fontsize=10)
    for axes in (above, below):
        axes.set_ylabel("ΔR")
    figure.savefig(out, dpi=110)


def corners_on_screen(scene) -> tuple[np.ndarray, np.ndarray]:
    """Columns and rows of the eight corners of the first surface's box."""
    camera, surface = camera_of(scene), scene.surfaces[0]
    low, high, _ = clip_box(surface)
    low, high = (np.array(v.tolist(), float)[:, 0] for v in (low, high))
    axes = np.array([v.tolist() for v in (camera.right, camera.up, camera.forward)], float)[..., 0]
    eye = np.array(camera.eye.tolist(), float)[:, 0]
    local = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1)
    world = surface.scale * np.array(surface.matrix) @ local + np.array(surface.center)[:, None]
    x, y, z = axes @ (world - eye[:, None])
    return x / z / float(camera.pixel) + camera.width / 2, camera.height / 2 - y / z / float(camera.pixel)


def draw_rectangle(scene, config: Config, out: Path) -> None:
    """A picture with the rectangle that is walked, and that of the surface's box, which would be twice as large."""
    scene = replace(scene, camera=scene.camera.model_copy(update={"vfov": WIDE}))
    frame = render_golden(scene, config)
    (left, top, right, bottom), (columns, rows) = frame.hits.compiled.surfaces[0].rect, corners_on_screen(scene)
    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    axes = figure.subplots()
    axes.imshow(frame.rgb, extent=(0, scene.camera.width, scene.camera.height, 0))
    box = columns.min(), rows.min(), columns.max(), rows.max()
    for (x0, y0, x1, y1), color, style, label in (
        (box, "#f2c14e", "--", "of the box"),
        ((left, top, right + 1, bottom + 1), "white", "-", "of what can be seen"),
    ):
        axes.plot([x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0], style, color=color, linewidth=1.5, label=label)
    axes.set_xlim(0, scene.camera.width)
    axes.set_ylim(scene.camera.height, 0)
    axes.legend(loc="lower right", fontsize=8, title="rectangle", title_fontsize=8, facecolor="#888888")
    axes.set_axis_off()
    figure.savefig(out, dpi=110)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "figures", help="folder (default: build/figures)")
    parser.add_argument("--write", action="store_true", help="renew those in docs/images")
    args = parser.parse_args()
    out = ROOT / "docs" / "images" if args.write else args.out
    scene = load_scene(ROOT / "scenes" / "torus.toml")
    config = Config(**families(scene))
    figures = {"method-step": draw_step, "method-rectangle": draw_rectangle}
    with bars() as shown:
        task = shown.add_task("figures", total=len(figures))

        def writer(draw):
            def write(work):
                draw(scene, config, work)
                shown.advance(task)

            return write

        paths = write_files({out / f"{name}.png": writer(draw) for name, draw in figures.items()})
    print("\n".join(map(str, paths)))
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
