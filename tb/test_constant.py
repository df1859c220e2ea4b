# SPDX-License-Identifier: Apache-2.0
"""One constant of the materials: what was written last is read, of each surface and bank."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from materials import MATERIAL_T, WRITE_T, write_of

LATENCY = 2


@cocotb.test
async def reads_what_was_written(dut):
    """Writes of all constants, banks and surfaces while others are read: only those of this one count."""
    random = bench.rng()
    surfaces, width, index = (bench.parameter(dut, name) for name in ("Surfaces", "W", "Index"))
    write, read, data = bench.Port(dut, "write_i", WRITE_T), bench.Port(dut, "material_i", MATERIAL_T), dut.data_o
    held, expected, checked = {}, [], 0
    places = [(bank, surface) for bank in (0, 1) for surface in range(surfaces)]
    write.write(write_of(0, 0, index, 0) | {"we": 0})
    await bench.start(dut)
    for clock in range(3000):
        place, word = random.choice(places), random.getrandbits(32)
        constant = random.choice((index, index ^ 1, random.randrange(64)))
        we = random.randrange(2)
        write.write(write_of(*place, constant, word) | {"we": we})
        asked = random.choice(places)
        changed = we and constant == index and asked == place
        expected.append(None if changed else held.get(asked))
        read.write(dict(zip(("bank", "surface"), asked, strict=True)))
        if we and constant == index:
            held[place] = word & ((1 << width) - 1)
        await FallingEdge(dut.clk_i)
        if clock >= LATENCY - 1:
            wanted = expected[clock - LATENCY + 1]
            if wanted is not None:
                checked += 1
                if int(data.value) != wanted:
                    raise bench.mismatch(clock, {"held": held}, [f"expected {wanted:#x}, got {int(data.value):#x}"])
    assert checked > 1000


SETS = [dict(Surfaces=1, W=18, Index=0), dict(Surfaces=5, W=17, Index=12), dict(Surfaces=64, W=18, Index=63)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_constant(parameters):
    """One surface, some, and all."""
    bench.run(__name__, "rdx_constant", parameters)
