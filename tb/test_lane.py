# SPDX-License-Identifier: Apache-2.0
"""Forward differences along rows: every pixel equals the model in every bit, while the next row is loaded."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from raydix.fdiff import ROWS, VALUE, load, next_pixel
from raydix.kernel import zeros

INPUTS = ("load_i", "index_i", "word_i", "start_i", "step_i")


def random_row(random, width, quadratic):
    """Value, difference and second difference of a row: of the whole width, few bits, or corners."""
    row = []
    for _ in range(3):
        size = random.choice((width, width, random.randint(1, width)))
        corners = (0, 1, -1, bench.low(width), bench.high(width))
        row.append(random.choice((*corners, *[bench.signed(random.getrandbits(size), size)] * 8)))
    return row if quadratic else [*row[:2], 0]


def model_at(row):
    """The model's state at the row's first pixel."""
    state = zeros(ROWS).reshape(ROWS, 1)
    load(state, 0, [row[0], row[1], 0, row[2], 0, 0], 0, True)
    return state


async def give(dut, **inputs):
    """One clock with these inputs; whatever is not named is 0."""
    for name in INPUTS:
        getattr(dut, name).value = inputs.get(name, 0)
    await FallingEdge(dut.clk_i)


def check(dut, item, x, row, state):
    """The pixel's value; the RTL wraps, the model counts on."""
    width = bench.parameter(dut, "W")
    got, wanted = bench.signed(int(dut.value_o.value), width), bench.signed(state[VALUE, 0], width)
    if got != wanted:
        raise bench.mismatch(item, {"row": row}, [f"value_o at {x}: expected {wanted:#x}, got {got:#x}"])


@cocotb.test
async def equals_model(dut):
    """Rows behind each other; the next one's words come in any order while this one is walked, above W is noise."""
    await bench.start(dut)
    random = bench.rng()
    width, quadratic = bench.parameter(dut, "W"), bool(bench.parameter(dut, "Quadratic"))
    row, state, x = None, None, 0
    for item in range(300):
        idle = random.choice((0.0, 0.3))
        following = random_row(random, width, quadratic)
        # pixels of this row: fewer clocks than words, as many, more
        waiting = random.sample(range(3), 3)
        steps = random.choice((0, 1, 2, 3, 3, 30)) if row else 0
        while waiting or steps:
            inputs = {"index_i": random.randrange(4), "word_i": random.getrandbits(64)}
            if waiting and random.random() >= idle:
                index = waiting.pop()
                noise = random.getrandbits(64) << width
                word = (noise | following[index] & ((1 << width) - 1)) & ((1 << 64) - 1)
                inputs |= {"load_i": 1, "index_i": index, "word_i": word}
            if steps and random.random() >= idle:
                inputs["step_i"] = 1
                next_pixel(state)
                steps -= 1
                x += 1
            await give(dut, **inputs)
            if row:
                check(dut, item, x, row, state)
        # a start goes before a step; nothing is loaded in this clock
        await give(dut, start_i=1, step_i=random.getrandbits(1), word_i=random.getrandbits(64))
        row, state, x = following, model_at(following), 0
        check(dut, item, x, row, state)


@cocotb.test
async def words_stay(dut):
    """A row that is started anew without a word begins with the same words: the walk leaves the shadow alone."""
    await bench.start(dut)
    random = bench.rng()
    width, quadratic = bench.parameter(dut, "W"), bool(bench.parameter(dut, "Quadratic"))
    row = random_row(random, width, quadratic)
    for index in range(3):
        await give(dut, load_i=1, index_i=index, word_i=row[index] & ((1 << width) - 1))
    for item in range(3):
        await give(dut, start_i=1)
        state = model_at(row)
        for x in range(20):
            check(dut, item, x, row, state)
            await give(dut, step_i=1, index_i=random.randrange(4), word_i=random.getrandbits(64))
            next_pixel(state)


@cocotb.test
async def widest_row(dut):
    """4096 pixels in a row."""
    await bench.start(dut)
    random = bench.rng()
    width, quadratic = bench.parameter(dut, "W"), bool(bench.parameter(dut, "Quadratic"))
    row = random_row(random, width, quadratic)
    for index in range(3):
        await give(dut, load_i=1, index_i=index, word_i=row[index] & ((1 << width) - 1))
    await give(dut, start_i=1)
    state = model_at(row)
    for x in range(4096):
        check(dut, 0, x, row, state)
        await give(dut, step_i=1)
        next_pixel(state)


@pytest.mark.parametrize(("width", "quadratic"), [(64, 1), (48, 0), (7, 1), (7, 0), (1, 1)])
def test_lane(width, quadratic):
    """Control points, coordinates, and narrow lanes that wrap often."""
    bench.run(__name__, "rdx_lane", dict(W=width, Quadratic=quadratic))
