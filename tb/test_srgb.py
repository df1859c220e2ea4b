# SPDX-License-Identifier: Apache-2.0
"""sRGB codes: RTL equals the model for every intensity, and the model is within its bound of the exact encoding."""

import cocotb
import numpy as np

import bench
from raydix.formats import UNIT_FRAC
from raydix.srgb import srgb
from shading import encoded

LATENCY = 3
BOUND = 0.61  # codes


@cocotb.test
async def equals_model(dut):
    """The code is the model's, three clocks later, for every intensity, and 0 again."""
    await bench.start(dut)
    items = ({"linear_i": value} for value in (*range((1 << UNIT_FRAC) + 1), 0))
    await bench.pipeline(dut, items, lambda item: {"code_o": int(srgb(item["linear_i"]))}, LATENCY)


def test_srgb():
    """Exhaustive."""
    bench.run(__name__, "rdx_srgb")


def test_error():
    """At most 0.61 codes off, rising, from 0 to 255; more than 0.59 is needed."""
    values = np.arange((1 << UNIT_FRAC) + 1)
    codes = np.array([int(srgb(v)) for v in values])
    off = np.abs(codes - encoded(values / (1 << UNIT_FRAC))).max()
    assert 0.59 < off <= BOUND
    assert codes[0] == 0 and codes[-1] == 255 and (np.diff(codes) >= 0).all()
