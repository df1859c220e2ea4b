# SPDX-License-Identifier: Apache-2.0
"""One ray followed step by step: what the golden model does at each, in words that a person can read."""

from dataclasses import dataclass

import numpy as np

from .bound import bounded
from .cells import subdivide
from .compile import CompiledFrame, CompiledSurface
from .config import Config
from .core import FORM_AT, scratch
from .ends import ends
from .fdiff import DXX, DXY, DYY, ROWS, SLOPE, VALUE, next_pixel, next_row
from .formats import COORD_LANES, VECTOR_WIDTH
from .item import (
    AGAIN,
    DEPTH,
    DONE,
    FIRST,
    FOLLOW,
    HIT,
    LEVEL,
    PAPER,
    PENDING,
    ROOTS,
    RUN,
    STATUS,
    STEPS,
    TMIN,
    TNEXT,
    B,
    T,
)
from .kernel import words, zeros
from .outside import outside_cells, outside_faces
from .product import product
from .raster import LANES, header, is_quartic, load_lanes, roots_wanted, sample
from .ring import enter, more, restart
from .select import changes, paper
from .step import boundaries, step

NAMES = {RUN: "run", AGAIN: "again", HIT: "hit", DONE: "done"}


@dataclass
class Step:
    """One step of a ray, numbers as in the item (docs/number-formats.md).

    number    counted from 1; level of the descent, 0 to K-1
    start     digits fixed before it, the cell's start, u0p<n>
    control   control points of the cell, sWp0; of vector sums the indicator at both ends, s5p33
    values    the indicator at the J+1 boundaries of the new cells
    excluded  cells outside of the box or before the one that is searched for: mask, bit j for cell j
    candidates   cells that may hold a root: mask
    pick      number of the cell that was chosen, -1 = none
    t, next_t digits after it; of the cell that waits, -1 = none
    status    "run", "again", "hit" or "done"
    after     control points after it; depth of the cell's start, s1p31
    """

    number: int
    level: int
    start: int
    control: list[int]
    values: list[int]
    excluded: int
    candidates: int
    pick: int
    t: int
    next_t: int
    status: str
    after: list[int]
    depth: int


def pixel_of(surface: CompiledSurface, x: int, y: int) -> CompiledSurface:
    """The surface with a rectangle of the one pixel (x, y): its ray is the same in every bit.

    Raises ValueError where the pixel is outside of the surface's rectangle.
    """
    x0, y0, x1, y1 = surface.rect
    if not (x0 <= x <= x1 and y0 <= y <= y1):
        raise ValueError(
            f"found pixel {x},{y}; allowed: {x0},{y0} to {x1},{y1}, the rectangle of surface {surface.index}"
        )
    state = state_at(surface, x, y)
    lanes, quadratic = COORD_LANES, 0
    if not surface.is_vector_sum:
        quadratic = 9 if is_quartic(words(surface.words)) else 3
    out = [surface.words[0], x | y << 16 | x << 32 | y << 48, surface.words[2]]
    for lane in range(lanes):
        out += [int(state[VALUE, lane]), int(state[SLOPE, lane]), 0]
    for lane in range(lanes, lanes + quadratic):
        out += [
            int(state[VALUE, lane]),
            int(state[SLOPE, lane]),
            0,
            *(int(state[row, lane]) for row in (DXX, DXY, DYY)),
        ]
    out += surface.words[FORM_AT:] if surface.is_vector_sum else ()
    return surface._replace(words=tuple(out), rect=(x, y, x, y))


def alone(compiled: CompiledFrame, surface: CompiledSurface, x: int, y: int) -> CompiledFrame:
    """A frame of one pixel with the ray of pixel (x, y) on a surface. Raises ValueError as :func:`pixel_of`."""
    one = pixel_of(surface, x, y)
    one = one._replace(words=(one.words[0], 0, *one.words[2:]), rect=(0, 0, 0, 0))
    return compiled._replace(width=1, height=1, surfaces=(one,))


