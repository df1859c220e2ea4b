# SPDX-License-Identifier: Apache-2.0
"""Forward differences: RTL equals the model in every bit; the model equals the exact polynomial at every pixel."""

from fractions import Fraction

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from raydix.fdiff import ROWS, VALUE, load, next_pixel, next_row
from raydix.kernel import zeros

CORNERS = (0, 1, -1)


def model_at(words, quadratic):
    """State of one lane of the model at the rectangle's first pixel."""
    state = zeros(ROWS).reshape(ROWS, 1)
    load(state, 0, words, 0, quadratic)
    return state


def exact(words, x, y):
    """c00 + c10 x + c01 y + c20 x² + c11 xy + c02 y², its coefficients from value, dx, dy, dxx, dxy, dyy."""
    value, dx, dy, dxx, dxy, dyy = words
    c20, c02 = Fraction(dxx, 2), Fraction(dyy, 2)
    c10, c01 = dx - c20, dy - c02
    return value + c10 * x + c01 * y + c20 * x * x + dxy * x * y + c02 * y * y


def random_words(random, width, quadratic):
    """Six words of a lane: of the whole width, few bits, or corners; no second differences in a linear lane."""
    words = []
    for i in range(6):
        bits = random.choice((width, width, random.randint(1, width)))
        corners = (*CORNERS, bench.low(width), bench.high(width))
        word = random.choice((*corners, *[bench.signed(random.getrandbits(bits), bits)] * 8))
        words.append(word if i < 3 or quadratic else 0)
    return words


async def give(dut, **inputs):
    """One clock with these inputs; whatever is not named is 0."""
    for name in ("load_i", "pixel_i", "row_i", "index_i", "word_i"):
        getattr(dut, name).value = inputs.get(name, 0)
    await FallingEdge(dut.clk_i)


async def load_lane(dut, random, words, quadratic, idle):
    """The lane's words in order; the bits above W and index and word of idle clocks are noise."""
    width = bench.parameter(dut, "W")
    for index, word in enumerate(words if quadratic else words[:3]):
        while random.random() < idle:
            await give(dut, index_i=random.randrange(8), word_i=random.getrandbits(64))
        noise = random.getrandbits(64) << width
        await give(dut, load_i=1, index_i=index, word_i=(noise | word & ((1 << width) - 1)) & ((1 << 64) - 1))


def check(dut, item, where, words, state):
    """RTL against the model, and the model against the exact polynomial; the RTL wraps, the model counts on."""
    width = bench.parameter(dut, "W")
    got, wanted = bench.signed(int(dut.value_o.value), width), state[VALUE, 0]
    lines = []
    if got != bench.signed(wanted, width):
        lines.append(f"value_o at {where}: expected {bench.signed(wanted, width):#x}, got {got:#x}")
    if wanted != exact(words, *where):
        lines.append(f"model at {where}: {wanted}, exact {exact(words, *where)}")
    if lines:
        raise bench.mismatch(item, {"words": words}, lines)


@cocotb.test
async def equals_model(dut):
    """Random walks of pixels and rows, lane after lane, with and without idle clocks in between."""
    await bench.start(dut)
    random = bench.rng()
    width, quadratic = bench.parameter(dut, "W"), bool(bench.parameter(dut, "Quadratic"))
    for item in range(120):
        idle = random.choice((0.0, 0.3))
        words = random_words(random, width, quadratic)
        await load_lane(dut, random, words, quadratic, idle)
        state = model_at(words, quadratic)
        x = y = 0
        check(dut, item, (x, y), words, state)
        for _ in range(random.choice((3, 40))):
            if random.random() < idle:
                await give(dut, index_i=random.randrange(8), word_i=random.getrandbits(64))
            elif random.random() < 0.2:
                # the raster gives pixel_i in the same clock: the row wins
                await give(dut, row_i=1, pixel_i=random.getrandbits(1))
                next_row(state)
                x, y = 0, y + 1
            else:
                await give(dut, pixel_i=1)
                next_pixel(state)
                x += 1
            check(dut, item, (x, y), words, state)


@cocotb.test
async def long_rows(dut):
    """The widest and the tallest rectangle: 4096 pixels in one row, then 4096 rows."""
    await bench.start(dut)
    random = bench.rng()
    width, quadratic = bench.parameter(dut, "W"), bool(bench.parameter(dut, "Quadratic"))
    words = random_words(random, width, quadratic)
    await load_lane(dut, random, words, quadratic, 0)
    state = model_at(words, quadratic)
    for x in range(1, 4096):
        await give(dut, pixel_i=1)
        next_pixel(state)
        if x % 64 == 63:
            check(dut, 0, (x, 0), words, state)
    for y in range(1, 4096):
        await give(dut, row_i=1, pixel_i=1)
        next_row(state)
        if y % 64 == 63:
            check(dut, 0, (0, y), words, state)


CASES = [dict(W=48, Quadratic=0), dict(W=64, Quadratic=1), dict(W=6, Quadratic=1)]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_lane(parameters):
    """Linear and quadratic lanes, in the widths of the raster and in one where everything wraps."""
    bench.run(__name__, "rdx_fdiff", parameters)
