#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run time against error: the golden model in many configurations, and what else a user would take, on the same rays.

    scripts/benchmark.py                      torus, hyperboloid, spiral, sphere, cyclide
    scripts/benchmark.py SCENE --size 320x240 --repeats 9
    scripts/benchmark.py --full --rtl         every scene with one surface, and the engines' clocks
    scripts/benchmark.py --write              renew docs/benchmarks.md, its pictures and its baseline, too; with --full
                                              its table of every scene, with --kept from the last run
    scripts/benchmark.py --check              compare ratios with the baseline; exit status 1 where one is lost

One thread each. All of a scene take turns, so noise hits everything, and a ratio is one of times of the same turn.
Error is that of the depth of the nearest hit against the oracle. Writes benchmarks.json, benchmarks.csv and a curve of
each scene (PNG, SVG) to build/bench. Exit status 0; 1: a ratio is lost (--check); 2: bad input, or a tool failed.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path

from benchmarks.clocks import COLUMNS as CLOCKS
from benchmarks.clocks import clocks, placed
from benchmarks.guard import lost
from benchmarks.plot import plot
from benchmarks.rows import RAYDIX, Row, measurable, measure
from benchmarks.tables import BEATEN, EVERY, LEFT, TABLE, beaten, cells, glance
from raydix.blocks import show_table, write_table
from raydix.command import COUNT, image_size, status_of
from raydix.config import ConfigError
from raydix.image import csv_writer, text_writer, write_files
from raydix.progress import bars
from raydix.rtl import RtlError
from raydix.scene import SceneError, load_scene

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
PAGE = ROOT / "docs" / "benchmarks.md"
BASELINE = ROOT / "docs" / "benchmarks.json"
OUT = ROOT / "build" / "bench"
CHOSEN = ("torus", "hyperboloid", "spiral", "sphere", "cyclide")
CHOSEN_PATHS = [SCENES / f"{name}.toml" for name in CHOSEN]


def save(rows: Sequence[Row], clock_rows, out: Path) -> None:
    """JSON, CSV and a picture of each scene."""
    writers = {out / "clocks.json": text_writer(json.dumps(clock_rows) + "\n")}
    if rows:
        text = json.dumps([asdict(row) for row in rows], indent=1) + "\n"
        writers[out / "benchmarks.json"] = text_writer(text)
        writers[out / "benchmarks.csv"] = csv_writer(TABLE, map(cells, rows))
    for scene in dict.fromkeys(row.scene for row in rows):
        curve = partial(plot, [r for r in rows if r.scene == scene], RAYDIX)
        writers |= {out / f"{scene}.{kind}": curve for kind in ("png", "svg")}
    write_files(writers)


def restore(out: Path) -> tuple[list[Row], list]:
    """What :func:`save` has written to the folder. Raises ValueError where there is nothing of this form."""
    path = out / "benchmarks.json"
    try:
        rows = [Row(**row) for row in json.loads(path.read_text())]
        glance(rows, clock_rows := json.loads((out / "clocks.json").read_text()))
    except (OSError, TypeError, ValueError, LookupError):
        raise ValueError(f"{path}, clocks.json: found no rows of this form; allowed: those of a run") from None
    return rows, clock_rows


def publish_every(rows: Sequence[Row], clock_rows) -> None:
    """The page's table of every scene. Raises ValueError where scenes or their clocks are missing."""
    wanted = {scene.name for path in SCENES.glob("*.toml") if measurable(scene := load_scene(path))}
    found = {row.scene for row in rows}
    if found != wanted or not clock_rows:
        raise ValueError(
            f"--write: found {len(found)} scenes, {len(clock_rows)} clocks; allowed: those of make bench-full"
        )
    write_table(PAGE, "every", EVERY, glance(rows, clock_rows))


