# SPDX-License-Identifier: Apache-2.0
"""Golden model on chords through random spirals, judged by ball arithmetic: every verdict is proved."""

import argparse
import random
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from raydix import spiral
from raydix.blocks import show_table, write_table
from raydix.chords_spiral import (
    box_of,
    chords_through,
    compile_chords,
    random_spiral,
    slopes,
    spiral_config,
    trace_spiral,
)
from raydix.command import COUNT, SEED, status_of, workers
from raydix.exact_spiral import MISSED, Judged, ends_of_words, judge
from raydix.formats import STEPS_MAX
from raydix.progress import track
from raydix.scene import Spiral

PAGE = Path(__file__).resolve().parents[1] / "docs" / "exact.md"
MARGIN = 64  # ulp of t by which the found cell is widened on either side
BAND = 1 / 64  # |cosine| between chord and normal below which t is ill-conditioned
CONFIGS = (("certified", 1, 24), ("certified", 2, 12), ("certified", 3, 8), ("certified", 4, 6), ("paper", 3, 8))
LONGEST = "{}, {}".format(*CONFIGS[0][1:])  # a digit a step: the most steps for the same way
HEADER = (
    "chords", "rule", "n1, K", "given up", "of these missed",
    "judged", "hit", "left out", "missed", "false", "wrong", "undecided",
    "error rms, ulp", "max", "rms within the band", "max", "largest left out, ε",
)  # fmt: skip


