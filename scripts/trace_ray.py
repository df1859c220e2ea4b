#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Follow the ray of one pixel, step by step, through golden model and RTL, and draw it.

    scripts/trace_ray.py scenes/torus.toml --pixel 300,140
    scripts/trace_ray.py SCENE --pixel X,Y --surface 2 --n1 2 --rule paper
    scripts/trace_ray.py SCENE --pixel X,Y --no-rtl

For each surface whose rectangle has the pixel: what each step saw and chose, with t as a number and as digits, and
whether the RTL's step unit gave back the same: the processor renders a frame of this one pixel, and skips nothing.
Options choose it as in raydix render. Writes <scene>-<x>-<y>-surface<i>.png, and the waveform beside it.
Exit status 0; 1: RTL and golden model differ, the first step and signal that do are named; 2: bad input.
"""

import argparse
import re
import sys
from functools import partial
from pathlib import Path

from raydix.blocks import show_table
from raydix.command import status_of, whole
from raydix.compile import CompiledFrame, CompiledSurface, compile_scene
from raydix.config import Config, ConfigError
from raydix.image import check_folder, write_files
from raydix.localise import Followed, follow_both, surfaces_at
from raydix.options import add_scene_options, config_of, scene_of
from raydix.progress import working
from raydix.rtl import TOP, build
from raydix.trace_plot import plot_ray
from raydix.trace_ray import Step, follow

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "build" / "trace"
COLUMNS = (
    "step", "digits so far", "candidates", "excluded", "digit", "waits at", "t", "camera depth", "then",
    "control points", "RTL",
)  # fmt: skip


def pixel(text: str) -> tuple[int, int]:
    """X,Y."""
    match = re.fullmatch(r"(\d{1,5}),(\d{1,5})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed: X,Y, for example 300,140")
    return int(match[1]), int(match[2])


def digits(t: int, config: Config, level: int) -> str:
    """The digits of t that are fixed, one for each step."""
    levels = range(config.steps - config.k_stop, level)
    return " ".join(str(t >> config.n1 * (config.steps - 1 - k) & config.cells - 1) for k in levels) or "–"


def rows_of(steps: list[Step], differences: list[str], surface: CompiledSurface, config: Config) -> list[list[str]]:
    """The table."""

    def cells(mask: int) -> str:
        return " ".join(str(j) for j in range(config.cells) if mask >> j & 1) or "–"

    whole = 2**config.digits
    rows = []
    for step, other in zip(steps, differences, strict=True):
        scene_depth = surface.near + (surface.far - surface.near) * step.t / whole
        rows.append(
            [
                str(step.number),
                digits(step.start, config, step.level),
                cells(step.candidates),
                cells(step.excluded),
                str(step.pick) if step.pick >= 0 else "none",
                f"{step.next_t / whole:.6f}" if step.next_t >= 0 else "–",
                f"{step.t / whole:.9f}",
                f"{scene_depth:.6f}",
                step.status,
                " ".join(f"{v:+.2e}" for v in step.control),
                other or "same",
            ]
        )
    return rows


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="scene file (TOML)")
    parser.add_argument("--pixel", type=pixel, required=True, metavar="X,Y", help="column and row, from 0")
    parser.add_argument("--surface", type=whole(0), metavar="I", help="only this surface")
    add_scene_options(parser)
    parser.set_defaults(units=1)  # one is easier to read in a waveform
    parser.add_argument("--no-rtl", dest="rtl", action="store_false", help="the golden model only")
    parser.add_argument("--out", type=Path, default=OUT, metavar="DIR", help="folder (default: build/trace)")
    return parser.parse_args(arguments)


def chosen(compiled: CompiledFrame, args) -> list[CompiledSurface]:
    """The surfaces whose rectangles have the pixel. Raises ConfigError where none has."""
    x, y = args.pixel
    if not (x < compiled.width and y < compiled.height):
        raise ConfigError(f"--pixel: found {x},{y}; allowed: 0,0 to {compiled.width - 1},{compiled.height - 1}")
    wanted = surfaces_at(compiled, x, y, args.surface)
    if not wanted:
        others = ", ".join(str(s.index) for s in surfaces_at(compiled, x, y, None))
        if not others:
            raise ConfigError(f"--pixel: found {x},{y}, where no surface can be; allowed: another pixel")
        raise ConfigError(f"--surface: found {args.surface}, which cannot be at {x},{y}; allowed there: {others}")
    return wanted


def main(arguments=None) -> int:
    """Follow, print, draw; returns the exit status."""
    args = parse(arguments)
    scene = scene_of(args, args.scene)
    config = config_of(args, scene)
    compiled = compile_scene(scene, config)
    surfaces = chosen(compiled, args)
    check_folder(args.out)
    if args.rtl:
        with working("building the RTL with Verilator (about two minutes, nothing if it stands)", "trace_ray"):
            build(config, "vcd", TOP)
    x, y = args.pixel
    differ = 0
    for surface in surfaces:
        stem = args.out / f"{scene.name}-{x}-{y}-surface{surface.index}"
        picture, wave = stem.with_name(f"{stem.name}.png"), stem.with_name(f"{stem.name}.vcd")
        kind = scene.surfaces[surface.index].type
        name = f"{scene.name}, pixel {x},{y}, surface {surface.index} ({kind}), {args.rule} rule"
        with working(f"following the ray on surface {surface.index}"):
            if args.rtl:
                ray = follow_both(scene, compiled, surface, config, x, y, wave)
            else:
                steps = follow(surface, config, x, y)
                ray = Followed(steps, ["–"] * len(steps), "")
            write_files({picture: partial(plot_ray, ray.steps, config.n1, config.k_stop, name)})
        show_table(name, COLUMNS, rows_of(ray.steps, ray.differences, surface, config), ("control points", "RTL"), 200)
        print(f"picture: {picture}" + (f"; waveform: {wave}" if args.rtl else ""))
        if args.rtl and ray.first:
            differ = 1
            print(f"RTL and golden model differ: {ray.first}")
    return differ


if __name__ == "__main__":
    sys.exit(status_of(main))
