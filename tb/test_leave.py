# SPDX-License-Identifier: Apache-2.0
"""What becomes of items at the wrap of a ring: records, restarts, ends behind the limit; every status, any item."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from raydix.formats import DEPTH_WIDTH, LIMIT_WIDTH, STEPS_MAX
from raydix.item import AGAIN, DONE, HIT, IDLE, RUN
from raydix.ring import NO_LIMIT, behind, limit_of

ORIGIN = bench.Struct(*bench.PLACE, ("limit", LIMIT_WIDTH))


class Wrap:
    """The same in Python: the record, the item that goes on, and what stands at the output."""

    def __init__(self, dut):
        self.steps, self.units, self.limited = (bench.parameter(dut, name) for name in ("K", "U", "Limit"))
        self.held = None

    def clock(self, given):
        """A clock: (item, ended, record at the output); what is held afterwards is kept."""
        item, ends, origin = dict(given["item"]), given["ends"], given["origin"]
        depth = ends["depth_start"]
        there = given["filled"] and item["status"] in (RUN, AGAIN, HIT)
        ended = bool(self.limited and there and behind(depth, origin["limit"]))
        status = item["status"] = DONE if ended else item["status"]
        lingers = not given["early"] and status == DONE and item["level"] != self.steps - 1
        wants_more = item["roots"] > 1 and item["pending"] and item["steps"] != STEPS_MAX
        last = int(status == DONE or not wants_more)
        record = {name: origin[name] for name in ("surface", "x", "y")} | {"hit": int(status == HIT), "last": last}
        record |= {"t": item["t"], "depth": depth, "point": ends["start"]}
        record |= {name: item[name] for name in ("enters", "steps")}
        shown, free = self.held, self.held is None or given["ready"]
        give = given["filled"] and free and (status == HIT or (status == DONE and not lingers))
        if free:
            self.held = record if give else None
        if not given["filled"]:
            item["status"] = IDLE
        elif give:
            item |= {"status": IDLE if last else AGAIN, "roots": (item["roots"] - 1) % 8}
        if lingers:
            item["level"] = min(item["level"] + self.units, self.steps - 1)
        return item, ended, shown


def anything(random, dut, digits):
    """Inputs of a clock: an item in any status, its cell at, before or behind the limit of its ray, or without one."""
    item = bench.control(digits).unpack(random.getrandbits(bench.control(digits).width))
    item |= {"status": random.choice((IDLE, RUN, AGAIN, HIT, HIT, DONE, DONE)), "roots": random.randint(1, 4)}
    item["level"] = random.choice((bench.parameter(dut, "K") - 1, random.randrange(bench.parameter(dut, "K"))))
    item["steps"] = random.choice((STEPS_MAX, STEPS_MAX - 1, item["steps"], item["steps"]))
    ends = bench.ENDS.unpack(random.getrandbits(bench.ENDS.width))
    ends["depth_start"] = random.choice((0, bench.high(DEPTH_WIDTH), *(random.getrandbits(DEPTH_WIDTH - 1),) * 8))
    origin = ORIGIN.unpack(random.getrandbits(ORIGIN.width))
    near = (limit_of(ends["depth_start"]) + d for d in (-1, 0, 1))
    limit = random.choice((NO_LIMIT, random.randrange(NO_LIMIT), *near))
    return {"item": item, "ends": ends, "origin": origin | {"limit": max(0, min(NO_LIMIT, limit))}}


@cocotb.test
@cocotb.parametrize(stall=(0.0, 0.5, 0.9))
async def equals_model(dut, stall):
    """Every clock another item: it goes on, leaves or ends, and its record stands at the output until it is taken."""
    random = bench.rng(stall)
    digits = bench.parameter(dut, "N1") * bench.parameter(dut, "K")
    control = bench.control(digits)
    ports = {"control_i": control, "control_o": control, "ends_i": bench.ENDS, "origin_i": ORIGIN, "hit_o": bench.HIT}
    ports = {name: bench.Port(dut, name, struct) for name, struct in ports.items()}
    dut.filled_i.value = dut.hit_ready_i.value = 0
    await bench.start(dut)
    wrap, seen = Wrap(dut), set()
    for number in range(6000):
        given = anything(random, dut, digits)
        given |= {"early": random.random() < 0.7, "filled": random.random() < 0.9, "ready": random.random() >= stall}
        ports["control_i"].write(given["item"])
        ports["ends_i"].write(given["ends"])
        ports["origin_i"].write(given["origin"])
        for name, value in (("early_i", "early"), ("filled_i", "filled"), ("hit_ready_i", "ready")):
            getattr(dut, name).value = int(given[value])
        if random.random() < 0.002:  # a reset empties the output
            dut.rst_ni.value = dut.filled_i.value = 0
            await FallingEdge(dut.clk_i)
            dut.rst_ni.value = 1
            wrap.held = None
            continue
        await ReadOnly()
        item, ended, shown = wrap.clock(given)
        seen.add((ended, given["item"]["status"]))
        lines = ports["control_o"].differences(ports["control_o"].words(item), ports["control_o"].read())
        if ended != bool(dut.ended_o.value):
            lines.append(f"ended_o: expected {ended}")
        if (shown is not None) != bool(dut.hit_valid_o.value):
            lines.append(f"hit_valid_o: expected {shown is not None}")
        elif shown:
            lines += ports["hit_o"].differences(ports["hit_o"].words(shown), ports["hit_o"].read())
        if lines:
            raise bench.mismatch(number, given, lines)
        await FallingEdge(dut.clk_i)
    ends = {(True, status) for status in (RUN, AGAIN, HIT)}
    assert seen >= {(False, status) for status in range(5)} and seen & ends == (ends if wrap.limited else set())


CASES = [
    dict(N1=3, K=8, U=8, Limit=1),
    dict(N1=1, K=32, U=3, Limit=1),
    dict(N1=2, K=5, U=1, Limit=0),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_leave(parameters):
    """All digits of a short search and of the longest; without limits."""
    bench.run(__name__, "rdx_leave", parameters)
