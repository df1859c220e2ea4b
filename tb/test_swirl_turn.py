# SPDX-License-Identifier: Apache-2.0
"""The turn of a spiral that a point belongs to: RTL equals the model in every bit, at the borders of turns, too."""

import cocotb
import pytest

import bench
import latency
from raydix import formats
from raydix.formats import SWIRL_FRAC, SWIRL_INDEX, SWIRL_WIDTH
from raydix.kernel import zeros
from raydix.swirl import turn
from test_split import Numbered
from test_swirl import reading, write_named

AHEAD = 2  # clocks from material_i to the point
TURN = 1 << SWIRL_FRAC
NAMES = ("turns", "turn_z", "turn_rho", "turn_offset")


def constants(random):
    """Words of a spiral of less than a turn or of many; the extreme ones and such as have points of many turns."""
    words = zeros(formats.SWIRL_WORDS)
    words[SWIRL_INDEX["turns"]] = random.choice((random.randrange(TURN), random.randrange(1, 128 * TURN), 5 * TURN))
    for name in ("turn_z", "turn_rho"):
        words[SWIRL_INDEX[name]] = random.choice((bench.low(32), bench.high(32), random.randint(-9 << 19, 9 << 19)))
    words[SWIRL_INDEX["turn_offset"]] = random.choice((bench.low(32), bench.high(32), random.randrange(60 << 16)))
    return words


def point(random, words, general):
    """Radius, height and azimuth; often where the turn's number is about to change."""
    rho, z = random.randrange(1 << (SWIRL_WIDTH - 1)), random.randint(-2 * TURN, 2 * TURN - 1)
    if random.random() < 0.5:
        rho, z = rho >> random.randrange(20), z >> random.randrange(20)
    azimuth = random.choice((0, TURN - 1, random.randrange(TURN)))
    if random.random() < 0.7:
        place = (words[SWIRL_INDEX["turn_offset"]] << 6) + (TURN >> 1)
        place += (z * int(words[SWIRL_INDEX["turn_z"]])) >> 19
        place += (rho * int(words[SWIRL_INDEX["turn_rho"]])) >> 19 if general else 0
        azimuth = (int(place) + random.choice((-1, 0, 1))) % TURN
    return rho, z, azimuth


@cocotb.test
async def equals_model(dut):
    """Another spiral and point in each clock."""
    random, general, surfaces = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "Surfaces")
    places = [(bank, surface) for bank in range(2) for surface in {0, surfaces - 1, random.randrange(surfaces)}]
    await bench.start(dut)
    inside = 0
    for _ in range(12):
        spirals = {place: constants(random) for place in places}
        named = {place: {name: words[SWIRL_INDEX[name]] for name in NAMES} for place, words in spirals.items()}
        await write_named(dut, named)
        items = [(place, point(random, spirals[place], general)) for place in random.choices(places, k=700)]
        wanted = [turn(*at, spirals[place], int(general)) for place, at in items]
        inside += sum(number > TURN for number, none in wanted if not none)

        def clocks(items=items):
            for clock in range(len(items) + AHEAD):
                material = items[min(clock, len(items) - 1)][0]
                rho, z, azimuth = items[max(clock - AHEAD, 0)][1]
                inputs = {"material_i": reading(material), "rho_i": rho, "z_i": z, "azimuth_i": azimuth}
                yield Numbered(inputs, clock - AHEAD if clock >= AHEAD else None)

        def answer(inputs, wanted=wanted):
            if inputs.number is None:
                return {}
            place, none = wanted[inputs.number]
            return {"place_o": int(place), "none_o": int(none and general)}

        await bench.pipeline(dut, clocks(), answer, latency.SWIRL_TURN)
    assert inside > 500, f"{inside} points beyond the first turn"


SETS = [dict(General=0, Surfaces=1), dict(General=1, Surfaces=5), dict(General=1, Surfaces=64)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_turn(parameters):
    """Helices; spirals of any radius, some of them and as many as there can be."""
    bench.run(__name__, "rdx_swirl_turn", parameters)
