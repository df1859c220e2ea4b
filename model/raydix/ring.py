# SPDX-License-Identifier: Apache-2.0
"""The ring of step units as one item sees it (mirrors ``rtl/rdx_ring.sv``).

An item is entered, stepped until it has a hit or no cell left, restarted from its first control points where a
pending cell is to be searched, and leaves a record for each root. How many units work on how many
items at a time changes the order of the records only, so the golden model follows one item after the other.
"""

from .formats import DEPTH_WIDTH, LIMIT_WIDTH, STEPS_MAX
from .item import (
    AGAIN,
    DEPTH,
    DONE,
    ENTERS,
    FIRST,
    FOLLOW,
    HIT,
    LEVEL,
    PENDING,
    ROOTS,
    RUN,
    STATUS,
    STEPS,
    TMIN,
    TNEXT,
    B,
    C,
    T,
)
from .kernel import kernel
from .step import step


@kernel
def start(item, first, degree):
    """(Re)start a descent: control points, coordinates and depth from ``first``, no digit fixed yet."""
    for i in range(C, B + degree + 1):
        item[i] = first[i]
    item[STATUS] = RUN
    item[LEVEL] = item[FIRST]
    item[T] = 0
    item[PENDING] = 0


@kernel
def enter(item, first, degree):
    """A new item: nothing counted, searched from t = 0."""
    start(item, first, degree)
    item[STEPS] = 0
    item[FOLLOW] = 0
    item[TMIN] = 0
    item[TNEXT] = 0
    item[ENTERS] = 0


@kernel
def restart(item, first, degree):
    """Search on from the pending cell: the digits of its start are followed down."""
    start(item, first, degree)
    item[FOLLOW] = 1
    item[TMIN] = item[TNEXT]


@kernel
def more(item):
    """After a hit: another root is wanted and a cell is pending."""
    return item[ROOTS] > 1 and item[PENDING] == 1 and item[STEPS] < STEPS_MAX


NO_LIMIT = (1 << LIMIT_WIDTH) - 1  # nothing is behind it


def limit_of(depth):
    """The limit that a ray carries: the highest bits of the depth of the nearest opaque hit."""
    return depth >> (DEPTH_WIDTH - 1 - LIMIT_WIDTH)


def behind(depth, limit):
    """A cell that begins at this depth lies behind a limit: it ends an item of the RTL. The golden model has no limits."""
    return limit_of(depth) > limit


@kernel
def trace(item, first, form, work, n1, steps, width, degree, general, t, depth, point, enters, at):
    """Follow one item to its end; the records of its hits go to places ``at``, ``at``+1, … in order of t.

    item        PAPER, ROOTS, BOX and FIRST are set; the rest is working state
    first       vector of item.SIZE: C, D, B of the whole segment
    form, work, … general   as in :func:`~raydix.step.step`
    t, depth, point[3], enters   outputs: digits, s1p31, s2p30, 1 where the indicator is positive before the hit
    Returns the number of hits; item[STEPS] is the number of steps.
    """
    hits = 0
    enter(item, first, degree)
    while True:
        while item[STATUS] == RUN:
            step(item, form, work, n1, steps, width, degree, general)
        if item[STATUS] == HIT:
            t[at + hits] = item[T]
            depth[at + hits] = item[DEPTH]
            for axis in range(3):
                point[at + hits, axis] = item[C + axis]
            enters[at + hits] = item[ENTERS]
            hits += 1
            if not more(item):
                return hits
            item[ROOTS] -= 1
            item[STATUS] = AGAIN
        if item[STATUS] == DONE:
            return hits
        restart(item, first, degree)
