# SPDX-License-Identifier: Apache-2.0
"""One step of the descent: RTL equals the model in every bit; the model's new cell is within its bound."""

from fractions import Fraction
from math import comb

import cocotb
import pytest

import bench
import latency
import spirals
from raydix.ends import ends as indicator_at_ends
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH, DEPTH_WIDTH, ROOTS_WIDTH, STEPS_MAX
from raydix.formats import VECTOR_WIDTH as VECTOR
from raydix.item import (
    AGAIN,
    BOX,
    DEPTH,
    DONE,
    ENTERS,
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
from raydix.kernel import words, zeros
from raydix.normalize import norm_limit
from raydix.step import new_work, step
from raydix.vecsum import new_lanes

CERTIFIED_ONLY, PAPER_ONLY, BOTH = 1, 2, 3
SCALARS = dict(
    status=STATUS, paper=PAPER, roots=ROOTS, level=LEVEL, steps=STEPS, follow=FOLLOW, pending=PENDING, enters=ENTERS
)
SCALARS |= dict(t=T, t_min=TMIN, t_next=TNEXT)
ALGEBRAIC, VECTOR_SUM = ["equals_model", "within_bound"], ["vector_sums_equal_model", "indicator_is_that_at_the_ends"]
REACH = 7 << COORD_FRAC - 2  # largest coordinate of a vector sum's segment, 7/4


def shape(dut):
    """N1, K, W, D, Rules."""
    return [bench.parameter(dut, name) for name in ("N1", "K", "W", "D", "Rules")]


def structs(dut):
    """The structs of the ports."""
    n1, steps, width, degree, _ = shape(dut)
    control, segment = bench.control(n1 * steps), bench.segment(width, degree)
    return dict(control_i=control, control_o=control, segment_i=segment, segment_o=segment)


def item_of(control, segment):
    """The model's item of two dictionaries of fields."""
    item = zeros(SIZE)
    for name, place in SCALARS.items():
        item[place] = control[name]
    item[BOX : BOX + 3] = words(control["box"])
    item[C : C + 6] = words([*segment["start"], *segment["stop"]])
    item[DEPTH : DEPTH + 2] = words([segment["depth_start"], segment["depth_stop"]])
    item[B : B + len(segment["b"])] = words(segment["b"])
    return item


def fields_of(item, degree):
    """And back: control, segment."""
    control = {name: int(item[place]) for name, place in SCALARS.items()} | dict(box=item[BOX : BOX + 3].tolist())
    segment = dict(start=item[C : C + 3].tolist(), stop=item[C + 3 : C + 6].tolist())
    segment |= dict(depth_start=int(item[DEPTH]), depth_stop=int(item[DEPTH + 1]), b=item[B : B + degree + 1].tolist())
    return control, segment


def drop_of(dut):
    """Digits that the evaluator of vector sums leaves away."""
    return bench.parameter(dut, "VectorDrop")


def model(dut, control, segment, form=None):
    """Control and segment after the model's step, with the rule that the design has."""
    n1, steps, width, degree, rules = shape(dut)
    if control["status"] != RUN:
        return control, segment
    item = item_of(control, segment)
    item[PAPER] = {CERTIFIED_ONLY: 0, PAPER_ONLY: 1, BOTH: control["paper"]}[rules]
    general = degree == 1 and bench.parameter(dut, "General")
    step(item, form, new_work(n1, degree, drop_of(dut)), n1, steps, width, degree, general)
    after, moved = fields_of(item, degree)
    return after | dict(paper=control["paper"]), moved


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
            enters=random.getrandbits(1),
            t=t,
            t_min=t_min,
            t_next=random.getrandbits(digits),
        )
        yield dict(control_i=control, segment_i=segment | dict(b=b))


def latency_of(dut):
    """Clocks of a step."""
    n1, _, _, degree, rules = shape(dut)
    return latency.step(
        n1, degree, bench.parameter(dut, "HalveStages"), bench.parameter(dut, "Lanes"), rules, drop_of(dut)
    )


def expected(dut, kinds, seen, item, form=None):
    """The output ports: what is no longer needed is what the design gives. Notes the change of status in ``seen``."""
    control, segment = model(dut, item["control_i"], item["segment_i"], form)
    before, after = item["control_i"]["status"], control["status"]
    seen.add((before, after))
    given = kinds["segment_o"].unpack(bench.Port(dut, "segment_o").read()[0])
    segment = dict(segment)
    if after != RUN:
        segment["b"] = given["b"]
        if after != HIT:
            kept = dict(depth_start=segment["depth_start"]) if before == RUN and after == AGAIN else {}
            segment = given | kept
    return dict(control_o=control, segment_o=segment)


