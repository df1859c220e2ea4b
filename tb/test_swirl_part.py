# SPDX-License-Identifier: Apache-2.0
"""A length on the scale of the tube: RTL equals the model in every bit, at the ends of what fits, too."""

import cocotb

import bench
from raydix.formats import SWIRL_WIDTH
from raydix.swirl import part

LATENCY = 2
FIT, DROP = 1 << 17, 6


@cocotb.test
async def equals_model(dut):
    """Every scale; the last length that fits and the first that does not, of both signs; any length."""
    random = bench.rng()
    low, high = -(1 << (SWIRL_WIDTH - 1)), (1 << (SWIRL_WIDTH - 1)) - 1
    items = []
    for scale in range(8):
        edge = (FIT << DROP) >> scale
        lengths = [sign * edge + near for sign in (1, -1) for near in range(-129, 130)] + [low, high, 0, 1, -1]
        lengths += [random.randint(low, high) >> random.randrange(SWIRL_WIDTH) for _ in range(300)]
        items += [{"length_i": max(low, min(high, length)), "scale_i": scale} for length in lengths]
    random.shuffle(items)
    await bench.start(dut)
    await bench.pipeline(dut, items, lambda item: {"part_o": part(item["length_i"], item["scale_i"])}, LATENCY)


def test_part():
    """All scales."""
    bench.run(__name__, "rdx_swirl_part")
