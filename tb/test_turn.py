# SPDX-License-Identifier: Apache-2.0
"""The nearest turn: RTL equals the model in every bit."""

import cocotb
import pytest

import bench
import latency
from raydix.cordic import vectoring
from raydix.formats import ANGLE_WIDTH, FORM_INDEX, TURN_FRAC
from raydix.multiply import scaled
from raydix.turn import RHO_DROP, TURN_DROP, Z_UP, nearest
from raydix.vecsum import UP, iterations
from test_vecsum import forms, points, with_forms

TURN = 1 << TURN_FRAC
FINE = ANGLE_WIDTH - TURN_FRAC  # an azimuth has so many more bits than a place


def polar(point, drop=0):
    """Radius, height and azimuth of a point, as the evaluator has them that leaves ``drop`` digits away."""
    x, y, angle = [point[0] << UP >> drop], [point[1] << UP >> drop], [0]
    vectoring(x, y, angle, 1, *iterations(drop)[:2], drop)
    return x[0], point[2], angle[0]


def middle(form, rho, z, general):
    """The azimuth, in units of place, at which the number of the nearest turn changes: for stimuli only."""

    def along(name_z, name_rho, offset):
        parts = ((z << Z_UP, name_z), (rho >> RHO_DROP, name_rho) if general else (0, name_rho))
        return sum(scaled(v, form[FORM_INDEX[n]], TURN_DROP) for v, n in parts) + form[FORM_INDEX[offset]]

    at, skew = along("turn_z", "turn_rho", "turn_offset"), abs(along("skew_z", "skew_rho", "skew_offset"))
    if not general:
        return at + TURN // 2
    return at - skew if form[FORM_INDEX["skew_back"]] else at + skew


def stimuli(random, form, general):
    """Points of all kinds; azimuths about the seam, about the end, and where the number of the turn changes."""
    for point in points(random, form, 80):
        rho, z, angle = polar(point)
        yield rho, z, angle
        nearly = random.choice((-2, -1, 0, 1, 2))
        yield rho, z, nearly % (1 << ANGLE_WIDTH)
        yield rho, z, ((int(form.words[FORM_INDEX["turns"]]) << FINE) + nearly) % (1 << ANGLE_WIDTH)
        yield rho, z, ((middle(form.words, rho, z, general) + nearly) % TURN << FINE) + random.getrandbits(FINE)


@cocotb.test
async def equals_model(dut):
    """The places of the turns, and whether there is none, six clocks later; a place then has no meaning."""
    random, general = bench.rng(), bench.parameter(dut, "General")

    def expect(form, item):
        arguments = item["rho_i"], item["z_i"], item["angle_i"], form.words
        places = [nearest(*arguments, second, general) for second in range(1 + general)]
        none = places[0] < 0
        return {"place_o": [None if none else place for place in places], "none_o": int(none)}

    def items(form):
        for values in stimuli(random, form, general):
            yield dict(zip(("rho_i", "z_i", "angle_i"), values, strict=True))

    await with_forms(dut, forms(random, general, 15), items, expect, latency.TURN)


@pytest.mark.parametrize("parameters", [dict(General=0), dict(General=1)], ids=bench.label)
def test_nearest(parameters):
    """The turn nearest in height; the two about the least distance."""
    bench.run(__name__, "rdx_turn", parameters)
