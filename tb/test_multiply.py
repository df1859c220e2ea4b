# SPDX-License-Identifier: Apache-2.0
"""Scaled product: RTL equals the model in every bit, and the model the exact floor."""

import cocotb
import pytest

import bench
from raydix.formats import OPERAND_WIDTH, PRODUCT_DROP
from raydix.multiply import multiply, scaled

LATENCY = 3
HALF = OPERAND_WIDTH // 2


def model(a, b, drop):
    """The whole product by the golden model; exact where less is dropped than it does."""
    return scaled(a, b, drop) if drop >= PRODUCT_DROP else (a * b) >> drop


def corners():
    """Operands made of halves about zero, about a half's own sign bit, and about its ends."""
    middle = 1 << (HALF - 1)
    halves = {0, 1, 2, middle - 1, middle, middle + 1, (1 << HALF) - 2, (1 << HALF) - 1}
    return sorted(bench.signed(a << HALF | b, OPERAND_WIDTH) for a in halves for b in halves)


def stimuli(dut):
    """Every pair of corners at the default parameters, else some; then random operands, of one or of any magnitude."""
    random, drop = bench.rng(), bench.parameter(dut, "Drop")
    pairs = [(a, b) for a in corners() for b in corners()]
    yield from pairs if drop == DEFAULT["Drop"] else random.sample(pairs, 400)
    yield from bench.vectors(random, OPERAND_WIDTH, 2, 1000)


async def equal(dut, pairs, stall=0.0):
    """RTL and model on ``pairs``, at the latency that the module documents."""
    drop = bench.parameter(dut, "Drop")
    items = ({"a_i": a, "b_i": b} for a, b in pairs)
    await bench.start(dut)
    await bench.pipeline(
        dut, items, lambda item: {"product_o": model(item["a_i"], item["b_i"], drop)}, LATENCY, stall=stall
    )


@cocotb.test
async def equals_model(dut):
    """The W bits of the product are the low ones of the model's, three clocks later."""
    await equal(dut, stimuli(dut))


@cocotb.test
async def stalls(dut):
    """Clocks without en_i do not count: nothing moves, nothing is lost."""
    await equal(dut, list(stimuli(dut))[-300:], 0.5)


@cocotb.test
async def equals_floor(dut):
    """The model is the floor of the exact quotient."""
    drop = max(bench.parameter(dut, "Drop"), PRODUCT_DROP)
    for number, (a, b) in enumerate(stimuli(dut)):
        pair = multiply(a, b), scaled(a, b, drop)
        exact = a * b // 2**PRODUCT_DROP, a * b // 2**drop
        if pair != exact:
            raise bench.mismatch(number, {"a": a, "b": b}, [f"expected {exact}, the model has {pair}"])


DEFAULT = dict(W=38, Drop=25)
SETS = [DEFAULT, dict(W=42, Drop=29), dict(W=72, Drop=0)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_product(parameters):
    """The products of tube and turn; all bits."""
    bench.run(__name__, "rdx_multiply", parameters)
