# SPDX-License-Identifier: Apache-2.0
"""Forward differences: polynomials of the pixel with two additions a pixel (mirrors ``rtl/rdx_fdiff.sv``).

The state of all lanes is a matrix of ROWS by lanes; a linear lane has second differences of zero.
"""

from .kernel import kernel

# rows of the state: value and x-difference at the pixel, the same at the row's first pixel with the
# y-difference there, and the three second differences
VALUE, SLOPE, ROW_VALUE, ROW_SLOPE, ROW_RISE, DXX, DXY, DYY = range(8)
ROWS = 8


@kernel
def load(state, lane, words, word, quadratic):
    """Lane at the rectangle's first pixel: value, dx, dy, if ``quadratic`` dxx, dxy, dyy, from ``words[word]`` on."""
    state[VALUE, lane] = words[word]
    state[ROW_VALUE, lane] = words[word]
    state[SLOPE, lane] = words[word + 1]
    state[ROW_SLOPE, lane] = words[word + 1]
    state[ROW_RISE, lane] = words[word + 2]
    for i in range(3):
        state[DXX + i, lane] = words[word + 3 + i] if quadratic else 0


@kernel
def next_pixel(state):
    """All lanes one pixel to the right."""
    for lane in range(state.shape[1]):
        state[VALUE, lane] += state[SLOPE, lane]
        state[SLOPE, lane] += state[DXX, lane]


@kernel
def next_row(state):
    """All lanes to the first pixel of the next row."""
    for lane in range(state.shape[1]):
        state[ROW_VALUE, lane] += state[ROW_RISE, lane]
        state[ROW_SLOPE, lane] += state[DXY, lane]
        state[ROW_RISE, lane] += state[DYY, lane]
        state[VALUE, lane] = state[ROW_VALUE, lane]
        state[SLOPE, lane] = state[ROW_SLOPE, lane]
