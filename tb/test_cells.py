# SPDX-License-Identifier: Apache-2.0
"""The J cells of a step: RTL equals the model in every bit; the model is within N1*D/2 ulp of the exact cells."""

from fractions import Fraction

import cocotb
import pytest

import bench
from raydix.cells import subdivide


def model(b, n1):
    """The control points of all cells by the golden model."""
    degree = len(b) - 1
    cells = list(b) + [0] * (((1 << n1) - 1) * degree)
    subdivide(cells, degree, n1)
    return cells


def exact(b, n1):
    """The same in fractions: the left halves' cells, then the right halves', sharing an end."""
    if n1 == 0:
        return list(b)
    rows = [[Fraction(v) for v in b]]
    while len(rows[-1]) > 1:
        rows.append([(x + y) / 2 for x, y in zip(rows[-1], rows[-1][1:], strict=False)])
    left, right = [row[0] for row in rows], [row[-1] for row in reversed(rows)]
    return exact(left, n1 - 1) + exact(right, n1 - 1)[1:]


def stimuli(dut, count):
    """Corners, then random cells."""
    return bench.vectors(bench.rng(), bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1, count)


async def equal(dut, cells):
    """RTL and model on ``cells``."""
    n1 = bench.parameter(dut, "N1")
    await bench.start(dut)
    await bench.pipeline(
        dut,
        ({"b_i": list(b)} for b in cells),
        lambda item: {"cells_o": model(item["b_i"], n1)},
        n1 * bench.parameter(dut, "HalveStages") - (not bench.parameter(dut, "Last")),
    )


@cocotb.test
async def equals_model(dut):
    """Every control point of every cell is the model's, N1*HalveStages clocks later."""
    await equal(dut, stimuli(dut, 500))


@cocotb.test
async def equals_model_exhaustively(dut):
    """The same for every possible cell."""
    await equal(dut, bench.every(bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1))


@cocotb.test
async def within_bound(dut):
    """Outer ends are exact, every control point is within N1*D/2 ulp and within the hull of the parent's."""
    n1, degree = bench.parameter(dut, "N1"), bench.parameter(dut, "D")
    for number, b in enumerate(stimuli(dut, 150)):
        cells = model(b, n1)
        errors = [abs(c - e) for c, e in zip(cells, exact(b, n1), strict=True)]
        good = (cells[0], cells[-1]) == (b[0], b[-1]) and max(errors) <= Fraction(n1 * degree, 2)
        if not good or min(cells) < min(b) or max(cells) > max(b):
            raise bench.mismatch(number, {"b": b}, [f"cells {cells}", f"errors {[float(e) for e in errors]}"])


SETS = [
    dict(W=36, D=4, N1=3, HalveStages=2),
    dict(W=36, D=4, N1=1, HalveStages=4),
    dict(W=37, D=4, N1=2, HalveStages=2, Last=0),
    dict(W=48, D=2, N1=4, HalveStages=1),
    dict(W=32, D=1, N1=2, HalveStages=1),
    dict(W=16, D=3, N1=2, HalveStages=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_cells(parameters):
    """Corners and random cells."""
    bench.run(__name__, "rdx_cells", parameters, ["equals_model", "within_bound"])


def test_every_small_cell():
    """Exhaustive at reduced width."""
    parameters = dict(W=4, D=2, N1=2, HalveStages=1)
    bench.run(__name__, "rdx_cells", parameters, ["equals_model_exhaustively", "within_bound"])
