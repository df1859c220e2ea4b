# SPDX-License-Identifier: Apache-2.0
"""Blending: RTL equals the model in every bit, with and without gaps; the model is near exact fractions."""

from fractions import Fraction

import cocotb
import numpy as np
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from materials import ONE, unit
from raydix.blend import add_layer, finish, times
from raydix.formats import UNIT_FRAC
from raydix.kernel import words, zeros

LATENCY = 8


def model(layers, background):
    """Linear colour of a pixel by the golden model; layers are pairs of opacity and colour."""
    total, through = zeros(3), ONE
    for opacity, color in layers:
        through = add_layer(total, through, words(color), opacity)
    finish(total, through, words(background))
    return [int(v) for v in total]


def pixels(random, most, count):
    """Random pixels of one layer to ``most``."""
    for _ in range(count):
        yield [(unit(random), [unit(random) for _ in range(3)]) for _ in range(random.randint(1, most))]


async def equal(dut, idle):
    """Send pixels before each of several backgrounds."""
    random = bench.rng(idle)
    dut.valid_i.value = 0
    await bench.start(dut)
    some = [[unit(random) for _ in range(3)] for _ in range(2)]
    for background in ([ONE - 1] * 3, [0] * 3, [ONE] * 3, [0, ONE, ONE - 1], *some):
        bench.Port(dut, "background_i").write(background)
        await before(dut, background, random, idle)


async def before(dut, background, random, idle):
    """Send pixels; valid_o comes eight clocks after a pixel's last layer, never else, with the model's colour."""
    most = bench.parameter(dut, "Layers")
    color, linear = bench.Port(dut, "color_i"), bench.Port(dut, "linear_o")
    clocks, done = [], []
    for layers in pixels(random, most, 200):
        for number, layer in enumerate(layers):
            while random.random() < idle:
                clocks.append(None)
                done.append(None)
            clocks.append((number == 0, number == len(layers) - 1, *layer))
            done.append(model(layers, background) if number == len(layers) - 1 else None)
    for clock in range(len(clocks) + LATENCY):
        item = clocks[clock] if clock < len(clocks) else None
        dut.valid_i.value = item is not None
        if item:
            first, last, opacity, shade = item
            dut.first_i.value, dut.last_i.value, dut.opacity_i.value = int(first), int(last), opacity
            color.write(shade)
        if not item or most == 1:  # a single layer is both, whatever the ports say
            bench.unknown(dut, random, "first_i", "last_i")
        if not item or not opacity:
            bench.unknown(dut, random, "color_i")
        if not item:
            bench.unknown(dut, random, "opacity_i")
        await ReadOnly()
        expected = done[clock - LATENCY] if clock >= LATENCY else None
        assert bool(dut.valid_o.value) == (expected is not None), f"clock {clock}"
        if expected and (lines := linear.differences(linear.words(expected), linear.read())):
            raise bench.mismatch(clock, {"background": background}, lines)
        await FallingEdge(dut.clk_i)


@cocotb.test
async def one_a_clock(dut):
    """Layers follow each other without a gap."""
    await equal(dut, 0.0)


@cocotb.test
async def with_gaps(dut):
    """Clocks without a layer, between pixels and within them, change nothing, whatever stands at the other ports."""
    await equal(dut, 0.5)


@cocotb.test
async def reset_forgets(dut):
    """Of the layers under way at a reset none is told."""
    dut.valid_i.value = 0
    await bench.start(dut)
    dut.valid_i.value = dut.first_i.value = dut.last_i.value = 1
    dut.opacity_i.value = ONE
    for _ in range(LATENCY + 3):
        await FallingEdge(dut.clk_i)
    assert dut.valid_o.value == 1
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value, dut.valid_i.value = 1, 0
    for clock in range(LATENCY + 1):
        assert dut.valid_o.value == 0, f"{clock} clocks after the reset"
        await FallingEdge(dut.clk_i)


@pytest.mark.parametrize("parameters", [dict(Layers=1), dict(Layers=4), dict(Layers=8)], ids=bench.label)
def test_blend(parameters):
    """One layer alone, and several."""
    bench.run(__name__, "rdx_blend", parameters)


def test_error():
    """n layers are within 2 n + 1 ulp of the exact sum, and never above 1; more than one ulp is needed."""
    import random

    stream, worst = random.Random(3), 0.0
    for layers in pixels(stream, 8, 5000):
        background = [unit(stream) for _ in range(3)]
        total, through = [Fraction(0)] * 3, Fraction(1)
        for opacity, color in layers:
            a = Fraction(opacity, ONE)
            total = [s + through * a * Fraction(c, ONE) for s, c in zip(total, color, strict=True)]
            through *= 1 - a
        exact = [(s + through * Fraction(b, ONE)) * ONE for s, b in zip(total, background, strict=True)]
        got = model(layers, background)
        off = max(abs(float(g - e)) for g, e in zip(got, exact, strict=True))
        assert off <= 2 * len(layers) + 1 and max(got) <= ONE
        worst = max(worst, off)
    assert worst > 1


def test_part_and_rest():
    """Part and what is let through are T at most, for every opacity, so no sum needs a cut; and T - 1 at least."""
    opacity, product = np.arange(ONE + 1), getattr(times, "py_func", times)
    for through in (0, 1, 2, 3, ONE // 2, ONE - 1, ONE, *range(5, ONE, 1031)):
        both = product(through, opacity) + (through * (ONE - opacity) >> UNIT_FRAC)
        assert both.max() == through and both.min() >= through - 1