def state_at(surface: CompiledSurface, x: int, y: int) -> np.ndarray:
    """Forward differences at a pixel."""
    state = zeros(ROWS * LANES).reshape(ROWS, LANES)
    load_lanes(state, words(surface.words))
    for _ in range(y - surface.rect[1]):
        next_row(state)
    for _ in range(x - surface.rect[0]):
        next_pixel(state)
    return state


def look(item, config: Config, work, form, degree: int, general: int) -> tuple[list[int], int, int]:
    """Boundary values, excluded cells and candidates of the step that an item is about to take."""
    n1, count = config.n1, config.cells
    level = int(item[LEVEL])
    last = level == config.steps - 1
    first = int(item[TMIN]) >> n1 * (config.steps - 1 - level) & count - 1 if item[FOLLOW] else 0
    cells = zeros((degree << n1) + 1)
    outside = outside_faces(item, cells, form, n1) if degree == 1 else outside_cells(item, cells, n1)
    excluded = int(outside) | (1 << first) - 1
    zone = 0
    if degree == 1:
        zone = boundaries(item, work, form, n1, general)
        cells[:] = work.cells
    else:
        cells[: degree + 1] = item[B : B + degree + 1]
        subdivide(cells, degree, n1)
    if item[PAPER]:
        found = int(paper(cells, excluded, degree, count))
    elif degree == 1:
        found = int(bounded(cells, excluded, last, form, level - int(item[FIRST]), zone, n1))
    else:
        parts = [cells[j * degree : (j + 1) * degree + 1] for j in range(count)]
        mixed = [changes(part, 0, degree) if last else len({bool(v > 0) for v in part}) == 2 for part in parts]
        found = sum(1 << j for j, may in enumerate(mixed) if may) & ~excluded
    return [int(v) for v in cells[::degree]], excluded, found


def follow(surface: CompiledSurface, config: Config, x: int, y: int) -> list[Step]:
    """Every step of the ray of pixel (x, y) on a surface. Raises ValueError as :func:`pixel_of`."""
    surface = pixel_of(surface, x, y)
    width, degree, general = config.width, config.degree, 0
    if surface.is_vector_sum:
        width, degree, general = VECTOR_WIDTH, 1, int(config.vecsum == "general")
    descriptor = words(surface.words)
    form = descriptor[FORM_AT:]
    _, item, first, quads, work = scratch(config, degree)
    header(descriptor, item, first)
    sample(state_at(surface, x, y), first, quads)
    if degree == 1:
        ends(first, work.lanes, form, general)
    else:
        product(quads, is_quartic(descriptor), first, B, width, degree)
    item[FIRST], item[ROOTS] = config.steps - config.k_stop, roots_wanted(descriptor)
    found: list[Step] = []
    enter(item, first, degree)
    while True:
        while item[STATUS] == RUN:
            before = item.copy()
            values, excluded, candidates = look(item, config, work, form, degree, general)
            step(item, form, work, config.n1, config.steps, width, degree, general)
            found.append(_step(before, item, config, values, excluded, candidates, degree))
        if item[STATUS] == HIT:
            if not more(item):
                return found
            item[ROOTS] -= 1
        elif item[STATUS] == DONE:
            return found
        restart(item, first, degree)


def _step(before, item, config: Config, values, excluded: int, candidates: int, degree: int) -> Step:
    """What a step did, by the item before and after it."""
    level = int(before[LEVEL])
    picked = int(item[T] - before[T]) >> config.n1 * (config.steps - 1 - level)
    return Step(
        int(item[STEPS]),
        level,
        int(before[T]),
        [int(v) for v in before[B : B + degree + 1]],
        values,
        excluded,
        candidates,
        picked if candidates else -1,
        int(item[T]),
        int(item[TNEXT]) if item[PENDING] else -1,
        NAMES[int(item[STATUS])],
        [int(v) for v in item[B : B + degree + 1]],
        int(item[DEPTH]),
    )
