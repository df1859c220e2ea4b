# SPDX-License-Identifier: Apache-2.0
"""Paper rule against certified rule on random chords that hit a torus: missed rays and wrong (later) roots."""

import argparse
import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from rich.console import Console
from rich.table import Table

from raydix.blocks import write_table
from raydix.chords import chord_quads, paper_float, random_chords, rates, trace_chords
from raydix.command import COUNT, INTEGER, SEED, above, status_of
from raydix.config import Config
from raydix.image import text_writer, write_files
from raydix.oracle import chord_roots, quadrics
from raydix.progress import track
from raydix.surfaces import form

ROOT = Path(__file__).resolve().parents[1]
TORUS = SimpleNamespace(type="torus", R=0.7, r=0.25)


def distance(p):
    """Signed distance to the torus."""
    return np.hypot(np.hypot(p[..., 0], p[..., 1]) - TORUS.R, p[..., 2]) - TORUS.r


def measure(count, seed, radius, width):
    """Rates by label for each n1; 24 digits."""
    h, e = random_chords(count, radius, seed)
    exact = chord_roots(quadrics(TORUS), h, e)
    quads = chord_quads(form(TORUS), h, e)
    for n1, steps in track(((1, 24), (2, 12), (3, 8), (4, 6)), "digits a step"):
        yield n1, steps, "paper, true distance, float64", rates(paper_float(distance, h, e, n1, steps), exact, 24)
        for rule in ("paper", "certified"):
            config = Config(n1, steps, width, rule=rule, units=1)
            t, taken = trace_chords(quads, True, config)
            yield n1, steps, f"{rule}, quartic, golden model", rates(t[:, 0], exact, 24, taken)


def cells(n1, steps, label, r):
    """The text of a row's cells."""
    counts = f"{r.chords:,}", f"{r.missed:.4%}", f"{r.wrong:.4%}", str(r.false)
    return [f"{n1}, {steps}", label, *counts, steps_text(r.steps_per_hit), steps_text(r.steps_per_miss)]


def steps_text(mean):
    """A mean of steps; nothing where it was not counted."""
    return "" if np.isnan(mean) else f"{mean:.2f}"


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--chords", type=COUNT, default=200_000, help="chords tried (default: 200000)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--radius", type=above(0), default=1.0, help="of the sphere that the ends lie on (default: 1)")
    parser.add_argument("--width", type=INTEGER, default=36, help="W, bits of a control point (default: 36)")
    parser.add_argument("--json", type=Path, help="write the figures there, too")
    parser.add_argument("--write", action="store_true", help="renew the table in docs/accuracy.md")
    args = parser.parse_args()
    table = Table(title=f"torus R = 0.7, r = 0.25; {args.chords} chords, seed {args.seed}; n = 24, W = {args.width}")
    for name in (
        "n1, K",
        "rule and indicator",
        "chords that hit",
        "missed",
        "wrong root",
        "false hits",
        "steps/hit",
        "/miss",
    ):
        table.add_column(name, justify="left" if "rule" in name else "right")
    rows = list(measure(args.chords, args.seed, args.radius, args.width))
    texts = [cells(*row) for row in rows]
    for text in texts:
        table.add_row(*text)
    Console(width=120).print(table)
    if args.write:
        write_table(ROOT / "docs" / "accuracy.md", "rules", [str(c.header) for c in table.columns], texts)
    if args.json:
        text = json.dumps([[n1, k, label, r._asdict()] for n1, k, label, r in rows], indent=1)
        write_files({args.json: text_writer(text)})
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
