# SPDX-License-Identifier: Apache-2.0
"""Stress: rays of named categories through the golden model, judged by exact roots; both rules, a picture each."""

import argparse
import sys
import zlib
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import numpy as np

from raydix import stress, stress_polynomials, stress_spirals
from raydix.blocks import show_table, write_table
from raydix.chords_spiral import compile_chords, spiral_config, trace_spiral
from raydix.command import COUNT, SEED, status_of, workers
from raydix.compile_spiral import Oversize
from raydix.config import Config
from raydix.exact import changes
from raydix.oracle_spiral import spiral_chord_roots
from raydix.progress import bars
from raydix.segments import trace_segments
from raydix.stress_plot import Case, plot_cases

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "stress.md"
IMAGES = ROOT / "docs" / "images"
BATCH = 20_000
# rays of a category relative to others: exact roots next to a tangency take a hundred times as long, spirals more
SLOW = {
    "tangent", "near-tangent, 2^-8 to 2^-40", "triple and quadruple roots", "two close roots in a cell",
    "roots in neighbouring cells", "as many roots as the degree", "saturating coefficients", "apex of a cone",
    "torus, 10^-6 to 10^6 units", "thin torus", "grazing", "clip faces through the silhouette", "root at 0 and at 1-",
}  # fmt: skip
SPIRAL_SHARE, SLOW_SHARE, PAPER_SHARE = 0.1, 0.15, 5  # of the paper rule: every fifth batch
LIMITS = ((1, 32, 36, 4), (2, 16, 48, 4), (4, 8, 40, 4), (3, 10, 36, 4), (4, 1, 36, 4), (1, 1, 16, 4), (3, 8, 36, 2))
LIMIT_CATEGORIES = (
    "any coefficients", "root on a boundary, each level", "root at 0 and at 1-", "near-tangent, 2^-8 to 2^-40",
    "two close roots in a cell", "roots in neighbouring cells", "saturating coefficients",
)  # fmt: skip
# and of spirals, which have no W and D
SPIRAL_LIMITS = ((1, 32), (2, 16), (4, 8), (3, 10), (4, 1), (1, 1))
SPIRAL_LIMIT_CATEGORIES = (
    "any chord through any spiral", "thin spiral", "spiral, seam of tube and ball", "spiral, eye inside",
)  # fmt: skip
HEADER = (
    "category", "rule", "rays", "hit", "missed", "false", "wrong", "off", "in the band: missed", "band: false",
    "band: wrong", "given up", "with a root in the band", "with a root outside", "rms", "median", "99.9 %", "max, ulp",
    "ill-conditioned", "max there", "most steps",
)  # fmt: skip


RULES = ("certified", "paper")
COUNTS = HEADER[2:14]
FAILED = [*range(2, 6), COUNTS.index("with a root outside")]  # of them: missed, false, wrong, off, and given up there


class Job(NamedTuple):
    """One batch: a category, its number, how many rays, and the hardware."""

    name: str
    number: int
    count: int
    config: Config
    seed: int


class Result(NamedTuple):
    """What came of a batch, for each rule: counts, errors of well- and ill-conditioned roots, steps, the worst case."""

    name: str
    rules: dict


def judged_parts(job: Job, rules):
    """(rule, Judged, steps, function of a place to its Case) for each part of the batch and each rule."""
    dice = np.random.default_rng([zlib.crc32(job.name.encode()), job.seed, job.number])
    if job.name in stress_spirals.CATEGORIES:
        for surface, h, e in stress_spirals.CATEGORIES[job.name](dice, job.count):
            exact = None
            for rule in rules:
                config = spiral_config(surface, job.config.n1, job.config.steps, rule)
                try:
                    compiled = compile_chords(surface, h, e, config)
                except Oversize:  # refused: a constant has no room
                    break
                exact = exact or spiral_chord_roots(surface, compiled.h, compiled.e)
                found = trace_spiral(compiled, config)
                judged = stress.judge_spiral(surface, compiled, found, *exact, config)

                def case(i, surface=surface, compiled=compiled, found=found, judged=judged, exact=exact):
                    near = root_of(exact[0][i], found.t[i, 0], judged.error[i], job.config.digits)
                    return Case(None, surface, compiled.h[i], compiled.e[i], int(found.t[i, 0]), near)

                yield rule, judged, found.steps, case
        return
    each = job.name in stress_polynomials.EACH
    for part in stress.categories(job.config.degree, each)[job.name](dice, job.count, job.config):
        exact = changes(part.b)
        for rule in rules:
            config = job.config.with_(rule=rule)
            t, steps = trace_segments(part, config)
            judged = stress.judge(part, t[:, 0], config, exact)

            def case(i, part=part, t=t, judged=judged, exact=exact):
                near = root_of(exact[i], t[i, 0], judged.error[i], job.config.digits)
                return Case(part.b[i], None, None, None, int(t[i, 0]), near)

            yield rule, judged, steps, case


