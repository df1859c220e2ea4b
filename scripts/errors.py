# SPDX-License-Identifier: Apache-2.0
"""Rounding errors of each stage: the bound that is derived, the worst that was found, and the slack between them."""

import argparse
import random
import sys
from pathlib import Path

import mpmath as mp
import numpy as np

from raydix import stress, stress_polynomials, stress_rays, stress_spirals
from raydix.blocks import show_table, write_table
from raydix.chords import chord_quads
from raydix.chords_spiral import random_spiral, spiral_config
from raydix.command import COUNT, SEED, status_of
from raydix.compile import PRECISION, Quadratic
from raydix.config import Config
from raydix.error_bounds import halving, resolution
from raydix.error_measure import coordinate_error, halving_error, indicator_errors, product_errors, word_errors
from raydix.formats import COORD_ACC_WIDTH
from raydix.progress import track
from raydix.rounding import bernstein, passed
from raydix.segments import Segments, trace_segments, whole
from raydix.surfaces import form

ROOT = Path(__file__).resolve().parents[1]
HEADER = ("inequality", "unit", "cases", "bound", "found", "found / bound")
FLOAT = 2.0**-10  # ulp of f: the rounding of float64 in a value of f
SHAPES = ((1, 24), (2, 12), (3, 8), (4, 6))


def halving_rows(count: int, seed: int, degrees=(4, 2), shapes=SHAPES):
    """Descents of the stress categories: (row, refuted) for each number of digits per step and degree."""
    for degree in degrees:
        for n1, steps in shapes:
            config, dice = Config(n1, steps, degree=degree, units=1), np.random.default_rng(seed)
            worst, least, cases, bound = 0.0, 0.0, 0, 0.0
            for make in track(stress_polynomials.CATEGORIES.values(), f"halving {n1} {degree}"):
                b = stress_polynomials.fitted(make(dice, count, degree), config.width)
                t, _ = trace_segments(Segments(b, whole(len(b))), config)
                for i in np.flatnonzero(t[:, 0] >= 0):
                    bound, low, high = halving_error(b[i], int(t[i, 0]), config)
                    worst, least, cases = max(worst, float(high)), min(least, float(low)), cases + 1
            row = [f"halving above, D = {degree}, n1 = {n1}", "ulp of f", cases, bound, worst]
            yield row, worst > bound or least < 0
            yield [f"halving below, D = {degree}, n1 = {n1}", "ulp of f", cases, 0.0, -least], least < 0


WORDS = {
    "quadrics": ("words of quadrics, where nearest to their bound", "unit"),
    "coordinates": ("words of coordinates, where nearest to their bound", "unit"),
    "ends": ("ends of the segment, cut by the raster", "2^-30"),
}


def word_rows(count: int, seed: int):
    """Random polynomials of the pixel that fit their accumulators, at pixels up to 1920: nearest to the bound."""
    dice = random.Random(seed)
    worst, cases = dict.fromkeys(WORDS, (0.0, 1.0)), dict.fromkeys(WORDS, 0)
    with mp.workprec(PRECISION):

        def real(bits, power):
            """Any number below 2^bits, over the factor of that many pixels, with more binary digits than a word has."""
            return (mp.mpf(dice.getrandbits(200)) / mp.mpf(2) ** 199 - 1) * mp.mpf(2) ** (bits - 11 * power)

        for _ in range(count):
            near = dice.randrange(4), dice.randrange(4)
            pixel = dice.choice(((0, 0), near, (dice.randrange(1920), dice.randrange(1920))))
            quadratics = [Quadratic(*(real(58, p) for p in (0, 1, 1, 2, 2, 2))) for _ in range(9)]
            linear = [tuple(real(COORD_ACC_WIDTH - 4, p) for p in (0, 1, 1)) for _ in range(6)]
            for kind, bound, found in word_errors(quadratics, linear, pixel):
                worst[kind] = max(worst[kind], (found, bound), key=lambda pair: pair[0] / pair[1])
                cases[kind] += 1
    for kind, (name, unit) in WORDS.items():
        found, bound = worst[kind]
        yield [name, unit, cases[kind], bound, found], found > bound


def product_rows(count: int, seed: int):
    """Tori and grazing rays, where the terms cancel most: the largest part of the bound."""
    config, dice = Config(units=1), np.random.default_rng(seed)
    worst, cases = (0.0, 1.0), 0
    for make in (stress_rays.grazing, stress_rays.thin, stress_rays.centre):
        for surface, h, e in make(dice, count):
            shape = form(surface)
            if shape.q1 is None:
                continue
            for bound, found in product_errors(chord_quads(shape, h, e), config):
                cases += 1
                worst = max(worst, (found, bound), key=lambda pair: pair[0] / pair[1])
    yield ["product, where nearest to its bound", "ulp of f", cases, worst[1], worst[0]], worst[0] > worst[1]


