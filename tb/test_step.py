# SPDX-License-Identifier: Apache-2.0
"""One step of the descent: RTL equals the model in every bit; the model's new cell is within its bound."""

from fractions import Fraction
from math import comb

import cocotb
import pytest

import bench
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH, DEPTH_WIDTH, ROOTS_WIDTH, STEPS_MAX
from raydix.item import (
    AGAIN,
    BOX,
    DEPTH,
    DONE,
    FOLLOW,
    HIT,
    IDLE,
    LEVEL,
    PAPER,
    PENDING,
    ROOTS,
    RUN,
    SIZE,
    STATUS,
    STEPS,
    TMIN,
    TNEXT,
    B,
    C,
    T,
)
from raydix.normalize import norm_limit
from raydix.step import step

CERTIFIED_ONLY, PAPER_ONLY, BOTH = 1, 2, 3
SCALARS = dict(status=STATUS, paper=PAPER, roots=ROOTS, level=LEVEL, steps=STEPS, follow=FOLLOW, pending=PENDING)
SCALARS |= dict(t=T, t_min=TMIN, t_next=TNEXT)


def shape(dut):
    """N1, K, W, D, Rules."""
    return [bench.parameter(dut, name) for name in ("N1", "K", "W", "D", "Rules")]


def structs(dut):
    """The structs of the ports."""
    n1, steps, width, degree, _ = shape(dut)
    control, segment = bench.control(n1 * steps), bench.segment(width, degree)
    return dict(control_i=control, control_o=control, segment_i=segment, segment_o=segment)


def model(dut, control, segment):
    """Control and segment after the model's step, with the rule that the design has."""
    n1, steps, width, degree, rules = shape(dut)
    if control["status"] != RUN:
        return control, segment
    item = [0] * SIZE
    for name, place in SCALARS.items():
        item[place] = control[name]
    item[PAPER] = {CERTIFIED_ONLY: 0, PAPER_ONLY: 1, BOTH: control["paper"]}[rules]
    item[BOX : BOX + 3] = control["box"]
    item[C : C + 6] = segment["start"] + segment["stop"]
    item[DEPTH : DEPTH + 2] = segment["depth_start"], segment["depth_stop"]
    item[B : B + degree + 1] = segment["b"]
    step(item, [0] * ((1 << n1) * degree + 1), [0] * ((n1 + 1) * (degree + 1)), n1, steps, width, degree)
    after = {name: item[place] for name, place in SCALARS.items()} | dict(paper=control["paper"], box=control["box"])
    moved = dict(start=item[C : C + 3], stop=item[C + 3 : C + 6], b=item[B : B + degree + 1])
    return after, moved | dict(depth_start=item[DEPTH], depth_stop=item[DEPTH + 1])


def polynomial(random, width, degree):
    """Bernstein coefficients, scaled to ``width`` bits, of a polynomial with some of its roots in [0, 1)."""
    coefficients = [1.0]  # of powers of t, the constant first
    roots = []
    while len(coefficients) <= degree:
        left = degree + 1 - len(coefficients)
        kind = random.random()
        if left > 1 and kind < 0.3:  # no real root: ((t - m)^2 + d^2)
            middle, distance = random.uniform(-0.5, 1.5), 10 ** random.uniform(-4, 0)
            factor = [middle**2 + distance**2, -2 * middle, 1.0]
        else:
            root = random.random() if kind < 0.9 else random.uniform(-1, 2)
            if roots and random.random() < 0.3:  # near the one before, or the same
                root = roots[-1] + random.choice((0, 1e-6, 1e-3, -1e-3))
            roots.append(root)
            factor = [-root, 1.0]
        product = [0.0] * (len(coefficients) + len(factor) - 1)
        for i, c in enumerate(coefficients):
            for j, f in enumerate(factor):
                product[i + j] += c * f
        coefficients = product
    b = [sum(comb(i, j) / comb(degree, j) * coefficients[j] for j in range(i + 1)) for i in range(degree + 1)]
    bits = width - 1 - random.choice((0, 0, 1, 3, random.randrange(width - 1)))
    scale = random.choice((-1, 1)) * bench.high(bits + 1) / max(abs(v) for v in b)
    return [max(bench.low(width), min(bench.high(width), round(v * scale))) for v in b]


def carried(random, box):
    """Ends and depths: coordinates about the faces of the box, a few over the whole range."""
    start, stop = [], []
    for m in box:
        face = 2.0 ** (COORD_FRAC + 1 - (m if random.random() < 0.9 else 1))
        for ends in (start, stop):
            value = round(random.choice((0.999, 0.9, 1.0, 1.5)) * random.choice((-1, 1, random.uniform(-1, 1))) * face)
            ends.append(max(bench.low(COORD_WIDTH), min(bench.high(COORD_WIDTH), value)))
    depths = [random.randint(0, bench.high(DEPTH_WIDTH)) for _ in range(2)]
    return dict(start=start, stop=stop, depth_start=depths[0], depth_stop=depths[1])


