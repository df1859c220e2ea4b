#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The paper's trade-off, steps against hardware: every design point of the sweep, placed, simulated, and compared.

    scripts/explore.py                        the sweep, two at a time; what was measured before is not measured again
    scripts/explore.py quadric --limit 4      the first four of a family
    scripts/explore.py --no-pnr               cells, clocks and errors, no place and route
    scripts/explore.py --scheduler tcp://host:8786   on the workers of a Dask cluster
    scripts/explore.py --write                renew docs/exploration.md, its picture and docs/exploration.json

A result is kept in build/explore as soon as it is there, by all that it depends on, so an interruption loses only what
was at work. Workers of a cluster need the same checkout with `scripts` on their PYTHONPATH; others are refused.
Writes explore.json, explore.csv and explore.png there, too. Exit status 0; 2: bad input, or a point failed.
"""

import argparse
import json
import re
import signal
import sys
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from exploration.designs import SCENE_OF, Design, all_designs
from exploration.measure import TOOLS, key, measure
from exploration.pareto import FRONTS, Point, front, point_of, recommended
from exploration.plot import plot
from raydix.blocks import show_table, write_table
from raydix.command import COUNT, status_of
from raydix.config import ConfigError
from raydix.image import csv_writer, text_writer, write_files
from raydix.progress import bars
from synth import SynthError, keep

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "explore"
PAGE = ROOT / "docs" / "exploration.md"
BASELINE = ROOT / "docs" / "exploration.json"
PICTURE = ROOT / "docs" / "images" / "exploration.png"
COLUMNS = (
    "engine",
    "LUT4",
    "FF",
    "DSP",
    "BRAM",
    "fmax, MHz",
    "Mray/s",
    "frames a second",
    "Mray/s per 1,000 LUT4",
    "latency, ns",
    "error 99.9 %",
    "silhouette",
    "on the front of",
)
GOALS = ("surfaces", "goal", "engine", "LUT4", "Mray/s", "frames a second", "latency, ns", "error 99.9 %")


@contextmanager
def executor(scheduler: str | None, jobs: int) -> Iterator[Executor]:
    """Where the design points are measured: threads that start the tools, or the workers of a Dask cluster.

    Raises OSError where there is no scheduler.
    """
    if scheduler is None:
        pool = ThreadPoolExecutor(jobs)
        try:
            yield pool
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            TOOLS.end()
        return
    from distributed import Client  # takes a second to import

    with Client(scheduler, timeout="10s") as client:
        pool = client.get_executor(pure=False)
        try:
            yield pool
        finally:
            pool.shutdown(wait=False)  # what is not finished is called off


def sweep(designs: list[Design], options) -> tuple[dict[Design, dict], list[str]]:
    """Results of the designs, in their order, and what failed; what is kept is not measured."""
    names = {design: key(design, options.pnr) for design in designs}
    kept = {design: options.out / f"{name}.json" for design, name in names.items()}
    missing = [] if options.kept else [design for design in designs if not kept[design].exists()]
    failed = []
    with bars() as bar:
        task = bar.add_task("design points", total=len(designs), completed=len(designs) - len(missing))
        if missing:
            with executor(options.scheduler, options.jobs) as pool:
                futures = {pool.submit(measure, d.as_dict(), names[d], options.pnr): d for d in missing}
                for future in as_completed(futures):
                    design = futures[future]
                    try:
                        kept[design].parent.mkdir(parents=True, exist_ok=True)
                        keep(kept[design], future.result())
                    except Exception as error:  # whatever a tool, a worker or its cluster raises
                        failed.append(f"{design.family} {design}: {error or type(error).__name__}")
                    bar.update(task, advance=1, description=f"{design.family} {design}")
    return {design: json.loads(path.read_text()) for design, path in kept.items() if path.exists()}, failed


def placed(results: dict[Design, dict]) -> list[Point]:
    """The designs that have a clock."""
    return [point_of(str(design), result) for design, result in results.items() if "fmax" in result]


def rows_of(points: list[Point]) -> list[list[str]]:
    """The table of a family."""
    fronts = {name: front(points, figures) for name, figures in FRONTS.items()}
    return [
        [
            p.name,
            f"{p.lut4:,}",
            f"{p.ff:,}",
            f"{p.dsp}",
            f"{p.bram}",
            f"{p.fmax:.1f}",
            f"{p.rate:.1f}",
            f"{p.frames:.1f}",
            f"{p.per_klut:.2f}",
            f"{p.latency:,.0f}",
            f"{p.error:.1e}",
            f"{p.silhouette}",
            ", ".join(name for name, best in fronts.items() if p in best),
        ]
        for p in points
    ]


def goals_of(points: list[Point], family: str) -> list[list[str]]:
    """What to take for which goal; nothing where none is placed."""
    found: list[list[str]] = []
    if not points:
        return found
    for goal, p in recommended(points).items():
        rates = [f"{p.rate:.1f}", f"{p.frames:.1f}"] if p else []
        figures = [p.name, f"{p.lut4:,}", *rates, f"{p.latency:,.0f}", f"{p.error:.1e}"] if p else ["none"]
        found.append([family, goal, *figures, *[""] * (6 - len(figures))])
    return found


def save(results: dict[Design, dict], points: list[Point], out: Path) -> None:
    """JSON, CSV and the picture."""
    writers = {
        out / "explore.json": text_writer(json.dumps(list(results.values()), indent=1) + "\n"),
        out / "explore.csv": csv_writer(Point._fields, points),
    }
    if points:
        writers[out / "explore.png"] = partial(plot, points)
    write_files(writers)


def publish(results: dict[Design, dict], points: list[Point], families: list[str]) -> None:
    """The page, its picture, and the results."""
    keep(BASELINE, list(results.values()))
    for family in families:
        write_table(PAGE, family, COLUMNS, rows_of([p for p in points if p.family == family]))
    goals = [row for family in families for row in goals_of([p for p in points if p.family == family], family)]
    write_table(PAGE, "goals", GOALS, goals)
    plot(points, PICTURE)


def scheduler(text: str) -> str:
    """An address of a scheduler: of a host with a port, or whatever distributed has found within this process."""
    match = re.fullmatch(r"(tcp|tls|ws|wss|ucx)://[^\s/]+:([0-9]{1,5})|inproc://\S+", text)
    if not match or match[2] and not 1 <= int(match[2]) <= 65535:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed: tcp://HOST:PORT, for example tcp://host:8786")
    return text


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("family", nargs="*", help=f"{', '.join(SCENE_OF)} (default: all)")
    parser.add_argument("--limit", type=COUNT, help="only so many points")
    parser.add_argument("--no-pnr", dest="pnr", action="store_false", help="no place and route")
    parser.add_argument("--kept", action="store_true", help="measure nothing: show what was measured so far")
    parser.add_argument("--jobs", type=COUNT, default=2, help="points at a time on this machine (default: 2)")
    parser.add_argument(
        "--scheduler", type=scheduler, metavar="tcp://HOST:PORT", help="of a Dask cluster that measures them"
    )
    parser.add_argument("--out", type=Path, default=BUILD, help="folder (default: build/explore)")
    parser.add_argument("--write", action="store_true", help="renew docs/exploration.md")
    options = parser.parse_args(arguments)
    for name in options.family:
        if name not in SCENE_OF:
            parser.error(f"family: found {name!r}; allowed: {', '.join(SCENE_OF)}")
    if options.write and (options.family or options.limit or not options.pnr):
        parser.error("--write: found with a part of the sweep; allowed: with all of it")
    return options


def main(arguments=None) -> int:
    """Measure, print, write; returns the exit status."""
    options = parse(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    designs = [d for d in all_designs() if not options.family or d.family in options.family][: options.limit]
    try:
        results, failed = sweep(designs, options)
        points = placed(results)
        save(results, points, options.out)
        families = list(dict.fromkeys(design.family for design in designs))
        if options.write and not failed:
            publish(results, points, families)
    except (ConfigError, SynthError, RuntimeError, ValueError, OSError) as error:
        print(f"explore: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"explore: interrupted; what was finished is kept in {options.out}", file=sys.stderr)
        return 130
    for family in families:
        mine = [p for p in points if p.family == family]
        if not mine:
            continue
        show_table(f"{family}: engines, scene {SCENE_OF[family]}", COLUMNS, rows_of(mine), ("engine",), 200)
    goals = [row for family in families for row in goals_of([p for p in points if p.family == family], family)]
    if goals:
        show_table("What to take", GOALS, goals, GOALS[:3], 160)
    print(f"{len(results)} design points, {len(points)} of them placed")
    for text in failed:
        print(f"explore: {text}", file=sys.stderr)
    return 2 if failed else 0


if __name__ == "__main__":
    sys.exit(status_of(main))
