# SPDX-License-Identifier: Apache-2.0
"""First part of a step of an algebraic surface: cells, masks and the chosen cell are the model's, at their clocks."""

import cocotb
import pytest

import bench
import latency
from raydix.cells import subdivide
from raydix.formats import BOX_WIDTH
from raydix.item import BOX, SIZE, C
from raydix.outside import outside_cells
from test_descend import POINT, cell, closed, random_ends

BOXES = bench.Struct(("box", BOX_WIDTH, 3))


def shape(dut):
    """N1, W, D, HalveStages, Wait, Below."""
    return [bench.parameter(dut, name) for name in ("N1", "W", "D", "HalveStages", "Wait", "Below")]


def stimuli(dut, count):
    """Box at each of several sizes, segment, and the cell that will be chosen."""
    n1, width, degree, *_ = shape(dut)
    random = bench.rng()
    for b in bench.vectors(random, width, degree + 1, count):
        box = dict(box=random.choices((0, 0, 1, 2, 5, 31), k=3))
        choice = dict(pick=random.randrange(1 << n1), close=random.getrandbits(1))
        yield dict(box_i=box, segment_i=random_ends(random) | dict(b=b)) | choice


def model(dut, item):
    """Control points of the cells, mask of cells outside, chosen cell."""
    n1, _, degree, *_, below = shape(dut)
    box, segment = item["box_i"]["box"], item["segment_i"]
    cells = [*segment["b"], *[0] * ((1 << n1) * degree - degree)]
    subdivide(cells, degree, n1)
    state = [0] * SIZE
    state[BOX : BOX + 3], state[C : C + 6] = box, segment["start"] + segment["stop"]
    outside = outside_cells(state, [0] * ((1 << n1) + 1), n1) if bench.parameter(dut, "Clip") else 0
    at = item["pick"] * degree
    ends = cell(segment, item["pick"], n1)
    chosen = (closed(ends) if item["close"] else ends) | dict(b=cells[at : at + degree + 1])
    return [value - below for value in cells], outside, chosen


@cocotb.test
async def equals_model(dut):
    """An item a clock: cells and masks after N1*HalveStages clocks, Wait later the choice, then the cell."""
    n1, width, degree, stages, wait, _ = shape(dut)
    segment = bench.segment(width, degree)
    points = bench.Struct(("b", -width, degree + 1))
    structs = dict(box_i=BOXES, segment_i=segment, b_o=points, point_o=POINT, ends_o=bench.ENDS)
    items = list(stimuli(dut, 300))
    answers = [model(dut, item) for item in items]
    await bench.start(dut)

    def first(number):
        cells, outside, _ = answers[number]
        return dict(cells_o=cells, outside_o=outside)

    await given(dut, items, first, n1 * stages, n1 * stages + wait, structs)
    await bench.start(dut)  # the waiting lines begin anew
    chosen = n1 * stages + wait
    late = chosen + latency.pick(n1, degree, stages)
    await given_parts(dut, items, [answer[2] for answer in answers], late, chosen, structs)


async def given_parts(dut, items, cells, late, choice, structs, every=1, fill=None):
    """The parts of the chosen cell, each at its clock: control points ``late`` clocks after the item, point, ends."""

    def ends(number):
        return {name: value for name, value in cells[number].items() if name != "b"}

    for part, more in (
        (lambda number: dict(b_o=dict(b=cells[number]["b"])), 0),
        (lambda number: dict(point_o=dict(at=ends(number)["start"])), 1),
        (lambda number: dict(ends_o=ends(number)), 3),
    ):
        await given(dut, items, part, late + more, choice, structs, every, fill, late - 1)


async def given(dut, items, expect, delay, choice, structs, every=1, fill=None, close=None):
    """Items one after the other, each one's choice ``choice`` clocks later; what ``expect`` names ``delay`` later.

    every  an item so many clocks, with ``fill()`` between them
    close  clock in which it is said whether the cell is closed
    """

    def clocks():
        count = len(items) * every + choice + delay + (close or 0)
        for clock in range(count):
            place, phase = divmod(clock, every)
            item = items[place] if phase == 0 and place < len(items) else fill() if fill else items[0]
            chosen, late = divmod(clock - choice, every)
            pick = items[chosen]["pick"] if late == 0 and 0 <= chosen < len(items) else 0
            inputs = {name: value for name, value in item.items() if name not in ("pick", "close")} | dict(pick_i=pick)
            closing, late = divmod(clock - (close or 0), every)
            inputs["close_i"] = items[closing]["close"] if late == 0 and 0 <= closing < len(items) else 0
            if every > 1:
                inputs |= dict(phase_i=phase)
            yield Numbered(inputs, place if phase == 0 and place < len(items) else None)

    def answer(inputs):
        return {} if inputs.number is None else expect(inputs.number)

    await bench.pipeline(dut, clocks(), answer, delay, structs)


class Numbered(dict):
    """Inputs of a clock and the number of the item that they are; None: of none."""

    def __init__(self, inputs, number):
        super().__init__(inputs)
        self.number = number


SETS = [
    dict(N1=3, W=36, D=4, HalveStages=2, Wait=1),
    dict(N1=2, W=36, D=2, HalveStages=1, Wait=3, Below=1),
    dict(N1=1, W=16, D=3, HalveStages=0, Wait=3, Below=1),
    dict(N1=1, W=16, D=2, HalveStages=1, Wait=3),
    dict(N1=4, W=48, D=3, HalveStages=0, Wait=5),
    dict(N1=3, W=28, D=4, HalveStages=1, Wait=3, Below=1, Clip=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_split(parameters):
    """The reference; less by one, for signs; two cells; sixteen without registers in the halvers; a halving a clock."""
    bench.run(__name__, "rdx_split", parameters)
