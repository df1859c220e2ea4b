# SPDX-License-Identifier: Apache-2.0
"""The gradient of the distance from the tube: RTL equals the model in every bit, at the ends of what fits, too."""

import cocotb
import pytest

import bench
import latency
from raydix.formats import NORMAL_WIDTH
from raydix.swirl import PARTS_WIDTH
from test_split import Numbered
from test_swirl import reading, write_named

AHEAD = 2  # clocks from material_i to the point
ONE = 1 << (NORMAL_WIDTH - 1)
DROP = 7
RADIANS = ("pitch_radian", "radius_radian", "tube_radian")


def model(found, along, across, size, rho, general):
    """(outwards, side, upwards) of ``raydix.swirl.swirl``."""
    side = along * found[0] + (across * found[1] + size * found[2] if general else 0)
    most = (1 << (PARTS_WIDTH - 1)) - 1
    return across * rho >> DROP, max(-most - 1, min(most, side >> DROP)), along * rho >> DROP


def point(random, found):
    """Distances and radius; where the constants allow it their sum is about the first that does not fit."""
    if found[1:] == (1, 1) and random.random() < 0.8:
        across = -ONE if found[0] > 0 else ONE - 1
        return -ONE, across, random.randint(-4 << DROP, 4 << DROP), random.randrange(ONE)
    values = [random.choice((-ONE, ONE - 1, random.randrange(-ONE, ONE))) for _ in range(3)]
    return *values, random.choice((ONE - 1, random.randrange(ONE)))


@cocotb.test
async def equals_model(dut):
    """Another spiral and point in each clock; writes of constants of others do not count."""
    random, general, surfaces = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "Surfaces")
    places = [(bank, surface) for bank in range(2) for surface in {0, surfaces - 1, random.randrange(surfaces)}]
    await bench.start(dut)
    cut = 0
    for _ in range(6):
        spirals = {place: tuple(random.randrange(-ONE, ONE) for _ in RADIANS) for place in places}
        edges = random.sample(places, 2)
        spirals |= {edges[0]: (ONE - 1, 1, 1), edges[1]: (1 - ONE, 1, 1)}
        named = {place: dict(zip(RADIANS, found, strict=True)) for place, found in spirals.items()}
        await write_named(dut, named)
        items = [(place, point(random, spirals[place])) for place in random.choices(places, k=800)]
        wanted = [model(spirals[place], *at, general) for place, at in items]
        cut += sum(side in (-1 << PARTS_WIDTH - 1, (1 << PARTS_WIDTH - 1) - 1) for _, side, _ in wanted)

        def clocks(items=items):
            for clock in range(len(items) + AHEAD):
                material = items[min(clock, len(items) - 1)][0]
                along, across, size, rho = items[max(clock - AHEAD, 0)][1]
                inputs = {"material_i": reading(material), "along_i": along, "across_i": across, "size_i": size}
                yield Numbered(inputs | {"rho_i": rho}, clock - AHEAD if clock >= AHEAD else None)

        def straight(inputs, wanted=wanted):
            if inputs.number is None:
                return {}
            return {"outwards_o": wanted[inputs.number][0], "upwards_o": wanted[inputs.number][2]}

        def aside(inputs, wanted=wanted):
            return {} if inputs.number is None else {"side_o": wanted[inputs.number][1]}

        await bench.pipeline(dut, clocks(), straight, 1)
        await bench.pipeline(dut, clocks(), aside, latency.SWIRL_SLOPE)
    assert cut > 100 or not general, f"{cut} sums were cut"


SETS = [dict(General=0, Surfaces=1), dict(General=1, Surfaces=5), dict(General=1, Surfaces=64)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_slope(parameters):
    """Helices; spirals of any radius, some of them and as many as there can be."""
    bench.run(__name__, "rdx_swirl_slope", parameters)
