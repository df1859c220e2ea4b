# SPDX-License-Identifier: Apache-2.0
"""Counters of a frame: each is the sum of what happened since the clear."""

import cocotb
from cocotb.triggers import FallingEdge

import bench
from raydix.formats import PIXEL_WIDTH, STEPS_WIDTH

EVENTS = bench.Struct(("rectangle", PIXEL_WIDTH + 1), ("hidden", 1), ("rootless", 1), ("beyond", 1), ("steps", 6),
                      ("ended", 6), ("visible", 1), ("lost", 1), ("stalled", 1))  # fmt: skip
COUNTERS = bench.Struct(
    ("cycles", 64), ("steps", 64), ("rays", 32), ("hits", 32), ("skipped_rectangle", 32), ("skipped_rootless", 32),
    ("skipped_depth", 32), ("skipped_boxes", 32), ("skipped_cells", 32), ("skipped_early", 32), ("visible", 32),
    ("layers_lost", 32), ("given_up", 32), ("stalled", 32),
)  # fmt: skip
SAME = {"skipped_rectangle": "rectangle", "skipped_rootless": "rootless", "skipped_depth": "hidden",
        "skipped_boxes": "beyond", "skipped_cells": "ended", "steps": "steps", "visible": "visible",
        "layers_lost": "lost", "stalled": "stalled"}  # fmt: skip
MOST = (1 << STEPS_WIDTH) - 1  # steps of a ray that was given up


def add(totals, valid, hit, events, k_stop):
    """What a clock adds."""
    for counter, event in SAME.items():
        totals[counter] += events[event]
    last = valid and hit["last"]
    totals["hits"] += valid and hit["hit"]
    totals["rays"] += last
    totals["given_up"] += last and hit["steps"] == MOST
    totals["skipped_early"] += max(0, k_stop - hit["steps"]) if last else 0


@cocotb.test
@cocotb.parametrize(rate=(0.0, 0.2, 1.0))
async def equals_sums(dut, rate):
    """Random events and records in each clock, from several clears on; at the largest values, too; two clocks later."""
    random = bench.rng(rate)
    ports = {name: bench.Port(dut, name, struct) for name, struct in (
        ("hit_i", bench.HIT), ("events_i", EVENTS), ("counters_o", COUNTERS))}  # fmt: skip
    await bench.start(dut)
    for length, k_stop in ((1, 32), (2, 1), (40, random.randint(1, 32)), (3000, random.randint(1, 32))):
        before = None
        totals = dict.fromkeys((field[0] for field in COUNTERS.fields), 0)
        dut.k_stop_i.value = k_stop
        for clock in range(-2, length):
            dut.clear_i.value = int(clock < 0)
            valid = random.random() < rate
            hit = bench.HIT.unpack(random.getrandbits(bench.HIT.width))
            hit["steps"] = random.choice((MOST, MOST - 1, 1, k_stop, k_stop - 1, k_stop + 1, random.randint(1, 40)))
            hit["steps"] = max(1, hit["steps"])
            events = EVENTS.unpack(random.getrandbits(EVENTS.width))
            if random.random() >= rate:
                events = dict.fromkeys(events, 0)
            dut.hit_valid_i.value = int(valid)
            ports["hit_i"].write(hit)
            ports["events_i"].write(events)
            await FallingEdge(dut.clk_i)
            if clock >= 0:
                if before is not None:
                    add(totals, *before, k_stop)
                wanted = totals | {"cycles": clock + 1}
                got = COUNTERS.unpack(ports["counters_o"].read()[0])
                lines = [f"{name}: expected {v}, got {got[name]}" for name, v in wanted.items() if got[name] != v]
                if lines:
                    raise bench.mismatch(clock, {"k_stop": k_stop}, lines)
                before = valid, hit, events


def test_count():
    """Records of every number of steps, events of every number."""
    bench.run(__name__, "rdx_count")
