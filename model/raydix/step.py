# SPDX-License-Identifier: Apache-2.0
"""One step of the descent: fixes the next n1 binary digits of t (mirrors ``rtl/rdx_step.sv``)."""

from typing import NamedTuple

import numpy as np

from .bound import bounded, zone_of
from .carry import descend
from .cells import subdivide
from .formats import STEPS_MAX, ZONES
from .item import (
    AGAIN,
    DEPTH,
    DONE,
    ENTERS,
    FIRST,
    FOLLOW,
    HIT,
    LEVEL,
    PAPER,
    PENDING,
    STATUS,
    STEPS,
    TMIN,
    TNEXT,
    B,
    C,
    T,
)
from .kernel import kernel, zeros
from .normalize import norm_limit, normalize
from .outside import outside_cells, outside_faces
from .select import certified, changes, paper
from .settle import settle
from .vecsum import Lanes, evaluate, new_lanes


class Work(NamedTuple):
    """Scratch of a step: see :func:`new_work`."""

    cells: np.ndarray  # J*degree + 1 values
    nodes: np.ndarray  # (n1+1)*5 values
    lanes: Lanes  # J+1 lanes


def new_work(n1: int, degree: int, drop: int = 0) -> Work:
    """Scratch for a step of J = 2**n1 cells and control points of a degree (1: vector sums).

    drop  digits that the vector-sum evaluator leaves away
    """
    return Work(zeros((degree << n1) + 1), zeros((n1 + 1) * 5), new_lanes((1 << n1) + 1, drop))


@kernel
def boundaries(item, work, form, n1, general):
    """Indicator of a vector-sum surface at the J+1 boundaries into ``work.cells``; both ends are known already.

    Returns the zone in which all boundaries lie, or beyond it.
    """
    cells, lanes = work.cells, work.lanes
    count = 1 << n1
    for axis in range(3):
        cells[0] = item[C + axis]
        cells[1] = item[C + 3 + axis]
        subdivide(cells, 1, n1)
        target = (lanes.x, lanes.y, lanes.z)[axis]
        for j in range(count + 1):
            target[j] = cells[j]
    zone = ZONES - 1
    for j in range(count + 1):
        zone = min(zone, zone_of((lanes.x[j] ^ (lanes.x[j] >> 63)) | (lanes.y[j] ^ (lanes.y[j] >> 63))))
    evaluate(lanes, count, form, general)
    for j in range(1, count):
        cells[j] = lanes.value[j]
    cells[0] = item[B]
    cells[count] = item[B + 1]
    return zone


@kernel
def first_two(mask, count):
    """Positions of the two lowest bits of a mask of ``count`` bits, ``count`` where there is none."""
    pick = 0
    while pick < count and (mask >> pick) & 1 == 0:
        pick += 1
    following = pick + 1
    while following < count and (mask >> following) & 1 == 0:
        following += 1
    return pick, min(following, count)


@kernel
def step(item, form, work, n1, steps, width, degree, general):
    """Fix the next n1 digits of ``item[T]``, or find that no cell is left.

    item    fields as in item.py, STATUS = RUN; changed in place. Its new STATUS is RUN while digits are left,
            HIT with the point in C and DEPTH when the last is fixed, AGAIN (restart at TNEXT) or DONE at a dead end.
    form    constants of the surface, formats.FORM (degree 1, vector sums, only); work: scratch
    Source: docs/method.md, "A step".
    """
    cells, nodes = work.cells, work.nodes
    size = degree + 1
    level = item[LEVEL]
    last = level == steps - 1
    shift = n1 * (steps - 1 - level)
    # cells that are passed over: before TMIN, or outside of the box
    first = 0
    if item[FOLLOW]:
        first = (item[TMIN] >> shift) & ((1 << n1) - 1)
    outside = outside_faces(item, cells, form, n1) if degree == 1 else outside_cells(item, cells, n1)
    excluded = outside | ((1 << first) - 1)
    # candidates
    zone = 0
    whole = degree == 1 or item[PAPER]  # all cells are there, not only the first candidate
    if degree == 1:
        zone = boundaries(item, work, form, n1, general)
    else:
        for i in range(size):
            cells[i] = item[B + i]
        if item[PAPER]:
            subdivide(cells, degree, n1)
    count = 1 << n1
    if item[PAPER]:
        pick, following = first_two(paper(cells, excluded, degree, count), count)
    elif degree == 1:
        pick, following = first_two(bounded(cells, excluded, last, form, level - item[FIRST], zone, n1), count)
    else:
        pick, following = certified(cells, nodes, excluded, last, degree, n1)
    item[STEPS] += 1
    # pick the first, remember the second
    if pick == count:
        item[STATUS] = DONE
    else:
        if following < count:
            item[TNEXT] = item[T] | following << shift
            item[PENDING] = 1
        item[T] |= pick << shift
        item[FOLLOW] = 1 if item[FOLLOW] and pick == first else 0
        at = pick * degree if whole else 0
        for i in range(size):
            item[B + i] = cells[at + i]
        for lane in range(3):
            descend(item, C + lane, C + 3 + lane, pick, n1)
        descend(item, DEPTH, DEPTH + 1, pick, n1)
        if not last:
            item[LEVEL] = level + 1
            if degree > 1:
                normalize(item, B, size, width, width, norm_limit(n1))
        elif settle(item, form, degree) and changes(item, B, degree):
            item[STATUS] = HIT
            item[ENTERS] = 1 if item[B] > 0 else 0
        else:
            item[STATUS] = DONE
    if item[STATUS] == DONE and item[PENDING]:
        item[STATUS] = AGAIN
    if item[STEPS] == STEPS_MAX and item[STATUS] != HIT:
        item[STATUS] = DONE
