# SPDX-License-Identifier: Apache-2.0
"""Pixels to beats: each beat leaves as it came, marked as AXI4-Stream wants it; room is never promised in vain."""

from collections import deque

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from raydix.formats import PIXEL_WIDTH

STREAM = ("m_axis_tdata_o", "m_axis_tkeep_o", "m_axis_tuser_o", "m_axis_tlast_o")


class Shading:
    """What gives pixels: a beat begins where there is room, its pixels come ``latency`` clocks later or more."""

    def __init__(self, random, pixels, latency):
        self.random, self.pixels, self.latency = random, pixels, latency
        self.due = deque()  # (clock, pixel, whole)
        self.free = 0  # clock in which the next layer may enter

    def begin(self, clock, words, whole):
        """A beat of these pixels, begun in this clock."""
        at = max(clock + 1, self.free)
        for word in words[:1] if whole else words:
            at += 0 if whole else self.random.choice((0, 0, 1, 3))  # more layers in front of the pixel's last
            self.due.append((at + self.latency, word, whole))
            at += 1
        self.free = at

    def drive(self, dut, clock):
        """Pixel of this clock, or noise."""
        valid = bool(self.due) and self.due[0][0] == clock
        _, word, whole = self.due.popleft() if valid else (0, self.random.getrandbits(24), self.random.getrandbits(1))
        dut.pixel_valid_i.value, dut.pixel_i.value, dut.whole_i.value = int(valid), word, int(whole)


def beats_of(random, pixels, width, height, plain):
    """Beats of a frame: (words, whole, expected values of the stream, the frame's last)."""
    per_line = -(-width // pixels)
    for y in range(height):
        for beat in range(per_line):
            whole = random.random() < plain
            words = [random.getrandbits(24)] * pixels if whole else [random.getrandbits(24) for _ in range(pixels)]
            data = sum(word << 24 * p for p, word in enumerate(words))
            keep = sum(7 << 3 * p for p in range(pixels) if beat * pixels + p < width)
            ends = beat == per_line - 1
            yield words, whole, (data, keep, int(not y and not beat), int(ends)), ends and y == height - 1


async def frames(dut, random, sizes, idle, stall, plain, latency):
    """Frames of these sizes, one after the other; the most beats that had begun and not left."""
    pixels, depth = bench.parameter(dut, "Pixels"), bench.parameter(dut, "Depth")
    dut.begin_i.value = dut.pixel_valid_i.value = dut.m_axis_tready_i.value = 0
    dut.last_x_i.value = dut.last_y_i.value = 0
    await bench.start(dut)
    shading, clock, most = Shading(random, pixels, latency), 0, 0
    for width, height in sizes:
        dut.last_x_i.value, dut.last_y_i.value = width - 1, height - 1
        beats, expected, waiting, ended = deque(beats_of(random, pixels, width, height, plain)), deque(), None, False
        long_stall = random.randint(0, len(beats))  # before this beat the receiver pauses until all is full
        while not ended:
            full = len(beats) == long_stall and len(expected) < depth - 1 and len(beats) > depth
            ready = not full and random.random() >= stall
            shading.drive(dut, clock)
            dut.m_axis_tready_i.value = int(ready)
            room = bool(dut.room_o.value)  # from a register
            begin = bool(beats) and room and random.random() >= idle and (not full or clock % 3 > 0)
            dut.begin_i.value = int(begin)
            await ReadOnly()
            assert room == (len(expected) < depth - 1), f"room_o = {room} with {len(expected)} beats of {depth}"
            valid = bool(dut.m_axis_tvalid_o.value)
            values = tuple(int(getattr(dut, name).value) for name in STREAM) if valid else None
            if waiting is not None:
                assert values == waiting, f"{waiting} became {values} before ready"
            waiting = values if valid and not ready else None
            assert bool(dut.stalled_o.value) == (valid and not ready), "stalled_o"
            ended = False
            if valid and ready:
                assert expected, "a beat that did not begin"
                wanted, ended = expected.popleft()
                if values != wanted:
                    raise bench.mismatch(clock, {"size": (width, height)}, [f"expected {wanted}, got {values}"])
            assert bool(dut.finish_o.value) == ended, f"finish_o, {len(beats) + len(expected)} beats left"
            if begin:
                words, whole, wanted, last = beats.popleft()
                shading.begin(clock, words, whole)
                expected.append((wanted, last))
            most = max(most, len(expected))
            clock += 1
            await FallingEdge(dut.clk_i)
    for _ in range(20):
        assert not dut.m_axis_tvalid_o.value, "a beat too many"
        await FallingEdge(dut.clk_i)
    return most


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.5), stall=(0.0, 0.4, 0.9), plain=(0.0, 0.5, 1.0))
async def keeps_beats(dut, idle, stall, plain):
    """Beats of single pixels and whole ones; widths that are a multiple of a beat and others; one pixel; stalls."""
    random, pixels = bench.rng(f"{idle} {stall} {plain}"), bench.parameter(dut, "Pixels")
    sizes = [(1, 1), (8 * pixels, 3), (2 * pixels + 1, 4), (5, 1), (1, 5), (random.randint(1, 20), 4)]
    await frames(dut, random, sizes, idle, stall, plain, latency=bench.parameter(dut, "Depth") // 2)


@cocotb.test
async def fills_the_queue(dut):
    """A receiver that pauses for long: beats begin until one place is left, none is lost, and all leave later."""
    depth, pixels = bench.parameter(dut, "Depth"), bench.parameter(dut, "Pixels")
    size = (3 * depth * pixels, 2)
    most = await frames(dut, bench.rng(), [size, size], 0.0, 0.97, 0.7, latency=depth // 2)
    assert most == depth - 1, f"{most} beats of {depth}"


@cocotb.test
async def reset_begins_a_frame(dut):
    """A reset within a line and a beat: the next beat is the first of a frame, and nothing of the old one leaves."""
    pixels = bench.parameter(dut, "Pixels")
    random = bench.rng()
    for _ in range(2):
        dut.begin_i.value = dut.pixel_valid_i.value = dut.m_axis_tready_i.value = 0
        dut.last_x_i.value, dut.last_y_i.value = 4 * pixels - 1, 3
        await bench.start(dut)
        shading = Shading(random, pixels, 0)
        for clock in range(8 * pixels + 6):
            dut.m_axis_tready_i.value = int(clock < 4 * pixels)
            begin = clock % pixels == 0 and bool(dut.room_o.value)
            if begin:
                shading.begin(clock, [1] * pixels, False)
            dut.begin_i.value = int(begin)
            shading.drive(dut, clock)
            await FallingEdge(dut.clk_i)
    await frames(dut, random, [(3 * pixels, 2)], 0.0, 0.3, 0.5, latency=3)


@cocotb.test
async def largest_frames(dut):
    """The widest frame there can be; with one pixel in a beat the highest, too; then the smallest."""
    most = 1 << PIXEL_WIDTH
    height = most if bench.parameter(dut, "Pixels") == 1 else 3
    await frames(dut, bench.rng(), [(most, 1), (1, height), (1, 1)], 0.0, 0.0, 0.5, latency=3)


SETS = [dict(Pixels=1, Depth=16), dict(Pixels=2, Depth=8), dict(Pixels=4, Depth=32)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_pixels(parameters):
    """One, two and four pixels in a beat."""
    bench.run(__name__, "rdx_pixels", parameters)
