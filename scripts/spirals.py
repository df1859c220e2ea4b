# SPDX-License-Identifier: Apache-2.0
"""Random chords through random spirals: roots missed by both rules, error of t, steps, and what each bound saves."""

import argparse
import random
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from raydix.blocks import write_table
from raydix.chords_spiral import (
    Judged,
    chords_through,
    compile_chords,
    judge,
    random_spiral,
    spiral_config,
    trace_spiral,
)
from raydix.command import COUNT, SEED, status_of
from raydix.compile_spiral import NEVER
from raydix.config import Config
from raydix.formats import FORM_INDEX, ZONES
from raydix.oracle_spiral import spiral_chord_roots
from raydix.progress import track
from raydix.scene import Spiral

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "spirals.md"
BAND = 1 / 64  # |cosine| between chord and normal below which t is ill-conditioned

FAMILY = (
    ("certified", 1, 24),
    ("certified", 2, 12),
    ("certified", 3, 8),
    ("certified", 4, 6),
    ("certified", 2, 10),
    ("certified", 3, 10),
    ("paper", 3, 8),
    ("paper", 4, 6),
)
FAMILY_HEADER = (
    "rule", "n1, K", "chords", "left out", "hit", "missed", "false", "wrong root",
    "error rms, ulp", "99.9 %", "max", "max within the band", "steps/hit", "/miss", "most",
)  # fmt: skip

SHAPES = {
    "helix, 3 turns": Spiral(type="spiral", R=0.6, r=0.1, pitch=0.35, turns=3),
    "shell": Spiral(type="spiral", R=0.09, r=0.08, pitch=0.22, turns=3.7, R_growth=0.18, r_growth=0.125),
    "flat spiral": Spiral(type="spiral", R=0.2, r=0.05, pitch=0, turns=6, R_growth=0.18),
    "cone spiral": Spiral(type="spiral", R=1, r=0.1, pitch=0.3, turns=3, R_growth=-0.25, r_growth=-0.02),
}
BOUNDS = {
    "Lipschitz, one zone": (False, False),
    "Lipschitz, by zone": (True, False),
    "both, one zone": (False, True),
    "both, by zone (as built)": (True, True),
}
BOUNDS_HEADER = ("spiral", "bound", "missed", "steps/hit", "/miss", "most")


def cases(spirals: int, chords: int, seed: int) -> list:
    """Random spirals, chords through them as the words have them, and the exact roots and clearances."""
    dice = random.Random(seed)
    made = []
    for number in track(range(spirals), "exact roots"):
        surface = random_spiral(dice)
        compiled = compile_chords(surface, *chords_through(surface, chords, seed * spirals + number), Config())
        made.append((surface, compiled.h, compiled.e, *spiral_chord_roots(surface, compiled.h, compiled.e)))
    return made


def family(made: list) -> Iterator[list[str]]:
    """Rows of the table of the family."""
    for rule, n1, steps in FAMILY:
        parts = []
        for surface, h, e, exact, clearance in made:
            config = spiral_config(surface, n1, steps, rule)
            compiled = compile_chords(surface, h, e, config)
            found = trace_spiral(compiled, config)
            parts.append(judge(surface, compiled, found, exact, clearance, config.digits))
        yield family_cells(rule, n1, steps, parts)


def family_cells(rule: str, n1: int, steps: int, parts: list[Judged]) -> list[str]:
    """The text of a row."""
    joined = {name: [getattr(p, name) for p in parts] for name in Judged._fields}
    counts = {name: sum(joined[name]) for name in ("chords", "left_out", "hit", "missed", "false", "wrong")}
    error, slope, hits, misses = (np.concatenate(joined[n]) for n in ("error", "slope", "steps_hit", "steps_miss"))
    right = error <= 64 if rule == "paper" else np.ones(len(error), bool)  # else the wrong roots would be the error
    good, bad = error[right & (slope >= BAND)], error[right & (slope < BAND)]
    return [
        rule,
        f"{n1}, {steps}",
        *(f"{n:,}" for n in counts.values()),
        f"{np.sqrt(np.mean(good**2)):.3f}",
        f"{np.percentile(good, 99.9):.2f}",
        f"{good.max():.2f}",
        f"{bad.max(initial=0):.1f}",
        f"{hits.mean():.2f}",
        f"{misses.mean():.2f}",
        str(max(hits.max(), misses.max())),
    ]


def bounds(chords: int, seed: int) -> Iterator[list[str]]:
    """Rows of the table of the bounds: J = 8, 24 digits."""
    for name, surface in SHAPES.items():
        config = spiral_config(surface)
        compiled = compile_chords(surface, *chords_through(surface, chords, seed), config)
        exact, clearance = spiral_chord_roots(surface, compiled.h, compiled.e)
        for label, (zones, curved) in BOUNDS.items():
            words = compiled.form.copy()
            if not zones:  # the bounds of the innermost zone hold everywhere
                for field in ("lipschitz", "curvature", "from_level"):
                    at = FORM_INDEX[field]
                    words[at : at + ZONES] = words[at]
            if not curved:
                words[FORM_INDEX["from_level"] : FORM_INDEX["from_level"] + ZONES] = NEVER
            found = trace_spiral(compiled._replace(form=words), config)
            r = judge(surface, compiled, found, exact, clearance, config.digits)
            most = max(r.steps_hit.max(), r.steps_miss.max())
            yield [name, label, f"{r.missed:,}", f"{r.steps_hit.mean():.2f}", f"{r.steps_miss.mean():.2f}", str(most)]


def show(title: str, header, rows) -> list[list[str]]:
    """Print a table; its rows."""
    rows = list(rows)
    table = Table(title=title)
    for column in header:
        table.add_column(column, justify="left" if column in ("rule", "spiral", "bound") else "right")
    for row in rows:
        table.add_row(*row)
    Console(width=None if sys.stdout.isatty() else 170).print(table)
    return rows


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--spirals", type=COUNT, default=120, help="random spirals (default: 120)")
    parser.add_argument("--chords", type=COUNT, default=10_000, help="chords through each (default: 10000)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--write", action="store_true", help="renew the tables in docs/spirals.md")
    args = parser.parse_args()
    made = cases(args.spirals, args.chords, args.seed)
    title = f"{args.spirals} random spirals, {args.chords:,} chords each, seed {args.seed}"
    rows = show(title, FAMILY_HEADER, family(made))
    others = show(f"bounds, {5 * args.chords:,} chords each", BOUNDS_HEADER, bounds(5 * args.chords, args.seed))
    if args.write:
        write_table(PAGE, "family", FAMILY_HEADER, rows)
        write_table(PAGE, "bounds", BOUNDS_HEADER, others)
    certified = [row for row in rows if row[0] == "certified"]
    return int(any(row[5:8] != ["0", "0", "0"] for row in certified))


if __name__ == "__main__":
    sys.exit(status_of(main))
