# SPDX-License-Identifier: Apache-2.0
"""Hits become layers of finished lines: a line is read when every pixel has its verdict, and holds all of its hits."""

from collections import defaultdict, deque

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, Timer

import bench
from entries import LAYER, entry, place
from raydix.formats import STEPS_WIDTH
from test_drain import given

SETTLED = 20  # clocks after a hit in which the limit is the new one: those before it in the queue wait, too


class Frame:
    """The rows of a frame as the raster and the rings would send them, and the model of the layers."""

    def __init__(self, dut, random, width, height, surfaces, opaque):
        self.dut, self.random, self.width, self.height = dut, random, width, height
        self.layers, self.pixels = bench.parameter(dut, "Layers"), bench.parameter(dut, "Pixels")
        self.rows = deque()  # (y, pixels of a surface's row, the line's last)
        for y in range(height):
            spans = [sorted(random.sample(range(width + 1), 2)) for _ in range(random.randint(0, surfaces))]
            self.rows += [(y, range(*span), False) for span in spans] + [(y, range(0), True)]
        self.opaque, self.held = opaque, defaultdict(list)
        self.skips, self.rays = [], []  # verdicts to come: rows; records of a ray, in order
        self.waiting = [0] * height
        self.sent, self.lost, self.now = 0, 0, 0
        self.touched = {}  # (y, x) -> clock of the last hit
        self.expected, self.given = deque(), 0

    def ray(self, y, x):
        """Records of a ray: up to three hits, the last of them or one more marked as the last."""
        random, records = self.random, []
        surface, depths = random.getrandbits(6), sorted(entry(random)["depth"] for _ in range(random.randint(0, 3)))
        for depth in depths:
            records.append({**entry(random, surface), "depth": depth, "hit": 1, "last": 0})
        if not records or random.getrandbits(1):
            records.append({**entry(random, surface), "hit": 0, "last": 0})
        records[-1]["last"] = 1
        for record in records:
            del record["opaque"]
            record |= {"x": x, "y": y, "t": random.getrandbits(32), "steps": random.getrandbits(STEPS_WIDTH)}
        return deque(records)

    def take(self, record):
        """A record was taken."""
        y, x = record["y"], record["x"]
        if record["hit"]:
            made = {name: record[name] for name in ("enters", "surface", "depth", "point")}
            made["opaque"] = self.opaque >> record["surface"] & 1
            self.held[y, x], lost = place(self.held[y, x], made, self.layers)
            self.lost += lost
            self.touched[y, x] = self.now
        self.waiting[y] -= record["last"]

    def line(self, y):
        """The layers of a line: as they stand now."""
        for first in range(0, self.width, self.pixels):
            yield from given([self.held.get((y, x), []) for x in range(first, first + self.pixels)])


