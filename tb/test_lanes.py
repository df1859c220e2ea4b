# SPDX-License-Identifier: Apache-2.0
"""Points that share lanes: the values are the evaluator's, whatever is at the inputs in the other phases."""

from collections import deque

import cocotb
import pytest

import bench
import latency
from test_vecsum import MOST, forms, model, points, with_forms


@cocotb.test
async def equals_model(dut):
    """Every bit of all values is the model's, vecsum_latency + Phases - 1 clocks after phase 0."""
    random = bench.rng()
    count, lanes, general, drop = (bench.parameter(dut, n) for n in ("Points", "Lanes", "General", "VectorDrop"))
    phases = latency.phases(count, lanes)
    clocks = latency.vecsum(drop) + phases - 1
    sent = deque()

    def items(form):
        choice = points(random, form, 60)
        for clock in range(12 * phases + clocks):  # the phases go on until the last item is there
            phase = clock % phases
            chosen = [random.choice(choice) if phase == 0 else [random.randint(-MOST, MOST)] * 3 for _ in range(count)]
            sent.append(chosen if phase == 0 and clock < 12 * phases else None)
            yield {"phase_i": phase, "points_i": [list(axis) for axis in zip(*chosen, strict=True)]}

    def expect(form, _):
        item = sent.popleft()
        return {"values_o": [int(v) for v in model(form, item, general, drop)[0]] if item else [None] * count}

    await with_forms(dut, forms(random, general, 2), items, expect, clocks)


SETS = [(7, 7), (7, 3), (7, 1), (2, 1), (15, 1)]
SETS += [pytest.param(s, marks=pytest.mark.long) for s in ((7, 4), (7, 2), (15, 2))]


@pytest.mark.parametrize("points_and_lanes", SETS, ids="{0[0]} on {0[1]}".format)
def test_lanes(points_and_lanes):
    """One to fifteen phases, the last of them full or not; a step's 7, 15 at most, the 2 ends of a ray."""
    bench.run(__name__, "rdx_lanes", dict(zip(("Points", "Lanes"), points_and_lanes, strict=True)))


def test_lanes_of_the_general_evaluator():
    """The evaluator of every spiral gets its parameters."""
    bench.run(__name__, "rdx_lanes", dict(Points=3, Lanes=2, General=1, VectorDrop=8))
