# SPDX-License-Identifier: Apache-2.0
"""The choice of the cell: RTL equals the model; the certified rule excludes no cell that holds a sign change."""

from math import comb

import cocotb
import pytest

import bench
import latency
from raydix.bound import bounded
from raydix.cells import subdivide
from raydix.formats import FORM_INDEX, FORM_WORDS, VECTOR_WIDTH, ZONES
from raydix.select import certified, changes, paper

CERTIFIED, PAPER, BOTH = 1, 2, 3


def mixed(cells, at, degree):
    """A coefficient is positive and another is not."""
    return len({value > 0 for value in cells[at : at + degree + 1]}) == 2


def candidates(cells, excluded, last, by_paper, degree, n1, possible=0):
    """Mask of the candidates by the model's tests of a cell; ``possible``: of those that a bound does not exclude."""
    count = 1 << n1
    if by_paper:
        return paper(cells, excluded, degree, count)
    test = changes if last else mixed
    mask = sum(1 << j for j in range(count) if test(cells, j * degree, degree))
    return (mask if last else mask | possible) & ~excluded


def first_two(mask, count):
    """Numbers of the lowest two bits, ``count`` where there is none."""
    bits = [j for j in range(mask.bit_length()) if mask >> j & 1]
    return tuple(bits + [count, count])[:2]


def stimuli(dut, count):
    """All control points where they are few; else corners, random ones, and the cells of a parent."""
    width, degree, n1 = (bench.parameter(dut, name) for name in ("W", "D", "N1"))
    size = (1 << n1) * degree + 1
    if width * size <= 15:
        yield from map(list, bench.every(width, size))
        return
    random = bench.rng()
    yield from list(bench.vectors(random, width, size, count))[-2 * count :]
    for b in bench.vectors(random, width, degree + 1, count):
        cells = b + [0] * (size - degree - 1)
        subdivide(cells, degree, n1)
        yield cells


def flags(random, cells, n1):
    """Inputs beside the control points: nothing excluded, everything, or any mask; both rules; last level or not."""
    j = 1 << n1
    excluded = random.choice((0, 0, (1 << j) - 1, (1 << random.randrange(j)) - 1, random.getrandbits(j)))
    possible = random.choice((0, 0, (1 << j) - 1, 1 << random.randrange(j), random.getrandbits(j)))
    request = dict(possible_i=possible, last_i=random.getrandbits(1), paper_i=random.getrandbits(1))
    return dict(cells_i=cells, excluded_i=excluded) | request


def less(item, below):
    """The item with values less by ``below``."""
    return item | dict(cells_i=[value - below for value in item["cells_i"]])


async def equal(dut, items):
    """RTL and model on ``items``."""
    degree, n1, rules, below = (bench.parameter(dut, name) for name in ("D", "N1", "Rules", "Below"))
    least = bench.low(bench.parameter(dut, "W"))

    def expect(item):
        item = less(item, -below)
        by_paper = rules == PAPER or (rules == BOTH and item["paper_i"])
        last, possible = item["last_i"], item["possible_i"]
        mask = candidates(item["cells_i"], item["excluded_i"], last, by_paper, degree, n1, possible)
        pick, following = first_two(mask, count := 1 << n1)
        outputs = {"found_o": pick < count, "more_o": following < count}
        # without a candidate the item keeps the start of its cell; what does not exist is 0
        return outputs | {"pick_o": [pick % count], "next_o": [following % count]}

    await bench.start(dut)
    items = (less(item, below) for item in items if least + below <= min(item["cells_i"]))
    await bench.pipeline(dut, items, expect, latency.select(n1, rules))


@cocotb.test
async def equals_model(dut):
    """found, more, and the two numbers; the second where it means something."""
    n1, random = bench.parameter(dut, "N1"), bench.rng("flags")
    await equal(dut, (flags(random, cells, n1) for cells in stimuli(dut, 400)))


@cocotb.test
async def equals_model_exhaustively(dut):
    """The same for all control points, masks and flags."""
    j = 1 << bench.parameter(dut, "N1")
    items = (
        dict(cells_i=cells, excluded_i=excluded, possible_i=possible, last_i=bits & 1, paper_i=bits >> 1)
        for cells in stimuli(dut, 0)
        for excluded in range(1 << j)
        for possible in range(1 << j)
        for bits in range(4)
    )
    await equal(dut, items)


@cocotb.test
async def walk_equals_masks(dut):
    """The model's walk of the tree finds the first two candidates of the masks, and the first one's control points."""
    width, degree, n1 = (bench.parameter(dut, name) for name in ("W", "D", "N1"))
    random = bench.rng()
    size = degree + 1
    for number, b in enumerate(bench.vectors(random, width, size, 400)):
        item = flags(random, b, n1)
        cells = b + [0] * ((1 << n1) * degree + 1 - size)
        subdivide(cells, degree, n1)
        count = 1 << n1
        wanted = first_two(candidates(cells, item["excluded_i"], item["last_i"], False, degree, n1), count)
        parent = list(b)
        found = certified(parent, [0] * ((n1 + 1) * 5), item["excluded_i"], item["last_i"], degree, n1)
        pick = wanted[0]
        points = b if pick == count else cells[pick * degree : pick * degree + size]
        if found != wanted or parent != points:
            raise bench.mismatch(number, item, [f"expected {wanted} {points}, the walk has {found} {parent}"])


