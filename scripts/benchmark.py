#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run time against error: the golden model in many configurations, and what else a user would take, on the same rays.

    scripts/benchmark.py                      torus, hyperboloid, spiral, sphere, cyclide
    scripts/benchmark.py SCENE --size 320x240 --repeats 9
    scripts/benchmark.py --full --rtl         every scene with one surface, and the processor's clocks
    scripts/benchmark.py --write              renew docs/benchmarks.md, its pictures and its baseline, too
    scripts/benchmark.py --check              compare ratios with the baseline; exit status 1 where one is lost

One thread each. All of a scene take turns, so noise hits everything, and a ratio is one of times of the same turn.
Error is that of the depth of the nearest hit against the oracle. Writes benchmarks.json, benchmarks.csv and a curve of
each scene (PNG, SVG) to build/bench. Exit status 0; 1: a ratio is lost (--check); 2: bad input, or a tool failed.
"""

import argparse
import csv
import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress

from alternatives import methods_for, problem_of
from benchmark_plot import plot
from raydix.blocks import show_table, write_table
from raydix.compile import compile_scene
from raydix.config import Config, ConfigError
from raydix.fit import families, frame_parameters
from raydix.golden import trace_golden
from raydix.oracle import ideal_frame
from raydix.processor import run_frames
from raydix.rtl import RtlError
from raydix.scene import SceneError, load_scene
from raydix.shade import compose

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
PAGE = ROOT / "docs" / "benchmarks.md"
BASELINE = ROOT / "docs" / "benchmarks.json"
OUT = ROOT / "build" / "bench"
CHOSEN = ("torus", "hyperboloid", "spiral", "sphere", "cyclide")
CHOSEN_PATHS = [SCENES / f"{name}.toml" for name in CHOSEN]
DIGITS = (12, 16, 20, 24)  # of t, about; in whole steps
WIDTHS = (24, 28, 32)  # of control points, beside 36
RAYDIX = "Raydix, golden model"
REFERENCE = "certified, n1 3, K 8"
LOSS = 1.10  # a ratio to the baseline that is bad news
TABLE = (
    "scene",
    "method",
    "variant",
    "ms",
    "spread",
    "ns / pixel",
    "ratio",
    "error rms",
    "99.9 %",
    "max",
    "silhouette",
)
RTL = ("scene", "n1, K", "clocks", "clocks / pixel", "steps")


@dataclass
class Row:
    """A method with what it was set to: seconds of each turn, and its errors (scene units, and pixels)."""

    scene: str
    method: str
    variant: str
    pixels: int
    rms: float
    p999: float
    max: float
    silhouette: int
    seconds: list[float] = field(default_factory=list)
    ratio: float = float("nan")  # to the reference, median over the turns

    @property
    def median(self) -> float:
        """Seconds."""
        return statistics.median(self.seconds)

    @property
    def spread(self) -> float:
        """Half of the range of the middle half of the turns, relative to the median."""
        low, high = np.percentile(self.seconds, (25, 75))
        return float(high - low) / 2 / self.median


def errors(depth: np.ndarray, ideal: np.ndarray) -> dict:
    """Errors of depths (H, W), inf where nothing is hit, over the pixels where both hit; and where only one does."""
    hit, wanted = np.isfinite(depth), np.isfinite(ideal)
    both = hit & wanted
    error = np.abs(depth[both] - ideal[both]) if both.any() else np.array([np.nan])
    return {
        "rms": float(np.sqrt(np.mean(error**2))),
        "p999": float(np.percentile(error, 99.9)),
        "max": float(error.max()),
        "silhouette": int((hit != wanted).sum()),
    }


def configurations(scene) -> dict[str, Config]:
    """Configurations of the golden model by name: digits of a step and of t, both rules, widths."""
    fixed = dict(units=1, **families(scene))
    found = {}
    for n1 in (1, 2, 3, 4):
        for digits in DIGITS:  # k_stop: the same steps as with a smaller K, without another kernel to compile
            steps = digits // n1
            found[f"certified, n1 {n1}, K {steps}"] = Config(
                n1=n1, steps=24 // n1, k_stop=steps, rules="certified", **fixed
            )
    for n1 in (1, 2, 3, 4):
        found[f"paper, n1 {n1}, K {24 // n1}"] = Config(n1=n1, steps=24 // n1, rule="paper", rules="paper", **fixed)
    if fixed.get("degree", 4):
        for width in WIDTHS:
            found[f"{REFERENCE}, W {width}"] = Config(n1=3, steps=8, width=width, rules="certified", **fixed)
    return found


def golden(scene, config: Config) -> Callable[[], tuple[float, Callable[[], np.ndarray]]]:
    """A function that renders once: seconds in the core, and how to get the depth."""
    compiled = compile_scene(scene, config)

    def run():
        hits = trace_golden(compiled, config, 1)
        return hits.seconds, lambda: compose(scene, hits, config, config.layers).depth

    return run


def alternative(render, problem) -> Callable[[], tuple[float, Callable[[], np.ndarray]]]:
    """The same for one of the alternatives."""

    def run():
        begun = time.perf_counter()
        depth = render(problem)
        return time.perf_counter() - begun, lambda: depth

    return run


def measure(scene, repeats: int, tick: Callable[[str], None]) -> list[Row]:
    """All rows of a scene. ``tick`` is told what comes."""
    problem, ideal = problem_of(scene), ideal_frame(scene).depth
    runs = {(RAYDIX, name): golden(scene, config) for name, config in configurations(scene).items()}
    for method in methods_for(problem):
        for value in method.values:
            variant = f"{method.knob} {value:g}" if method.knob else ""
            runs[method.name, variant] = alternative(method.renderer(value), problem)
    rows = {}
    for key, run in runs.items():  # the first time compiles
        tick(f"{scene.name}: {' '.join(key)}")
        _, depth = run()
        rows[key] = Row(scene.name, *key, ideal.size, **errors(depth(), ideal))
    for number in range(repeats):
        tick(f"{scene.name}: turn {number + 1} of {repeats}")
        for key, run in runs.items():
            rows[key].seconds.append(run()[0])
    reference = rows[RAYDIX, REFERENCE].seconds
    for row in rows.values():
        row.ratio = statistics.median(a / b for a, b in zip(row.seconds, reference, strict=True))
    return list(rows.values())


def measurable(scene) -> bool:
    """Whether it is one picture of one surface."""
    return len(scene.surfaces) == 1 and not scene.cameras


def clocks(scene, digits_of_a_step=(1, 2, 3, 4)) -> list[list[str]]:
    """Clocks of a frame of the smallest processor for the scene, by simulation of the RTL, for each n1."""
    rows = []
    for n1 in digits_of_a_step:
        config = Config(
            n1=n1, steps=24 // n1, units=1, rules="certified", rings=4, **families(scene), **frame_parameters(scene, 2)
        )
        counted = run_frames([(scene, compile_scene(scene, config))], config).counters
        pixels = scene.camera.width * scene.camera.height
        cycles = counted["cycles"]
        rows.append([scene.name, f"{n1}, {24 // n1}", f"{cycles:,}", f"{cycles / pixels:.3f}", f"{counted['steps']:,}"])
    return rows


def cells(row: Row) -> list[str]:
    """A row of the table."""
    length = (f"{v:.1e}" for v in (row.rms, row.p999, row.max))
    times = f"{1e3 * row.median:.1f}", f"{row.spread:.0%}", f"{1e9 * row.median / row.pixels:.0f}", f"{row.ratio:.2f}"
    return [row.scene, row.method, row.variant, *times, *length, f"{row.silhouette:,}"]


def beaten(rows: list[Row]) -> list[list[str]]:
    """For each scene: alternatives that are faster than the certified rule is at any setting as good.

    As good: neither a larger 99.9 % error nor more silhouette pixels.
    """
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [r for r in rows if r.scene == scene and r.method == RAYDIX and r.variant.startswith("certified")]
        for row in (r for r in rows if r.scene == scene and r.method != RAYDIX):
            good = [r for r in own if r.p999 <= row.p999 and r.silhouette <= row.silhouette]
            best = min(good, key=lambda r: r.median, default=None)
            if best is None:
                found.append([scene, row.method, row.variant, "none as good", "", f"{row.p999:.1e}"])
            elif row.median < best.median:
                ratio = statistics.median(a / b for a, b in zip(row.seconds, best.seconds, strict=True))
                found.append([scene, row.method, row.variant, best.variant, f"{ratio:.2f}", f"{row.p999:.1e}"])
    return found


BEATEN = ("scene", "method", "variant", "fastest certified setting as good", "time over its time", "99.9 % error")


def lost(rows: list[Row], baseline: list[dict]) -> list[str]:
    """Golden-model times, each to those of the alternatives in its turn, that are worse than the baseline's.

    The measure is the geometric mean of the golden model's time over each alternative's. It must be above the
    baseline's by more than a tenth and both spreads.
    """

    def standing(some: list[Row], scene: str) -> tuple[float, float]:
        others = [r for r in some if r.scene == scene and r.method != RAYDIX]
        own = next(r for r in some if r.scene == scene and r.method == RAYDIX and r.variant == REFERENCE)
        return float(np.exp(np.mean([np.log(1 / r.ratio) for r in others]))), own.spread

    before = [Row(**row) for row in baseline]
    known = {row.scene for row in before}
    found = []
    for scene in dict.fromkeys(row.scene for row in rows if row.scene in known):
        (now, noise), (then, its) = standing(rows, scene), standing(before, scene)
        if now > then * (LOSS + noise + its):
            found.append(f"{scene}: {now / then:.2f} times the baseline; allowed: {LOSS + noise + its:.2f}")
    return found


def save(rows: list[Row], clock_rows, out: Path) -> None:
    """JSON, CSV and a picture of each scene."""
    out.mkdir(parents=True, exist_ok=True)
    (out / "benchmarks.json").write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n")
    with (out / "benchmarks.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(TABLE)
        writer.writerows(cells(row) for row in rows)
    if clock_rows:
        (out / "clocks.json").write_text(json.dumps(clock_rows) + "\n")
    for scene in dict.fromkeys(row.scene for row in rows):
        for kind in ("png", "svg"):
            plot([r for r in rows if r.scene == scene], RAYDIX, out / f"{scene}.{kind}")


def publish(rows: list[Row], clock_rows) -> None:
    """The page, its pictures, its baseline."""
    write_table(PAGE, "times", TABLE, [cells(row) for row in rows])
    write_table(PAGE, "beaten", BEATEN, beaten(rows))
    if clock_rows:
        write_table(PAGE, "clocks", RTL, clock_rows)
    for scene in CHOSEN[:3]:
        plot([r for r in rows if r.scene == scene], RAYDIX, ROOT / "docs" / "images" / f"benchmark-{scene}.png")
    BASELINE.write_text(json.dumps([asdict(row) for row in rows]) + "\n")


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path, help=f"scene files (default: {', '.join(CHOSEN)})")
    parser.add_argument("--full", action="store_true", help="every scene with one surface")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(None, None))
    parser.add_argument("--repeats", type=int, default=7, help="turns (default: 7)")
    parser.add_argument("--rtl", action="store_true", help="clocks of the processor, too")
    parser.add_argument("--out", type=Path, default=OUT, help="folder (default: build/bench)")
    parser.add_argument("--write", action="store_true", help="renew docs/benchmarks.md, its pictures and the baseline")
    parser.add_argument("--check", action="store_true", help="compare with the baseline")
    options = parser.parse_args(arguments)
    if options.repeats < 1:
        parser.error("--repeats: found less than 1; allowed: 1 or more")
    return options


def main(arguments=None) -> int:
    """Measure, print, write; returns the exit status."""
    options = parse(arguments)
    try:
        paths = options.scene or (sorted(SCENES.glob("*.toml")) if options.full else CHOSEN_PATHS)
        scenes = [load_scene(path, *options.size) for path in paths]
        if options.full:
            scenes = [scene for scene in scenes if measurable(scene)]
        rows, clock_rows = [], []
        with Progress(console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task("", total=None)
            for scene in scenes:
                rows += measure(scene, options.repeats, lambda text: bar.update(task, description=text))
                if options.rtl:
                    bar.update(task, description=f"{scene.name}: RTL")
                    clock_rows += clocks(scene)
        save(rows, clock_rows, options.out)
    except (SceneError, ConfigError, RtlError, ValueError, OSError) as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    left = ("scene", "method", "variant")
    show_table("Run time against error", TABLE, [cells(row) for row in rows], left, 200)
    show_table("Faster than the certified rule at no larger error", BEATEN, beaten(rows), left, 200)
    if clock_rows:
        show_table("Clocks of a frame, four rings", RTL, clock_rows, left, 160)
    if options.write:
        publish(rows, clock_rows)
    if options.check:
        complaints = lost(rows, json.loads(BASELINE.read_text()))
        print("\n".join(complaints) or "no ratio is lost")
        return int(bool(complaints))
    return 0


if __name__ == "__main__":
    sys.exit(main())
