# SPDX-License-Identifier: Apache-2.0
"""The pixels of a surface's screen rectangle and what each item starts with (mirrors ``rtl/rdx_raster.sv``).

A surface descriptor is a vector of 64-bit words (docs/number-formats.md, "Surface descriptor").
"""

from .fdiff import VALUE, load
from .formats import (
    BOX_WIDTH,
    COORD_ACC_WIDTH,
    COORD_LANES,
    COORD_WIDTH,
    DEPTH_WIDTH,
    HEADER_WORDS,
    PIXEL_WIDTH,
    ROOTS_WIDTH,
    SURFACE_WIDTH,
)
from .item import BOX, DEPTH, PAPER, C
from .kernel import kernel

LANES = COORD_LANES + 9
ROOTS_AT = SURFACE_WIDTH
PAPER_AT = ROOTS_AT + ROOTS_WIDTH
QUARTIC_AT = PAPER_AT + 1
BOX_AT = QUARTIC_AT + 1
VECTOR_AT = BOX_AT + 3 * BOX_WIDTH
OPAQUE_AT = VECTOR_AT + 1


@kernel
def field(word, at, width):
    """Bits ``at`` to ``at+width-1`` of a descriptor word."""
    return (word >> at) & ((1 << width) - 1)


@kernel
def rectangle(words):
    """First column, first row, last column, last row of the surface."""
    rect = words[1]
    return (
        field(rect, 0, PIXEL_WIDTH),
        field(rect, 16, PIXEL_WIDTH),
        field(rect, 32, PIXEL_WIDTH),
        field(rect, 48, PIXEL_WIDTH),
    )


@kernel
def is_quartic(words):
    """The descriptor carries Q1 and Q2 as well."""
    return field(words[0], QUARTIC_AT, 1) == 1


@kernel
def is_vector_sum(words):
    """The descriptor is that of a vector-sum surface: constants follow the coordinate lanes."""
    return field(words[0], VECTOR_AT, 1) == 1


@kernel
def header(words, item, first):
    """What all items of the surface share: rule, roots wanted, box exponents, depth of the near and far plane."""
    item[PAPER] = field(words[0], PAPER_AT, 1)
    for axis in range(3):
        item[BOX + axis] = field(words[0], BOX_AT + axis * BOX_WIDTH, BOX_WIDTH)
    first[DEPTH] = field(words[2], 0, DEPTH_WIDTH)
    first[DEPTH + 1] = field(words[2], DEPTH_WIDTH, DEPTH_WIDTH)


@kernel
def roots_wanted(words):
    """Roots to be found on a ray, 1 to 4."""
    return field(words[0], ROOTS_AT, ROOTS_WIDTH)


@kernel
def load_lanes(state, words):
    """All lanes at the first pixel of the rectangle."""
    word = HEADER_WORDS
    lanes = LANES if is_quartic(words) else COORD_LANES + 3
    if is_vector_sum(words):
        lanes = COORD_LANES
    for lane in range(lanes):
        quadratic = lane >= COORD_LANES
        load(state, lane, words, word, quadratic)
        word += 6 if quadratic else 3


@kernel
def sample(state, first, quads):
    """At the current pixel: ends h and e into ``first`` (s2p46 to s2p30, floor), accumulators into ``quads``."""
    for axis in range(3):
        for end in range(2):
            value = state[VALUE, axis * 2 + end]
            first[C + end * 3 + axis] = value >> (COORD_ACC_WIDTH - COORD_WIDTH)
    for i in range(9):
        quads[i] = state[VALUE, COORD_LANES + i]
