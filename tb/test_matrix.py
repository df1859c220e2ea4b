# SPDX-License-Identifier: Apache-2.0
"""Matrix of the material times a vector: RTL equals exact integers, both kinds of matrix, every bank and surface."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from materials import MATERIAL_T, chosen, load, normal, random_materials, words_of

CONSTANTS, LATENCY = 2, 3


def rows(words, index, symmetric):
    """The matrix by rows."""
    w = [int(v) for v in words[index : index + 9]]
    if symmetric:
        return [w[0], w[3], w[5]], [w[3], w[1], w[4]], [w[5], w[4], w[2]]
    return w[:3], w[3:6], w[6:9]


@cocotb.test
async def equals_integers(dut):
    """A product a clock; the vector comes two clocks after its material, the product three after the vector."""
    random = bench.rng()
    surfaces, index, symmetric = (bench.parameter(dut, name) for name in ("Surfaces", "Index", "Symmetric"))
    materials = random_materials(random, surfaces)
    asked, vector = bench.Port(dut, "material_i", MATERIAL_T), bench.Port(dut, "vector_i")
    product = bench.Port(dut, "product_o")
    await bench.start(dut)
    await load(dut, materials)
    items = [(chosen(random, materials), [normal(random) for _ in range(3)]) for _ in range(1500)]
    checked = 0
    for clock in range(len(items) + CONSTANTS + LATENCY):
        if clock < len(items):
            asked.write(items[clock][0])
        if 0 <= clock - CONSTANTS < len(items):
            vector.write(items[clock - CONSTANTS][1])
        number = clock - CONSTANTS - LATENCY
        if number >= 0:
            await ReadOnly()
            material, v = items[number]
            exact = [sum(a * b for a, b in zip(row, v, strict=True))
                     for row in rows(words_of(materials, material), index, symmetric)]  # fmt: skip
            if lines := product.differences(product.words(exact), product.read()):
                raise bench.mismatch(number, {"material": material, "vector": v}, lines)
            checked += 1
        await FallingEdge(dut.clk_i)
    assert checked == len(items)


SETS = [dict(Surfaces=1, Index=14, Symmetric=1), dict(Surfaces=64, Index=0, Symmetric=0)]


@pytest.mark.parametrize("parameters", SETS, ids=bench.label)
def test_matrix(parameters):
    """A quadric's matrix and the light's."""
    bench.run(__name__, "rdx_matrix", parameters)
