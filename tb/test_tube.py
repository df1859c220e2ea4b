# SPDX-License-Identifier: Apache-2.0
"""Distance from a turn of the tube: RTL equals the model in every bit."""

from unittest.mock import patch

import cocotb
import pytest

import bench
import latency
from raydix import vecsum
from raydix.cordic import lengths
from raydix.formats import FORM_INDEX
from raydix.turn import nearest
from raydix.vecsum import FAR, iterations, new_lanes
from test_turn import polar
from test_vecsum import MOST, forms, points, with_forms


def model(form, rho, z, place, general, drop):
    """The distance by the golden model, of the turn at ``place`` (-1: none) whether or not it is the nearest."""
    lanes = new_lanes(1, drop)
    lanes.rho[0], lanes.z[0] = rho, z
    with patch.object(vecsum, "nearest", lambda *_: place):
        vecsum.tube(lanes, 1, form, 0, general)
    lengths(lanes.u, lanes.v, 1, iterations(drop)[2])
    return FAR >> drop if place < 0 else lanes.u[0] - lanes.size[0]


def stimuli(random, form, general, drop):
    """Points of all kinds and their nearest turn; the same points and corners with any turn, either end, none."""
    turns = int(form.words[FORM_INDEX["turns"]])
    for point in points(random, form, 80):
        rho, z, angle = polar(point, drop)
        yield rho, z, nearest(rho << drop, z, angle, form.words, random.randint(0, general), general)
        for height in (z, random.choice((-MOST, 0, MOST))):
            yield rho, height, random.choice((0, turns, -1, random.randint(0, turns)))


@cocotb.test
async def equals_model(dut):
    """Every bit of the distance is the model's, tube_latency clocks later; without a turn it is the largest number."""
    random, general, drop = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "VectorDrop")

    def items(form):
        for rho, z, place in stimuli(random, form, general, drop):
            noise = random.getrandbits(28)
            yield {"rho_i": rho, "z_i": z, "place_i": noise if place < 0 else place, "none_i": int(place < 0)}

    def expect(form, item):
        place = -1 if item["none_i"] else item["place_i"]
        return {"distance_o": model(form.words, item["rho_i"], item["z_i"], place, general, drop)}

    await with_forms(dut, forms(random, general, 15), items, expect, latency.tube(drop))


@pytest.mark.parametrize(
    "parameters", [dict(General=0), dict(General=1), dict(General=1, VectorDrop=12)], ids=bench.label
)
def test_tube(parameters):
    """Radii that stay; radii that grow; fewer digits."""
    bench.run(__name__, "rdx_tube", parameters)
