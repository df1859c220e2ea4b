# SPDX-License-Identifier: Apache-2.0
"""The control points of a chosen cell: RTL equals the model, and they are those of the cells of the whole tree."""

import cocotb
import pytest

import bench
from raydix.cells import subdivide
from raydix.halve import halve


def model(b, pick, n1):
    """Control points of cell ``pick``, by halving towards it."""
    right, left = list(b), [0] * len(b)
    for digit in reversed(range(n1)):
        halve(right, 0, left, 0, len(b) - 1)
        if not pick >> digit & 1:
            right = list(left)
    return right


def stimuli(dut, count):
    """Segments and every cell of each, in any order."""
    n1, random = bench.parameter(dut, "N1"), bench.rng()
    segments = bench.vectors(random, bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1, count)
    items = [dict(b_i=list(b), pick_i=pick) for b in segments for pick in range(1 << n1)]
    random.shuffle(items)
    return items


@cocotb.test
async def equals_model(dut):
    """Every cell of each of many segments, N1*Stages clocks later, one a clock."""
    n1 = bench.parameter(dut, "N1")
    await bench.start(dut)
    await bench.pipeline(dut, stimuli(dut, 100), lambda item: {"b_o": model(item["b_i"], item["pick_i"], n1)},
                         n1 * bench.parameter(dut, "Stages"))  # fmt: skip


@cocotb.test
async def is_of_the_tree(dut):
    """The model of a cell is the cell of the segment halved as a whole, bit for bit."""
    n1, degree = bench.parameter(dut, "N1"), bench.parameter(dut, "D")
    for number, item in enumerate(stimuli(dut, 50)):
        cells = item["b_i"] + [0] * ((1 << n1) * degree - degree)
        subdivide(cells, degree, n1)
        wanted = cells[item["pick_i"] * degree :][: degree + 1]
        if model(item["b_i"], item["pick_i"], n1) != wanted:
            raise bench.mismatch(number, item, [f"in the tree: {wanted}"])


SETS = [
    dict(W=36, D=4, N1=3),
    dict(W=16, D=2, N1=1),
    dict(W=48, D=3, N1=4),
    dict(W=8, D=1, N1=2),
    dict(W=28, D=4, N1=3, Stages=1),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_follow(parameters):
    """Two to sixteen cells, every degree; a digit a clock."""
    bench.run(__name__, "rdx_follow", parameters)
