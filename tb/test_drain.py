# SPDX-License-Identifier: Apache-2.0
"""Lines of layers are read from left to right and given in order, a layer a clock; nothing begins without room."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from entries import LAYER, listed, padded

READ = 2  # clocks from read_o to the group


def given(group):
    """What a group becomes: [(fields of a layer that matter, whole)], the first of which begins it."""
    nothing = {"shade": 0, "first": 1, "last": 1}
    if not any(group):
        return [(nothing, 1)]
    layers = []
    for entries in group:
        layers += [] if entries else [(nothing, 0)]
        for number, entry in enumerate(entries):
            ends = {"shade": 1, "first": int(number == 0), "last": int(number == len(entries) - 1)}
            layers.append((ends | {name: entry[name] for name in ("enters", "surface", "point")}, 0))
    return layers


class Reader:
    """The layers' memory and the shading around the module; :meth:`clock` drives a clock and checks the outputs."""

    def __init__(self, dut, random, last_group):
        self.dut, self.random, self.last_group = dut, random, last_group
        self.layers, self.pixels = bench.parameter(dut, "Layers"), bench.parameter(dut, "Pixels")
        self.groups = bench.parameter(dut, "MaxWidth") // self.pixels
        self.count = bench.parameter(dut, "Lines")
        self.lines = [None] * self.count  # by row: the groups of a line that is finished and has not been read
        self.place = (0, 0)  # row and group that is read next
        self.reads = [None] * READ
        self.freed = None  # line that was read to its end in the clock before
        self.expected = []  # (layer, whole, first of its group)
        self.begun = False  # a group began in the clock before
        self.clocks = self.groups_begun = 0
        self.counts, self.entries = bench.Port(dut, "count_i"), bench.Port(dut, "entries_i")
        dut.start_i.value, dut.room_i.value, dut.line_i.value = 0, 0, 0
        dut.last_group_i.value = last_group

    def finish_line(self, row, background):
        """A line is there: groups of random layers, ``background`` of them without any."""
        empty = [[] for _ in range(self.pixels)]
        self.lines[row] = [
            empty if self.random.random() < background else
            [listed(self.random, self.layers) if self.random.random() < 0.7 else [] for _ in empty]
            for _ in range(self.last_group + 1)
        ]  # fmt: skip
        for group in self.lines[row]:
            self.expected += [(*layer, number == 0) for number, layer in enumerate(given(group))]

    async def clock(self, room, start=False):
        """One clock."""
        dut, random = self.dut, self.random
        dut.room_i.value, dut.start_i.value = int(room), int(start)
        dut.line_i.value = sum((line is not None) << row for row, line in enumerate(self.lines))
        group = self.reads[-1]
        self.counts.write([len(e) for e in group] if group else
                          [random.randrange(self.layers + 1) for _ in range(self.pixels)])  # fmt: skip
        self.entries.write([padded(random, e, self.layers) for e in group or [[]] * self.pixels])
        await ReadOnly()
        read = None
        if dut.read_o.value:
            row, number = self.place
            found = int(dut.read_row_o.value), int(dut.read_group_o.value)
            assert found == self.place, f"read_o of {found}, expected {self.place}"
            assert self.lines[row] is not None, f"line {row} is read before it is finished"
            read = self.lines[row][number]
        freed = int(dut.free_o.value)
        assert freed == (0 if self.freed is None else 1 << self.freed), f"free_o = {freed:02b}"
        if self.freed is not None:
            self.lines[self.freed] = None
        self.freed = None
        if read is not None:
            ends = number == self.last_group
            self.freed = row if ends else None
            self.place = ((row + 1) % self.count, 0) if ends else (row, number + 1)
        if start:
            self.place = (0, 0)
        valid, begins = bool(dut.layer_valid_o.value), bool(dut.begin_o.value)
        assert room or not begins, "a group begins without room"
        if valid:
            assert self.expected, "a layer of no line"
            wanted, whole, first = self.expected.pop(0)
            got = LAYER.unpack(int(dut.layer_o.value))
            lines = [f"{name}: expected {v}, got {got[name]}" for name, v in wanted.items() if got[name] != v]
            lines += [] if int(dut.whole_o.value) == whole else [f"whole_o: expected {whole}"]
            lines += [] if self.begun == first else [f"begin_o = {int(self.begun)} a clock before, first = {first}"]
            if lines:
                raise bench.mismatch(self.groups_begun, {"layer": wanted}, lines)
        else:
            assert not self.begun, "no layer after begin_o"
            assert not self.expected or self.expected[0][2], "a pause within a group"
        self.begun = begins
        self.groups_begun += begins
        self.reads = [read, *self.reads[:-1]]
        self.clocks += 1
        await FallingEdge(dut.clk_i)

    async def swept(self):
        """After a reset: all lines are read once, all groups, and only then ready_o."""
        seen = []
        while not self.dut.ready_o.value:
            assert self.dut.read_o.value, "the sweep pauses"
            assert len(seen) < self.count * self.groups, "the sweep does not end"
            seen.append((int(self.dut.read_row_o.value), int(self.dut.read_group_o.value)))
            assert not self.dut.layer_valid_o.value and not int(self.dut.free_o.value)
            await FallingEdge(self.dut.clk_i)
        assert seen == [(row, group) for row in range(self.count) for group in range(self.groups)][-len(seen) :]
        return len(seen)