def resolution_rows(count: int, seed: int):
    """Height of f between two roots in one cell of the last level, which the ends of the cell do not show."""
    dice, digits = np.random.default_rng(seed), 4
    for degree in (4, 2):
        bound, worst = resolution(digits, degree, 36), 0.0
        near = 2.0 ** -dice.uniform(1, 20, (count, 2))  # of the roots from the ends of the cell
        pair = (dice.integers(0, 1 << digits, (count, 1)) + np.stack([near[:, 0], 1 - near[:, 1]], axis=1)) / (
            1 << digits
        )
        rest = dice.normal(size=(count, degree - 1))
        b = stress_polynomials.times(stress_polynomials.through(pair), rest)
        b *= 2.0**35 / np.abs(b).max(axis=1, keepdims=True)
        for part in np.linspace(0, 1, 65):
            worst = max(worst, float(np.abs(bernstein(b, pair[:, 0] + part * (pair[:, 1] - pair[:, 0]))).max()))
        yield [f"pair in a cell, D = {degree}, n = {digits}", "ulp of f", count, bound, worst], worst > bound


def coordinate_rows(count: int, seed: int):
    """Random segments and cells."""
    config, dice = Config(units=1), np.random.default_rng(seed)
    worst = least = bound = 0.0
    for _ in range(count):
        ends, digits = dice.integers(-(2**31), 2**31, 2), int(dice.integers(0, 1 << config.digits))
        bound, off = coordinate_error(*ends, digits, config)
        worst, least = max(worst, float(off)), min(least, float(off))
    yield ["hit point above", "2^-30", count, bound, worst], worst > bound
    yield ["hit point below", "2^-30", count, 0.0, -least], least < 0


def indicator_rows(count: int, seed: int):
    """Points about the surface of random spirals, carried coordinates exact: the evaluator's part of epsilon."""
    dice, dots = random.Random(seed), np.random.default_rng(seed)
    worst, cases = 0.0, 0
    for _ in range(max(1, count // 50)):
        surface = random_spiral(dice)
        config = spiral_config(surface)
        turns, tilt = dots.uniform(0, surface.turns, 50), dots.uniform(0, 2 * np.pi, 50)
        points = stress_spirals.tube_points(surface, turns, tilt, 2.0 ** dots.uniform(-3, 2, 50))
        for _, found in indicator_errors(surface, points, config):
            cases, worst = cases + 1, max(worst, found)
    yield ["indicator of a spiral", "ε", cases, 1.0, worst], worst > 1


def root_rows(count: int, seed: int):
    """First roots of the stress categories: what was passed over, the cell that was found, the error of t."""
    config = Config(units=1)
    above = halving(3, 8, 4, config.width)
    deep, low, high, error = [], [], [], []
    for make in stress.categories(4).values():
        for segments in make(np.random.default_rng(seed), count, config):
            t = trace_segments(segments, config)[0][:, 0]
            judged = stress.judge(segments, t, config)
            dip, hump = passed(segments, t, config.digits, np.flatnonzero(judged.missed | judged.wrong)).T
            deep += np.where(hump == 0, 0.0, dip).tolist()
            ends = np.stack([bernstein(segments.b, (t + k) * 2.0**-config.digits) for k in (0, 1)])[:, t >= 0]
            low += ends.min(axis=0).tolist()
            high += (-ends.max(axis=0)).tolist()
            error += judged.error[judged.well & ~judged.band & ~np.isnan(judged.error)].tolist()
    for name, unit, values, bound in (
        ("passed over: depth of f below 0", "ulp of f", deep, above),
        ("cell found: its positive end below 0", "ulp of f", high, above),
        ("cell found: its other end above 0", "ulp of f", low, 0.0),
        ("t of a well-conditioned root", "ulp of t", error, 2.0),
    ):
        worst = max(0.0, *values)
        # float64 gives values of f to 2^-10
        yield [name, unit, len(values), bound, worst if worst > FLOAT else 0.0], worst > bound + FLOAT


def text(row) -> list[str]:
    """The cells of a row."""
    name, unit, cases, bound, found = row
    return [name, unit, f"{cases:,}", f"{bound:.2f}", f"{abs(found):.2f}", f"{found / bound:.2f}" if bound else ""]


def main() -> int:
    """Command line; exit status 1 where a bound is refuted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rays", type=COUNT, default=200, help="of each category (default: 200)")
    parser.add_argument("--seed", type=SEED, default=1)
    parser.add_argument("--write", action="store_true", help="renew the table in docs/error-analysis.md")
    args = parser.parse_args()
    rows, refuted = [], []
    kinds = (
        (halving_rows, args.rays),
        (word_rows, 4 * args.rays),
        (product_rows, 4 * args.rays),
        (resolution_rows, 20 * args.rays),
        (coordinate_rows, 20 * args.rays),
        (root_rows, 20 * args.rays),
        (indicator_rows, 10 * args.rays),
    )
    for make, count in kinds:
        for row, bad in make(count, args.seed):
            rows.append(text(row))
            refuted += [row[0]] if bad else []
    show_table(f"bounds and worst cases, seed {args.seed}", HEADER, rows, HEADER[:2], 140)
    if args.write:
        write_table(ROOT / "docs" / "error-analysis.md", "errors", HEADER, rows)
    if refuted:
        print(f"errors: refuted: {', '.join(refuted)}", file=sys.stderr)
    return int(bool(refuted))


if __name__ == "__main__":
    sys.exit(status_of(main))
