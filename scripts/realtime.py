#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cycles of a frame of the processor, the clock that 60 frames a second take, and what skipping saves.

    scripts/realtime.py                       the paper's figure 2, 1920x1080, on the processors of `make pnr`
    scripts/realtime.py SCENE --rings 4       one scene, on a processor of its own; parameters as those of raydix render
    scripts/realtime.py --work                steps done over those needed, instead, of every scene, 1920x1080
    scripts/realtime.py --skips               what each kind of skipping saves, instead, of every scene, 320x240
    scripts/realtime.py --digits              what fewer digits change in the picture, instead, by the golden model
    scripts/realtime.py --write               renew the table in docs/realtime.md, too

Cycles are those of the RTL under Verilator, counted by the processor itself. Every picture is compared with the golden
model's; exit status 1 where a bit differs. The clock is that of the design point's row in docs/synthesis.md.
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from picture_error import picture_errors
from raydix.blocks import show_table, write_table
from raydix.command import COUNT, image_size, status_of, whole
from raydix.compile import compile_scene
from raydix.config import VECSUMS, Config
from raydix.fit import families, frame_parameters
from raydix.golden import trace_golden
from raydix.processor import ALL, SKIPS, run_frames
from raydix.progress import track
from raydix.render import steps_of
from raydix.scene import load_scene
from raydix.shade import compose
from raydix.vecsum import DROPS
from synth import PAGE as SIZES
from synth import POINTS

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "realtime.md"
SCENES = ROOT / "scenes"
BUILT = {"torus": "render-torus", "hyperboloid": "render-quadric", "spiral": "render-spiral"}  # scene: design point
RATE = 60  # frames a second
SPEED = ("scene", "size", "processor", "n1", "digits", "rings", "rays", "steps", "steps / needed", "cycles",
         "clock for 60 Hz, MHz", "LUT4", "placed, MHz", "frames a second")  # fmt: skip
WORK = ("scene", "rays", "visible layers", "steps", "steps / needed", "cycles")
FEWER = ("scene", "processor", "n1", "K", "digits", "W", "left away", "steps", "pixels that differ",
         "largest difference, levels", "PSNR, dB", "FLIP", "silhouette")  # fmt: skip
SAVED = ("scene", "steps / needed", "all on", *(f"without {name}" for name in SKIPS), "all off", "saved")


def point_config(point):
    """The configuration of a design point of ``scripts/synth.py``."""
    p = POINTS[point].parameters
    return Config(
        n1=p.get("N1", 3), steps=p.get("K", 8), width=p.get("W", 36), degree=p.get("D", 4),
        units=p.get("U", 1), rings=p.get("Rings", 1), rules="certified", vecsum=VECSUMS[p.get("Vecsum", 0)],
        lanes=p.get("Lanes"),
        vector_units=p.get("VectorUnits", 1), vector_drop=p.get("VectorDrop", 0),
        vector_rings=p.get("VectorRings", 1), surfaces=p["Surfaces"],
        clip=bool(p.get("Clip", 1)), halve_stages=p.get("HalveStages"), layers=p["Layers"],
        max_width=p["MaxWidth"], beat=p["Pixels"],
    )  # fmt: skip


def own_config(scene, args):
    """The smallest configuration for a scene, with the parameters asked for."""
    return Config(
        n1=args.n1, steps=24 // args.n1, units=1, rules="certified", lanes=args.lanes, rings=args.rings,
        vector_rings=args.vector_rings, **families(scene), **frame_parameters(scene, args.beat),
    )  # fmt: skip


def chosen(scene, args):
    """The design point for a scene, None where there is none or parameters are given, and the configuration."""
    point = None if args.own else BUILT.get(scene.name)
    return point, point_config(point) if point else own_config(scene, args)


def placed(point):
    """(LUT4, clock in MHz) of a design point's row in docs/synthesis.md, as texts; empty where there is none."""
    for line in SIZES.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0].strip() == point:
            return cells[2], cells[-1]
    return "", ""


def golden(scene, config):
    """The words of a scene, and the golden model's frame."""
    compiled = compile_scene(scene, config)
    return compiled, compose(scene, trace_golden(compiled, config, 2), config, config.layers)


def work(config, counted):
    """Steps done over needed: K for each visible layer, one for each other ray that entered a ring."""
    visible = counted["visible"]
    return f"{counted['steps'] / (config.steps * visible + max(0, counted['rays'] - visible)):.3f}"


def speed_rows(path, args):
    """The row of a scene, and whether the picture is the golden model's."""
    scene = load_scene(path, *args.size)
    point, config = chosen(scene, args)
    compiled, frame = golden(scene, config)
    output = run_frames([(scene, compiled)], config)
    counted = output.counters
    lut, clock = placed(point) if point else ("", "")
    rings = config.rings if config.degree else config.vector_rings
    row = [scene.name, f"{args.size[0]}×{args.size[1]}", point or "", str(config.n1), str(config.digits), str(rings)]
    row += [f"{counted['rays']:,}", f"{counted['steps']:,}", work(config, counted), f"{counted['cycles']:,}"]
    row += [f"{counted['cycles'] * RATE / 1e6:.1f}", lut, clock]
    row += [f"{float(clock) * 1e6 / counted['cycles']:.1f}" if clock else ""]
    return [row], (output.rgb[0] == frame.rgb).all()


