# SPDX-License-Identifier: Apache-2.0
"""Cocotb tests of the module ``tiny`` in ``test_mutants.py``: one looks at a single output, one at all."""

import cocotb

import bench


def expected(a, b):
    """Outputs of ``tiny`` for two inputs of four bits."""
    sum_, less = (a + b) % 16, a < b
    return {"sum_o": sum_, "less_o": less, "pick_o": (a & b) if less else (~a % 16), "low_o": sum_ & 1}


async def compare(dut, names):
    """Every pair of inputs; the outputs ``names``."""
    await bench.start(dut)
    items = ({"a_i": a, "b_i": b} for a in range(16) for b in range(16))
    await bench.pipeline(dut, items, lambda item: {n: expected(item["a_i"], item["b_i"])[n] for n in names}, 1)


@cocotb.test
async def strong(dut):
    """All outputs."""
    await compare(dut, ["sum_o", "less_o", "pick_o", "low_o"])


@cocotb.test
async def weak(dut):
    """One of them."""
    await compare(dut, ["sum_o"])