def root_of(exact: np.ndarray, t: int, error: float, digits: int) -> float:
    """Of a ray's exact roots the one whose error, in ulp, the table has; the nearest one where it has none."""
    row = exact[~np.isnan(exact)]
    away = np.abs(row * 2.0**digits - t - 0.5)
    return float(row[np.abs(away - np.nan_to_num(error)).argmin()]) if len(row) else np.nan


def nothing() -> dict:
    """What a rule has before its first batch."""
    return {"counts": np.zeros(len(COUNTS), np.int64), "well": [], "ill": [], "most": 0, "worst": None}


def run(job: Job) -> Result:
    """One batch through the golden model, both rules where it is its turn."""
    rules = RULES if job.number % PAPER_SHARE == 0 else RULES[:1]
    out = {}
    for rule, j, steps, case in judged_parts(job, rules):
        into = out.setdefault(rule, nothing())
        bad = [j.missed, j.false, j.wrong]
        outside, within = ([(b & where).sum() for b in bad] for where in (~j.band, j.band))
        given_up = [j.given_up.sum(), *((j.given_up & j.hit & where).sum() for where in (j.band, ~j.band))]
        into["counts"] += [len(steps), j.hit.sum(), *outside, j.off.sum(), *within, *given_up]
        compared = ~np.isnan(j.error) & ~j.band
        into["well"].append(j.error[compared & j.well].astype(np.float32))
        into["ill"].append(j.error[compared & ~j.well].astype(np.float32))
        into["most"] = max(into["most"], int(steps.max(initial=0)))
        # the worst case: a failure, else the largest error
        score = np.where(j.failed, np.inf, np.where(compared, j.error, -1.0))
        i = int(np.argmax(score)) if len(score) else 0
        if len(score) and score[i] >= 0 and (into["worst"] is None or score[i] > into["worst"][0]):
            into["worst"] = float(score[i]), case(i)
    return Result(job.name, out)


