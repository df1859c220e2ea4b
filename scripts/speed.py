# SPDX-License-Identifier: Apache-2.0
"""How fast the golden model and the RTL simulation render a scene: medians of many runs on this machine."""

import argparse
import statistics
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from raydix.command import COUNT, status_of
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.progress import track
from raydix.rtl import build, trace_rtl
from raydix.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", nargs="?", type=Path, default=ROOT / "scenes" / "torus.toml")
    parser.add_argument("--runs", type=COUNT, default=21, help="runs of each (default: 21)")
    parser.add_argument("--units", type=COUNT, default=8, help="step units in the RTL (default: 8)")
    args = parser.parse_args()
    scene = load_scene(args.scene)
    config = Config(units=args.units, rules="certified", **families(scene))
    compiled = compile_scene(scene, config)
    build(config)
    # one and two threads take turns, so that noise hits both
    golden = [
        [trace_golden(compiled, config, n).seconds for n in (1, 2)] for _ in track(range(args.runs), "golden model")
    ]
    rtl = [trace_rtl(compiled, config).seconds for _ in track(range(max(1, args.runs // 4)), "RTL")]
    pixels = scene.camera.width * scene.camera.height
    table = Table(title=f"{scene.name}, {scene.camera.width}×{scene.camera.height}, {args.runs} runs")
    for name in ("", "median, ms", "fastest, ms", "slowest, ms", "Mpixel/s"):
        table.add_column(name, justify="right" if name else "left")
    one, two = zip(*golden, strict=True)
    sides = {"golden, 1 thread": one, "golden, 2 threads": two, "RTL": rtl}
    for label, seconds in sides.items():
        median = statistics.median(seconds)
        times = (f"{1e3 * t:.1f}" for t in (median, min(seconds), max(seconds)))
        table.add_row(label, *times, f"{pixels / median / 1e6:.2f}")
    Console().print(table)
    ratio = statistics.median(a / b for a, b in golden)
    print(f"two threads against one, median of the runs' ratios: {ratio:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
