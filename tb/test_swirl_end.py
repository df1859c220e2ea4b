# SPDX-License-Identifier: Apache-2.0
"""Whether a point belongs to the ball at an end: RTL equals the model, at a half and a whole turn from the end, too."""

import cocotb
import pytest

import bench
import latency
from raydix import formats
from raydix.formats import NORMAL_WIDTH, SWIRL_FRAC, SWIRL_INDEX
from raydix.kernel import zeros
from raydix.swirl import PARTS_WIDTH, in_ball
from test_split import Numbered
from test_swirl import reading, write_named

AHEAD, RHO, SIDE = 2, 6, 9  # clocks from material_i to place_i, from there to rho_i and to side_i
ONE, TURN = 1 << (NORMAL_WIDTH - 1), 1 << SWIRL_FRAC
NAMES = ("turns", "near", "bend", "start_reach", "stop_reach")


def constants(random, general):
    """Words of a spiral; a helix has the same reach at both ends."""
    words = zeros(formats.SWIRL_WORDS)
    words[SWIRL_INDEX["turns"]] = random.choice((random.randrange(TURN), random.randrange(1, 128 * TURN)))
    least = random.choice((0, 0, 4, NORMAL_WIDTH))  # at the latter all are 0: as near as the tube
    for name in NAMES[1:]:
        words[SWIRL_INDEX[name]] = random.randrange(ONE) >> least
    words[SWIRL_INDEX["bend"]] *= random.choice((-1, 1))
    if not general:
        words[SWIRL_INDEX["stop_reach"]] = words[SWIRL_INDEX["start_reach"]]
    return words


def point(random, words):
    """(place, azimuth, rho, side, stop): often where the kind of the answer changes."""
    stop = random.getrandbits(1)
    turns = int(words[SWIRL_INDEX["turns"]])
    away = random.choice((TURN // 2, TURN, random.randrange(TURN + TURN // 4))) + random.choice((-1, 0, 1))
    place = turns - away if stop else away
    azimuth = random.choice((place % TURN, random.randrange(TURN), TURN // 2, TURN // 2 - 1))
    low = -1 << PARTS_WIDTH - 1
    side = random.choice((low, -low - 1, random.randrange(low, 0), random.randrange(low, 0) >> 6))
    return place, azimuth, random.choice((ONE - 1, random.randrange(ONE))), side, stop


@cocotb.test
async def equals_model(dut):
    """Another spiral and point in each clock."""
    random, general, surfaces = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "Surfaces")
    places = [(bank, surface) for bank in range(2) for surface in {0, surfaces - 1, random.randrange(surfaces)}]
    await bench.start(dut)
    balls = number = 0
    for _ in range(8):
        spirals = {place: constants(random, general) for place in places}
        named = {place: {name: words[SWIRL_INDEX[name]] for name in NAMES} for place, words in spirals.items()}
        await write_named(dut, named)
        items = [(place, point(random, spirals[place])) for place in random.choices(places, k=1000)]
        wanted = [int(in_ball(*at[:4], spirals[place], at[4])) for place, at in items]
        balls, number = balls + sum(wanted), number + len(wanted)

        def of(clock, items=items):
            """The item of a clock."""
            return items[min(max(clock, 0), len(items) - 1)]

        def clocks(items=items, of=of):
            for clock in range(AHEAD + len(items)):
                now = clock - AHEAD
                place, azimuth, _, _, stop = of(now)[1]
                inputs = {"material_i": reading(of(clock)[0]), "place_i": place, "azimuth_i": azimuth, "stop_i": stop}
                inputs |= {"rho_i": of(now - RHO)[1][2], "side_i": of(now - SIDE)[1][3]}
                whole = 0 <= now < len(items) - SIDE  # all of the item's inputs are given
                yield Numbered(inputs, now if whole else None)

        def answer(inputs, wanted=wanted):
            return {} if inputs.number is None else {"ball_o": wanted[inputs.number]}

        await bench.pipeline(dut, clocks(), answer, latency.SWIRL_END)
    assert number / 20 < balls < number * 19 / 20, f"{balls} of {number} points are of a ball"


SETS = [dict(General=0, Surfaces=1), dict(General=1, Surfaces=5), dict(General=1, Surfaces=64)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_end(parameters):
    """Helices; spirals of any radius, some of them and as many as there can be."""
    bench.run(__name__, "rdx_swirl_end", parameters)
