# SPDX-License-Identifier: Apache-2.0
"""A frame's walk, around rdx_rows and rdx_feed: descriptors, rings and layers, and all that must happen."""

from cocotb.triggers import FallingEdge, ReadOnly

import bench
import looks
from raydix.formats import PIXEL_WIDTH, SURFACE_WIDTH, UNIT_FRAC
from raydix.kernel import words
from raydix.raster import is_vector_sum, rectangle
from test_raster import descriptor

SKIPS = ("early", "depth", "rootless", "boxes", "rectangle")
FRAME = bench.Struct(
    ("last_x", PIXEL_WIDTH), ("last_y", PIXEL_WIDTH), ("last_slot", SURFACE_WIDTH), ("empty", 1), ("k_stop", 6),
    *((name, 1) for name in SKIPS), ("ambient", 1 + UNIT_FRAC), ("background", 1 + UNIT_FRAC, 3),
)  # fmt: skip


class Frame:
    """Descriptors and size of a frame; ``rects``: first column, first row, last column, last row of each."""

    def __init__(self, random, width, height, rects, kinds, skip=True):
        self.random, self.width, self.height, self.skip = random, width, height, skip
        self.descriptors = []
        for number, (rect, kind) in enumerate(zip(rects, kinds, strict=True)):
            d = descriptor(random, 1, 1, kind)
            d[0] = d[0] & ~63 | number
            d[1] = sum(place << 16 * i for i, place in enumerate(rect))
            self.descriptors.append(d)
        self.rects = [tuple(int(r) for r in rectangle(words(d))) for d in self.descriptors]
        self.vectors = [bool(is_vector_sum(words(d))) for d in self.descriptors]

    def fields(self):
        """Fields of :data:`FRAME`; what the walk does not look at is any bits."""
        fields = {name: self.random.getrandbits(1) for name in SKIPS[:-1]}
        fields |= {"last_x": self.width - 1, "last_y": self.height - 1, "rectangle": int(self.skip)}
        fields |= {"last_slot": max(0, len(self.descriptors) - 1), "empty": int(not self.descriptors)}
        fields |= {"k_stop": self.random.getrandbits(6), "ambient": self.random.getrandbits(1 + UNIT_FRAC)}
        return fields | {"background": [self.random.getrandbits(1 + UNIT_FRAC) for _ in range(3)]}

    def crossing(self, y):
        """Slots whose rectangles line ``y`` crosses."""
        return [slot for slot, (_, y0, _, y1) in enumerate(self.rects) if y0 <= y <= y1]

    def pixels(self, slot):
        """Pixels of a row."""
        return self.rects[slot][2] - self.rects[slot][0] + 1

    def events(self):
        """Rows and ends of lines in order."""
        out = []
        for y in range(self.height):
            out += [("row", y, slot) for slot in self.crossing(y)] + [("end", y)]
        return out

    def rows(self):
        """(line, slot, whether the constants come, too) of all rows in order."""
        out, formed = [], None
        for y in range(self.height):
            for slot in self.crossing(y):
                out.append((y, slot, self.vectors[slot] and formed != slot))
                formed = slot if self.vectors[slot] else formed
        return out

    def outside(self):
        """Pixels of all lines and surfaces outside of their rectangles."""
        inside = sum(self.pixels(slot) for y in range(self.height) for slot in self.crossing(y))
        return self.width * self.height * len(self.descriptors) - inside


def random_frame(random, count, kinds, skip=True, width=None):
    """A small frame; surfaces of one row and of one column among others."""
    width, height = width or random.randint(1, 20), random.randint(1, 8)
    rects = []
    for _ in range(count):
        x, y = (sorted(random.choices(range(n), k=2)) for n in (width, height))
        x, y = (random.choice((p, p, (p[0], p[0]), (0, n - 1))) for p, n in ((x, width), (y, height)))
        rects.append((x[0], y[0], x[1], y[1]))
    return Frame(random, width, height, rects, [random.choice(kinds) for _ in range(count)], skip)


