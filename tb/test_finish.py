# SPDX-License-Identifier: Apache-2.0
"""Layers to the pixel stream: the beats of a frame are the shading's pixels, whatever the receiver does."""

from collections import deque

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from entries import LAYER
from materials import FRAME_T, WRITE_T, coordinate, load, random_materials, unit
from test_shade import shaded


def pixel_layers(random, most, surfaces):
    """Layers of a pixel, or the one that stands for none."""
    count = random.randint(0, most)
    layers = [{"shade": 1, "enters": random.getrandbits(1), "surface": random.choice(surfaces),
               "point": [coordinate(random) for _ in range(3)]} for _ in range(count)]  # fmt: skip
    layers = layers or [{"shade": 0, "enters": 0, "surface": 0, "point": [0] * 3}]
    return [layer | {"first": int(not i), "last": int(i == len(layers) - 1)} for i, layer in enumerate(layers)]


@cocotb.test
@cocotb.parametrize(stall=(0.0, 0.5, 0.97))
async def equals_model(dut, stall):
    """A frame of random layers of random materials, groups of background among them."""
    random = bench.rng(stall)
    pixels, most = bench.parameter(dut, "Pixels"), bench.parameter(dut, "Layers")
    materials = random_materials(random, bench.parameter(dut, "Surfaces"))
    width, height, bank = 12 * pixels - 1, 11, random.getrandbits(1)
    frame = {"last_x": width - 1, "last_y": height - 1, "last_slot": 0, "empty": 0, "k_stop": 1, "skip": 0,
             "ambient": unit(random), "background": [unit(random) for _ in range(3)]}  # fmt: skip
    bench.Port(dut, "frame_i", FRAME_T).write(frame)
    bench.Port(dut, "material_i", WRITE_T).write(dict.fromkeys(("we", "bank", "surface", "constant", "data"), 0))
    dut.bank_i.value = bank
    dut.begin_i.value = dut.layer_valid_i.value = dut.whole_i.value = dut.m_axis_tready_i.value = 0
    await bench.start(dut)
    await load(dut, materials, "material_i")
    surfaces, layer_i = [s for b, s in materials if b == bank], bench.Port(dut, "layer_i", LAYER)

    def color(layers):
        made = [layer | {"words": materials[bank, layer["surface"]] if layer["shade"] else None} for layer in layers]
        return shaded(made, materials, frame["ambient"], frame["background"], bench.parameter(dut, "D"))

    groups, expected = [], []
    for _ in range(height * 12):
        if random.random() < 0.3:
            one = [layer for layer in pixel_layers(random, 0, surfaces)]
            groups.append([(layer, 1) for layer in one])
            colors = [color(one)] * pixels
        else:
            each = [pixel_layers(random, most, surfaces) for _ in range(pixels)]
            groups.append([(layer, 0) for layers in each for layer in layers])
            colors = [color(layers) for layers in each]
        expected.append(sum(c << 24 * p for p, c in enumerate(colors)))
    left, wanted, now, ends = deque(groups), deque(expected), deque(), 0
    for clock in range(60000):
        if not wanted:
            break
        ready = random.random() >= stall
        dut.m_axis_tready_i.value = int(ready)
        valid = bool(now)
        if valid:
            layer, whole = now.popleft()
            layer_i.write(layer)
            dut.whole_i.value = whole
        dut.layer_valid_i.value = int(valid)
        begin = bool(left) and not now and bool(dut.room_o.value)
        dut.begin_i.value = int(begin)
        if begin:
            now.extend(left.popleft())
        await ReadOnly()
        taken = ready and bool(dut.m_axis_tvalid_o.value)
        assert bool(dut.stalled_o.value) == (bool(dut.m_axis_tvalid_o.value) and not ready)
        if taken:
            word, number = wanted.popleft(), len(expected) - len(wanted) - 1
            got = int(dut.m_axis_tdata_o.value)
            assert got == word, f"beat {number} of clock {clock}: expected {word:x}, got {got:x}"
            assert bool(dut.m_axis_tuser_o.value) == (number == 0)
            line_end = number % 12 == 11
            assert bool(dut.m_axis_tlast_o.value) == line_end
            assert int(dut.m_axis_tkeep_o.value) == (1 << 3 * (pixels - line_end)) - 1
        ends += int(dut.finish_o.value)
        assert bool(dut.finish_o.value) == (taken and not wanted), "finish_o"
        await FallingEdge(dut.clk_i)
    assert not wanted and ends == 1, f"{len(wanted)} beats did not come"


@pytest.mark.parametrize("parameters", [dict(D=2, Surfaces=3, Layers=3, Pixels=2)], ids=bench.label)
def test_finish(parameters):
    """Quadrics, two pixels in a beat."""
    bench.run(__name__, "rdx_finish", parameters)
