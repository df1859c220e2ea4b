# SPDX-License-Identifier: Apache-2.0
"""The end of a step: RTL equals the model, of which the hit point is within half an ulp of the middle of the cell."""

from fractions import Fraction

import cocotb
import pytest

import bench
import latency
from raydix.formats import (
    BOX_WIDTH,
    COORD_FRAC,
    COORD_WIDTH,
    DEPTH_WIDTH,
    FORM_INDEX,
    FORM_WORDS,
    ROOTS_WIDTH,
    STEPS_MAX,
    VECTOR_WIDTH,
)
from raydix.item import AGAIN, BOX, DEPTH, DONE, HIT, IDLE, RUN, SIZE, B, C
from raydix.normalize import norm_limit, normalize
from raydix.select import changes
from raydix.settle import settle
from test_descend import POINT

FACES = bench.Struct(("face", -COORD_WIDTH, 3))  # of low_i and of high_i


def structs(dut):
    """The structs of the ports."""
    digits = bench.parameter(dut, "N1") * bench.parameter(dut, "K")
    control, points = (
        bench.control(digits),
        bench.Struct(("b", -bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1)),
    )
    return dict(control_i=control, control_o=control, b_i=points, b_o=points, point_i=POINT)


def constants(faces):
    """Words of a surface of which the box (low, high) counts, for the model."""
    form = [0] * FORM_WORDS
    for name, face in zip(("low", "high"), faces, strict=True):
        form[FORM_INDEX[name] : FORM_INDEX[name] + 3] = face
    return form


def model(dut, control, segment, dead, faces):
    """Control and segment by the golden model; whether the control points mean something."""
    n1, steps, width, degree = (bench.parameter(dut, name) for name in ("N1", "K", "W", "D"))
    control, segment = dict(control), dict(segment)
    if control["status"] != RUN:
        return control, segment, False
    last = control["level"] == steps - 1
    item = [0] * SIZE
    item[BOX : BOX + 3] = control["box"]
    item[C : C + 6] = segment["start"] + segment["stop"]
    item[DEPTH : DEPTH + 2] = segment["depth_start"], segment["depth_stop"]
    item[B : B + degree + 1] = segment["b"]
    status = RUN
    if dead:
        status = DONE
    elif last:
        status = HIT if settle(item, constants(faces), degree) and changes(item, B, degree) else DONE
    else:
        control["level"] += 1
        if degree > 1:
            normalize(item, B, degree + 1, width, width, norm_limit(n1))
    if status == DONE and control["pending"]:
        status = AGAIN
    if control["steps"] == STEPS_MAX and status != HIT:
        status = DONE
    control["status"] = status
    if status == HIT:
        control["enters"] = int(segment["b"][0] > 0)
    segment = dict(start=item[C : C + 3], stop=item[C + 3 : C + 6], b=item[B : B + degree + 1])
    segment |= dict(depth_start=item[DEPTH], depth_stop=item[DEPTH + 1])
    return control, segment, status == RUN


def batches(dut, count):
    """Items in batches of one box (low, high): it counts where D = 1, and is constant there."""
    random = bench.rng("faces")
    for number in range(5 if bench.parameter(dut, "D") == 1 else 1):
        faces = [[random.randint(bench.low(COORD_WIDTH) + 8, bench.high(COORD_WIDTH) - 8) for _ in range(3)]
                 for _ in range(2)]  # fmt: skip
        faces = [list(map(f, *faces)) for f in (min, max)]
        if number == 0:  # an axis that is not cut
            faces[0][1], faces[1][1] = bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)
        yield faces, stimuli(dut, count, faces, bench.rng(number))


def stimuli(dut, count, faces, random):
    """Items of every status and level; cells at the faces of the box; steps at their limit."""
    n1, steps, width, degree = (bench.parameter(dut, name) for name in ("N1", "K", "W", "D"))
    points = bench.vectors(random, width, degree + 1, count)
    for b in points:
        box = [random.choice((0, 0, 1, 2, random.randrange(1 << BOX_WIDTH))) for _ in range(3)]
        start = [random.choice((-1, 1)) * (1 << (COORD_FRAC + 1 - m)) if m else 0 for m in box]
        if degree == 1:  # one axis at a face, others within
            cut = random.randrange(3)
            start = [random.choice(pair) if i == cut else random.randint(*pair)
                     for i, pair in enumerate(zip(*faces, strict=True))]  # fmt: skip
        if random.random() < 0.3:
            start = [random.randint(bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)) for _ in box]
        elif degree == 1:
            start = [v + random.randint(-3, 3) for v in start]
        else:
            start = [int(v * random.choice((1, 1, random.random()))) + random.randint(-3, 3) for v in start]
        start = [max(bench.low(COORD_WIDTH), min(bench.high(COORD_WIDTH), v)) for v in start]
        stop = [bench.signed(v + random.randint(-5, 5), COORD_WIDTH) for v in start]
        depths = [random.randint(0, bench.high(DEPTH_WIDTH)) for _ in range(2)]
        control = dict(
            status=random.choice((IDLE, RUN, RUN, RUN, RUN, RUN, AGAIN, HIT, DONE)),
            paper=random.getrandbits(1),
            roots=random.getrandbits(ROOTS_WIDTH),
            box=box,
            level=random.choice((0, steps - 1, steps - 1, random.randrange(steps))),
            steps=random.choice((1, STEPS_MAX - 1, STEPS_MAX, random.randint(1, STEPS_MAX))),
            follow=random.getrandbits(1),
            pending=random.getrandbits(1),
            enters=random.getrandbits(1),
            **{name: random.getrandbits(n1 * steps) for name in ("t", "t_min", "t_next")},
        )
        segment = dict(start=start, stop=stop, depth_start=depths[0], depth_stop=depths[1], b=b)
        yield dict(control_i=control, segment_i=segment, dead_i=int(random.random() < 0.2))


