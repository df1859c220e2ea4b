#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Render scenes by the golden model and print how far the images are from the ideal scenes in float64.

    scripts/accuracy.py                               every scene of scenes/
    scripts/accuracy.py scenes/torus.toml --n1 4 --steps 6 --max-ulp 2

Exit status 0: every scene within the limits; 1: a limit exceeded; 2: bad input, or nothing to measure.
"""

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from raydix.accuracy import DepthErrors, depth_errors
from raydix.blocks import write_table
from raydix.command import INTEGER, above, image_size, status_of, whole
from raydix.config import RULES, Config
from raydix.fit import families
from raydix.image import text_writer, write_files
from raydix.oracle import ideal_frame
from raydix.progress import track
from raydix.render import render_golden
from raydix.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
COLUMNS = (
    "scene",
    "size",
    "hit\npixels",
    "silhouette\ndifferent",
    "other\nsurface",
    "error\nrms",
    "error\n99.9 %",
    "error\nmax",
    "one ulp\nof t",
    "in ulp\nrms",
    "in ulp\n99.9 %",
    "in ulp\nmax",
)


@dataclass(frozen=True)
class Measured:
    """One row of the table."""

    scene: str
    width: int
    height: int
    errors: DepthErrors


def main(arguments=None):
    """Measure, print, compare with the limits; returns the exit status."""
    options = parse(arguments)
    scenes = options.scene or sorted(SCENES.glob("*.toml"))
    rows = [measure(scene, options) for scene in track(scenes, "scenes")]

    Console(width=None if sys.stdout.isatty() else 160).print(table(rows))
    if options.json:
        write_files({options.json: text_writer(json.dumps([as_json(row, options) for row in rows], indent=2) + "\n")})

    if options.write:
        header = [column.replace("\n", " ") for column in COLUMNS]
        write_table(ROOT / "docs" / "accuracy.md", "scenes", header, list(cells(rows)))

    complaints = [f"{row.scene}: {text}" for row in rows for text in exceeded(row.errors, options)]
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    return 1 if complaints else 0


def parse(arguments):
    """The command line."""
    reference = Config()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path, help="scene files (default: all of scenes/)")
    parser.add_argument("--rule", choices=RULES, default=reference.rule)
    parser.add_argument("--n1", type=INTEGER, default=reference.n1, help="digits per step")
    parser.add_argument("--steps", type=INTEGER, default=reference.steps, help="steps K")
    parser.add_argument("--width", type=INTEGER, default=reference.width, help="bits W of a control point")
    parser.add_argument("--size", type=image_size, default=(None, None), metavar="WxH", help="image size")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers to FILE, too")
    parser.add_argument("--write", action="store_true", help="renew the table in docs/accuracy.md")
    limits = parser.add_argument_group("limits per scene (exit status 1 when exceeded)")
    limits.add_argument("--max-silhouette", type=whole(0), default=0, metavar="PIXELS")
    limits.add_argument("--max-ulp", type=above(0), metavar="ULP", help="largest error in ulp")
    limits.add_argument("--max-depth", type=above(0), metavar="LENGTH", help="largest depth error")
    limits.add_argument("--max-rms", type=above(0), metavar="LENGTH", help="rms depth error")
    return parser.parse_args(arguments)


def measure(path, options):
    """Render one scene and compare it with the ideal one."""
    scene = load_scene(path, *options.size)
    # one step unit: the number of units changes the speed of the hardware, not the image
    config = Config(
        rule=options.rule, n1=options.n1, steps=options.steps, width=options.width, units=1, **families(scene)
    )
    errors = depth_errors(render_golden(scene, config), ideal_frame(scene))
    return Measured(path.stem, scene.camera.width, scene.camera.height, errors)


def cells(rows):
    """The text of each row's cells."""
    for row in rows:
        e, image = row.errors, f"{row.width}×{row.height}"
        counts = (f"{n:,}" for n in (e.hit, e.silhouette, e.other))
        lengths = (f"{x:.2e}" for x in (e.rms, e.p999, e.max, e.ulp))
        ulps = (f"{x:.3f}" for x in (e.ulp_rms, e.ulp_p999, e.ulp_max))
        yield [row.scene, image, *counts, *lengths, *ulps]


def table(rows):
    """All rows as a table for the terminal."""
    result = Table(title="golden model against the ideal scene (depth error in scene units and in ulp of t)")
    for column in COLUMNS:
        result.add_column(column, justify="left" if column == "scene" else "right")
    for row in cells(rows):
        result.add_row(*row)
    return result


def as_json(row, options):
    """One row for the JSON file."""
    head = {"scene": row.scene, "width": row.width, "height": row.height, "rule": options.rule}
    head |= {"n1": options.n1, "steps": options.steps, "control_point_bits": options.width}
    return head | row.errors.as_json()


def exceeded(errors, options):
    """The limits this scene does not keep, as text; a number that could not be measured keeps none."""
    limits = (
        ("silhouette pixels different", errors.silhouette, options.max_silhouette),
        ("largest error in ulp", errors.ulp_max, options.max_ulp),
        ("largest depth error", errors.max, options.max_depth),
        ("rms depth error", errors.rms, options.max_rms),
    )
    return [
        f"{name} {value:.6g}, allowed {limit:.6g}"
        for name, value, limit in limits
        if limit is not None and not value <= limit
    ]


if __name__ == "__main__":
    sys.exit(status_of(main))
