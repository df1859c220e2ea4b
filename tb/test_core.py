# SPDX-License-Identifier: Apache-2.0
"""The intersection core: descriptors of small scenes in, the golden model's hits out, whatever the ports do."""

import cocotb
from cocotb.triggers import FallingEdge, with_timeout

import bench
import spirals
import streams
import streams_extra
from raydix.compile import compile_scene, descriptor_array
from raydix.config import RULES, Config
from raydix.golden import trace_golden
from raydix.rtl import parameters

CONFIG = Config(n1=2, steps=6, width=36, degree=4, units=2, rules="both", vecsum="general", lanes=2)
NAMES = ("surface", "x", "y", "hit", "last", "t", "depth", "point", "enters", "steps")
SIGNED = ("depth", "point")
SILENCE = 4000  # clocks without a record; the longest of a frame that is not stuck are about 900


def compiled_frame(scene, rule="certified"):
    """Words of a scene of ``scenes/`` or ``tb/scenes/`` in 16 x 12 pixels."""
    return compile_scene(spirals.load(scene, 16, 12), CONFIG.with_(rule=rule))


def record(words):
    """One record as a dictionary; ``point`` is a list of three."""
    words = [bench.signed(w, 32) if i in (6, 7, 8, 9) else w for i, w in enumerate(words)]
    return dict(zip(NAMES, [*words[:7], words[7:10], *words[10:]], strict=True))


def compare(frame, received):
    """The records of each ray are the golden model's hits in order, then its end; nothing else comes."""
    by_ray = {}
    for r in received:
        by_ray.setdefault((r["surface"], r["x"], r["y"]), []).append(r)
    for hits in frame.surfaces:
        x0, y0, *_ = hits.surface.rect
        rows, columns, roots = hits.t.shape
        for row in range(rows):
            for column in range(columns):
                key = hits.surface.index, x0 + column, y0 + row
                got = by_ray.pop(key, [])
                at = row, column
                wanted = [
                    (
                        int(hits.t[*at, i]),
                        int(hits.depth[*at, i]),
                        hits.point[*at, i].tolist(),
                        int(hits.enters[*at, i]),
                    )
                    for i in range(roots)
                    if hits.t[*at, i] >= 0
                ]
                found = [(r["t"], r["depth"], r["point"], r["enters"]) for r in got if r["hit"]]
                lines = []
                if found != wanted:
                    lines.append(f"hits (t, depth, point, enters): expected {wanted}, got {found}")
                if [r["last"] for r in got] != [0] * (len(got) - 1) + [1]:
                    lines.append(f"last record: {got}")
                elif got[-1]["steps"] != hits.steps[at]:
                    lines.append(f"steps: expected {hits.steps[at]}, got {got[-1]['steps']}")
                if lines:
                    raise bench.mismatch(key, {"words": list(hits.surface.words)}, lines)
    assert not by_ray, f"records of rays that there are not: {by_ray}"


async def render(dut, random, frame, idle, stall):
    """Feed the frame's descriptors, take records until every ray has left its last one; the records."""
    rays = sum(hits.steps.size for hits in frame.surfaces)
    words = descriptor_array(frame.compiled).tolist()
    sink = streams_extra.sink(dut, random, stall, "hit_", {f"hit_{name}_o": None for name in NAMES})
    task = cocotb.start_soon(sink.take())
    cocotb.start_soon(streams.source(dut, words, random, idle, "desc_", "desc_data_i"))
    last = NAMES.index("last")

    async def finished():
        done, quiet = False, 0
        while not done or quiet < 200:  # then nothing more may come
            before = len(sink.received)
            await FallingEdge(dut.clk_i)
            ended = sum(words[last] for words in sink.received)
            assert ended <= rays, f"{ended} rays have ended, {rays} were sent"
            done = ended == rays
            quiet = quiet + 1 if len(sink.received) == before else 0
            assert quiet < SILENCE, f"no record for {quiet} clocks, {len(sink.received)} before"

    await with_timeout(cocotb.start_soon(finished()), 10 * (5000 + 100 * rays), "ns")
    task.cancel()
    received = [record(words) for words in sink.received]
    compare(frame, received)
    return received


@cocotb.test
@cocotb.parametrize(scene=("torus", "gallery", "glass", spirals.MIXED), rule=RULES)
async def equals_golden(dut, scene, rule):
    """All records of a frame are the golden model's arrays, with stalls at both ports."""
    random = bench.rng(f"{scene} {rule}")
    dut.desc_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    frame = trace_golden(compiled_frame(scene, rule), CONFIG.with_(rule=rule))
    assert frame.counts()["hits"] > 10
    if scene == spirals.MIXED:  # every surface is seen, behind each other the constants of three spirals are loaded
        assert [hits.surface.is_vector_sum for hits in frame.surfaces] == [True, False, True, True]
        assert all((hits.t >= 0).any() for hits in frame.surfaces)
    order = [r["surface"] for r in await render(dut, random, frame, 0.3, 0.5 if scene == "glass" else 0.2)]
    if scene == spirals.MIXED:  # both rings give records at the same time
        assert order.index(1) < len(order) - order[::-1].index(0)


@cocotb.test
async def without_stalls(dut):
    """The same with ports that are always ready, frames behind each other."""
    random = bench.rng()
    dut.desc_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    for scene in ("torus", spirals.MIXED, "glass"):
        await render(dut, random, trace_golden(compiled_frame(scene), CONFIG), 0.0, 0.0)


def test_core():
    """Quartics, quadrics and spirals, boxes, one root and all, both rules."""
    bench.run(__name__, "rdx_core", parameters(CONFIG))