@cocotb.test
@cocotb.parametrize(stall=(0.0, 0.3, 0.9), background=(0.0, 0.7, 1.0))
async def gives_lines(dut, stall, background):
    """Lines of one group, of all groups, and others; all finished at once, or with pauses; some thousand layers."""
    random = bench.rng(f"{stall} {background}")
    groups = bench.parameter(dut, "MaxWidth") // bench.parameter(dut, "Pixels")
    dut.line_i.value, dut.start_i.value, dut.room_i.value = 0, 0, 1
    await bench.start(dut)
    reader = Reader(dut, random, 0)
    await reader.swept()
    for last, eager in ((0, True), (groups - 1, True), (groups // 2, False), (1, True), (0, False)):
        reader.last_group, dut.last_group_i.value = last, last
        await reader.clock(True, start=True)
        count = 5 + 40 // (last + 1)
        for line in range(count):
            while reader.lines[line % reader.count] is not None or (not eager and random.random() < 0.9):
                await reader.clock(random.random() >= stall)
            reader.finish_line(line % reader.count, background)
        while reader.expected:
            await reader.clock(random.random() >= stall)
        for _ in range(6):
            await reader.clock(True)
    assert reader.groups_begun > 5 * groups


@cocotb.test
async def a_group_of_background_a_clock(dut):
    """With room and both lines there, groups without a hit take one clock each, from line to line."""
    random = bench.rng()
    dut.line_i.value, dut.start_i.value, dut.room_i.value = 0, 0, 1
    await bench.start(dut)
    last = bench.parameter(dut, "MaxWidth") // bench.parameter(dut, "Pixels") - 1
    reader = Reader(dut, random, last)
    await reader.swept()
    reader.finish_line(0, 1.0)
    reader.finish_line(1, 1.0)
    total = len(reader.expected)
    while reader.expected:
        await reader.clock(True)
    assert reader.clocks <= total + 6, f"{reader.clocks} clocks for {total} groups"


@cocotb.test
async def reset_sweeps(dut):
    """A reset in the middle of a line forgets it: the whole sweep follows, then lines from row 0 on."""
    random = bench.rng()
    dut.line_i.value, dut.start_i.value, dut.room_i.value = 0, 0, 1
    await bench.start(dut)
    reader = Reader(dut, random, 1)
    await reader.swept()
    for _ in range(2):
        reader.finish_line(0, 0.0)
        while reader.lines[0] is not None:
            await reader.clock(True)
        reader.finish_line(1, 0.0)
        for _ in range(4):
            await reader.clock(False)
        dut.line_i.value = 0
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 1
        reader = Reader(dut, random, 1)
        assert await reader.swept() == reader.count * reader.groups
    for row in (0, 1):
        reader.finish_line(row, 0.5)
    while reader.expected:
        await reader.clock(True)


SETS = [
    dict(MaxWidth=64, Pixels=1, Layers=1),
    dict(MaxWidth=32, Pixels=2, Layers=4, Lines=4),
    dict(MaxWidth=32, Pixels=4, Layers=3),
    dict(MaxWidth=12, Pixels=1, Layers=2),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_drain(parameters):
    """One layer and several, one pixel in a group and several, a width that is no power of two."""
    bench.run(__name__, "rdx_drain", parameters)
