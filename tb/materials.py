# SPDX-License-Identifier: Apache-2.0
"""Materials for the tests of the shading: their writing, random words, words of scenes."""

from cocotb.triggers import FallingEdge

import bench
from raydix import kernel
from raydix.formats import (
    COORD_WIDTH,
    MATERIAL,
    MATERIAL_INDEX,
    MATERIAL_WORDS,
    NORMAL_WIDTH,
    PIXEL_WIDTH,
    SURFACE_WIDTH,
    UNIT_FRAC,
)

ONE = 1 << UNIT_FRAC
MATERIAL_T = bench.Struct(("bank", 1), ("surface", SURFACE_WIDTH))
WRITE_T = bench.Struct(("we", 1), ("bank", 1), ("surface", SURFACE_WIDTH), ("constant", 6), ("data", 32))
SKIP_T = bench.Struct(*((name, 1) for name in ("early", "depth", "rootless", "boxes", "rectangle")))
FRAME_T = bench.Struct(
    ("last_x", PIXEL_WIDTH), ("last_y", PIXEL_WIDTH), ("last_slot", SURFACE_WIDTH), ("empty", 1), ("k_stop", 6),
    ("skip", SKIP_T.width), ("ambient", UNIT_FRAC + 1), ("background", UNIT_FRAC + 1, 3),
)  # fmt: skip
AFTER = 3  # clocks after which a written word is read


def unit(random):
    """A number from 0 to 1, u1p16; often one of its ends."""
    return random.choice((0, 1, ONE - 1, ONE, *(random.randint(0, ONE) for _ in range(4))))


def normal(random):
    """A number of 18 bits of any magnitude; often one of its ends."""
    bits = random.randint(1, NORMAL_WIDTH)
    return random.choice((bench.low(NORMAL_WIDTH), bench.high(NORMAL_WIDTH), 0, -1,
                          *(bench.signed(random.getrandbits(bits), bits) for _ in range(6))))  # fmt: skip


def coordinate(random):
    """A word of a point of any magnitude; often where it rounds up or saturates."""
    bits = random.randint(COORD_WIDTH // 2, COORD_WIDTH)
    high = bench.high(COORD_WIDTH)
    return random.choice((bench.low(COORD_WIDTH), high, high - (1 << 13), high - (1 << 13) + 1, 0, 1 << 13, -(1 << 13),
                          *(bench.signed(random.getrandbits(bits), bits) for _ in range(9))))  # fmt: skip


def random_material(random):
    """Any words of the right width; of an algebraic surface."""
    words = [0] * MATERIAL_WORDS
    for field in MATERIAL:
        for i in range(field.count):
            value = normal(random) if field.token == "s1p17" else unit(random)
            words[MATERIAL_INDEX[field.name] + i] = 0 if field.name == "vector" else value
    return words


def write_of(bank, surface, constant, data):
    """Fields of a write."""
    return {"we": 1, "bank": bank, "surface": surface, "constant": constant, "data": data}


async def load(dut, materials, port="write_i"):
    """Write the materials, (bank, surface) -> words, by a port of WRITE_T, and wait until they can be read."""
    port = bench.Port(dut, port, WRITE_T)
    for (bank, surface), words in materials.items():
        for constant, data in enumerate(words):
            port.write(write_of(bank, surface, constant, data))
            await FallingEdge(dut.clk_i)
    port.write(write_of(0, 0, 0, 0) | {"we": 0})
    for _ in range(AFTER):
        await FallingEdge(dut.clk_i)


def random_materials(random, surfaces):
    """Materials of some surfaces in both banks: the first, the last, and others."""
    numbers = {0, surfaces - 1, *(random.randrange(surfaces) for _ in range(4))}
    return {(bank, surface): random_material(random) for bank in (0, 1) for surface in sorted(numbers)}


def chosen(random, materials):
    """One of the materials, as fields."""
    bank, surface = random.choice(list(materials))
    return {"bank": bank, "surface": surface}


def words_of(materials, material):
    """The words of a material given as fields."""
    return kernel.words(materials[material["bank"], material["surface"]])
