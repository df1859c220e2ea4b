# SPDX-License-Identifier: Apache-2.0
"""One step of the descent: fixes the next n1 binary digits of t (mirrors ``rtl/rdx_step.sv``)."""

from .carry import descend
from .cells import subdivide
from .formats import STEPS_MAX
from .item import AGAIN, DEPTH, DONE, FOLLOW, HIT, LEVEL, PAPER, PENDING, STATUS, STEPS, TMIN, TNEXT, B, C, T
from .kernel import kernel
from .normalize import norm_limit, normalize
from .outside import outside_cells
from .select import certified, changes, paper
from .settle import settle


@kernel
def step(item, cells, nodes, n1, steps, width, degree):
    """Fix the next n1 digits of ``item[T]``, or find that no cell is left.

    item    fields as in item.py, STATUS = RUN; changed in place. Its new STATUS is RUN while digits are left,
            HIT with the point in C and DEPTH when the last is fixed, AGAIN (restart at TNEXT) or DONE at a dead end.
    cells   scratch for J*degree + 1 values, nodes for (n1+1)*(degree+1)
    Source: docs/method.md, "A step".
    """
    size = degree + 1
    level = item[LEVEL]
    last = level == steps - 1
    shift = n1 * (steps - 1 - level)
    # cells that are passed over: before TMIN, or outside of the box
    first = 0
    if item[FOLLOW]:
        first = (item[TMIN] >> shift) & ((1 << n1) - 1)
    excluded = outside_cells(item, cells, n1) | ((1 << first) - 1)
    # candidates
    for i in range(size):
        cells[i] = item[B + i]
    if item[PAPER]:
        subdivide(cells, degree, n1)
        mask = paper(cells, excluded, degree, 1 << n1)
    else:
        mask = certified(cells, nodes, excluded, last, degree, n1)
    item[STEPS] += 1
    # pick the first, remember the second
    if mask == 0:
        item[STATUS] = DONE
    else:
        pick = 0
        while (mask >> pick) & 1 == 0:
            pick += 1
        following = pick + 1
        while mask >> following != 0 and (mask >> following) & 1 == 0:
            following += 1
        if mask >> following != 0:
            item[TNEXT] = item[T] | following << shift
            item[PENDING] = 1
        item[T] |= pick << shift
        item[FOLLOW] = 1 if item[FOLLOW] and pick == first else 0
        at = pick * degree if item[PAPER] else 0
        for i in range(size):
            item[B + i] = cells[at + i]
        for lane in range(3):
            descend(item, C + lane, C + 3 + lane, pick, n1)
        descend(item, DEPTH, DEPTH + 1, pick, n1)
        if not last:
            item[LEVEL] = level + 1
            normalize(item, B, size, width, width, norm_limit(n1))
        elif settle(item) and changes(item, B, degree):
            item[STATUS] = HIT
        else:
            item[STATUS] = DONE
    if item[STATUS] == DONE and item[PENDING]:
        item[STATUS] = AGAIN
    if item[STEPS] == STEPS_MAX and item[STATUS] != HIT:
        item[STATUS] = DONE