@cocotb.test
async def bounds_are_possible_cells(dut):
    """Vector sums: the model's mask is this module's, possible_i set where no bound excludes a cell."""
    width, n1 = bench.parameter(dut, "W"), bench.parameter(dut, "N1")
    assert bench.parameter(dut, "D") == 1
    random = bench.rng("bounds")
    seen = set()
    for number, cells in enumerate(stimuli(dut, 200)):
        item = flags(random, [max(v, -bench.high(width)) for v in cells], n1)
        level, zone, values = random.randrange(8), random.randrange(ZONES), item["cells_i"]
        form = [0] * FORM_WORDS
        start, shift = random.choice((0, level, level + 1, 63)), n1 * (level + 1)
        since = 2 * n1 * max(level - start, 0)
        form[FORM_INDEX["from_level"] + zone] = start
        for name, digits in (("lipschitz", shift), ("curvature", since)):
            sums = [abs(a) + abs(b) for a, b in zip(values, values[1:], strict=False)]
            bound = random.choice([*sums, max(0, random.choice(sums) - 1), random.getrandbits(width)])
            form[FORM_INDEX[name] + zone] = bound << digits | random.getrandbits(digits)  # rounded up: bound + 1
        bend = (form[FORM_INDEX["curvature"] + zone] >> since) + 1
        most = (form[FORM_INDEX["lipschitz"] + zone] >> shift) + 1
        possible = 0
        for j, (a, b) in enumerate(zip(values, values[1:], strict=False)):
            size, above = abs(a) + abs(b), a > 0 and b > 0 and level >= start
            free = size > most or (above and (size > bend or min(abs(a), abs(b)) > bend >> 2))
            possible |= (not free) << j
        wanted = candidates(values, item["excluded_i"], item["last_i"], False, 1, n1, possible)
        mask = bounded(values, item["excluded_i"], item["last_i"], form, level, zone, n1)
        if mask != wanted:
            raise bench.mismatch(number, item, [f"the bounds leave {possible:b}, so {wanted:b}; the model: {mask:b}"])
        seen.add((possible != 0, possible == (1 << (1 << n1)) - 1))
    assert len(seen) == 3


def signs_of(b, eighths):
    """Signs of the polynomial with Bernstein coefficients b at k/8 for k in ``eighths``, exactly (times 8^D)."""
    degree = len(b) - 1
    return {sum(comb(degree, i) * k**i * (8 - k) ** (degree - i) * v for i, v in enumerate(b)) > 0 for k in eighths}


@cocotb.test
async def certified_misses_nothing(dut):
    """A cell whose polynomial takes both signs, exactly evaluated, is a candidate; at the last level if its ends do."""
    degree, n1 = bench.parameter(dut, "D"), bench.parameter(dut, "N1")
    seen = 0
    for number, cells in enumerate(stimuli(dut, 40)):
        for last in (False, True):
            mask = candidates(cells, 0, last, False, degree, n1)
            for j in range(1 << n1):
                b = cells[j * degree : j * degree + degree + 1]
                signs = signs_of(b, (0, 8) if last else range(9))
                seen += len(signs) == 2
                if len(signs) == 2 and not mask >> j & 1:
                    raise bench.mismatch(number, {"cell": b}, [f"cell {j} changes sign, candidates: {bin(mask)}"])
    assert seen > 100, "the stimuli do not change sign"


WIDE = [
    dict(W=36, D=4, N1=3, Rules=BOTH),
    dict(W=36, D=4, N1=3, Rules=CERTIFIED),
    dict(W=37, D=4, N1=3, Rules=CERTIFIED, Below=1),
    dict(W=36, D=4, N1=3, Rules=PAPER),
    dict(W=48, D=2, N1=4, Rules=BOTH),
    dict(W=16, D=3, N1=2, Rules=BOTH),
    dict(W=VECTOR_WIDTH, D=1, N1=3, Rules=BOTH),
    dict(W=3, D=2, N1=1, Rules=BOTH),
]


@pytest.mark.parametrize("parameters", WIDE, ids=bench.label)
def test_choice(parameters):
    """Corners, random control points and cells of a parent; all control points at W = 3; every set of rules.

    Cells that a bound leaves possible, whatever the degree.
    """
    checks = ["equals_model", "certified_misses_nothing"]
    checks += ["walk_equals_masks"] * (parameters["W"] > 3) + ["bounds_are_possible_cells"] * (parameters["D"] == 1)
    bench.run(__name__, "rdx_select", parameters, checks)


@pytest.mark.parametrize("rules, below", [(CERTIFIED, 0), (CERTIFIED, 1), (PAPER, 0), (BOTH, 0)])
def test_every_small_choice(rules, below):
    """Exhaustive in control points, excluded and possible cells, level and rule."""
    bench.run(__name__, "rdx_select", dict(W=3, D=1, N1=1, Rules=rules, Below=below), ["equals_model_exhaustively"])
