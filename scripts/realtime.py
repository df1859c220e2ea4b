#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cycles of a frame of the processor, the clock that 60 frames a second take, and what skipping saves.

    scripts/realtime.py                       the scenes of the paper's figure 2, 1920x1080
    scripts/realtime.py SCENE --rings 4       one scene; parameters as those of raydix render
    scripts/realtime.py --skips               what each kind of skipping saves, instead, 320x240
    scripts/realtime.py --write               renew the table in docs/realtime.md, too

Cycles are those of the RTL under Verilator, counted by the processor itself. Every picture is compared with the golden
model's; exit status 1 where a bit differs.
"""

import argparse
import sys
from pathlib import Path

from raydix.blocks import show_table, write_table
from raydix.compile import compile_scene
from raydix.config import Config, ConfigError
from raydix.fit import families, frame_parameters
from raydix.golden import trace_golden
from raydix.processor import ALL, SKIPS, run_frames
from raydix.rtl import RtlError
from raydix.scene import SceneError, load_scene
from raydix.shade import compose

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "realtime.md"
FIGURE2 = [ROOT / "scenes" / f"{name}.toml" for name in ("torus", "hyperboloid", "spiral")]
RATE = 60  # frames a second
SPEED = ("scene", "size", "n1", "rings", "lanes", "pixels a beat", "rays", "steps", "cycles", "clock for 60 Hz, MHz",
         "steps / needed")  # fmt: skip
SAVED = ("scene", "all on", *(f"without {name}" for name in SKIPS), "all off", "saved")


def prepared(path, args):
    """Scene, words, configuration and the golden model's frame."""
    scene = load_scene(path, *args.size)
    config = Config(
        n1=args.n1, steps=24 // args.n1, units=1, rules="certified", lanes=args.lanes,
        vector_units=1, rings=args.rings, vector_rings=args.vector_rings, **families(scene),
        **frame_parameters(scene, args.beat),
    )  # fmt: skip
    compiled = compile_scene(scene, config)
    return scene, compiled, config, compose(scene, trace_golden(compiled, config, 2), config, config.layers)


def speed_row(path, args):
    """A row of the table, and whether the picture is the golden model's."""
    scene, compiled, config, frame = prepared(path, args)
    output = run_frames([(scene, compiled)], config)
    counted = output.counters
    # K steps for each visible hit of an opaque surface, one for each other ray that entered a ring
    visible = counted["visible"]
    needed = config.steps * visible + max(0, counted["rays"] - visible)
    units = config.rings if config.degree else config.vector_rings
    row = [scene.name, f"{args.size[0]}×{args.size[1]}", str(config.n1), str(units)]
    row += [str(config.lanes) if config.vecsum != "none" else "", str(config.beat)]
    row += [f"{counted[name]:,}" for name in ("rays", "steps", "cycles")]
    row += [f"{counted['cycles'] * RATE / 1e6:.1f}", f"{counted['steps'] / needed:.3f}"]
    return row, (output.rgb[0] == frame.rgb).all()


def saved_row(path, args):
    """Cycles with all kinds of skipping, without each, and without any."""
    scene, compiled, config, frame = prepared(path, args)
    cycles, same = [], True
    for skips in (ALL, *(ALL - {name} for name in SKIPS), frozenset()):
        output = run_frames([(scene, compiled)], config, skips=skips)
        same &= bool((output.rgb[0] == frame.rgb).all())
        cycles.append(output.counters["cycles"])
    return [scene.name, *(f"{c:,}" for c in cycles), f"{1 - cycles[0] / cycles[-1]:.0%}"], same


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path, help="scene files (default: the paper's figure 2)")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), metavar="WxH")
    parser.add_argument("--n1", type=int, default=3)
    parser.add_argument("--rings", type=int, default=4)
    parser.add_argument("--lanes", type=int)
    parser.add_argument("--vector-rings", type=int, default=1)
    parser.add_argument("--beat", type=int, default=2)
    parser.add_argument("--skips", action="store_true", help="what each kind of skipping saves")
    parser.add_argument("--write", action="store_true", help="renew the table in docs/realtime.md")
    args = parser.parse_args()
    args.size = args.size or ((320, 240) if args.skips else (1920, 1080))
    header, row_of, name = (SAVED, saved_row, "skips") if args.skips else (SPEED, speed_row, "speed")
    try:
        results = [row_of(path, args) for path in args.scene or FIGURE2]
    except (SceneError, ConfigError, RtlError) as error:
        print(f"realtime: {error}", file=sys.stderr)
        return 2
    rows = [row for row, _ in results]
    show_table("Cycles of a frame", header, rows, ("scene",), 160)
    if args.write:
        write_table(PAGE, name, header, rows)
    wrong = [row[0] for row, same in results if not same]
    if wrong:
        print(f"realtime: not the golden model's picture: {', '.join(wrong)}", file=sys.stderr)
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
