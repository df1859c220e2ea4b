# SPDX-License-Identifier: Apache-2.0
"""Layers of some lines: each hit finds those before it, a line read is the model's and empty, the limit is current."""

from collections import defaultdict

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from entries import entry, meant, place
from raydix.formats import DEPTH_WIDTH, PIXEL_WIDTH, STEPS_WIDTH

WRITTEN = 4  # clocks from a hit's transfer to its writing


class Lines:
    """The module's ports and the model: a clock is driven by :meth:`clock`, which checks everything."""

    def __init__(self, dut, random):
        self.dut, self.random = dut, random
        self.layers, self.pixels = (bench.parameter(dut, name) for name in ("Layers", "Pixels"))
        self.width, self.limited = (bench.parameter(dut, name) for name in ("MaxWidth", "Limit"))
        self.groups, self.lines = self.width // self.pixels, bench.parameter(dut, "Lines")
        self.held = defaultdict(list)  # (row, x) -> entries; all hits that were taken
        self.limits = {}  # (row, x) -> depth; as written
        self.under_way = [None] * WRITTEN  # what the last transfers do, the latest first
        self.reads = [None, None]
        self.limit = self.opaque = None
        self.hits, self.hazards, self.lost, self.walls = 0, 0, 0, 0
        self.hit, self.counts, self.entries = (
            bench.Port(dut, "hit_i", bench.HIT), bench.Port(dut, "count_o"), bench.Port(dut, "entries_o"),
        )  # fmt: skip
        for name in ("hit_valid_i", "read_i", "look_i"):
            getattr(dut, name).value = 0

    async def clock(self, hit=None, read=None, look=None):
        """Offer a hit, read a group (row, group), look at a pixel (row, x); True where the hit was taken."""
        dut, random = self.dut, self.random
        dut.hit_valid_i.value = int(hit is not None)
        if hit is None:
            dut.hit_i.value = random.getrandbits(bench.HIT.width)
        else:
            self.hit.write(hit)
        dut.read_i.value = int(read is not None)
        anything = random.randrange(self.lines), random.randrange(self.groups)
        dut.read_row_i.value, dut.read_group_i.value = read or anything
        dut.look_i.value = int(look is not None)
        dut.look_row_i.value, dut.look_x_i.value = look or (random.randrange(self.lines), random.randrange(self.width))
        await ReadOnly()
        taken = False
        if hit is not None:
            pixel = hit["y"] % self.lines, hit["x"]
            at = hit["y"] & 3, hit["x"]
            hazard = hit["hit"] and any(w and w["at"] == at and w["hit"] for w in self.under_way)
            taken = bool(dut.hit_ready_o.value)
            assert taken == (not hazard), f"hit_ready_o = {taken} at {pixel}, under way: {self.under_way}"
            self.hazards += hazard
        done = self.under_way[-1]
        assert bool(dut.last_o.value) == bool(done and done["last"]), "last_o"
        if done and done["last"]:
            assert int(dut.last_row_o.value) == done["at"][0], "last_row_o"
        assert bool(dut.lost_o.value) == bool(done and done["lost"]), f"lost_o = {dut.lost_o.value}: {done}"
        if self.reads[-1] is not None:
            words = [meant(entries, self.layers) for entries in self.reads[-1]]
            lines = self.counts.differences([len(entries) for entries in self.reads[-1]], self.counts.read())
            lines += self.entries.differences(self.entries.words(words), self.entries.read())
            if lines:
                raise bench.mismatch(0, {"group": self.reads[-1]}, lines)
        if self.limited and self.limit is not None:
            valid, depth = self.limit
            assert bool(dut.limit_valid_o.value) == valid, f"limit_valid_o: expected {self.limit}"
            assert not valid or int(dut.limit_o.value) == depth, f"limit_o: expected {depth:#x}"
        elif not self.limited:
            assert not int(dut.limit_valid_o.value)
        if look is not None:
            self.limit = look in self.limits, self.limits.get(look)
            self.walls += look in self.limits
        self.reads = [None, self.reads[0]]
        if read is not None:
            xs = [read[1] * self.pixels + p for p in range(self.pixels)]
            self.reads[0] = [self.held.pop((read[0], x), []) for x in xs]
            for x in xs:
                self.limits.pop((read[0], x), None)
        if done and done["hit"]:
            wall = done["entries"][-1]
            if wall["opaque"]:
                self.limits[done["pixel"]] = wall["depth"]
            else:
                self.limits.pop(done["pixel"], None)
        self.under_way = [self.take(hit) if taken else None, *self.under_way[:-1]]
        await FallingEdge(dut.clk_i)
        return taken

    def take(self, hit):
        """Put a hit into the model; what its writing does."""
        pixel = hit["y"] % self.lines, hit["x"]
        if hit["hit"]:
            opaque = self.opaque >> hit["surface"] & 1
            made = {name: hit[name] for name in ("enters", "surface", "depth", "point")} | {"opaque": opaque}
            self.held[pixel], lost = place(self.held[pixel], made, self.layers)
            self.hits += 1
            self.lost += lost
        return {"pixel": pixel, "at": (hit["y"] & 3, hit["x"]), "hit": hit["hit"], "last": hit["last"],
                "lost": bool(hit["hit"] and lost), "entries": self.held[pixel]}  # fmt: skip

    async def sweep(self):
        """Read every pixel once, which empties it; what is read means nothing."""
        for group in range(self.groups):
            for row in range(self.lines):
                self.dut.read_i.value, self.dut.read_row_i.value, self.dut.read_group_i.value = 1, row, group
                await FallingEdge(self.dut.clk_i)
        self.dut.read_i.value = 0
        for _ in range(2):
            await FallingEdge(self.dut.clk_i)

    def record(self, row, spots):
        """A random record at one of a few pixels of a line."""
        random = self.random
        made = entry(random)
        del made["opaque"]
        return made | {"x": random.choice(spots), "y": (random.getrandbits(PIXEL_WIDTH - 2) << 2) + row,
                       "hit": int(random.random() < 0.85), "last": random.getrandbits(1),
                       "t": random.getrandbits(32), "steps": random.getrandbits(STEPS_WIDTH)}  # fmt: skip


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.3), spots=(1, 3, 40))
async def keeps_lines(dut, idle, spots):
    """Hits of one line, often of one pixel in consecutive clocks, while another is read and limits are asked for."""
    random = bench.rng(f"{idle} {spots}")
    lines = Lines(dut, random)
    await bench.start(dut)
    await lines.sweep()
    for turn in range(40):
        if turn >= 10 and (lines.walls > 100 or not lines.limited):  # few seeds take more than ten
            break
        row, other = turn % lines.lines, (turn + 1) % lines.lines
        lines.opaque = random.getrandbits(64) & random.getrandbits(64)
        dut.opaque_i.value = lines.opaque
        xs = [random.randrange(lines.width) for _ in range(spots)]
        records = [lines.record(row, xs) for _ in range(150)]
        groups = sorted({x // lines.pixels for r, x in lines.held if r == other} | set(range(min(20, lines.groups))))
        while records or groups:
            hit = records[0] if records and random.random() >= idle else None
            read = (other, groups[0]) if groups and random.random() < 0.3 else None
            look = (row, random.choice(xs)) if random.random() < 0.4 else None
            if await lines.clock(hit, read, look):
                records.pop(0)
            if read:
                groups.pop(0)
        assert not [pixel for pixel in lines.held if pixel[0] == other], "the line that was read is empty"
        for _ in range(WRITTEN):
            await lines.clock()
    assert lines.hits > 1000 and (lines.hazards or spots > 3), f"{lines.hits} hits, {lines.hazards} waited"
    if lines.limited:
        assert lines.walls > 100, f"{lines.walls} limits"
    if spots == 1:
        assert lines.lost > 50, f"{lines.lost} without room"


@cocotb.test
async def each_pixel_has_its_own_limit(dut):
    """Opaque hits at all pixels of all lines, or many: each pixel has its own limit, and none once it was read."""
    lines = Lines(dut, bench.rng())
    await bench.start(dut)
    await lines.sweep()
    lines.opaque = (1 << 64) - 1
    dut.opaque_i.value = lines.opaque
    xs = sorted({*range(min(48, lines.width)), *range(lines.width - 48, lines.width)} & set(range(lines.width)))
    for flip in (bench.high(DEPTH_WIDTH), 0):
        for x in xs:
            for row in range(lines.lines):
                assert await lines.clock(lines.record(row, [x]) | {"hit": 1, "depth": x ^ flip})
        for _ in range(WRITTEN):
            await lines.clock()
        for row in range(lines.lines):
            for x in xs:
                await lines.clock(look=(row, x))
            for group in sorted({x // lines.pixels for x in xs}):
                await lines.clock(read=(row, group))
            await lines.clock()
            await lines.clock(look=(row, xs[0]))
            for x in xs:
                await lines.clock(look=(row, x))
            await lines.clock()


@cocotb.test
async def reset_forgets_what_is_under_way(dut):
    """Hits that have not been written are gone after a clock of reset: nothing is told of them, nothing waits."""
    random = bench.rng()
    lines = Lines(dut, random)
    await bench.start(dut)
    await lines.sweep()
    lines.opaque = 0
    dut.opaque_i.value = 0
    record = lines.record(0, [1]) | {"hit": 1, "last": 1}
    assert await lines.clock(record)
    dut.rst_ni.value = 0
    dut.hit_valid_i.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    lines.held.clear()
    lines.under_way = [None] * WRITTEN
    for _ in range(WRITTEN):
        await lines.clock()
    assert await lines.clock(record)
    for _ in range(WRITTEN):
        await lines.clock()
    await lines.clock(read=(0, 1 // lines.pixels))
    await lines.clock()
    await lines.clock()


SETS = [
    dict(MaxWidth=4096, Pixels=1, Layers=1, Lines=4),
    dict(MaxWidth=64, Pixels=2, Layers=4, Limit=0),
    dict(MaxWidth=2048, Pixels=4, Layers=4, Lines=4),
    dict(MaxWidth=48, Pixels=1, Layers=3),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_layers(parameters):
    """One layer and several, one pixel in a beat and several, with and without the limit, no power of two."""
    bench.run(__name__, "rdx_layers", parameters)
