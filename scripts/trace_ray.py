#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Follow the ray of one pixel, step by step, through golden model and RTL, and draw it.

    scripts/trace_ray.py scenes/torus.toml --pixel 320,200
    scripts/trace_ray.py SCENE --pixel X,Y --surface 2 --n1 2 --rule paper
    scripts/trace_ray.py SCENE --pixel X,Y --no-rtl

For each surface whose rectangle has the pixel: what each step saw and chose, with t as a number and as digits, and
whether the step unit of the RTL gave back the same. Writes <scene>-<x>-<y>-surface<i>.png, and the waveform beside it.
Exit status 0; 1: RTL and golden model differ, the first step and signal that do are named; 2: bad input.
"""

import argparse
import re
import sys
from pathlib import Path

from raydix.blocks import show_table
from raydix.command import image_size, status_of
from raydix.compile import CompiledFrame, CompiledSurface, compile_scene
from raydix.config import RULES, Config, ConfigError
from raydix.fit import families
from raydix.rtl import RtlError, trace_rtl
from raydix.scene import SceneError, load_scene
from raydix.trace_plot import plot_ray
from raydix.trace_ray import Step, follow, pixel_of
from raydix.waves import Output, step_outputs

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
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed: X,Y, for example 320,200")
    return int(match[1]), int(match[2])


def difference(step: Step, output: Output | None) -> str:
    """The first field in which the RTL differs, with both values; empty where none does."""
    if output is None:
        return "step: RTL took none"
    pairs = [(name, getattr(step, name), getattr(output, name)) for name in ("status", "t", "next_t")]
    if step.status == "run":  # of a step after which there is no other the control points mean nothing
        pairs += [(f"b[{i}]", a, b) for i, (a, b) in enumerate(zip(step.after, output.after, strict=True))]
    if step.status in ("run", "hit"):
        pairs.append(("depth", step.depth, output.depth))
    return next((f"{name}: golden {a}, RTL {b}" for name, a, b in pairs if a != b), "")


def digits(t: int, config: Config, level: int) -> str:
    """The digits of t that are fixed, one for each step."""
    return " ".join(str(t >> config.n1 * (config.steps - 1 - k) & config.cells - 1) for k in range(level)) or "–"


def rows_of(steps: list[Step], differences: list[str], surface: CompiledSurface, config: Config) -> list[list[str]]:
    """The table."""

    def cells(mask: int) -> str:
        return " ".join(str(j) for j in range(config.cells) if mask >> j & 1) or "–"

    whole = 2 ** (config.n1 * config.steps)
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


def run(
    surface: CompiledSurface, compiled: CompiledFrame, config: Config, args, stem: Path
) -> tuple[list[Step], list[str]]:
    """Steps of the golden model, and for each where the RTL differs: empty, or a dash without RTL."""
    steps = follow(surface, config, *args.pixel)
    if not args.rtl:
        return steps, ["–"] * len(steps)
    alone = compiled._replace(surfaces=(pixel_of(surface, *args.pixel),))
    wave = stem.with_suffix(".vcd")
    trace_rtl(alone, config, wave=wave)
    outputs = {output.number: output for output in step_outputs(wave)}
    differences = [difference(step, outputs.get(step.number)) for step in steps]
    if not any(differences) and len(outputs) > len(steps):
        differences[-1] = f"step: RTL took {len(outputs)}"
    return steps, differences


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="scene file (TOML)")
    parser.add_argument("--pixel", type=pixel, required=True, metavar="X,Y", help="column and row, from 0")
    parser.add_argument("--surface", type=int, metavar="I", help="only this surface")
    parser.add_argument("--rule", choices=RULES, default="certified", help="how a cell is chosen (default: certified)")
    parser.add_argument("--n1", type=int, default=3, help="digits fixed per step (default: 3)")
    parser.add_argument("--steps", type=int, metavar="K", help="steps to a hit (default: as many as make 24 digits)")
    parser.add_argument("--size", type=image_size, default=(None, None))
    parser.add_argument("--no-rtl", dest="rtl", action="store_false", help="the golden model only")
    parser.add_argument("--out", type=Path, default=OUT, metavar="DIR", help="folder (default: build/trace)")
    return parser.parse_args(arguments)


def chosen(compiled: CompiledFrame, args) -> list[CompiledSurface]:
    """The surfaces whose rectangles have the pixel. Raises ValueError where none has."""
    x, y = args.pixel
    if not (x < compiled.width and y < compiled.height):
        raise ValueError(f"--pixel: found {x},{y}; allowed: 0,0 to {compiled.width - 1},{compiled.height - 1}")
    inside = [s for s in compiled.surfaces if s.rect[0] <= x <= s.rect[2] and s.rect[1] <= y <= s.rect[3]]
    wanted = [s for s in inside if args.surface in (None, s.index)]
    if not wanted:
        what = "no surface" if args.surface is None else f"not surface {args.surface}"
        others = ", ".join(str(s.index) for s in inside) or "none, choose another pixel"
        raise ValueError(f"--pixel: found {x},{y}, where {what} can be; surfaces there: {others}")
    return wanted


def main(arguments=None) -> int:
    """Follow, print, draw; returns the exit status."""
    args = parse(arguments)
    differ = 0
    try:
        scene = load_scene(args.scene, *args.size)
        steps = args.steps or 24 // max(1, args.n1)
        config = Config(n1=args.n1, steps=steps, units=1, rules=args.rule, rule=args.rule, **families(scene))
        compiled = compile_scene(scene, config)
        args.out.mkdir(parents=True, exist_ok=True)
        for surface in chosen(compiled, args):
            x, y = args.pixel
            stem = args.out / f"{scene.name}-{x}-{y}-surface{surface.index}"
            steps, differences = run(surface, compiled, config, args, stem)
            kind = scene.surfaces[surface.index].type
            name = f"{scene.name}, pixel {x},{y}, surface {surface.index} ({kind}), {args.rule} rule"
            show_table(name, COLUMNS, rows_of(steps, differences, surface, config), ("control points", "RTL"), 200)
            plot_ray(steps, config.n1, config.steps, name, stem.with_suffix(".png"))
            print(
                f"picture: {stem.with_suffix('.png')}" + (f"; waveform: {stem.with_suffix('.vcd')}" if args.rtl else "")
            )
            first = next((k for k, text in enumerate(differences) if args.rtl and text), None)
            if first is not None:
                differ = 1
                print(f"RTL and golden model differ: step {steps[first].number}, {differences[first]}")
    except (SceneError, ConfigError, RtlError, ValueError, OSError) as error:
        print(f"trace_ray: {error}", file=sys.stderr)
        return 2
    return differ


if __name__ == "__main__":
    sys.exit(status_of(main))