def publish(rows: Sequence[Row], clock_rows) -> None:
    """The page, its pictures, its baseline."""
    if clock_rows:
        write_table(PAGE, "clocks", CLOCKS, clock_rows)
    if not rows:
        return
    write_table(PAGE, "times", TABLE, [cells(row) for row in rows])
    write_table(PAGE, "beaten", BEATEN, beaten(rows))
    for scene in CHOSEN[:3]:
        plot([r for r in rows if r.scene == scene], RAYDIX, ROOT / "docs" / "images" / f"benchmark-{scene}.png")
    write_files({BASELINE: text_writer(json.dumps([asdict(row) for row in rows]) + "\n")})


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path, help=f"scene files (default: {', '.join(CHOSEN)})")
    parser.add_argument("--full", action="store_true", help="every scene with one surface")
    parser.add_argument("--size", type=image_size, default=(None, None), metavar="WxH", help="instead of the scene's")
    parser.add_argument("--repeats", type=COUNT, default=7, help="turns (default: 7)")
    parser.add_argument("--rtl", action="store_true", help="clocks of the engines, too")
    parser.add_argument("--only-rtl", action="store_true", help="clocks of the engines, no times")
    parser.add_argument("--out", type=Path, default=OUT, help="folder (default: build/bench)")
    parser.add_argument("--kept", action="store_true", help="measure nothing; show what the last run kept")
    parser.add_argument("--write", action="store_true", help="renew docs/benchmarks.md; see above")
    parser.add_argument("--check", action="store_true", help="compare with the baseline")
    options = parser.parse_args(arguments)
    if options.check and options.only_rtl:
        parser.error("--check: found with --only-rtl; allowed: with times, whose ratios it compares")
    asked = options.scene, options.check, options.rtl, options.only_rtl, options.size != (None, None)
    if options.kept and any(asked):
        parser.error("--kept: found with something to measure; allowed: with --full, --out and --write")
    if options.kept and options.write and not options.full:
        parser.error("--kept: found with --write; allowed: with --full, for the table of every scene")
    if options.full and options.write and not (options.rtl or options.kept):
        parser.error("--write: found with --full; allowed: with --rtl or --kept, too: the table has both")
    if options.write and (options.scene or options.check or options.size != (None, None)):
        parser.error("--write: found with other scenes, another size or --check; allowed: as the page has it")
    return options


def scenes_of(options) -> list:
    """The scenes to be measured. Raises ValueError where one cannot be, SceneError where one is wrong."""
    paths = options.scene or (sorted(SCENES.glob("*.toml")) if options.full else CHOSEN_PATHS)
    scenes = [load_scene(path, *options.size) for path in paths]
    if options.full:
        return [scene for scene in scenes if measurable(scene)]
    for scene in scenes:
        if not measurable(scene):
            raise ValueError(f"{scene.path}: found another scene; allowed: one picture of one opaque surface")
    return scenes


def baseline() -> list[Row]:
    """The rows that were kept. Raises ValueError where there are none, or of an older form."""
    try:
        return [Row(**row) for row in json.loads(BASELINE.read_text())]
    except (OSError, TypeError, ValueError):
        raise ValueError(
            f"{BASELINE}: found no baseline of this form; allowed: one of make bench ARGS=--write"
        ) from None


def main(arguments=None) -> int:
    """Measure, print, write; returns the exit status."""
    options = parse(arguments)
    rows, clock_rows, missing = [], [], []
    try:
        scenes = [] if options.kept else scenes_of(options)
        if options.kept:
            rows, clock_rows = restore(options.out)
        before = baseline() if options.check else []
        if options.rtl or options.only_rtl:
            placed()
        with bars() as bar:
            hardware = options.rtl or options.only_rtl
            turns = 0 if options.only_rtl else 1 + options.repeats  # the first time compiles
            task = bar.add_task("turns", total=len(scenes) * (turns + hardware))

            def tick(text: str, turns: int) -> None:
                bar.update(task, description=text, advance=turns)

            for scene in scenes:
                if not options.only_rtl:
                    some, absent = measure(scene, options.repeats, tick)
                    rows, missing = rows + some, missing + absent
                if hardware:
                    tick(f"{scene.name}: RTL", 0)
                    clock_rows += clocks(scene)
                    tick(f"{scene.name}: RTL", 1)
                save(rows, clock_rows, options.out)
        if options.write:
            (publish_every if options.full else publish)(rows, clock_rows)
    except (SceneError, ConfigError, RtlError, RuntimeError, ValueError, OSError) as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"benchmark: interrupted; scenes that were finished are in {options.out}", file=sys.stderr)
        return 130
    for text in dict.fromkeys(missing):
        print(f"benchmark: left out: {text}", file=sys.stderr)
    if rows:
        show_table("Run time against error", TABLE, [cells(row) for row in rows], LEFT, 200)
        show_table("Faster than the certified rule at no larger error", BEATEN, beaten(rows), LEFT, 200)
        show_table("Least time over the golden model's at the same error", EVERY, glance(rows, clock_rows), LEFT, 200)
    if clock_rows:
        show_table("The engines, at the clock that they were placed at", CLOCKS, clock_rows, CLOCKS[:2], 200)
    if options.check:
        complaints = lost(rows, before)
        print("\n".join(complaints) or "no ratio is lost")
        return int(bool(complaints))
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