def stimuli(dut, count):
    """Corners of the control points, then items with a polynomial: every level, following t_min or not, and not Run."""
    n1, steps, width, degree, _ = shape(dut)
    digits, random = n1 * steps, bench.rng()
    points = list(bench.corners(width, degree + 1))
    for number in range(len(points) + count):
        b = points[number] if number < len(points) else polynomial(random, width, degree)
        box = [random.choice((0, 0, 0, 1, 1, random.randrange(1 << BOX_WIDTH))) for _ in range(3)]
        level = random.choice((0, steps - 1, random.randrange(steps)))
        left = n1 * (steps - level)  # digits still to be fixed
        t = random.getrandbits(digits) >> left << left
        t_min = t | random.getrandbits(left) if random.random() < 0.7 else random.getrandbits(digits)
        status = RUN if random.random() < 0.9 else random.choice((IDLE, AGAIN, HIT, DONE))
        segment = carried(random, box)
        if status == HIT:  # its ends have met
            segment |= dict(stop=segment["start"], depth_stop=segment["depth_start"])
        control = dict(
            status=status,
            paper=random.getrandbits(1),
            roots=random.getrandbits(ROOTS_WIDTH),
            box=box,
            level=level,
            steps=random.choice((level, random.randrange(STEPS_MAX), STEPS_MAX - 1, STEPS_MAX - 2)),
            follow=int(random.random() < 0.4),
            pending=random.getrandbits(1),
            t=t,
            t_min=t_min,
            t_next=random.getrandbits(digits),
        )
        yield dict(control_i=control, segment_i=segment | dict(b=b))


@cocotb.test
async def equals_model(dut):
    """Every field that is still needed, step_latency clocks later. Of items that are not Run the control fields pass
    unchanged, of a hit the point, too: halving a cell whose ends have met does not move them."""
    n1, _, _, _, rules = shape(dut)
    kinds = structs(dut)
    seen = set()

    def expect(item):
        control, segment = model(dut, item["control_i"], item["segment_i"])
        before, after = item["control_i"]["status"], control["status"]
        seen.add((before, after))
        given = kinds["segment_o"].unpack(bench.Port(dut, "segment_o").read()[0])
        segment = dict(segment)
        if after != RUN:
            segment["b"] = given["b"]
            if after != HIT:
                segment = given
        return dict(control_o=control, segment_o=segment)

    await bench.start(dut)
    select = 1 if rules == CERTIFIED_ONLY else 2 + (n1 + 2) // 2
    latency = n1 * bench.parameter(dut, "HalveStages") + select + 1 + 2
    await bench.pipeline(dut, stimuli(dut, 1000), expect, latency, kinds)
    assert seen == {(RUN, s) for s in (RUN, HIT, AGAIN, DONE)} | {(s, s) for s in (IDLE, AGAIN, HIT, DONE)}, seen


@cocotb.test
async def within_bound(dut):
    """The new cell is the old one's at the digits chosen: control points within N1*D/2 ulp before the scaling,
    coordinates and depth within N1/2 ulp (a hit: half an ulp more); earlier digits stay. By the certified rule t is not
    before t_min."""
    n1, steps, _, degree, rules = shape(dut)
    cells = 1 << n1
    checked = hits = 0
    for number, item in enumerate(stimuli(dut, 500)):
        old, segment = item["control_i"], item["segment_i"]
        control, moved = model(dut, old, segment)
        if old["status"] != RUN or control["status"] not in (RUN, HIT):
            continue
        checked, hits = checked + 1, hits + (control["status"] == HIT)
        shift = n1 * (steps - 1 - old["level"])
        pick = control["t"] - old["t"] >> shift
        ends = [Fraction(pick + i, cells) for i in (0, 1)]
        bound = Fraction(n1, 2)
        if control["status"] == HIT:
            ends, bound = [Fraction(2 * pick + 1, 2 * cells)] * 2, Fraction(n1 + 1, 2)
        lines = []
        if old["t"] | pick << shift != control["t"] or not 0 <= pick < cells:
            lines.append(f"t became {control['t']:#x}")
        by_paper = rules == PAPER_ONLY or (rules == BOTH and old["paper"])
        if old["follow"] and not by_paper and pick < (old["t_min"] >> shift) % cells:
            lines.append(f"t became {control['t']:#x}, before t_min")
        lanes = list(zip(segment["start"], segment["stop"], moved["start"], moved["stop"], strict=True))
        lanes.append(tuple(s[name] for s in (segment, moved) for name in ("depth_start", "depth_stop")))
        for start, stop, *new in lanes:
            if any(abs(start + (stop - start) * u - v) > bound for u, v in zip(ends, new, strict=True)):
                lines.append(f"{start}, {stop} became {new}")
        if control["status"] == RUN:
            exact = blossom(segment["b"], ends)
            scales = [1 << s for s in range(norm_limit(n1) + 1)]
            slack = Fraction(n1 * degree, 2)
            if not any(all(abs(e - Fraction(v, s)) <= slack for e, v in zip(exact, moved["b"], strict=True))
                       for s in scales):  # fmt: skip
                lines.append(f"control points {moved['b']}, exact before the scaling: {[float(e) for e in exact]}")
        if lines:
            raise bench.mismatch(number, item, lines)
    assert checked > 50 and hits > 5, f"{checked} items checked, {hits} hits"


def blossom(b, ends):
    """Bernstein coefficients on the cell ``ends``: the blossom at D-i times its start and i times its end."""
    degree = len(b) - 1
    points = []
    for i in range(degree + 1):
        row = [Fraction(v) for v in b]
        for k in range(degree):
            u = ends[1] if k < i else ends[0]
            row = [x + (y - x) * u for x, y in zip(row, row[1:], strict=False)]
        points.append(row[0])
    return points


SETS = [
    dict(N1=3, K=8, W=36, D=4, Rules=BOTH),
    dict(N1=3, K=8, W=36, D=4, Rules=CERTIFIED_ONLY, HalveStages=0),
    dict(N1=3, K=8, W=36, D=4, Rules=PAPER_ONLY, HalveStages=4),
    dict(N1=1, K=32, W=16, D=2, Rules=BOTH),
    dict(N1=2, K=12, W=48, D=3, Rules=BOTH, HalveStages=1),
    dict(N1=4, K=8, W=48, D=2, Rules=BOTH),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_step(parameters):
    """The reference with each set of rules; J = 2 to 16, all widths, as many digits as fit."""
    bench.run(__name__, "rdx_step", parameters)
