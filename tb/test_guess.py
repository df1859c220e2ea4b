# SPDX-License-Identifier: Apache-2.0
"""The paper rule's Case 1: RTL equals the model; the model equals equations (8) and (9) written out."""

import cocotb
import pytest

import bench
from raydix.guess import guess


def equations(values):
    """Equations (8) and (9), as the paper has them, for the indicator at the J+1 boundaries."""
    count = len(values) - 1
    j = min(range(count + 1), key=lambda i: (abs(values[i]), i))
    cells = [c for c in (j, j - 1) if 0 <= c < count]  # [j, j+1] first: it wins a tie
    return min(cells, key=lambda c: abs(values[c] - values[c + 1]))


def stimuli(dut, count):
    """All vectors where they are few; else corners, ties of magnitudes and of second differences, and random ones."""
    width, size = bench.parameter(dut, "W"), (1 << bench.parameter(dut, "N1")) + 1
    if width * size <= 15:
        yield from map(list, bench.every(width, size))
        return
    random = bench.rng()
    yield from bench.vectors(random, width, size, count)
    for i in range(count):
        few = random.sample((-3, -2, -1, 0, 1, 2, 3, bench.low(width), bench.high(width)), 3)
        yield [random.choice(few) for _ in range(size)]
        middle, rise = random.randrange(size), random.randint(1, 3)  # a valley, the same on both sides
        base = random.randint(-2, 9)
        yield [(base + rise * abs(k - middle)) * (-1 if i % 2 else 1) for k in range(size)]


@cocotb.test
async def equals_model(dut):
    """The model's cell, select_latency - 2 clocks later; ties, too."""
    n1 = bench.parameter(dut, "N1")
    await bench.start(dut)
    items = ({"values_i": values} for values in stimuli(dut, 800))
    latency = 1 + (n1 + 2) // 2
    await bench.pipeline(dut, items, lambda item: {"cell_o": guess(item["values_i"], 1, 1 << n1)}, latency)


@cocotb.test
async def equals_equations(dut):
    """The model is the paper's rule, at every distance of the boundaries among the control points."""
    for number, values in enumerate(stimuli(dut, 800)):
        expected = equations(values)
        for degree in (1, 2, 4):
            cells = [0] * ((len(values) - 1) * degree + 1)
            cells[::degree] = values
            if guess(cells, degree, len(values) - 1) != expected:
                raise bench.mismatch(number, {"values": values}, [f"D = {degree}: the equations say {expected}"])


SETS = [dict(W=3, N1=1), dict(W=3, N1=2), dict(W=36, N1=3), dict(W=16, N1=4)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_guess(parameters):
    """Exhaustive at 3 bits; corners, ties and random values at J = 8 and 16."""
    bench.run(__name__, "rdx_guess", parameters)