@cocotb.test
async def equals_model(dut):
    """Status, level and scaled control points, SettleLatency clocks later; other items pass unchanged."""
    seen = set()
    kinds = structs(dut)
    await bench.start(dut)
    for faces, items in batches(dut, 1500):
        items = list(items)
        answers = [model(dut, item["control_i"], item["segment_i"], item["dead_i"], faces) for item in items]
        order = iter(range(len(items) + 1))

        def clocks(items=items, answers=answers):
            points = [[0, 0, 0], *(segment["start"] for _, segment, _ in answers)]
            for point, item in zip(points, [*items, items[-1]], strict=True):
                given = dict(control_i=item["control_i"], b_i=dict(b=item["segment_i"]["b"]), dead_i=item["dead_i"])
                yield given | dict(point_i=dict(at=point))

        def expect(_, items=items, answers=answers, order=order):
            if (number := next(order)) == len(items):
                return {}
            control, segment, points = answers[number]
            seen.add((items[number]["control_i"]["status"], control["status"]))
            return dict(control_o=control) | (dict(b_o=dict(b=segment["b"])) if points else {})

        await bench.noise(dut, "low_i", "high_i")
        for name, face in zip(("low_i", "high_i"), faces, strict=True):
            bench.Port(dut, name, FACES).write(dict(face=face))
        await bench.pipeline(dut, clocks(), expect, latency.SETTLE, kinds)
    assert seen == {(RUN, s) for s in (RUN, HIT, AGAIN, DONE)} | {(s, s) for s in (IDLE, AGAIN, HIT, DONE)} or (
        bench.parameter(dut, "K") == 1 and (RUN, RUN) not in seen
    ), seen


@cocotb.test
async def within_bound(dut):
    """A hit's ends have met within half an ulp of the exact middle, half up; the point is in the box."""
    hits = edges = 0
    for faces, items in batches(dut, 1500):
        for number, item in enumerate(items):
            control, segment, _ = model(dut, item["control_i"], item["segment_i"], item["dead_i"], faces)
            if item["control_i"]["status"] != RUN or control["status"] != HIT:
                continue
            hits += 1
            old = item["segment_i"]
            pairs = [*zip(old["start"], old["stop"], strict=True), (old["depth_start"], old["depth_stop"])]
            point = [*segment["start"], segment["depth_start"]]
            good = point == [*segment["stop"], segment["depth_stop"]] and (old["b"][0] > 0) != (old["b"][-1] > 0)
            good &= all(0 <= p - Fraction(a + b, 2) <= Fraction(1, 2) for p, (a, b) in zip(point, pairs, strict=True))
            if bench.parameter(dut, "D") == 1:
                good &= all(low <= p <= high for p, low, high in zip(point[:3], *faces, strict=True))
                edges += any(p in pair for p, *pair in zip(point[:3], *faces, strict=True))
            else:
                good &= all(-(2 ** (1 - m)) <= Fraction(p, 1 << COORD_FRAC) < Fraction(2) ** (1 - m)
                            for p, m in zip(point[:3], control["box"], strict=True))  # fmt: skip
            if not good:
                raise bench.mismatch(number, item, [f"the model has {control} {segment}"])
    assert hits > 20, f"only {hits} hits"
    assert edges > 5 or bench.parameter(dut, "D") > 1, f"only {edges} hits on a face"


SETS = [
    dict(N1=3, K=8, W=36, D=4),
    dict(N1=1, K=32, W=16, D=2),
    dict(N1=4, K=1, W=48, D=3),
    dict(N1=3, K=8, W=VECTOR_WIDTH, D=1),
    dict(N1=2, K=1, W=VECTOR_WIDTH, D=1),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_settle(parameters):
    """The reference, the most steps, a single step; vector sums, whose values are not scaled."""
    bench.run(__name__, "rdx_settle", parameters)
