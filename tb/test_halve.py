# SPDX-License-Identifier: Apache-2.0
"""Halving of a cell: RTL equals the model in every bit; the model is within its bound of the exact values."""

from fractions import Fraction

import cocotb
import pytest

import bench
from raydix.halve import halve


def model(b):
    """Both halves by the golden model."""
    right, left = list(b), [0] * len(b)
    halve(right, 0, left, 0, len(b) - 1)
    return left, right


def stimuli(dut, count):
    """Corners, then random cells."""
    return bench.vectors(bench.rng(), bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1, count)


async def equal(dut, cells):
    """RTL and model on ``cells``, at the latency that the module documents."""

    def expect(item):
        left, right = model(item["b_i"])
        return {"left_o": left, "right_o": right}

    await bench.start(dut)
    await bench.pipeline(dut, ({"b_i": list(b)} for b in cells), expect, bench.parameter(dut, "Stages"))


@cocotb.test
async def equals_model(dut):
    """Every bit of both halves is the model's, Stages clocks later."""
    await equal(dut, stimuli(dut, 1500))


@cocotb.test
async def equals_model_exhaustively(dut):
    """The same for every possible cell."""
    await equal(dut, bench.every(bench.parameter(dut, "W"), bench.parameter(dut, "D") + 1))


@cocotb.test
async def within_bound(dut):
    """Outer ends exact, inner end shared and within D/2 ulp, a point of row r within r/2 ulp, all within the hull."""
    for number, b in enumerate(stimuli(dut, 1000)):
        left, right = model(b)
        row, degree = [Fraction(v) for v in b], len(b) - 1
        errors = []
        for r in range(degree + 1):
            errors += [(abs(left[r] - row[0]), r), (abs(right[degree - r] - row[-1]), r)]
            row = [(x + y) / 2 for x, y in zip(row, row[1:], strict=False)]
        good = (left[0], right[-1]) == (b[0], b[-1]) and left[-1] == right[0]
        good &= all(error <= Fraction(r, 2) for error, r in errors)
        good &= all(min(b) <= v <= max(b) for v in left + right)
        if not good:
            raise bench.mismatch(number, {"b": b}, [f"left {left}, right {right}, errors {errors}"])


SMALL = [dict(W=3, D=4, Stages=2), dict(W=4, D=2, Stages=1), dict(W=4, D=1, Stages=0)]
WIDE = [dict(W=36, D=4, Stages=s) for s in range(5)]
WIDE += [dict(W=16, D=3, Stages=2), dict(W=48, D=2, Stages=2), dict(W=48, D=1, Stages=1)]


@pytest.mark.parametrize("parameters", SMALL, ids=bench.label)
def test_every_small_cell(parameters):
    """Exhaustive at reduced width."""
    bench.run(__name__, "rdx_halve", parameters, ["equals_model_exhaustively", "within_bound"])


@pytest.mark.parametrize("parameters", WIDE, ids=bench.label)
def test_wide_cells(parameters):
    """Corners and random cells; every number of register stages."""
    bench.run(__name__, "rdx_halve", parameters, ["equals_model", "within_bound"])
