# SPDX-License-Identifier: Apache-2.0
"""Distance from the balls at the ends: RTL equals the model in every bit."""

import cocotb
import pytest

import bench
import latency
from raydix.cordic import lengths
from raydix.formats import FORM_INDEX, VECTOR_WIDTH
from raydix.kernel import words
from raydix.vecsum import ball, iterations, new_lanes
from test_vecsum import forms, points, with_forms


def model(form, point, stop, size, drop):
    """The distance by the golden model, from the ball at the start or at the end."""
    lanes = new_lanes(1, drop)
    lanes.x[0], lanes.y[0], lanes.z[0] = words(point)
    ball(lanes, 1, form, stop, 1)
    length, across = lanes.u[1:], lanes.v[1:]
    lengths(length, across, 1, iterations(drop)[2])
    lengths(length, lanes.height, 1, iterations(drop)[2])
    return length[0] - (size >> drop)


@cocotb.test
async def equals_model(dut):
    """Every bit of the distance is the model's, ball_latency clocks later; both balls in any order."""
    random, drop = bench.rng(), bench.parameter(dut, "VectorDrop")

    def items(form):
        sizes = [int(form.words[FORM_INDEX[name]]) for name in ("tube", "tube_stop")]
        dut.size_i.value = random.choice((*sizes, random.getrandbits(VECTOR_WIDTH - 2)))
        for point in points(random, form, 150):
            yield {"point_i": point, "stop_i": random.getrandbits(1)}

    def expect(form, item):
        return {"distance_o": model(form.words, item["point_i"], item["stop_i"], int(dut.size_i.value), drop)}

    await with_forms(dut, forms(random, True, 25), items, expect, latency.ball(drop))


@pytest.mark.parametrize("parameters", [{}, dict(VectorDrop=8)], ids=bench.label)
def test_ball(parameters):
    """Ends of spirals of all kinds; all digits, and fewer."""
    bench.run(__name__, "rdx_ball", parameters)
