# SPDX-License-Identifier: Apache-2.0
"""A hit takes its place: the list is that of a plain sort, whatever the order in which hits come; lost is told."""

import itertools

import cocotb
import pytest
from cocotb.triggers import ReadOnly, Timer

import bench
from entries import ENTRY, entry, key, listed, meant, padded, place

DEPTHS, SURFACES = range(3), range(2)


def expect(item):
    """Outputs of an item; the lists stand in it as ``entries`` and ``hit``."""
    entries, lost = place(item.entries, item.hit, item.layers)
    return {"count_o": len(entries), "entries_o": meant(entries, item.layers), "lost_o": int(lost)}


class Item(dict):
    """Values of the ports, and what they mean."""

    def __init__(self, random, entries, hit, layers):
        self.entries, self.hit, self.layers = entries, hit, layers
        super().__init__(count_i=len(entries), entries_i=padded(random, entries, layers), hit_i=ENTRY.pack(hit))


def kinds(opaque):
    """Hits of each small depth and surface; ``opaque`` by surface."""
    return [{"depth": depth, "surface": s, "opaque": opaque[s]} for depth in DEPTHS for s in SURFACES]


def lists(opaque, layers):
    """All sorted lists of them without one behind an opaque one."""
    for count in range(layers + 1):
        for entries in itertools.combinations_with_replacement(kinds(opaque), count):
            if not any(e["opaque"] for e in entries[:-1]):
                yield sorted(entries, key=key)


@cocotb.test
async def equals_sort(dut):
    """Exhaustive: every list of hits of three depths and two surfaces, opaque or not, with every further hit."""
    random, layers = bench.rng(), bench.parameter(dut, "Layers")

    def full(kind):
        return entry(random) | kind

    items = [Item(random, [full(e) for e in entries], full(hit), layers)
             for opaque in itertools.product((0, 1), repeat=len(SURFACES))
             for entries in lists(opaque, layers) for hit in kinds(opaque)]  # fmt: skip
    assert await bench.pipeline(dut, items, expect, 0) > 4 * 6 * layers


@cocotb.test
async def equals_sort_of_any(dut):
    """Random lists of all lengths, all bits of depth, surface and point."""
    random, layers = bench.rng(), bench.parameter(dut, "Layers")
    items = (Item(random, listed(random, layers, 2 * layers), entry(random), layers) for _ in range(3000))
    await bench.pipeline(dut, items, expect, 0)


@cocotb.test
async def order_of_arrival(dut):
    """Four hits in each of the 24 orders leave the same list, that of a sort of all four."""
    random, layers = bench.rng(), bench.parameter(dut, "Layers")
    ports = {name: bench.Port(dut, name) for name in ("count_i", "entries_i", "hit_i", "count_o", "entries_o")}
    for _ in range(60):
        opaque = [random.random() < 0.4 for _ in range(8)]
        hits = [entry(random, surface, opaque[surface]) | {"depth": random.randrange(6)}
                for surface in random.sample(range(8), 4)]  # fmt: skip
        wanted = []
        for hit in sorted(hits, key=key):
            if len(wanted) < layers and not any(e["opaque"] for e in wanted):
                wanted.append(hit)
        for order in itertools.permutations(hits):
            ports["count_i"].write(0)
            for hit in order:
                ports["hit_i"].write(ENTRY.pack(hit))
                await Timer(1, unit="ns")
                await ReadOnly()
                count, entries = ports["count_o"].read()[0], ports["entries_o"].read()
                await Timer(1, unit="ns")
                ports["count_i"].write(count)
                ports["entries_i"].write(entries)
            lines = ports["entries_o"].differences(meant(wanted, layers), entries)
            if count != len(wanted) or lines:
                raise bench.mismatch(0, {"hits": list(order)}, [f"{count} layers, expected {len(wanted)}", *lines])


@pytest.mark.parametrize("layers", [1, 2, 3, 4])
def test_insert(layers):
    """One layer and up to four, which no power of two need be."""
    bench.run(__name__, "rdx_insert", dict(Layers=layers))