EVERY_CHANGE = {(RUN, s) for s in (RUN, HIT, AGAIN, DONE)} | {(s, s) for s in (IDLE, AGAIN, HIT, DONE)}


@cocotb.test
async def equals_model(dut):
    """Every field that is still needed, step_latency clocks later. Of items that are not Run the control fields pass
    unchanged, of a hit the point, too: halving a cell whose ends have met does not move them. The same without the
    test of boxes, for items that no face cuts."""
    kinds = structs(dut)
    seen = set()

    def expect(item):
        return expected(dut, kinds, seen, item)

    await bench.start(dut)
    await bench.noise(dut, "modes_i")
    dut.modes_i.value = 3  # boxes and early leaving, all digits
    await bench.pipeline(dut, stimuli(dut, 1000), expect, latency_of(dut), kinds)
    assert seen == EVERY_CHANGE, seen
    dut.modes_i.value = 1  # early leaving only: no boxes
    whole = (item | dict(control_i=item["control_i"] | dict(box=[0, 0, 0])) for item in stimuli(dut, 300))
    await bench.pipeline(dut, whole, expect, latency_of(dut), kinds)


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


# ---- vector sums, D = 1 ----


def surfaces(dut):
    """Compiled spirals that the evaluator at hand can do."""
    for name, index in spirals.GENERAL if bench.parameter(dut, "General") else spirals.HELIX:
        yield spirals.surface(name, index, shape(dut)[0])