def work_rows(path, args):
    """Steps done and needed on a processor of its own, and whether the picture is the golden model's."""
    scene = load_scene(path, *args.size)
    config = own_config(scene, args)
    compiled, frame = golden(scene, config)
    output = run_frames([(scene, compiled)], config)
    counted = output.counters
    row = [scene.name, *(f"{counted[name]:,}" for name in ("rays", "visible", "steps"))]
    row += [work(config, counted), f"{counted['cycles']:,}"]
    return [row], (output.rgb[0] == frame.rgb).all()


def saved_rows(path, args):
    """Cycles with all kinds of skipping, without each, and without any."""
    scene = load_scene(path, *args.size)
    config = own_config(scene, args)
    compiled, frame = golden(scene, config)
    cycles, same, ratio = [], True, ""
    for skips in (ALL, *(ALL - {name} for name in SKIPS), frozenset()):
        output = run_frames([(scene, compiled)], config, skips=skips)
        same &= bool((output.rgb[0] == frame.rgb).all())
        cycles.append(output.counters["cycles"])
        ratio = ratio or work(config, output.counters)
    return [[scene.name, ratio, *(f"{c:,}" for c in cycles), f"{1 - cycles[0] / cycles[-1]:.0%}"]], same


def fewer_rows(path, args):
    """Pictures of a design point with fewer and fewer steps, to 12 digits, beside that of 24 and all bits; no RTL."""
    scene = load_scene(path, *args.size)
    point, built = chosen(scene, args)
    n1, rows = built.n1, []
    all_steps = range(24 // n1, 12 // n1 - 1, -1 if n1 > 1 else -2)
    spiral = built.vecsum != "none"
    cases = [(steps, 0) for steps in all_steps] + [(all_steps[-2], drop) for drop in DROPS[1:] if spiral]
    _, finest = golden(scene, replace(built, steps=24 // n1, k_stop=None, width=36, vector_drop=0))
    for steps, drop in cases:
        config = replace(built, steps=steps, k_stop=None, vector_drop=drop)
        _, frame = golden(scene, config)
        apart = np.abs(frame.rgb.astype(int) - finest.rgb).max(axis=2)
        error = picture_errors(frame.rgb, finest.rgb)
        bits = ["" if spiral else str(config.width), str(drop) if spiral else ""]
        row = [scene.name, point or "", str(n1), str(steps), str(config.digits), *bits, f"{steps_of(frame).sum():,}"]
        row += [f"{(apart > 0).sum():,}", str(apart.max()), f"{error['psnr']:.1f}" if error["psnr"] else "same"]
        rows.append([*row, f"{error['flip']:.6f}", str(((frame.t < 0) != (finest.t < 0)).sum())])
    return rows, True


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path, help="scene files (default: the paper's figure 2, or all)")
    parser.add_argument("--size", type=image_size, metavar="WxH")
    parser.add_argument("--n1", type=whole(1, 4))
    parser.add_argument("--rings", type=COUNT)
    parser.add_argument("--lanes", type=COUNT)
    parser.add_argument("--vector-rings", type=COUNT)
    parser.add_argument("--beat", type=COUNT)
    table = parser.add_mutually_exclusive_group()
    table.add_argument("--work", action="store_true", help="steps done over those needed")
    table.add_argument("--skips", action="store_true", help="what each kind of skipping saves")
    table.add_argument("--digits", action="store_true", help="what fewer digits change in the picture")
    parser.add_argument("--write", action="store_true", help="renew the table in docs/realtime.md")
    args = parser.parse_args()
    defaults = {"n1": 3, "rings": 4, "lanes": None, "vector_rings": 1, "beat": 2}
    args.own = any(getattr(args, name) is not None for name in defaults)
    for name, value in defaults.items():
        setattr(args, name, value if getattr(args, name) is None else getattr(args, name))
    args.size = args.size or ((320, 240) if args.skips else (1920, 1080))
    header, rows_of, name = SPEED, speed_rows, "speed"
    if args.work:
        header, rows_of, name = WORK, work_rows, "work"
    if args.skips:
        header, rows_of, name = SAVED, saved_rows, "skips"
    if args.digits:
        header, rows_of, name = FEWER, fewer_rows, "digits"
    every = sorted(SCENES.glob("*.toml"))
    scenes = args.scene or (every if args.work or args.skips else [SCENES / f"{name}.toml" for name in BUILT])
    results = [rows_of(path, args) for path in track(scenes, "scenes")]
    rows = [row for found, _ in results for row in found]
    show_table("Cycles of a frame", header, rows, ("scene",), 200)
    if args.write:
        write_table(PAGE, name, header, rows)
    wrong = [found[0][0] for found, same in results if not same]
    if wrong:
        print(f"realtime: not the golden model's picture: {', '.join(wrong)}", file=sys.stderr)
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(status_of(main))
