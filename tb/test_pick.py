# SPDX-License-Identifier: Apache-2.0
"""The choice becomes digits of t: RTL equals the definition written with whole numbers."""

import cocotb
import pytest

import bench
from raydix.formats import STEPS_MAX
from raydix.item import AGAIN, DONE, HIT, IDLE, RUN

STRUCTS = ("control_i", "control_o")


def expected(control, item, n1, steps):
    """The item goes on at the chosen cell, of which the last 2^-(n1*(level+1)) of t are not fixed yet."""
    if control["status"] != RUN:
        return control
    after = control | {"steps": control["steps"] + 1}
    if item["found_i"]:
        unit = 1 << n1 * (steps - 1 - control["level"])
        after["t"] = control["t"] + item["pick_i"] * unit
        after["follow"] = int(control["follow"] and item["pick_i"] == item["first_i"])
        if item["more_i"]:
            after |= {"pending": 1, "t_next": control["t"] + item["next_i"] * unit}
    return after


def stimuli(random, n1, steps, count):
    """Every level, pair of candidates and combination of flags where they are few, else random ones."""
    digits, cells = n1 * steps, 1 << n1
    for number in range(count):
        level = number % steps
        left = n1 * (steps - level)
        control = bench.control(digits).unpack(random.getrandbits(bench.control(digits).width))
        control["status"] = random.choice((IDLE, RUN, RUN, RUN, RUN, RUN, AGAIN, HIT, DONE))
        control |= dict(level=level, steps=random.randrange(STEPS_MAX), follow=random.getrandbits(1))
        if control["status"] == RUN:
            control["t"] = control["t"] >> left << left  # no digit of this level and below yet
        pick = random.randrange(cells)
        found = random.random() < 0.9
        yield dict(
            control_i=control,
            found_i=int(found),
            more_i=int(found and pick < cells - 1 and random.random() < 0.7),
            pick_i=pick,
            next_i=random.randrange(pick + 1, cells) if pick < cells - 1 else random.randrange(cells),
            first_i=random.choice((0, pick, random.randrange(cells))),
        )


@cocotb.test
async def equals_definition(dut):
    """All fields, at once; an item that is not Run passes unchanged."""
    n1, steps = bench.parameter(dut, "N1"), bench.parameter(dut, "K")
    structs = dict.fromkeys(STRUCTS, bench.control(n1 * steps))
    items = stimuli(bench.rng(), n1, steps, 4000)
    await bench.pipeline(
        dut, items, lambda item: {"control_o": expected(item["control_i"], item, n1, steps)}, 0, structs
    )


@pytest.mark.parametrize("parameters", [dict(N1=3, K=8), dict(N1=1, K=32), dict(N1=4, K=1)], ids=bench.label)
def test_pick(parameters):
    """The reference, the most steps, a single step."""
    bench.run(__name__, "rdx_pick", parameters)