def made_up(random, constants, left):
    """A segment anywhere within reach, as long as a cell of ``left`` digits or so; any values, small ones too."""
    segment = carried(random, [0, 0, 0])
    start = [random.choice((REACH, -REACH, random.randint(-REACH, REACH))) for _ in range(3)]
    if random.random() < 0.5:  # at a face of the box
        face, axis = random.choice(("low", "high")), random.randrange(3)
        start[axis] = constants[face][axis] + random.choice((-1, 0, 1))
    stop = [v + random.randint(-REACH, REACH) // (1 << random.choice((0, 2, 32 - left))) for v in start]
    if random.random() < 0.3:  # near the axis
        near = random.randint(0, 20)
        start[:2], stop[:2] = ([v >> near for v in end[:2]] for end in (start, stop))
    ends = [[max(-REACH, min(REACH, v)) for v in end] for end in (start, stop)]
    bits = [random.randint(2, VECTOR) for _ in range(2)]
    values = [max(-bench.high(VECTOR), bench.signed(random.getrandbits(n), n)) for n in bits]
    return segment | dict(start=ends[0], stop=ends[1], b=values)


def vector_sum_stimuli(dut, random, found, count):
    """Items of the model at the start of their steps, some changed in what is not their segment, and made-up ones."""
    n1, steps, _, degree, rules = shape(dut)
    general, digits = bench.parameter(dut, "General"), n1 * steps
    constants = bench.form_fields(spirals.form(found))
    for item in spirals.items(random, found, n1, steps, general, count):
        control, segment = fields_of(item, degree)
        control["paper"] = int(rules == PAPER_ONLY or random.random() < 0.3)
        if random.random() < 0.3:
            # the paper rule needs no sign change on its way: it comes to any level with any segment
            control["level"] = random.choice((0, steps - 1, random.randrange(steps)))
            left = n1 * (steps - control["level"])
            control["t"] = control["t"] >> left << left
            if random.random() < 0.5:
                segment = made_up(random, constants, left)
        if random.random() < 0.4:
            control |= dict(follow=1, t_min=random.choice((control["t"], random.getrandbits(digits))))
        if random.random() < 0.3:
            control |= dict(pending=1 - control["pending"], t_next=random.getrandbits(digits))
        if random.random() < 0.1:
            control["steps"] = random.choice((STEPS_MAX - 1, STEPS_MAX - 2))
        if random.random() < 0.1:
            control["status"] = random.choice((IDLE, AGAIN, HIT, DONE))
            if control["status"] == HIT:  # its ends have met
                segment |= dict(stop=segment["start"], depth_stop=segment["depth_start"])
        yield dict(control_i=control, segment_i=segment)


def with_phases(dut, random, items):
    """Each item at phase 0; in the other phases, and behind the last one, anything that is not to matter."""
    kinds = structs(dut)
    count = latency.phases((1 << shape(dut)[0]) - 1, bench.parameter(dut, "Lanes"))

    def anything(phase):
        parts = {name: kind.unpack(random.getrandbits(kind.width)) for name, kind in kinds.items() if name[-1] == "i"}
        return parts | dict(phase_i=phase)

    for item in items:
        yield item | dict(phase_i=0)
        for phase in range(1, count):
            yield anything(phase)
    for clock in range(latency_of(dut)):
        yield anything(clock % count)


@cocotb.test
async def vector_sums_equal_model(dut):
    """Every field that is still needed, step_latency clocks later, of an item each Phases clocks; several surfaces."""
    kinds, seen, random = structs(dut), set(), bench.rng()
    place = bench.Port(dut, "form_i", bench.FORM)
    await bench.start(dut)
    await bench.noise(dut, "modes_i")
    dut.modes_i.value = 3  # boxes and early leaving, all digits
    clocks = 0
    for found in surfaces(dut):
        constants = spirals.form(found)
        await bench.noise(dut, "form_i")
        place.write(bench.form_fields(constants))
        items = list(vector_sum_stimuli(dut, random, found, 150))
        number = {id(item["control_i"]): item for item in items}  # the bubbles are not in it

        def expect(item, number=number, constants=constants):
            known = id(item["control_i"]) in number
            return expected(dut, kinds, seen, item, constants) if known else {}

        clocks += await bench.pipeline(dut, with_phases(dut, random, items), expect, latency_of(dut), kinds)
    dut._log.info(f"{clocks} clocks")
    assert seen == EVERY_CHANGE, seen


@cocotb.test
async def indicator_is_that_at_the_ends(dut):
    """The values that the model's item carries from step to step are the evaluator's at its ends."""
    n1, steps, _, degree, _ = shape(dut)
    general, lanes, random = bench.parameter(dut, "General"), new_lanes(2, drop_of(dut)), bench.rng()
    hits = 0
    for found in surfaces(dut):
        constants = spirals.form(found)
        for number, item in enumerate(spirals.items(random, found, n1, steps, general, 300, drop_of(dut))):
            control, segment = fields_of(item, degree)
            after, moved = model(dut, control, segment, constants)
            copy = item_of(after, moved)
            indicator_at_ends(copy, lanes, constants, general)
            if after["status"] == RUN and copy[B : B + 2].tolist() != moved["b"]:
                raise bench.mismatch(number, segment, [f"values {moved['b']}, at the ends {copy[B : B + 2]}"])
            hits += after["status"] == HIT
    assert hits > 1, f"{hits} hits"


SETS = [
    dict(N1=3, K=8, W=36, D=4, Rules=BOTH),
    dict(N1=3, K=8, W=36, D=4, Rules=CERTIFIED_ONLY, HalveStages=0),
    dict(N1=3, K=8, W=36, D=4, Rules=CERTIFIED_ONLY),
    dict(N1=1, K=24, W=36, D=2, Rules=CERTIFIED_ONLY),
    dict(N1=3, K=8, W=36, D=4, Rules=PAPER_ONLY, HalveStages=4),
    pytest.param(dict(N1=1, K=32, W=16, D=2, Rules=BOTH), marks=pytest.mark.long),
    dict(N1=2, K=12, W=48, D=3, Rules=BOTH, HalveStages=1),
    dict(N1=4, K=8, W=48, D=2, Rules=BOTH),
    dict(N1=3, K=8, W=28, D=4, Rules=CERTIFIED_ONLY, HalveStages=1),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_step(parameters):
    """The reference with each set of rules; J = 2 to 16, all widths, as many digits as fit."""
    bench.run(__name__, "rdx_step", parameters, ALGEBRAIC)


VECTOR_SETS = [
    dict(N1=1, K=32, Lanes=1, General=0, Rules=BOTH),
    dict(N1=2, K=5, Lanes=1, General=1, Rules=CERTIFIED_ONLY),
    dict(N1=1, K=13, Lanes=1, General=0, Rules=CERTIFIED_ONLY, VectorDrop=12),
    dict(N1=3, K=8, Lanes=7, General=0, Rules=BOTH),
    pytest.param(dict(N1=3, K=8, Lanes=3, General=1, Rules=BOTH), marks=pytest.mark.long),
    pytest.param(dict(N1=4, K=8, Lanes=4, General=1, Rules=PAPER_ONLY), marks=pytest.mark.long),
]


@pytest.mark.parametrize("parameters", VECTOR_SETS, ids=bench.label)
def test_step_of_vector_sums(parameters):
    """One evaluator, some and all; for helices and for every spiral; each rule alone and both."""
    bench.run(__name__, "rdx_step", dict(D=1, W=VECTOR, HalveStages=1) | parameters, VECTOR_SUM)
