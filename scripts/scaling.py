#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How time grows with pixels, surfaces and depth complexity, and what a processor with unneeded parts loses.

    scripts/scaling.py                  all four tables, with clocks of the processor by simulation of the RTL
    scripts/scaling.py surfaces depth   some of them
    scripts/scaling.py --no-rtl         the golden model only
    scripts/scaling.py --write          renew docs/benchmarks.md and its picture, too

Every picture of the RTL is compared with the golden model's. Exit status 0; 1: a bit differs; 2: bad input, or a tool
failed.
"""

import argparse
import math
import statistics
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from raydix.blocks import show_table, write_table
from raydix.command import COUNT, status_of
from raydix.compile import compile_scene
from raydix.config import Config, ConfigError
from raydix.fit import families, frame_parameters
from raydix.golden import trace_golden
from raydix.processor import run_frames
from raydix.progress import track
from raydix.rtl import RtlError
from raydix.scene import Scene, SceneError, load_scene
from raydix.shade import compose

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "benchmarks.md"
PICTURE = ROOT / "docs" / "images" / "scaling.png"
TORUS = ROOT / "scenes" / "torus.toml"
SIZES = (160, 120), (320, 240), (640, 480), (1280, 960)
COUNTS = (1, 2, 4, 8, 16, 32, 64)
FRAME = 320, 240
COLUMNS = (
    "what grows",
    "how much",
    "golden model, ms",
    "ns / pixel",
    "clocks",
    "clocks / pixel",
    "rays",
    "steps",
    "behind a hit",
)
LOSES = ("processor", "clocks", "steps", "golden model, ms")
CAMERA = """
[camera]
eye = [0.0, -8.0, 0.0]
look_at = [0.0, 0.0, 0.0]
up = [0.0, 0.0, 1.0]
vfov = 30.0
width = {0}
height = {1}
[light]
direction = [-0.36, -0.80, 0.48]
ambient = 0.1
[background]
color = [0.0, 0.0, 0.0]
"""
SPHERE = """
[[surface]]
type = "sphere"
R = {0}
center = {1}
color = [0.9, 0.5, 0.2]
"""


@dataclass
class Task:
    """A frame to be measured: what grows, how much, scene and configuration."""

    kind: str
    label: str
    size: int
    scene: Scene
    config: Config


def scene_of(spheres: list[tuple[float, list[float]]], folder: Path) -> Scene:
    """A scene of spheres (radius, centre)."""
    path = folder / f"spheres-{len(spheres)}.toml"
    path.write_text(CAMERA.format(*FRAME) + "".join(SPHERE.format(*sphere) for sphere in spheres))
    return load_scene(path)


def beside(count: int) -> list[tuple[float, list[float]]]:
    """Spheres side by side that cover the same part of the picture, whatever their number."""
    edge = math.ceil(math.sqrt(count))
    pitch = 3.6 / edge
    places = [((i % edge + 0.5) * pitch - 1.8, 1.8 - (i // edge + 0.5) * pitch) for i in range(count)]
    radius = 1.4 / math.sqrt(count) / 2 * min(1.0, pitch * math.sqrt(count) / 1.5)
    return [(radius, [x, 0.0, z]) for x, z in places]


def behind(count: int, nearest_first: bool) -> list[tuple[float, list[float]]]:
    """Spheres one behind another that cover the same pixels: radius in proportion to the distance."""
    spheres = []
    for i in range(count):
        y = -2.0 + 4.0 * i / max(1, count - 1)
        spheres.append((0.15 * (y + 8.0), [0.0, y, 0.0]))
    return spheres if nearest_first else spheres[::-1]


def smallest(scene: Scene, **more) -> Config:
    """The smallest processor for a scene with four rings, or one with more."""
    fixed = dict(units=1, rings=4, rules="certified", lanes=1) | families(scene) | frame_parameters(scene, 2)
    return Config(**fixed | more)


def tasks(kinds, folder: Path) -> Iterator[Task]:
    """Every frame of the kinds asked for."""
    if "pixels" in kinds:
        for width, height in SIZES:
            scene = load_scene(TORUS, width, height)
            yield Task("pixels", f"{width}×{height}", width * height, scene, smallest(scene, max_width=SIZES[-1][0]))
    for kind, make in (
        ("surfaces", beside),
        ("depth, nearest first", lambda count: behind(count, True)),
        ("depth, farthest first", lambda count: behind(count, False)),
    ):
        if kind.split(",")[0] in kinds:
            for count in COUNTS:
                scene = scene_of(make(count), folder)
                yield Task(kind, str(count), count, scene, smallest(scene, surfaces=64))
    if "unneeded" in kinds:
        scene = load_scene(TORUS, *FRAME)
        yield Task("unneeded", "smallest for the torus", 0, scene, smallest(scene))
        yield Task("unneeded", "64 surfaces", 1, scene, smallest(scene, surfaces=64))
        yield Task("unneeded", "boxes", 2, scene, smallest(scene, clip=True))
        yield Task("unneeded", "both rules", 3, scene, smallest(scene, rules="both"))
        yield Task("unneeded", "8 layers", 4, scene, smallest(scene, layers=8))
        yield Task("unneeded", "every spiral", 5, scene, smallest(scene, vecsum="general"))
        everything = dict(surfaces=64, clip=True, rules="both", layers=8, vecsum="general")
        yield Task("unneeded", "all of these", 6, scene, smallest(scene, **everything))


def measure(task: Task, repeats: int, rtl: bool) -> tuple[float, dict]:
    """Seconds of the golden model on one thread, median; counters of the processor.

    Raises RuntimeError where the pictures differ.
    """
    compiled = compile_scene(task.scene, task.config)
    runs = [trace_golden(compiled, task.config) for _ in range(repeats)]
    counters = {}
    if rtl:
        output = run_frames([(task.scene, compiled)], task.config)
        frame = compose(task.scene, runs[0], task.config, task.config.layers)
        if (output.rgb[0] != frame.rgb).any():
            raise RuntimeError(f"{task.kind} {task.label}: the pictures of RTL and golden model differ")
        counters = output.counters
    return statistics.median(run.seconds for run in runs), counters


def row(task: Task, seconds: float, counters: dict) -> list[str]:
    """A row of the table."""
    pixels = task.scene.camera.width * task.scene.camera.height
    cells = [task.kind, task.label, f"{1e3 * seconds:.1f}", f"{1e9 * seconds / pixels:.0f}"]
    if not counters:
        return cells + [""] * 5
    ended = counters["skipped_depth"] + counters["skipped_cells"]
    clocks = counters["cycles"]
    return [
        *cells,
        f"{clocks:,}",
        f"{clocks / pixels:.2f}",
        *(f"{counters[n]:,}" for n in ("rays", "steps")),
        f"{ended:,}",
    ]


def loses(task: Task, seconds: float, counters: dict) -> list[str]:
    """A row of the table of unneeded parts."""
    counted = [f"{counters[name]:,}" for name in ("cycles", "steps")] if counters else ["", ""]
    return [task.label, *counted, f"{1e3 * seconds:.1f}"]


def plot(measured: list[tuple[Task, float, dict]], path: Path) -> None:
    """Time and clocks against what grows, relative to the first of each kind."""
    kinds = list(dict.fromkeys(task.kind for task, *_ in measured if task.kind != "unneeded"))
    picture = Figure(figsize=(4.2 * len(kinds), 3.6), layout="constrained")
    for axes, kind in zip(picture.subplots(1, len(kinds), squeeze=False)[0], kinds, strict=True):
        some = [(t.size, seconds, c) for t, seconds, c in measured if t.kind == kind]
        size = [s[0] for s in some]
        axes.plot(size, [s[1] / some[0][1] for s in some], "o-", color="#a63603", label="golden model, time")
        if some[0][2]:
            axes.plot(
                size,
                [s[2]["cycles"] / some[0][2]["cycles"] for s in some],
                "s-",
                color="0.3",
                label="processor, clocks",
            )
        axes.plot(size, [s / size[0] for s in size], ":", color="0.7", label="in proportion")
        axes.set_xscale("log", base=2)
        axes.set_yscale("log", base=2)
        axes.set_title(f"{kind}, to the first", fontsize=9, loc="left")
        axes.legend(fontsize=7, frameon=False)
        axes.grid(True, color="0.92")
    picture.savefig(path, dpi=100)


KINDS = ("pixels", "surfaces", "depth", "unneeded")


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", nargs="*", help=f"{', '.join(KINDS)} (default: all)")
    parser.add_argument("--repeats", type=COUNT, default=7, help="runs of the golden model (default: 7)")
    parser.add_argument("--no-rtl", dest="rtl", action="store_false", help="the golden model only")
    parser.add_argument("--write", action="store_true", help="renew docs/benchmarks.md and its picture")
    options = parser.parse_args(arguments)
    for kind in options.kind:
        if kind not in KINDS:
            parser.error(f"kind: found {kind!r}; allowed: {', '.join(KINDS)}")
    if options.repeats < 1:
        parser.error(f"--repeats: found {options.repeats}; allowed: 1 or more")
    if options.write and (options.kind or not options.rtl):
        parser.error("--write: found with a part; allowed: with all four tables and the RTL")
    return options


def main(arguments=None) -> int:
    """Measure, print, write; returns the exit status."""
    options = parse(arguments)
    kinds, measured = options.kind or KINDS, []
    try:
        with tempfile.TemporaryDirectory() as folder:
            for task in track(list(tasks(kinds, Path(folder))), "frames"):
                measured.append((task, *measure(task, options.repeats, options.rtl)))
        grown = [row(*m) for m in measured if m[0].kind != "unneeded"]
        lost = [loses(*m) for m in measured if m[0].kind == "unneeded"]
        if grown:
            show_table(f"What grows, {FRAME[0]}×{FRAME[1]}", COLUMNS, grown, COLUMNS[:1], 160)
        if lost:
            show_table("Parts that the torus does not need", LOSES, lost, LOSES[:1], 120)
        if options.write:
            write_table(PAGE, "scaling", COLUMNS, grown)
            write_table(PAGE, "unneeded", LOSES, lost)
            plot(measured, PICTURE)
    except (SceneError, ConfigError, RtlError, OSError) as error:
        print(f"scaling: {error}", file=sys.stderr)
        return 2
    except RuntimeError as error:
        print(f"scaling: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
