# SPDX-License-Identifier: Apache-2.0
"""The side of rdx_walk that asks for limits: answers of the layers, rows that wait, and what becomes of each pixel."""

import bench
from raydix.formats import DEPTH_WIDTH, PIXEL_WIDTH
from raydix.ring import NO_LIMIT, limit_of

FAR = (1 << (DEPTH_WIDTH - 1)) - 1


class Limits:
    """The nearest opaque hit of each pixel of four lines, or none; ``depths`` are few, so that equal ones are met."""

    def __init__(self, dut, random, share):
        self.dut, self.random, self.share = dut, random, share
        some = random.getrandbits(DEPTH_WIDTH - 1)
        self.depths = (0, FAR, FAR - some, *(max(0, min(FAR, some + d)) for d in (-1, 0, 1)))
        self.known = {}
        dut.limit_valid_i.value = 0
        dut.limit_i.value = 0

    def of(self, row, x):
        """Depth at column ``x`` of a line with lowest bits ``row``; None where there is none."""
        if (row, x) not in self.known:
            there = self.random.random() < self.share
            self.known[row, x] = self.random.choice(self.depths) if there else None
        return self.known[row, x]

    def hides(self, row, x, near):
        """A pixel there of a surface that begins at ``near`` has no ray."""
        limit = self.of(row, x)
        return limit is not None and limit < near

    def carried(self, row, x):
        """The limit that a ray there carries."""
        limit = self.of(row, x)
        return NO_LIMIT if limit is None else limit_of(limit)

    def asked(self):
        """What is asked for in this clock, settled; None for nothing, also before there was a pixel to ask for."""
        row, x = self.dut.look_row_o.value, self.dut.look_x_o.value
        known = self.dut.look_o.value == 1 and row.is_resolvable and x.is_resolvable
        return (int(row), int(x)) if known else None

    def answer(self, asked):
        """At the next falling edge: the answer, which stays until the next question."""
        if asked is not None:
            limit = self.of(*asked)
            self.dut.limit_valid_i.value = int(limit is not None)
            self.dut.limit_i.value = self.random.getrandbits(DEPTH_WIDTH - 1) if limit is None else limit


def widths(random, count):
    """Pixels of rows: 1 to 4 often."""
    return [random.choice((1, 1, 2, 3, 4, random.randint(1, 12))) for _ in range(count)]


def columns(random, width):
    """First and last column of a row: anywhere, or at an edge of the largest image."""
    last = 1 << PIXEL_WIDTH
    x0 = random.choice((0, last - width, random.randrange(last - width + 1)))
    return x0, x0 + width - 1


def differs(number, inputs, **pairs):
    """Raise where one of the pairs (expected, got) differs."""
    lines = [f"{name}: expected {e}, got {g}" for name, (e, g) in pairs.items() if e != g]
    if lines:
        raise bench.mismatch(number, {"given": inputs}, lines)
