#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Both rules and every width on random chords through each type of surface: missed and wrong roots, error, steps.

    scripts/every_type.py              every algebraic type, as it is in its scene
    scripts/every_type.py torus cone   some of them
    scripts/every_type.py --write      renew the tables in docs/accuracy.md, too

Chords are between random points of the sphere around the surface's box; 24 digits. Spirals: scripts/spirals.py.
Exit status 0; 2: bad input.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from raydix.blocks import show_table, write_table
from raydix.chords import chord_quads, random_chords, rates, trace_chords
from raydix.command import COUNT, SEED, status_of
from raydix.config import Config
from raydix.oracle import chord_roots, quadrics
from raydix.progress import track
from raydix.scene import load_scene
from raydix.surfaces import bounding_box, form

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "accuracy.md"
SCENES = (
    "plane", "sphere", "ellipsoid", "cylinder", "cone", "paraboloid", "saddle", "hyperboloid_one_sheet", "hyperboloid",
    "quadric", "torus", "cyclide", "quartic",
)  # fmt: skip
STEPS = ((1, 24), (2, 12), (3, 8), (4, 6))
WIDTHS = (24, 28, 32, 36)
DIGITS = 24
RULES = (
    "type", "n1, K", "chords that hit", "paper: missed", "wrong root", "steps/hit", "/miss",
    "certified: missed", "wrong root", "false", "steps/hit", "/miss", "most",
)  # fmt: skip
WIDE = ("type", "W", "chords", "missed", "false", "error rms, ulp", "99.9 %", "max", "steps/hit", "/miss", "most")


class Chords:
    """Random chords of a type: its surface, whether it is a quartic, accumulators (N, 9), exact roots (N, 4)."""

    def __init__(self, name: str, count: int, seed: int):
        (self.surface,) = load_scene(ROOT / "scenes" / f"{name}.toml").surfaces
        low, high = (np.array([float(v) for v in corner]) for corner in self.surface.clip or bounding_box(self.surface))
        h, e = random_chords(count, float(np.linalg.norm(high - low)) / 2, seed)
        h, e = h + (low + high) / 2, e + (low + high) / 2
        self.quartic = form(self.surface).q1 is not None
        self.quads = chord_quads(form(self.surface), h, e)
        self.exact = chord_roots(quadrics(self.surface), h, e)

    def trace(self, n1: int, steps: int, width: int, rule: str) -> tuple[np.ndarray, np.ndarray]:
        """First roots (N) and steps (N) of the golden model."""
        config = Config(n1, steps, width, degree=4 if self.quartic else 2, units=1, rule=rule)
        t, taken = trace_chords(self.quads, self.quartic, config)
        return t[:, 0], taken


def rule_rows(chords: Chords) -> Iterator[list[str]]:
    """Both rules at each number of digits a step."""
    for n1, steps in STEPS:
        cells = []
        for rule in ("paper", "certified"):
            t, taken = chords.trace(n1, steps, 36, rule)
            r = rates(t, chords.exact, DIGITS, taken)
            false = [str(r.false)] if rule == "certified" else []
            cells += [f"{r.missed:.4%}", f"{r.wrong:.4%}", *false, f"{r.steps_per_hit:.2f}", f"{r.steps_per_miss:.2f}"]
        yield [chords.surface.type, f"{n1}, {steps}", f"{r.chords:,}", *cells, str(taken.max())]


def width_rows(chords: Chords) -> Iterator[list[str]]:
    """The certified rule, n1 = 3, at each width of a control point."""
    hit = ~np.isnan(chords.exact[:, 0])
    for width in WIDTHS:
        t, taken = chords.trace(3, 8, width, "certified")
        r = rates(t, chords.exact, DIGITS, taken)
        both = hit & (t >= 0)
        error = np.abs(chords.exact[both, 0] * 2.0**DIGITS - t[both] - 0.5)
        figures = np.sqrt(np.mean(error**2)), np.percentile(error, 99.9), error.max()
        missed = int((hit & (t < 0)).sum())
        yield [
            chords.surface.type,
            f"{width}",
            f"{len(t):,}",
            f"{missed}",
            f"{r.false}",
            *(f"{value:.3g}" for value in figures),
            f"{r.steps_per_hit:.2f}",
            f"{r.steps_per_miss:.2f}",
            str(taken.max()),
        ]


def main(arguments=None) -> int:
    """Command line; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", help=f"{', '.join(SCENES)} (default: all)")
    parser.add_argument("--chords", type=COUNT, default=200_000, help="chords of each type (default: 200000)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--write", action="store_true", help="renew the tables in docs/accuracy.md")
    args = parser.parse_args(arguments)
    for name in args.scene:
        if name not in SCENES:
            parser.error(f"scene: found {name!r}; allowed: {', '.join(SCENES)}")
    if args.chords < 1:
        parser.error(f"--chords: found {args.chords}; allowed: 1 or more")
    if args.write and args.scene:
        parser.error("--write: found with some types; allowed: with all of them")
    rules, widths = [], []
    for name in track(args.scene or SCENES, "types"):
        chords = Chords(name, args.chords, args.seed)
        rules += rule_rows(chords)
        widths += width_rows(chords)
    show_table(f"Both rules, W = 36, {args.chords:,} chords of each type", RULES, rules, RULES[:1], 200)
    show_table("The certified rule, n1 = 3, K = 8", WIDE, widths, WIDE[:1], 160)
    if args.write:
        write_table(PAGE, "types", RULES, rules)
        write_table(PAGE, "widths", WIDE, widths)
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
