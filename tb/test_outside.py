# SPDX-License-Identifier: Apache-2.0
"""Cells beyond a face of the box: RTL equals the model; the model equals the definition by intervals."""

import cocotb
import pytest

import bench
from raydix.cells import subdivide
from raydix.formats import BOX_WIDTH, COORD_FRAC, COORD_WIDTH, FORM_INDEX, FORM_WORDS
from raydix.item import BOX, SIZE, C
from raydix.outside import beyond, outside_cells, outside_faces

LEAST, MOST = bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)
BOX_CHECKS = ["equals_model", "cells_of_an_item", "equals_intervals"]
FACES_CHECKS = ["faces_equal_intervals", "faces_equal_model"]


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


def packed(values):
    """Three coordinates as one word."""
    return sum((v & (1 << COORD_WIDTH) - 1) << COORD_WIDTH * i for i, v in enumerate(values))


def random_faces(random):
    """(low, high) of each axis: any, the whole range, thin, a single coordinate."""
    faces = []
    for _ in range(3):
        low, high = sorted(random.choice((LEAST, MOST, -1, 0, 1, random.randint(LEAST, MOST))) for _ in range(2))
        faces.append(random.choice(((low, high), (low, high), (LEAST, MOST), (low, min(MOST, low + 1)), (low, low))))
    return faces


def about(random, low, high):
    """A coordinate at a face of (low, high) or beside it, or an extreme, or any."""
    value = random.choice((low, high)) + random.choice((-1, 0, 1))
    return random.choice((max(LEAST, min(MOST, value)), value if LEAST <= value <= MOST else low, LEAST, MOST,
                          random.randint(LEAST, MOST)))  # fmt: skip


@cocotb.test
async def faces_equal_intervals(dut):
    """Bit j is set if on some axis no point between the ends of cell j, both included, lies in [low, high]."""
    random, count = bench.rng("faces"), len(bench.Port(dut, "outside_o").handles[0]) + 1

    def items():
        for _ in range(4000):
            faces, axis = random_faces(random), random.randrange(3)
            inside = [[random.randint(*pair) for _ in range(count)] for pair in faces]
            anywhere = [[about(random, *pair) for _ in range(count)] for pair in faces]
            values = random.choice((anywhere, [anywhere[i] if i == axis else inside[i] for i in range(3)]))
            lows, highs = zip(*faces, strict=True)
            yield dict(boundaries_i=values, low_i=packed(lows), high_i=packed(highs), box_i=random.getrandbits(15))

    def expect(item):
        mask = 0
        for axis, values in enumerate(item["boundaries_i"]):
            low, high = (bench.signed(item[n] >> COORD_WIDTH * axis, COORD_WIDTH) for n in ("low_i", "high_i"))
            for j, (start, end) in enumerate(zip(values, values[1:], strict=False)):
                meets = min(start, end) <= high and max(start, end) >= low
                mask |= (not meets) << j
        return {"outside_o": mask}

    await bench.pipeline(dut, items(), expect, 0)


@cocotb.test
async def faces_equal_model(dut):
    """The model's mask for an item is this module's for the boundaries of its cells."""
    random = bench.rng("faces of an item")
    n1 = len(bench.Port(dut, "outside_o").handles[0]).bit_length() - 1
    masks, items = [], []
    for _ in range(1000):
        item, form, faces, boundaries = [0] * SIZE, [0] * FORM_WORDS, random_faces(random), []
        for axis, (low, high) in enumerate(faces):
            form[FORM_INDEX["low"] + axis], form[FORM_INDEX["high"] + axis] = low, high
            ends = [about(random, low, high) for _ in range(2)]
            item[C + axis], item[C + 3 + axis] = ends
            cells = ends + [0] * ((1 << n1) - 1)
            subdivide(cells, 1, n1)
            boundaries.append(cells)
        masks.append(outside_faces(item, [0] * ((1 << n1) + 1), form, n1))
        lows, highs = zip(*faces, strict=True)
        items.append(dict(boundaries_i=boundaries, low_i=packed(lows), high_i=packed(highs), box_i=0))
    assert 0 in masks and (1 << (1 << n1)) - 1 in masks
    order = iter(masks)
    await bench.pipeline(dut, items, lambda item: {"outside_o": next(order)}, 0)


@pytest.mark.parametrize("parameters", [dict(J=1), dict(J=8)], ids=bench.label)
def test_outside(parameters):
    """One cell, as for the hit point; the cells of a step."""
    bench.run(__name__, "rdx_outside", parameters, BOX_CHECKS)


@pytest.mark.parametrize("parameters", [dict(J=1, Faces=1), dict(J=8, Faces=1)], ids=bench.label)
def test_faces(parameters):
    """The same for a box of any faces."""
    bench.run(__name__, "rdx_outside", parameters, FACES_CHECKS)
