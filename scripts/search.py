# SPDX-License-Identifier: Apache-2.0
"""Evolutionary search for the rays of the largest error and of the most steps; the worst become directed cases."""

import argparse
import sys
import tomllib
from pathlib import Path

import numpy as np

from raydix import stress, stress_spirals
from raydix.blocks import show_table, write_table
from raydix.chords_spiral import compile_chords, spiral_config, trace_spiral
from raydix.command import COUNT, SEED, status_of
from raydix.compile_spiral import Oversize
from raydix.config import Config
from raydix.formats import STEPS_MAX
from raydix.image import text_writer, write_files
from raydix.oracle_spiral import spiral_chord_roots
from raydix.progress import bars
from raydix.segments import Segments, trace_segments, whole
from raydix.stress_polynomials import fitted

ROOT = Path(__file__).resolve().parents[1]
CASES = ROOT / "tb" / "cases.toml"
HEADER = ("search", "generations", "rays tried", "of the first", "found")
SPIRALS_TRIED = 10  # of a category, before the one is chosen that is searched
KEPT = 8  # cases of each search that are written
ALIKE = 0.9999  # cosine of the angle between two items' coefficients that count as the same case
FIELDS = ("R", "r", "pitch", "turns", "R_growth", "r_growth")


def first_items(dice, count: int, config: Config) -> np.ndarray:
    """Control points of all categories of the stress test: (N, degree + 1) int64."""
    named = stress.categories(config.degree).values()
    share = -(-count // len(named))
    return np.concatenate([part.b for make in named for part in make(dice, share, config)])


def children(dice, b: np.ndarray, count: int, config: Config) -> np.ndarray:
    """Variations of items: an ulp or a bit off, another size of a coefficient, two parents' coefficients mixed."""
    parents = b[dice.integers(0, len(b), count)]
    other = b[dice.integers(0, len(b), count)]
    kind, place = dice.integers(0, 5, count), dice.integers(0, b.shape[1], count)
    row = np.arange(count)
    step = dice.choice([-1, 1], count) * (1 << dice.integers(0, config.width - 1, count))
    small = np.rint(dice.normal(size=count) * 4).astype(np.int64)
    made = parents.copy()
    old = made[row, place]
    made[row, place] = np.choose(kind, [old + step, old + small, old ^ np.abs(step), -old, other[row, place]])
    mixed = dice.random(count) < 0.2
    made[mixed] = np.where(dice.random((int(mixed.sum()), b.shape[1])) < 0.5, parents[mixed], other[mixed])
    return fitted(made, config.width)


def error_score(b: np.ndarray, config: Config) -> np.ndarray:
    """Error of a well-conditioned first root, ulp; of a failure outside of the band infinite; else 0."""
    segments = Segments(b, whole(len(b)))
    judged = stress.judge(segments, trace_segments(segments, config)[0][:, 0], config)
    good = judged.well & ~judged.band & ~np.isnan(judged.error)
    return np.where(judged.failed, np.inf, np.where(good, np.nan_to_num(judged.error), 0.0))


def steps_score(b: np.ndarray, config: Config) -> np.ndarray:
    """Steps to the first root or to none."""
    return trace_segments(Segments(b, whole(len(b))), config)[1].astype(float)


def apart(b: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Numbers of the `KEPT` best items, no two of which have nearly the same direction of their coefficients."""
    direction = b / np.maximum(np.linalg.norm(b.astype(float), axis=1, keepdims=True), 1)
    kept: list[int] = []
    for i in np.argsort(-s, kind="stable"):
        if len(kept) < KEPT and (direction[kept] @ direction[i] < ALIKE).all():
            kept.append(int(i))
    return np.array(kept)


def evolve(
    score, config: Config, generations: int, count: int, seed: int, tick
) -> tuple[np.ndarray, np.ndarray, float]:
    """The best items, their scores, and the best score of the first generation."""
    dice = np.random.default_rng(seed)
    b = first_items(dice, count, config)
    s = score(b, config)
    begin = float(s.max())
    for _ in range(generations):
        # a tenth of the best, without doubles, and their children
        _, unique = np.unique(b, axis=0, return_index=True)
        best = unique[np.argsort(-s[unique], kind="stable")][: count // 10]
        fresh = children(dice, b[best], count - len(best), config)
        b, s = np.concatenate([b[best], fresh]), np.concatenate([s[best], score(fresh, config)])
        tick()
    best = apart(b, s)
    return b[best], s[best], begin


def spiral_steps(surface, h, e) -> np.ndarray:
    """Steps to the first root of chords or to none."""
    config = spiral_config(surface)
    return trace_spiral(compile_chords(surface, h, e, config), config).steps


def spiral_error(surface, h, e) -> np.ndarray:
    """Error of well-conditioned first roots of chords, as `error_score`."""
    judged = judge_chords(surface, h, e)
    good = judged.well & ~judged.band & ~np.isnan(judged.error)
    return np.where(judged.failed, np.inf, np.where(good, np.nan_to_num(judged.error), 0.0))


def judge_chords(surface, h, e) -> stress.Judged:
    """What the oracle says of the golden model's first roots."""
    config = spiral_config(surface)
    compiled = compile_chords(surface, h, e, config)
    exact, clearance = spiral_chord_roots(surface, compiled.h, compiled.e)
    return stress.judge_spiral(surface, compiled, trace_spiral(compiled, config), exact, clearance, config)


def alone(score, surface, h, e) -> np.ndarray:
    """Scores of chords that are compiled one by one, as cases are: together they have one unit, that of the longest.

    -1 for a chord that is refused, since a constant has no room.
    """

    def one(i):
        try:
            return float(score(surface, h[i : i + 1], e[i : i + 1])[0])
        except Oversize:
            return -1.0

    return np.array([one(i) for i in range(len(h))])


def first_chords(score, name: str, spirals: int, count: int, dice):
    """Of a category the spiral that has the chord of the highest score, and its ``count`` best chords.

    Chords of a spiral are compiled together here, which is much faster. Also whether the score told of a failure.
    """
    best, failed = None, False
    for surface, h, e in stress_spirals.CATEGORIES[name](dice, spirals * stress_spirals.SHARE):
        try:
            s = score(surface, h, e)
        except Oversize:
            continue
        failed |= bool(np.isinf(s).any())
        if best is None or s.max() > best[0]:
            kept = np.argsort(-s, kind="stable")[:count]
            best = float(s.max()), surface, h[kept], e[kept]
    if best is None:
        sys.exit(f"search: {name}: found {spirals} spirals that are all refused; allowed: another --seed")
    return *best[1:], failed


def evolve_spiral(score, names, generations: int, count: int, seed: int, tick):
    """Best chords of a spiral of each category: [(surface, h, e, score)], the first best score, whether any failed."""
    dice, kept, begin, failed = np.random.default_rng(seed), [], 0.0, False
    for name in names:
        surface, h, e, bad = first_chords(score, name, SPIRALS_TRIED, count, dice)
        failed |= bad
        size = float(np.linalg.norm(e - h, axis=1).max())
        s = alone(score, surface, h, e)
        begin = max(begin, float(s.max()))
        for _ in range(generations):
            if s.max() >= STEPS_MAX:  # no ray takes more
                tick()
                continue
            best = np.argsort(-s, kind="stable")[: max(1, count // 10)]
            parents = dice.choice(best, count - len(best))
            scale = size * 2.0 ** -dice.uniform(4, 28, (2, len(parents), 1))
            off = dice.normal(size=(2, len(parents), 3)) * scale
            fresh = h[parents] + off[0], e[parents] + off[1]
            h, e = np.concatenate([h[best], fresh[0]]), np.concatenate([e[best], fresh[1]])
            s = np.concatenate([s[best], alone(score, surface, *fresh)])
            tick()
        i = int(np.argmax(s))
        kept.append((surface, h[i], e[i], float(s[i])))
    return sorted(kept, key=lambda case: -case[3]), begin, failed


def toml(items: dict, spirals: dict) -> str:
    """The directed cases as a TOML document."""
    lines = ["# SPDX-License-Identifier: Apache-2.0", "# Worst rays found by `make search`; run by tb/test_search.py."]
    for name, (b, s) in items.items():
        for row, value in zip(b.tolist(), s.tolist(), strict=True):
            lines += ["", "[[item]]", f'search = "{name}"', f"b = {row}", f"found = {value!r}"]
    for name, kept in spirals.items():
        for surface, h, e, value in kept:
            lines += ["", "[[spiral]]", f'search = "{name}"', f"h = {h.tolist()}", f"e = {e.tolist()}"]
            lines += [f"found = {value!r}", *(f"{key} = {float(getattr(surface, key))!r}" for key in FIELDS)]
    return "\n".join(lines) + "\n"


# score of the chords, and the categories of each of which one spiral is searched
SPIRALS = {
    "error": (spiral_error, ("any chord through any spiral", "thin spiral", "spiral, turns nearly touch")),
    "steps": (spiral_steps, ("spiral, tip near the axis", "spiral, grazing", "spiral, along its axis")),
}


def load_cases() -> dict:
    """The committed directed cases."""
    return tomllib.loads(CASES.read_text())


def main() -> int:
    """Command line; exit status 1 where a failure outside of the band was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--generations", type=COUNT, default=150)
    parser.add_argument("--rays", type=COUNT, default=20_000, help="in a generation (default: 20000)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--write", action="store_true", help="renew tb/cases.toml and the table in docs/stress.md")
    args = parser.parse_args()
    config, rows, items, failed = Config(units=1), [], {}, False
    with bars() as progress:
        for name, score in (("error", error_score), ("steps", steps_score)):
            bar = progress.add_task(name, total=args.generations)
            b, s, begin = evolve(
                score, config, args.generations, args.rays, args.seed, lambda bar=bar: progress.advance(bar)
            )
            items[name] = b, s
            tried = args.generations * (args.rays - args.rays // 10) + args.rays
            rows.append([f"algebraic: most {name}", str(args.generations), f"{tried:,}", f"{begin:.3f}", f"{s[0]:.3f}"])
        few = max(1, args.generations // 5)
        spirals = {}
        for name, (score, names) in SPIRALS.items():
            bar = progress.add_task(f"spirals: {name}", total=few * len(names))
            count = max(10, args.rays // 200)
            spirals[name], begin, bad = evolve_spiral(
                score, names, few, count, args.seed, lambda bar=bar: progress.advance(bar)
            )
            failed |= bad
            tried = len(names) * (few * (count - count // 10) + SPIRALS_TRIED * stress_spirals.SHARE)
            most = spirals[name][0][3]
            rows.append([f"spirals: most {name}", str(few), f"{tried:,}", f"{begin:.3f}", f"{most:.3f}"])
    failed |= not np.isfinite(items["error"][1]).all()
    for surface, h, e, _ in (case for kept in spirals.values() for case in kept):
        failed |= bool(judge_chords(surface, h[None], e[None]).failed.any())
    show_table(f"search, seed {args.seed}", HEADER, rows, ("search",), 120)
    if args.write:
        write_files({CASES: text_writer(toml(items, spirals))})
        write_table(ROOT / "docs" / "stress.md", "search", HEADER, rows)
    if failed:
        print("search: a ray was found on which the certified rule fails outside of the band", file=sys.stderr)
    return int(failed)


if __name__ == "__main__":
    sys.exit(status_of(main))
