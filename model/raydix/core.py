# SPDX-License-Identifier: Apache-2.0
"""Descriptor in, hits out: raster, product or ends, and ring together (mirrors ``rtl/rdx_core.sv``)."""

from functools import lru_cache

from .config import Config
from .ends import ends
from .fdiff import ROWS, next_pixel, next_row
from .formats import COORD_LANES, HEADER_WORDS
from .item import ROOTS, SIZE, STEPS, B
from .kernel import kernel, zeros
from .product import product
from .raster import LANES, header, is_quartic, load_lanes, rectangle, roots_wanted, sample
from .ring import trace
from .step import new_work

FORM_AT = HEADER_WORDS + 3 * COORD_LANES  # constants of a vector-sum surface in its descriptor


@lru_cache
def renderer(n1, steps, width, degree, general):
    """The kernel ``render_rows`` for one set of parameters, which are constants in it.

    degree   of the control points; 1: vector sums, whose evaluator is the one for every form if ``general``
    """

    @kernel
    def render_rows(words, row_begin, row_end, state, item, first, quads, work, t, depth, point, enters, counts):
        """Trace rows ``row_begin`` to ``row_end - 1`` of the rectangle of the surface descriptor ``words``.

        state … work   scratch, see :func:`scratch`
        t, depth    (rows*columns*roots) of the whole rectangle; a pixel's roots follow each other. t is -1 on entry
        point       (rows*columns*roots, 3), s2p30
        enters      (rows*columns*roots), 1 where the indicator is positive before the hit
        counts      (rows*columns), steps
        """
        x0, _, x1, _ = rectangle(words)
        columns = x1 - x0 + 1
        roots = roots_wanted(words)
        quartic = is_quartic(words)
        form = words[FORM_AT:]
        header(words, item, first)
        load_lanes(state, words)
        for _ in range(row_begin):
            next_row(state)
        for row in range(row_begin, row_end):
            for column in range(columns):
                pixel = row * columns + column
                sample(state, first, quads)
                if degree == 1:
                    ends(first, work.lanes, form, general)
                else:
                    product(quads, quartic, first, B, width, degree)
                item[ROOTS] = roots
                trace(
                    item, first, form, work, n1, steps, width, degree, general, t, depth, point, enters, pixel * roots
                )
                counts[pixel] = item[STEPS]
                if column + 1 < columns:
                    next_pixel(state)
            if row + 1 < row_end:
                next_row(state)

    return render_rows


def scratch(config: Config, degree: int):
    """Working vectors of ``render_rows`` for a configuration and degree: state, item, first, quads, work."""
    return (
        zeros(ROWS * LANES).reshape(ROWS, LANES),
        zeros(SIZE),
        zeros(SIZE),
        zeros(9),
        new_work(config.n1, degree, config.vector_drop),
    )