def on_surface(surface, s: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """Points (N, 3) of the tube at the place ``s`` (N) on the spiral, ``phi`` (N) radians about the centre curve."""
    radius, size = surface.R + surface.R_growth * s, surface.r + surface.r_growth * s
    rho, z = radius + size * np.cos(phi), surface.pitch * s + size * np.sin(phi)
    return np.stack([rho * np.cos(2 * np.pi * s), rho * np.sin(2 * np.pi * s), z], axis=-1)


def about(surface, dice, points: np.ndarray, ahead: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ends (N, 3) of chords through points with a direction (N, 3); each part as long as 0.2 to 0.6 times the box."""
    low, high = box_of(surface)
    reach = np.linalg.norm(high - low) * dice.uniform(0.2, 0.6, (2, len(points), 1))
    ahead = ahead / np.linalg.norm(ahead, axis=1, keepdims=True)
    return points - reach[0] * ahead, points + reach[1] * ahead


def grazing(surface, count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Chords in tangential planes of random points, moved off by 1e-10 to 0.1 of the tube's radius."""
    dice = np.random.default_rng(seed)
    s = dice.uniform(0, surface.turns, count)
    points = on_surface(surface, s, dice.uniform(0, 2 * np.pi, count))
    normal = spiral.gradient(surface, points)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
    off = dice.choice((-1, 1), (count, 1)) * 10 ** dice.uniform(-10, -1, (count, 1))
    size = (surface.r + surface.r_growth * s)[:, None]
    return about(surface, dice, points + size * off * normal, np.cross(normal, dice.normal(size=(count, 3))))


def ends(surface, count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Chords through points next to the half planes of both ends, where tube and ball meet."""
    dice = np.random.default_rng(seed)
    s = dice.choice((0, surface.turns), count) + dice.choice((-1, 1), count) * 10 ** dice.uniform(-12, -1, count)
    points = on_surface(surface, s, dice.uniform(0, 2 * np.pi, count))
    return about(surface, dice, points, dice.normal(size=(count, 3)))


def axial(surface, count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Chords whose distance from the axis at one place is about that of the solid, or much less."""
    dice = np.random.default_rng(seed)
    low, high = box_of(surface)
    clear = min(surface.R - surface.r, surface.R - surface.r + (surface.R_growth - surface.r_growth) * surface.turns)
    off, phase = clear * 10 ** dice.uniform(-8, 0.5, count), dice.uniform(0, 2 * np.pi, count)
    points = np.stack([off * np.cos(phase), off * np.sin(phase), dice.uniform(low[2], high[2], count)], axis=-1)
    rise = dice.normal(size=count) * 10 ** dice.uniform(-2, 2, count)
    return about(surface, dice, points, np.stack([-np.sin(phase), np.cos(phase), rise], axis=-1))


class Part(NamedTuple):
    """Chords through one spiral in one configuration.

    judged    all; ``missed`` without those that were given up
    slope     of those that hit (0 elsewhere): :func:`raydix.chords_spiral.slopes`
    given_up  how many steps came to their limit, which a record tells, and in how many of these a root was missed
    largest   clearance of those left out, over epsilon
    """

    judged: Judged
    slope: np.ndarray
    given_up: tuple[int, int]
    largest: float


KINDS = {"random": chords_through, "grazing": grazing, "at the ends": ends, "about the axis": axial}


def one(kind: str, count: int, work: tuple[Spiral, int]) -> list[Part]:
    """For each configuration a :class:`Part` of a surface, with a seed for its chords."""
    surface, seed = work
    h, e = KINDS[kind](surface, count, seed)
    results = []
    for rule, n1, steps in CONFIGS:
        config = spiral_config(surface, n1, steps, rule)
        compiled = compile_chords(surface, h, e, config)
        t, taken = trace_spiral(compiled, config)
        found = t[:, 0]
        local = (ends_of_words(words, compiled.factors, compiled.middle) for words in compiled.coordinates)
        starts, stops = zip(*local, strict=True)
        judged = judge(surface, starts, stops, found, config.digits, MARGIN, compiled.epsilon)
        at, slope = ~np.isnan(judged.error), np.zeros(len(found))
        places = np.flatnonzero(at), (found[at] + 0.5) * 2.0**-config.digits
        slope[at] = slopes(surface, compiled.h[places[0]], compiled.e[places[0]], places[1])
        ratios = [float(v.clearance.upper()) / compiled.epsilon for _, v in judged.uncertified if v.kind != "undecided"]
        given_up = (found < 0) & (taken == STEPS_MAX)
        missed = sum(
            v.kind == MISSED and not v.clearance < compiled.epsilon for i, v in judged.uncertified if given_up[i]
        )
        # balls do not travel between processes
        plain = judged._replace(uncertified=[], missed=judged.missed - missed)
        largest = max((v for v in ratios if v < 1), default=0.0)
        results.append(Part(plain, slope, (int(given_up.sum()), missed), largest))
    return results


def rows(spirals: int, chords: int, seed: int, processes: int) -> Iterator[list[str]]:
    """Rows of the table."""
    dice = random.Random(seed)
    surfaces = [random_spiral(dice) for _ in range(spirals)]
    with workers(processes) as pool:
        for kind in KINDS:
            seeds = (seed * spirals + number for number in range(spirals))
            work = pool.imap(partial(one, kind, chords), zip(surfaces, seeds, strict=True))
            made = list(track(work, kind, spirals))
            for number, config in enumerate(CONFIGS):
                yield cells(kind, config, [parts[number] for parts in made])


def cells(kind: str, config, parts: list[Part]) -> list[str]:
    """The text of a row."""
    rule, n1, steps = config
    names = "chords", "hit", "left_out", "missed", "false", "wrong", "undecided"
    counts = [sum(column) for column in zip(*(p.given_up for p in parts), strict=True)]
    counts += [sum(getattr(p.judged, name) for p in parts) for name in names]
    error, slope = np.concatenate([p.judged.error for p in parts]), np.concatenate([p.slope for p in parts])
    hit = ~np.isnan(error)
    groups = error[hit & (slope >= BAND)], error[hit & (slope < BAND)]
    figures = [f"{np.sqrt(np.mean(v**2)):.3f}|{np.abs(v).max():.2f}" if len(v) else "–|–" for v in groups]
    texts = [f"{n:,}" for n in counts] + "|".join(figures).split("|")
    return [kind, rule, f"{n1}, {steps}", *texts, f"{max(p.largest for p in parts):.2f}"]


def bad(row: list[str]) -> bool:
    """Whether a row of the table is a failure; see :func:`main`."""
    cells = dict(zip(HEADER, row, strict=True))
    counts = ["missed", "false", "wrong"] + ["of these missed"] * (cells["n1, K"] != LONGEST)
    return cells["rule"] == "certified" and any(cells[name] != "0" for name in counts)


def main() -> int:
    """Command line; the exit status is 1 if the certified rule missed a root or found a false or wrong one.

    A root missed by a chord that was given up, which its record tells, counts except with a digit a step.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--spirals", type=COUNT, default=40, help="random spirals (default: 40)")
    parser.add_argument("--chords", type=COUNT, default=500, help="chords of each kind through each (default: 500)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--processes", type=COUNT, default=2)
    parser.add_argument("--write", action="store_true", help="renew the table in docs/exact.md")
    args = parser.parse_args()
    for name, least in (("spirals", 1), ("chords", 1), ("processes", 1), ("seed", 0)):
        if getattr(args, name) < least:
            parser.error(f"--{name}: found {getattr(args, name)}; allowed: {least} or more")
    made = list(rows(args.spirals, args.chords, args.seed, args.processes))
    title = f"{args.spirals} random spirals, {args.chords:,} chords of each kind, seed {args.seed}"
    show_table(title, HEADER, made, ("chords", "rule"), 190)
    if args.write:
        write_table(PAGE, "spirals", HEADER, made)
    return int(any(map(bad, made)))


if __name__ == "__main__":
    sys.exit(status_of(main))
