# SPDX-License-Identifier: Apache-2.0
"""First part of a step of a vector-sum surface: the indicator, masks and the chosen cell are the model's."""

import cocotb
import pytest

import bench
import latency
import spirals
from raydix.bound import limits, possible
from raydix.formats import VECTOR_WIDTH
from raydix.item import LEVEL, B
from raydix.outside import outside_faces
from raydix.step import boundaries, new_work
from test_descend import POINT, cell, closed
from test_split import given, given_parts
from test_step import fields_of, item_of, made_up


def shape(dut):
    """N1, K, General, Lanes, Wait, VectorDrop."""
    return [bench.parameter(dut, name) for name in ("N1", "K", "General", "Lanes", "Wait", "VectorDrop")]


def stimuli(dut, random, found, count):
    """Items at the start of steps, some with any segment and level, and the cell that will be chosen."""
    n1, steps, general, *_, drop = shape(dut)
    constants = bench.form_fields(spirals.form(found))
    for item in spirals.items(random, found, n1, steps, general, count, drop):
        control, segment = fields_of(item, 1)
        if random.random() < 0.3:
            control["level"] = random.randrange(steps)
            segment = made_up(random, constants, n1 * (steps - control["level"]))
        choice = dict(pick=random.randrange(1 << n1), close=random.getrandbits(1))
        yield dict(control_i=control, segment_i=segment) | choice


def model(dut, found, item):
    """Values at the boundaries, masks of the cells outside and of those that may hold a root, chosen cell."""
    n1, _, general, *_, drop = shape(dut)
    form, work, state = spirals.form(found), new_work(n1, 1, drop), item_of(item["control_i"], item["segment_i"])
    outside = outside_faces(state, work.cells, form, n1)
    zone = boundaries(state, work, form, n1, general)
    values, may = [int(v) for v in work.cells], 0
    assert [values[0], values[-1]] == state[B : B + 2].tolist()
    bounds = limits(form, state[LEVEL], zone, n1)
    for j in range(1 << n1):
        may |= possible(values[j], values[j + 1], *bounds) << j
    changes = sum(((values[j] > 0) != (values[j + 1] > 0)) << j for j in range(1 << n1))
    pick = item["pick"]
    ends = cell(item["segment_i"], pick, n1)
    ends = closed(ends) if item["close"] else ends
    return values, outside, may, changes, ends | dict(b=values[pick : pick + 2])


@cocotb.test
async def equals_model(dut):
    """An item every Phases clocks, anything between: values and masks after cells_latency clocks, then the cell.

    possible_o says nothing about a cell in which the sign changes.
    """
    n1, steps, general, lanes, wait, drop = shape(dut)
    control, segment = bench.control(n1 * steps), bench.segment(VECTOR_WIDTH, 1)
    structs = dict(control_i=control, control_o=control, segment_i=segment)
    structs |= dict(b_o=bench.Struct(("b", -VECTOR_WIDTH, 2)), point_o=POINT, ends_o=bench.ENDS)
    random, every = bench.rng(), latency.phases((1 << n1) - 1, lanes)
    clocks = latency.cells(n1, 1, 1, lanes, drop)
    await bench.start(dut)
    masks = bench.Port(dut, "possible_o")

    def anything():
        parts = ("control_i", control), ("segment_i", segment)
        return {name: struct.unpack(random.getrandbits(struct.width)) for name, struct in parts}

    for name, index in spirals.GENERAL if general else spirals.HELIX:
        found = spirals.surface(name, index, n1)
        await bench.noise(dut, "form_i", "modes_i")
        dut.modes_i.value = 3  # rdx_pkg::ModesDefault
        bench.Port(dut, "form_i", bench.FORM).write(bench.form_fields(spirals.form(found)))
        items = list(stimuli(dut, random, found, 80))
        answers = [model(dut, found, item) for item in items]

        def first(number, items=items, answers=answers):
            values, outside, may, changes, _ = answers[number]
            may = may & ~changes | masks.read()[0] & changes
            return dict(control_o=items[number]["control_i"], cells_o=values, outside_o=outside, possible_o=may)

        await given(dut, items, first, clocks, clocks + wait, structs, every, anything)
        cells = [answer[-1] for answer in answers]
        await given_parts(dut, items, cells, clocks + wait + n1, clocks + wait, structs, every, anything)


SETS = [
    dict(N1=3, K=8, Lanes=7, General=0, Wait=1),
    dict(N1=2, K=5, Lanes=2, General=1, Wait=4),
    dict(N1=1, K=32, Lanes=1, General=1, Wait=3),
    dict(N1=1, K=13, Lanes=1, General=0, Wait=3, VectorDrop=12),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_sample(parameters):
    """All lanes and some; for helices and for every spiral; two to eight cells."""
    bench.run(__name__, "rdx_sample", parameters)
