# SPDX-License-Identifier: Apache-2.0
"""Cells of a segment beyond a face of the box: RTL equals the model; the model's mask is the definition's."""

import cocotb
import pytest

import bench
from raydix.cells import subdivide
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH
from raydix.item import BOX, SIZE, C
from raydix.outside import outside_cells
from test_outside import LEAST, MOST, edges

COORDS = bench.Struct(("at", -COORD_WIDTH, 3))
BOXES = bench.Struct(("at", BOX_WIDTH, 3))


def boundaries(start, stop, n1):
    """The coordinates of one axis at the J + 1 boundaries."""
    cells = [start, stop] + [0] * ((1 << n1) - 1)
    subdivide(cells, 1, n1)
    return cells


def model(item, n1):
    """The golden model's mask."""
    state = [0] * SIZE
    state[BOX : BOX + 3] = item["box_i"]["at"]
    state[C : C + 6] = item["start_i"]["at"] + item["stop_i"]["at"]
    return outside_cells(state, [0] * ((1 << n1) + 1), n1)


def about_a_face(random, box, n1):
    """Ends whose segment comes to a face of the box at or beside a boundary, or crosses both."""
    face = 1 << (COORD_FRAC + 1 - box)
    at = random.choice((-face, face)) + random.choice((-2, -1, 0, 1))
    slope = random.choice((0, 1, -1, random.randint(-9, 9), random.randint(-face, face), random.randint(LEAST, MOST)))
    place = random.randrange((1 << n1) + 1)
    ends = [at - slope * place // (1 << n1), at + slope * ((1 << n1) - place) // (1 << n1)]
    return [max(LEAST, min(MOST, end + random.choice((-1, 0, 0, 1)))) for end in ends]


def stimuli(n1, random):
    """Every box exponent on every axis with every pair of edges as ends; ends about a face; any ends, any boxes."""

    def item(lines, boxes):
        starts, stops = zip(*lines, strict=True)
        return dict(start_i=dict(at=list(starts)), stop_i=dict(at=list(stops)), box_i=dict(at=boxes))

    def alone(axis, line, box):
        lines = [(random.randint(-(1 << 30), 1 << 30), random.randint(-(1 << 30), 1 << 30)) for _ in range(3)]
        lines[axis] = line
        return item(lines, [box if i == axis else 0 for i in range(3)])

    number = 0
    for box in range(1 << BOX_WIDTH):
        for start in edges(box):
            for stop in edges(box):
                number += 1
                yield alone(number % 3, (start, stop), box)
        for _ in range(60):
            number += 1
            yield alone(number % 3, about_a_face(random, box, n1), box)
    for _ in range(1500):
        boxes = [random.choice((0, 1, 1, 2, 3, random.randrange(32))) for _ in range(3)]
        lines = [
            random.choice((about_a_face(random, box, n1), [random.randint(LEAST, MOST) for _ in range(2)]))
            for box in boxes
        ]
        yield item(lines, boxes)


@cocotb.test
async def equals_model(dut):
    """The mask is the model's, Latency clocks later, a segment a clock."""
    n1, latency = (bench.parameter(dut, name) for name in ("N1", "Latency"))
    await bench.start(dut)
    structs = dict(start_i=COORDS, stop_i=COORDS, box_i=BOXES)
    items = stimuli(n1, bench.rng())
    await bench.pipeline(dut, items, lambda item: {"outside_o": model(item, n1)}, latency, structs)


@cocotb.test
async def equals_intervals(dut):
    """Outside means: on some axis no point between the cell's ends, both included, lies in [-2^(1-m), 2^(1-m))."""
    n1 = bench.parameter(dut, "N1")
    kinds = set()
    for number, item in enumerate(stimuli(n1, bench.rng("intervals"))):
        mask = 0
        for axis, box in enumerate(item["box_i"]["at"]):
            face = 1 << (COORD_FRAC + 1 - box)
            at = boundaries(item["start_i"]["at"][axis], item["stop_i"]["at"][axis], n1)
            sides = [(v >= face) - (v < -face) for v in at]
            kinds.add((sides[0], sides[-1]))
            for j, (a, b) in enumerate(zip(at, at[1:], strict=False)):
                mask |= (max(a, b) < -face or min(a, b) >= face) << j
        if mask != model(item, n1):
            raise bench.mismatch(number, item, [f"by intervals {mask:b}, the model has {model(item, n1):b}"])
    assert len(kinds) == 9, kinds


SETS = [
    dict(N1=3, Latency=6),
    dict(N1=3, Latency=3),
    dict(N1=2, Latency=2),
    dict(N1=1, Latency=2),
    dict(N1=1, Latency=1),
    dict(N1=4, Latency=8),
    dict(N1=4, Latency=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_clip(parameters):
    """The steps of degree 4 and 2 with three, two, one and four digits, and without registers."""
    bench.run(__name__, "rdx_clip", parameters)
