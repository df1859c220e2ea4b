# SPDX-License-Identifier: Apache-2.0
"""Descriptors to pixels, without the registers: a small frame is the golden picture, whatever the receiver does.

What is counted adds up: each pixel of the rectangle is a ray or was skipped, and the records are the golden hits.
"""

from pathlib import Path

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from materials import FRAME_T, SKIP_T, WRITE_T, load
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.golden import trace_golden
from raydix.material import material_words
from raydix.render import compose
from raydix.rtl import top_parameters
from raydix.scene import load_scene
from raydix.shade import units
from test_count import COUNTERS

ROOT = Path(__file__).resolve().parents[1]
CONFIG = Config(n1=2, steps=6, degree=2, units=1, rules="certified", surfaces=2, layers=2, max_width=32)
WIDTH, HEIGHT = 16, 12


async def frame_of(dut, random, words, stall):
    """Start, answer the table, take the beats of a frame; the pixels, 24 bits each, in order, and the records."""
    pixels, records, asked = [], [], None
    tap = bench.Port(dut, "tap_o")
    dut.start_i.value = 1
    for clock in range(60000):
        ready = random.random() >= stall
        dut.m_axis_tready_i.value = int(ready)
        known = asked and asked[1] < len(words[asked[0]])
        dut.table_i.value = words[asked[0]][asked[1]] if known else random.getrandbits(64)
        await ReadOnly()
        assert int(dut.error_o.value) == 0, f"error {int(dut.error_o.value)}"
        assert bool(dut.ready_o.value) == (clock == 0), "ready while a frame is under way"
        if dut.tap_valid_o.value:
            records.append(bench.HIT.unpack(tap.read()[0]))
        if dut.m_axis_tvalid_o.value and ready:
            assert bool(dut.m_axis_tuser_o.value) == (not pixels)
            assert bool(dut.m_axis_tlast_o.value) == (len(pixels) % WIDTH == WIDTH - 1)
            pixels.append(int(dut.m_axis_tdata_o.value))
        done = bool(dut.done_o.value)
        assert done == (len(pixels) == WIDTH * HEIGHT)
        slot, place = (bench.Port(dut, name).read()[0] for name in ("slot_o", "place_o"))
        assert asked is None or None not in (slot, place), "once an address is known all are"
        asked = None if None in (slot, place) else (slot % len(words), place)
        await FallingEdge(dut.clk_i)
        dut.start_i.value = 0
        if done:
            return pixels, records
    raise AssertionError(f"the frame does not end; {len(pixels)} pixels")


@cocotb.test
@cocotb.parametrize(name=("scenes/sphere", "tb/scenes/pair"))
async def equals_golden_picture(dut, name):
    """A sphere, and two of glass, in 16 x 12 pixels: without skips by a stalling receiver, with all by a fast one."""
    random = bench.rng(name)
    scene = load_scene(ROOT / f"{name}.toml", WIDTH, HEIGHT)
    compiled = compile_scene(scene, CONFIG)
    traced = trace_golden(compiled, CONFIG)
    hits, rays = traced.counts()["hits"], traced.counts()["rays"]
    golden = compose(scene, traced, CONFIG, CONFIG.layers)
    frame = {"last_x": WIDTH - 1, "last_y": HEIGHT - 1, "last_slot": len(compiled.surfaces) - 1, "empty": 0,
             "k_stop": CONFIG.steps, "skip": 0, "ambient": int(units([scene.light.ambient])[0]),
             "background": [int(v) for v in units(scene.background.color)]}  # fmt: skip
    port = bench.Port(dut, "frame_i", FRAME_T)
    port.write(frame)
    bench.Port(dut, "material_i", WRITE_T).write(dict.fromkeys(("we", "bank", "surface", "constant", "data"), 0))
    dut.start_i.value = dut.abort_i.value = dut.bank_i.value = dut.m_axis_tready_i.value = 0
    await bench.start(dut)
    materials = {(0, s.index): [int(w) for w in material_words(scene, scene.surfaces[s.index], s.origin, s.unit)]
                 for s in compiled.surfaces}  # fmt: skip
    assert not dut.ready_o.value, "ready before the layers are swept"
    await load(dut, materials, "material_i")
    while not dut.ready_o.value:
        await FallingEdge(dut.clk_i)
    wanted = [int.from_bytes(rgb.tobytes(), "big") for rgb in golden.rgb.reshape(-1, 3)]
    assert len(set(wanted)) > 10
    for skips, stall in ((0, 0.4), ((1 << SKIP_T.width) - 1, 0.0)):
        port.write(frame | {"skip": skips})
        pixels, records = await frame_of(dut, random, [list(s.words) for s in compiled.surfaces], stall)
        bad = [i for i, (w, p) in enumerate(zip(wanted, pixels, strict=True)) if w != p]
        assert not bad, f"pixel {bad[0]}: expected {wanted[bad[0]]:06x}, got {pixels[bad[0]]:06x}; {len(bad)} differ"
        for _ in range(5):
            await FallingEdge(dut.clk_i)
        assert dut.ready_o.value, "ready for another frame"
        counted = COUNTERS.unpack(bench.Port(dut, "counters_o").read()[0])
        skipped = [counted[f"skipped_{name}"] for name in ("boxes", "rootless", "depth")]
        assert counted["rays"] == sum(r["last"] for r in records) == rays - sum(skipped), f"{rays}, {skipped}"
        assert counted["hits"] == sum(r["hit"] for r in records) == hits
        assert counted["visible"] + counted["layers_lost"] == hits, f"{hits} hits: {counted}"
        assert skipped[2] == 0 and (skipped[1] > 0) == bool(skips), f"boxes, rootless, depth: {skipped}"


def test_render():
    """One step unit, the certified rule, quadrics."""
    bench.run(__name__, "rdx_render", top_parameters(CONFIG))
