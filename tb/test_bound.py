# SPDX-License-Identifier: Apache-2.0
"""Cells that may hold a root: RTL equals the model; the model equals both bounds as they are stated."""

from fractions import Fraction

import cocotb
import pytest

import bench
from raydix.bound import bounded
from raydix.formats import FORM_INDEX, FORM_WORDS, VECTOR_WIDTH, ZONES
from raydix.kernel import zeros

LATENCY = 5  # from zone and level
EARLY = 2  # clocks in which they are ahead of the values
BOUND = 56  # bits
MOST = bench.high(VECTOR_WIDTH)


def random_word(random):
    """A bound of any magnitude, or one of few bits set or clear."""
    bits = random.randint(0, BOUND)
    return random.choice(((1 << bits) - 1, (1 << bits) % (1 << BOUND), *[random.getrandbits(bits) for _ in range(4)]))


def random_form(random):
    """Bounds in each zone, and levels from which the second holds: at once, later, never."""
    form = zeros(FORM_WORDS)
    for zone in range(ZONES):
        form[FORM_INDEX["lipschitz"] + zone] = random_word(random)
        form[FORM_INDEX["curvature"] + zone] = random_word(random)
        form[FORM_INDEX["from_level"] + zone] = random.choice((0, 0, random.randrange(64), 63))
    return form


def stated(form, level, zone, n1):
    """Both bounds over a cell, exact, and whether the second holds."""
    lipschitz, curvature, start = (
        int(form[FORM_INDEX[name] + zone]) for name in ("lipschitz", "curvature", "from_level")
    )
    cell, since = 1 << n1 * (level + 1), 1 << 2 * n1 * max(level - start, 0)
    return Fraction(lipschitz, cell), Fraction(curvature, since), level >= start


def random_values(random, thresholds, count):
    """Values of one sign: sums of neighbours at a threshold or beside it, values at its quarter, any, corners."""
    values = []
    for number in range(count):
        near = random.choice(thresholds) + random.randint(-1, 2)
        sum_with = near - values[-1] if number else near
        anything = 0, 1, MOST, random.randint(0, MOST), random.getrandbits(random.randint(1, VECTOR_WIDTH - 1))
        size = random.choice((sum_with, sum_with, near // 4 + random.randint(-1, 1), random.choice(anything)))
        values.append(max(0, min(MOST, size)))
    if random.random() < 0.5:
        return [-v for v in values]
    return [max(1, v) for v in values]


def stimuli(random, form, n1, steps):
    """(zone, level, values) for every zone and level."""
    for zone in range(ZONES):
        for level in range(steps):
            lipschitz, curvature, _ = stated(form, level, zone, n1)
            for _ in range(6):
                yield zone, level, random_values(random, [int(lipschitz), int(curvature)], (1 << n1) + 1)


def model(form, item, n1):
    """Cells that may hold a root although the sign does not change, by the golden model."""
    zone, level, values = item
    return bounded(values, 0, 0, form, level, zone, n1)


@cocotb.test
async def equals_model(dut):
    """Every bit of the mask is the model's, three clocks after the values, five after zone and level."""
    random = bench.rng()
    n1 = bench.parameter(dut, "N1")
    steps = 32 // n1
    await bench.start(dut)
    form_i = bench.Port(dut, "form_i", bench.FORM)
    for _ in range(max(3, 60 // steps)):
        form = random_form(random)
        await bench.noise(dut, "form_i")
        form_i.write(bench.form_fields(form))
        waiting = list(stimuli(random, form, n1, steps))
        none = [[0] * ((1 << n1) + 1)] * EARLY
        values = none + [item[2] for item in waiting]
        ahead = [item[:2] for item in waiting] + [(0, 0)] * EARLY
        order = iter([None] * EARLY + waiting)

        def expect(_, form=form, order=order):
            item = next(order)
            return {} if item is None else {"possible_o": model(form, item, n1)}

        items = ({"zone_i": z, "level_i": k, "values_i": v} for (z, k), v in zip(ahead, values, strict=True))
        await bench.pipeline(dut, items, expect, LATENCY - EARLY)


@cocotb.test
async def equals_bounds(dut):
    """A cell is excluded only if the exact bounds allow it, and if they do by two ulp it is. About half of them are."""
    random = bench.rng("exact")
    n1 = bench.parameter(dut, "N1")
    steps = 32 // n1
    cells = kept = number = 0
    for _ in range(max(3, 60 // steps)):
        form = random_form(random)
        for item in stimuli(random, form, n1, steps):
            zone, level, values = item
            lipschitz, curvature, curved = stated(form, level, zone, n1)
            mask = model(form, item, n1)
            for j, pair in enumerate(zip(values, values[1:], strict=False)):
                a, b = map(abs, pair)

                def excluded(slack, a=a, b=b, curved=curved and pair[0] > 0, lipschitz=lipschitz, curvature=curvature):
                    bends = curved and (a + b > curvature + slack or min(a, b) > (curvature + slack) / 4)
                    return a + b > lipschitz + slack or bends

                may = bool(mask >> j & 1)
                if excluded(2) and may or not may and not excluded(0):
                    lines = [f"cell {j}: bounds {float(lipschitz)}, {float(curvature)}; possible: {may}"]
                    raise bench.mismatch(number, {"zone": zone, "level": level, "values": values}, lines)
                cells, kept = cells + 1, kept + may
            number += 1
    assert cells / 5 < kept < cells * 4 / 5, f"{kept} of {cells} cells are possible"


@pytest.mark.parametrize("parameters", [dict(N1=3), dict(N1=1), dict(N1=4)], ids=bench.label)
def test_bound(parameters):
    """The step's cells, the most levels, the most cells."""
    bench.run(__name__, "rdx_bound", parameters)