async def render(dut, random, frame, idle, stall):
    """A frame from its start to its last layer; lost_o and all layers are the model's."""
    record_i, limits = bench.Port(dut, "hit_i", bench.HIT), 0
    dut.last_x_i.value, dut.opaque_i.value = frame.width - 1, frame.opaque
    lost, look, begun, ray = 0, None, False, None
    y, total, quiet = 0, 0, 0
    while y < frame.height or frame.expected or quiet < 20:
        dut.start_i.value = int(frame.now == 0)
        sending = frame.rows[0][0] if frame.rows else frame.height - 1
        dut.row_i.value = sending & 3
        await Timer(1, unit="ns")
        # when a line's first layer comes all of the line before it has been read
        if frame.now and frame.rows and sending <= y - 2 + bench.parameter(dut, "Lines"):
            assert dut.free_o.value, f"row {sending} cannot be sent, rows to {y - 2} have been read"
        free = bool(dut.free_o.value) and frame.now > 0 and bool(frame.rows) and random.random() >= idle
        add = end = False
        pixels = range(0)
        if free:
            _, pixels, end = frame.rows[0]
            add = len(pixels) > 0
        dut.add_i.value, dut.add_count_i.value, dut.line_end_i.value = int(add), max(len(pixels) - 1, 0), int(end)
        # verdicts
        skipped = rows = 0
        for bit in range(3):
            rows |= random.getrandbits(2) << 2 * bit
            if frame.skips and random.random() < 0.4:
                of = frame.skips.pop(random.randrange(len(frame.skips)))
                frame.waiting[of] -= 1
                skipped |= 1 << bit
                rows = rows & ~(3 << 2 * bit) | (of & 3) << 2 * bit
        dut.skipped_i.value, dut.skipped_row_i.value = skipped, rows
        if ray is None and frame.rays and random.random() >= idle:
            ray = random.choice(frame.rays)
        dut.hit_valid_i.value = int(ray is not None)
        if ray is not None:
            record_i.write(ray[0])
        asked = look
        spots = [spot for spot in frame.touched if frame.waiting[spot[0]] and spot[0] >= y]
        look = random.choice(spots) if spots and random.random() < 0.6 else None
        dut.look_i.value = int(look is not None)
        dut.look_row_i.value, dut.look_x_i.value = (look[0] & 3, look[1]) if look else (0, 0)
        room = random.random() >= stall
        dut.room_i.value = int(room)
        await ReadOnly()
        if asked and frame.now - frame.touched[asked] > SETTLED and bench.parameter(dut, "Limit"):
            wall = frame.held[asked][-1]
            assert bool(dut.limit_valid_o.value) == bool(wall["opaque"]), f"limit of {asked}"
            assert not wall["opaque"] or int(dut.limit_o.value) == wall["depth"], f"limit of {asked}"
            limits += 1
        lost += int(dut.lost_o.value)
        if dut.layer_valid_o.value:
            if not frame.expected:
                assert frame.sent > y and not frame.waiting[y], f"line {y} is read, {frame.waiting[y]} pixels wait"
                frame.expected.extend(frame.line(y))
                y += 1
            (wanted, whole), got = frame.expected.popleft(), LAYER.unpack(int(dut.layer_o.value))
            lines = [f"{name}: expected {v}, got {got[name]}" for name, v in wanted.items() if got[name] != v]
            lines += [] if int(dut.whole_o.value) == whole else [f"whole_o: expected {whole}"]
            if lines:
                raise bench.mismatch(total, {"line": y - 1, "layer": wanted}, lines)
            total += 1
        else:
            assert not begun, "no layer after begin_o"
        begun = bool(dut.begin_o.value)
        assert room or not begun, "a group begins without room"
        if free:
            frame.rows.popleft()
            frame.waiting[sending] += len(pixels)
            frame.sent += end
            for x in pixels:
                if random.random() < 0.3:
                    frame.skips.append(sending)
                else:
                    frame.rays.append(frame.ray(sending, x))
        if ray is not None and dut.hit_ready_o.value:
            frame.take(ray.popleft())
            if not ray:
                frame.rays.remove(ray)
            ray = None
        frame.now += 1
        quiet = 0 if y < frame.height or frame.expected else quiet + 1
        await FallingEdge(dut.clk_i)
        assert frame.now < 200000, "the frame does not end"
    assert lost == frame.lost, f"lost_o in {lost} clocks, expected {frame.lost}"
    return limits


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.5), stall=(0.0, 0.6))
async def lines_hold_their_hits(dut, idle, stall):
    """Frames of an odd and an even number of lines, lines without any ray, one group wide and as wide as can be."""
    random, limits = bench.rng(f"{idle} {stall}"), 0
    for name in ("start_i", "row_i", "add_i", "line_end_i", "skipped_i", "hit_valid_i", "look_i", "room_i"):
        getattr(dut, name).value = 0
    dut.last_x_i.value = 0
    await bench.start(dut)
    while not dut.ready_o.value:
        await FallingEdge(dut.clk_i)
    assert dut.free_o.value
    shapes = deque([(bench.parameter(dut, "MaxWidth"), 5, 4), (1, 9, 12), (7, 12, 1), (11, 4, 9)])
    while shapes:
        width, height, surfaces = shapes.popleft()
        opaque = random.getrandbits(64) & random.getrandbits(64)
        limits += await render(dut, random, Frame(dut, random, width, height, surfaces, opaque), idle, stall)
        if bench.parameter(dut, "Limit") and not shapes and limits <= 20:
            shapes.append((11, 9, 9))  # where the random frames had few: the bench ends when enough were compared


SETS = [
    dict(MaxWidth=32, Pixels=1, Layers=1, Lines=4),
    dict(MaxWidth=64, Pixels=4, Layers=4, Lines=4),
    dict(MaxWidth=16, Pixels=2, Layers=2, Limit=0),
]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_lines(parameters):
    """One layer and several, one pixel in a beat and several, without the limit."""
    bench.run(__name__, "rdx_lines", parameters)
