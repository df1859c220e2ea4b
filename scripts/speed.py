# SPDX-License-Identifier: Apache-2.0
"""How fast the golden model and the RTL simulation render a scene: medians of interleaved runs on this machine."""

import argparse
import statistics
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from raydix.compile import compile_scene
from raydix.config import Config
from raydix.golden import trace_golden
from raydix.rtl import RtlError, build, trace_rtl
from raydix.scene import SceneError, load_scene

ROOT = Path(__file__).resolve().parents[1]


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", nargs="?", type=Path, default=ROOT / "scenes" / "torus.toml")
    parser.add_argument("--runs", type=int, default=11, help="runs of each (default: 11)")
    parser.add_argument("--units", type=int, default=8, help="step units in the RTL (default: 8)")
    args = parser.parse_args()
    config = Config(units=args.units, rules="certified")
    try:
        scene = load_scene(args.scene)
        compiled = compile_scene(scene, config)
        build(config)
        # the compiler of the golden model works before the clock starts, and runs alternate, so that noise hits all
        runs = [
            (
                trace_golden(compiled, config, 1).seconds,
                trace_golden(compiled, config, 2).seconds,
                trace_rtl(compiled, config).seconds,
            )
            for _ in range(args.runs)
        ]
    except (SceneError, RtlError) as error:
        print(f"speed: {error}", file=sys.stderr)
        return 2
    pixels = scene.camera.width * scene.camera.height
    table = Table(title=f"{scene.name}, {scene.camera.width}×{scene.camera.height}, {args.runs} interleaved runs")
    for name in ("", "median, ms", "fastest, ms", "slowest, ms", "Mpixel/s (median)"):
        table.add_column(name, justify="right" if name else "left")
    medians = []
    for label, seconds in zip(
        ("golden, 1 thread", "golden, 2 threads", f"RTL, U = {args.units}"), zip(*runs, strict=True), strict=True
    ):
        median = statistics.median(seconds)
        medians.append(median)
        times = (f"{1e3 * t:.1f}" for t in (median, min(seconds), max(seconds)))
        table.add_row(label, *times, f"{pixels / median / 1e6:.2f}")
    Console().print(table)
    ratio = statistics.median(one / two for one, two, _ in runs)
    print(f"two threads against one, median of the runs' ratios: {ratio:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