class Rings:
    """What takes the rows: one waits, one is walked, rays of vector sums stay under way for a time."""

    def __init__(self, dut, frame, random, stall):
        self.dut, self.frame, self.random, self.stall = dut, frame, random, stall
        self.waiting, self.walking, self.flight = None, 0, 0
        self.begun, self.gaps = 0, 0

    def idle(self):
        """No pixel is under way and none waits."""
        return self.waiting is None and not self.walking

    def drive(self):
        """Ports at a falling edge."""
        self.dut.full_i.value = int(self.waiting is not None)
        self.dut.idle_i.value = int(self.idle())
        self.dut.vector_idle_i.value = int(not self.flight)

    def clock(self):
        """A clock has passed."""
        if self.walking and self.random.random() >= self.stall:
            self.walking -= 1
        elif self.flight and not self.walking and self.random.random() < 0.2:
            self.flight -= 1
        if self.begun and not self.walking and self.waiting is None:
            self.gaps += 1
        if self.waiting is not None and not self.walking:
            self.walking, self.begun = self.frame.pixels(self.waiting), self.begun + 1
            self.flight = 5 if self.frame.vectors[self.waiting] else self.flight
            self.waiting = None

    def take(self, slot):
        """All words of a row have come."""
        assert self.waiting is None, "a row's words come while another one waits"
        self.waiting = slot


class Result:
    """What was seen of a frame."""

    def __init__(self):
        self.events, self.ends, self.skipped, self.error, self.clocks, self.after_abort = [], [], 0, None, 0, 0
        self.last_gap = 0


async def rest(dut):
    """Clock and reset, with the ports at rest."""
    for name in ("start_i", "abort_i", "finish_i", "full_i", "free_i"):
        getattr(dut, name).value = 0
    dut.idle_i.value = dut.vector_idle_i.value = 1
    dut.frame_i.value = 0
    await bench.start(dut)


async def run_frame(dut, random, frame, make_side, stall=0.0, free=1.0, abort=None, end=None):
    """Make a frame, from its start to the end of busy_o; what was seen.

    make_side   function of the frame and the rings to the rest of the bench: drive() at a falling edge, settled(),
                and passed() when the clock has passed
    stall       probability that a pixel does not leave in a clock; free: probability that the layers are free
    abort       clock of abort_i; end: stop at that clock
    """
    result, rings = Result(), Rings(dut, frame, random, stall)
    side = make_side(frame, rings)
    dut.frame_i.value = FRAME.pack(frame.fields())
    finish, started = None, False
    while True:
        dut.start_i.value = int(not started)
        dut.abort_i.value = int(result.clocks == abort)
        dut.free_i.value = int(random.random() < free)
        dut.finish_i.value = int(finish == 0)
        rings.drive()
        side.drive()
        await ReadOnly()
        busy = bool(dut.busy_o.value)
        if started and (not busy or result.clocks == end):
            break
        assert busy == started
        y, ended = int(dut.y_o.value), dut.line_end_o.value == 1
        result.skipped += int(dut.skipped_o.value)
        if dut.add_o.value == 1:
            result.events.append(("row", y, int(dut.slot_o.value)))
            result.after_abort += abort is not None and result.clocks > abort
        if ended:
            assert dut.free_i.value == 1 or frame.crossing(y) or frame.descriptors
            result.events.append(("end", y))
            result.ends.append(result.clocks)
        if int(dut.error_o.value):
            assert result.error is None, "an error twice"
            result.error = int(dut.error_o.value)
            side.error()
        side.settled()
        await FallingEdge(dut.clk_i)
        started = True
        rings.clock()
        side.passed()
        if finish is not None and rings.idle():
            finish -= 1
        if ended and y == frame.height - 1:
            finish, result.gaps = random.randrange(4, 9), rings.gaps  # words are under way for three clocks
        result.clocks += 1
        assert result.clocks < 5000 + 400 * len(frame.descriptors) * frame.height * (frame.width + 1)
    await FallingEdge(dut.clk_i)
    return result


def compare(frame, result):
    """All that must have happened has, and nothing else."""
    expected = frame.events()
    place = next((i for i, (e, r) in enumerate(zip(expected, result.events, strict=False)) if e != r), len(expected))
    where = {"rects": frame.rects, "size": (frame.width, frame.height), "event": place}
    looks.differs(place, where, events=(expected[place:], result.events[place:]), error=(None, result.error))
    looks.differs(place, where, skipped=(frame.outside() if frame.skip else 0, result.skipped))
