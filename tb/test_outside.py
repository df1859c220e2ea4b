# SPDX-License-Identifier: Apache-2.0
"""Cells beyond a face of the box: RTL equals the model; the model equals the definition by intervals."""

import cocotb
import pytest

import bench
from raydix.cells import subdivide
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH
from raydix.item import BOX, SIZE, C
from raydix.outside import beyond, outside_cells

LEAST, MOST = bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)


def edges(box):
    """Coordinates at the faces of the box and beside them, at zero, and the extremes."""
    face = 1 << (COORD_FRAC + 1 - box)
    values = [s * face + d for s in (-1, 1) for d in (-1, 0, 1)] + [-1, 0, 1, LEAST, MOST]
    return sorted({max(LEAST, min(MOST, v)) for v in values})


def stimuli(dut, random):
    """Every box exponent on every axis, every pair of edges of a cell; then random boundaries and boxes."""
    count = len(bench.Port(dut, "outside_o").handles[0]) + 1

    def item(axis, box, values):
        boundaries = [[0] * count for _ in range(3)]
        boundaries[axis] = values
        return dict(boundaries_i=boundaries, box_i=box << BOX_WIDTH * axis)

    for box in range(1 << BOX_WIDTH):
        pairs = [(a, b) for a in edges(box) for b in edges(box)]
        random.shuffle(pairs)
        for number, (a, b) in enumerate(pairs):
            values = [random.choice(edges(box)) for _ in range(count)]
            place = random.randrange(count - 1)
            values[place : place + 2] = a, b
            yield item(number % 3, box, values)
    for _ in range(500):
        boxes = [random.choice((0, 1, 2, 3, random.randrange(32))) for _ in range(3)]
        boundaries = [[random.choice([*edges(b), random.randint(LEAST, MOST)]) for _ in range(count)] for b in boxes]
        yield dict(boundaries_i=boundaries, box_i=sum(b << BOX_WIDTH * i for i, b in enumerate(boxes)))


def boxes_of(item):
    """Box exponents of x, y, z."""
    return [item["box_i"] >> BOX_WIDTH * axis & 31 for axis in range(3)]


@cocotb.test
async def equals_model(dut):
    """Bit j is set if on some axis both ends of cell j lie beyond the same face."""

    def expect(item):
        mask = 0
        for values, box in zip(item["boundaries_i"], boxes_of(item), strict=True):
            for j, (start, end) in enumerate(zip(values, values[1:], strict=False)):
                mask |= beyond(start, end, box) << j
        return {"outside_o": mask}

    await bench.pipeline(dut, stimuli(dut, bench.rng()), expect, 0)


@cocotb.test
async def cells_of_an_item(dut):
    """The model's mask for an item is this module's for the boundaries of its cells."""
    random = bench.rng("item")
    n1 = len(bench.Port(dut, "outside_o").handles[0]).bit_length() - 1
    masks, items = {}, []
    for number in range(400):
        item = [0] * SIZE
        item[BOX : BOX + 3] = [random.choice((0, 1, 2, 31)) for _ in range(3)]
        item[C : C + 6] = [random.randint(LEAST, MOST) >> random.randrange(4) for _ in range(6)]
        boundaries = []
        for axis in range(3):
            cells = [item[C + axis], item[C + 3 + axis]] + [0] * ((1 << n1) - 1)
            subdivide(cells, 1, n1)
            boundaries.append(cells)
        masks[number] = outside_cells(item, [0] * ((1 << n1) + 1), n1)
        items.append(
            dict(boundaries_i=boundaries, box_i=sum(item[BOX + axis] << BOX_WIDTH * axis for axis in range(3)))
        )
    order = iter(range(len(items)))
    await bench.pipeline(dut, items, lambda item: {"outside_o": masks[next(order)]}, 0)


@cocotb.test
async def equals_intervals(dut):
    """Beyond means: no point between the ends, both included, lies in [-2^(1-m), 2^(1-m)) of this axis."""
    for number, item in enumerate(stimuli(dut, bench.rng())):
        for values, box in zip(item["boundaries_i"], boxes_of(item), strict=True):
            inside = range(-1 << (COORD_FRAC + 1 - box), 1 << (COORD_FRAC + 1 - box))
            for start, end in zip(values, values[1:], strict=False):
                nearest = min(max(0, min(start, end)), max(start, end))  # the point between the ends nearest to 0
                touches = nearest in inside
                if beyond(start, end, box) == touches:
                    raise bench.mismatch(number, dict(start=start, end=end, box=box), [f"meets the box: {touches}"])


@pytest.mark.parametrize("parameters", [dict(J=1), dict(J=8)], ids=bench.label)
def test_outside(parameters):
    """One cell, as for the hit point; the cells of a step."""
    bench.run(__name__, "rdx_outside", parameters)