def jobs(rays: int, seed: int, names, config: Config, shares=True) -> list[Job]:
    """All batches; ``rays`` of a full share."""
    made = []
    for name in names:
        spiral = name in stress_spirals.CATEGORIES
        share = (SPIRAL_SHARE if spiral else SLOW_SHARE if name in SLOW else 1.0) if shares else 1.0
        count = max(1, round(rays * share))
        size = BATCH // 5 if spiral else BATCH
        made += [Job(name, i, min(size, count - i * size), config, seed) for i in range(-(-count // size))]
    return made


def collect(todo: list[Job], processes: int) -> dict:
    """Run all batches; (category, rule) -> joined results."""
    joined = defaultdict(nothing)
    with bars() as progress:
        bar = progress.add_task("rays", total=sum(j.count for j in todo))
        size = {job.name: 0 for job in todo}

        def take(result, count):
            for rule, part in result.rules.items():
                into = joined[result.name, rule]
                into["counts"] += part["counts"]
                into["well"] += part["well"]
                into["ill"] += part["ill"]
                into["most"] = max(into["most"], part["most"])
                if part["worst"] and (into["worst"] is None or part["worst"][0] > into["worst"][0]):
                    into["worst"] = part["worst"]
            size[result.name] += count
            progress.advance(bar, count)

        if processes == 1:
            for job in todo:
                take(run(job), job.count)
        else:
            with workers(processes) as pool:
                for job, result in zip(todo, pool.imap(run, todo), strict=True):
                    take(result, job.count)
    return joined


def cells(name: str, rule: str, r: dict) -> list[str]:
    """The text of a row."""
    well, ill = (np.concatenate([*r[k], np.zeros(0, np.float32)]).astype(float) for k in ("well", "ill"))
    figures = [""] * 4
    if len(well):
        figures = [np.sqrt(np.mean(well**2)), np.median(well), np.percentile(well, 99.9), well.max()]
        figures = [f"{v:.3f}" for v in figures]
    most = [f"{len(ill):,}", f"{ill.max():.4g}" if len(ill) else "", f"{r['most']:,}"]
    return [name, rule, *(f"{n:,}" for n in r["counts"]), *figures, *most]


def total(joined: dict, rule: str) -> list[str]:
    """A row of all categories."""
    parts = [r for (_, other), r in joined.items() if other == rule]
    return cells("all", rule, {
        "counts": sum(p["counts"] for p in parts), "well": [e for p in parts for e in p["well"]],
        "ill": [e for p in parts for e in p["ill"]], "most": max(p["most"] for p in parts),
    })  # fmt: skip


def failures(joined: dict) -> int:
    """Rays on which the certified rule failed outside of the band."""
    return sum(int(r["counts"][FAILED].sum()) for (_, rule), r in joined.items() if rule == "certified")


def each_level(rays: int, seed: int, processes: int) -> tuple[list, int]:
    """Rows of single levels and distances, and failures."""
    names = list(stress_polynomials.EACH)
    part = collect(jobs(rays, seed, names, Config(units=1), False), processes)
    return [cells(name, rule, part[name, rule]) for rule in RULES for name in names], failures(part)


def at_limits(rays: int, seed: int, processes: int) -> tuple[list, int]:
    """Rows of the parameters' ends, both rules, and failures."""
    limits = [(Config(*n1_k_w, degree=degree, units=1), LIMIT_CATEGORIES, rays) for *n1_k_w, degree in LIMITS]
    limits += [(Config(*n1_k, units=1), SPIRAL_LIMIT_CATEGORIES, max(1, rays // 10)) for n1_k in SPIRAL_LIMITS]
    rows, failed = [], 0
    for config, names, count in limits:
        part = collect(jobs(count, seed, names, config, False), processes)
        words = f"{config.width}, {config.degree}" if names is LIMIT_CATEGORIES else "spirals"
        rows += [[f"{config.n1}, {config.steps}, {words}", *total(part, rule)[1:]] for rule in RULES]
        failed += failures(part)
    return sorted(rows, key=lambda row: RULES.index(row[1])), failed


def main() -> int:
    """Command line; exit status 1 where the certified rule failed outside of the documented band."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rays", type=COUNT, default=790_000, help="of a full category (default: 790000, 10^7 in all)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--jobs", type=COUNT, default=2, help="processes (default: 2)")
    parser.add_argument("--only", help="categories whose name contains this")
    parser.add_argument("--write", action="store_true", help="renew the tables and pictures of docs/stress.md")
    parser.add_argument("--pictures", type=Path, help="write pictures of the worst cases into this folder")
    args = parser.parse_args()
    reference = Config(units=1)
    algebraic, spirals = list(stress.categories(4)), list(stress_spirals.CATEGORIES)
    names = [n for n in algebraic + spirals if not args.only or args.only in n]
    if not names:
        parser.error(f"--only: found {args.only!r}; allowed: part of one of {', '.join(algebraic + spirals)}")
    joined = collect(jobs(args.rays, args.seed, names, reference), args.jobs)
    rows = [cells(name, rule, joined[name, rule]) for rule in RULES for name in names]
    rows += [total(joined, rule) for rule in RULES]
    left = ("category", "rule", "n1, K, W, D")
    show_table(f"n1 = 3, K = 8, W = 36, D = 4; seed {args.seed}", HEADER, rows, left, 240)
    failed = failures(joined)
    limit_rows, each_rows = [], []
    if not args.only:
        few = max(1, args.rays // 40)
        each_rows, more = each_level(few, args.seed, args.jobs)
        show_table("each level, each distance", HEADER, each_rows, left, 240)
        limit_rows, most = at_limits(few, args.seed, args.jobs)
        failed += more + most
        show_table("limits of the parameters", ("n1, K, W, D", *HEADER[1:]), limit_rows, left, 240)
    pictures = IMAGES if args.write else args.pictures
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
        for file, part in (("stress-algebraic.png", algebraic), ("stress-spirals.png", spirals)):
            cases = [(n, joined[n, "certified"]["worst"]) for n in part if joined[n, "certified"]["worst"]]
            if cases:
                plot_cases(pictures / file, [(n, worst[1]) for n, worst in cases], reference)
    if args.write:
        write_table(PAGE, "stress", HEADER, rows)
        write_table(PAGE, "each", HEADER, each_rows)
        write_table(PAGE, "limits", ("n1, K, W, D", *HEADER[1:]), limit_rows)
    if failed:
        print(f"stress: the certified rule failed on {failed} rays outside of the band", file=sys.stderr)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(status_of(main))
