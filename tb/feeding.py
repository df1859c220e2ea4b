# SPDX-License-Identifier: Apache-2.0
"""Rows of surfaces, as rdx_feed makes them and rdx_scan takes them."""

import bench
from raydix.fdiff import DXX, ROW_SLOPE, ROW_VALUE, ROWS, next_row
from raydix.formats import COORD_LANES, FORM_WORDS, HEADER_WORDS
from raydix.kernel import words, zeros
from raydix.raster import LANES, is_quartic, is_vector_sum, load_lanes, rectangle

HEADER, LANE, FORM = range(3)  # kinds of words
WORD = bench.Struct(("kind", 2), ("last", 1), ("lane", 4), ("index", 7), ("word", 64))
MARK = 3  # index of a word that only says that the row is complete
MASK = (1 << 64) - 1


def lanes_of(w):
    """Lanes that a descriptor carries."""
    return COORD_LANES if is_vector_sum(w) else LANES if is_quartic(w) else COORD_LANES + 3


def row(descriptor, y, form):
    """Words of row ``y`` as fields of :data:`WORD`, a word that does not matter None; ``form``: constants, too."""
    w = words(descriptor)
    state = zeros(ROWS * LANES).reshape(ROWS, LANES)
    load_lanes(state, w)
    for _ in range(y - rectangle(w)[1]):
        next_row(state)
    out = [(HEADER, 0, i, w[i]) for i in range(HEADER_WORDS)]
    out[1] = (HEADER, 0, 1, w[1] & ~(0xFFF << 16) | y << 16)
    for lane in range(lanes_of(w)):
        out += [(LANE, lane, 0, state[ROW_VALUE, lane]), (LANE, lane, 1, state[ROW_SLOPE, lane])]
        if lane >= COORD_LANES:
            out.append((LANE, lane, 2, state[DXX, lane]))
    if form:
        out += [(FORM, 0, i, word) for i, word in enumerate(descriptor[-FORM_WORDS:])]
    else:
        out.append((LANE, lanes_of(w) - 1, MARK, None))
    return [
        {"kind": kind, "last": int(number == len(out) - 1), "lane": lane, "index": index,
         "word": None if word is None else int(word) & MASK}
        for number, (kind, lane, index, word) in enumerate(out)
    ]  # fmt: skip
