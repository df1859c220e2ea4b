# SPDX-License-Identifier: Apache-2.0
"""Rows of algebraic surfaces and spirals, fed one by one: the golden model's hits, and no ray with a hit is dropped."""

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import feeding
import looks
import spirals
import test_core
import walking
from raydix.compile import compile_scene
from raydix.formats import DEPTH_WIDTH, HEADER_WORDS
from raydix.golden import trace_golden
from raydix.ring import behind
from raydix.rtl import parameters
from test_core import CONFIG, compiled_frame

FRAME = {"last_x": 0, "last_y": 0, "last_slot": 0, "empty": 0, "ambient": 0, "background": [0, 0, 0]}
FRAME |= dict.fromkeys(walking.SKIPS, 0)
HIDDEN, ROOTLESS, BEYOND = range(3)  # reasons
TURN = 400  # clocks, more than a turn of any ring here
SILENCE = 100 * TURN  # clocks without a record; no ray here takes more steps, of a turn each


async def cast(dut, random, frame, skips, share, stall, k_stop, pause):
    """Cast all rows of a frame; (records, limits, pixels without a ray: (reason, bit of the row), items that ended).

    steps_o adds up to the steps of the records, with and without vector sums; where none is built its ring is idle.
    """
    dut.frame_i.value = walking.FRAME.pack(FRAME | dict.fromkeys(skips, 1) | {"k_stop": k_stop})
    limits, load, hit = (
        looks.Limits(dut, random, share),
        bench.Port(dut, "load_i", feeding.WORD),
        bench.Port(dut, "hit_o"),
    )
    limits.depths = tuple(sorted(surface.words[2] & ((1 << DEPTH_WIDTH) - 1) for surface in frame.compiled.surfaces))
    found = [int(d) for hits in frame.surfaces for d in hits.depth[hits.t >= 0]]
    limits.depths = (0, *limits.depths, looks.FAR, *random.choices(found, k=12))
    records, without, words, formed, ended, steps, clock = [], [], [], None, 0, 0, 0
    vectors = bench.parameter(dut, "Vecsum")
    for surface in frame.compiled.surfaces:
        for y in range(surface.rect[1], surface.rect[3] + 1):
            words += feeding.row([int(w) for w in surface.words], y, surface.is_vector_sum and formed is not surface)
            formed = surface if surface.is_vector_sum else formed
    pixels = sum((x1 - x0 + 1) * (y1 - y0 + 1) for x0, y0, x1, y1 in (s.rect for s in frame.compiled.surfaces))
    left, quiet = pixels, 0  # pixels that have neither a last record nor a reason to have none
    while left or quiet < TURN:
        word = words[0] if words else None
        # full_o and both idle outputs come from registers
        room = dut.full_o.value == 0 and random.random() >= stall
        if word and word["kind"] == feeding.FORM:
            room = room and dut.idle_o.value == 1 and dut.vector_idle_o.value == 1
        dut.load_valid_i.value = int(word is not None and room)
        if word and room:
            load.write(word | {"word": word["word"] or 0})
            words.pop(0)
        dut.hit_ready_i.value = int(clock >= pause and random.random() >= stall)
        clock += 1
        await ReadOnly()
        asked = limits.asked()
        if dut.hit_valid_o.value == 1 and dut.hit_ready_i.value == 1:
            records.append(bench.HIT.unpack(hit.read()[0]))
            left -= records[-1]["last"]
        ended += int(dut.ended_o.value)
        steps += int(dut.steps_o.value)
        assert vectors or dut.vector_idle_o.value == 1
        skipped = int(dut.skipped_o.value)
        rows = int(dut.skipped_row_o.value) if skipped else 0
        without += [(reason, rows >> 2 * reason & 3) for reason in range(3) if skipped >> reason & 1]
        left -= skipped.bit_count()
        quiet = 0 if words or dut.hit_valid_o.value == 1 or dut.idle_o.value == 0 else quiet + 1
        assert quiet < SILENCE, f"{left} pixels have no last record, and no more come"
        await FallingEdge(dut.clk_i)
        limits.answer(asked)
    taken = sum(r["steps"] for r in records if r["last"])
    assert steps == taken, f"steps_o adds up to {steps}, the records have {taken}"
    return records, limits, without, ended


def filled(frame, records, limits):
    """The records, with those of rays that have none: hidden ones the golden model's, others an end without a hit.

    A ray with a limit has no hit behind it; it gets those that the golden model has there, and its steps. Also the
    lowest bits of the rows of pixels that are hidden and of the other ones without a ray, and of how many rays with a
    limit hits are missing, and how many of them end without a hit.
    """
    there = {(r["surface"], r["x"], r["y"]) for r in records}
    out, hidden, empty, cut = list(records), [], [], [0, 0]
    for hits in frame.surfaces:
        x0, y0, x1, y1 = hits.surface.rect
        near = hits.surface.words[HEADER_WORDS - 1] & ((1 << DEPTH_WIDTH) - 1)
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                place, key = (y - y0, x - x0), {"surface": hits.surface.index, "x": x, "y": y}
                whole = [
                    {"hit": 1, "last": 0, "t": int(hits.t[*place, i]), "depth": int(hits.depth[*place, i]),
                     "point": hits.point[*place, i].tolist(), "enters": int(hits.enters[*place, i])}
                    for i in range(hits.t.shape[2]) if hits.t[*place, i] >= 0
                ]  # fmt: skip
                hides = limits.hides(y & 3, x, near)
                assert not (hides and tuple(key.values()) in there), f"{key} is hidden and has a ray"
                if hides:
                    hidden.append(y & 3)
                    out += [key | hit for hit in whole]
                elif limits.of(y & 3, x) is not None and tuple(key.values()) in there:
                    mine = [r for r in out if tuple(r[name] for name in key) == tuple(key.values())]
                    out = [r for r in out if r not in mine]
                    limit = limits.carried(y & 3, x)
                    assert not any(r["hit"] and behind(r["depth"], limit) for r in mine), f"{key}: {limit}, {mine}"
                    assert mine[-1]["last"] and mine[-1]["steps"] <= hits.steps[*place]
                    gone = [key | hit for hit in whole if behind(hit["depth"], limit)]
                    cut = [cut[0] + bool(gone), cut[1] + (not mine[-1]["hit"])]
                    out += [r | {"last": 0} for r in mine if r["hit"]] + gone
                    out.append(key | {"hit": 0, "last": 1, "steps": hits.steps[*place]})
                elif tuple(key.values()) not in there:
                    empty.append(y & 3)
                if tuple(key.values()) not in there:
                    out.append(key | {"hit": 0, "last": 1, "steps": hits.steps[*place]})
    return out, hidden, empty, cut


async def compare(dut, random, frame, skips=(), share=0.0, stall=0.0, k_stop=CONFIG.k_stop, pause=0):
    """A frame against the golden model; how many pixels have no ray, by reason."""
    records, limits, without, ended = await cast(dut, random, frame, skips, share, stall, k_stop, pause)
    records, hidden, empty, cut = filled(frame, records, limits)
    assert cut[0] <= ended <= cut[1] and (ended > 0) == (share > 0), f"{ended} items have ended; {cut}"
    if "boxes" not in skips:  # then cells beyond a face take steps, too
        surfaces = {hits.surface.index: hits for hits in frame.surfaces}
        for r in (r for r in records if r["last"]):
            x0, y0, *_ = surfaces[r["surface"]].surface.rect
            steps = surfaces[r["surface"]].steps[r["y"] - y0, r["x"] - x0]
            assert r["steps"] >= steps
            r["steps"] = steps
    test_core.compare(frame, records)
    assert hidden == [row for reason, row in without if reason == HIDDEN]
    assert sorted(empty) == sorted(row for reason, row in without if reason != HIDDEN)
    return [sum(reason == r for r, _ in without) for reason in range(3)]


async def start(dut):
    """Clock and reset, with the ports at rest; after a turn of the rings steps_o tells of no item from before."""
    for name in ("load_valid_i", "hit_ready_i", "limit_valid_i", "limit_i", "frame_i", "load_i"):
        getattr(dut, name).value = 0
    await bench.start(dut)
    for _ in range(TURN):
        await FallingEdge(dut.clk_i)


@cocotb.test
@cocotb.parametrize(scene=("torus", "glass", spirals.MIXED))
async def equals_golden(dut, scene):
    """Nothing is skipped: every ray's records are the golden model's, quadrics, quartics and spirals."""
    random = bench.rng(scene)
    await start(dut)
    frame = trace_golden(compiled_frame(scene), CONFIG)
    assert frame.counts()["hits"] > 10
    assert await compare(dut, random, frame, stall=0.3) == [0, 0, 0]


@cocotb.test
async def papers_rule(dut):
    """The same by the paper's rule, of quartics and spirals."""
    random = bench.rng()
    await start(dut)
    for scene in ("torus", spirals.MIXED):
        frame = trace_golden(compiled_frame(scene, "paper"), CONFIG.with_(rule="paper"))
        assert frame.counts()["hits"] > 10
        assert await compare(dut, random, frame) == [0, 0, 0]


@cocotb.test
async def full_queues_lose_nothing(dut):
    """No hit is taken for so long that rays wait in all queues and for them."""
    await start(dut)
    frame = trace_golden(compile_scene(spirals.load("glass", 24, 18), CONFIG), CONFIG)
    assert await compare(dut, bench.rng(), frame, pause=4000) == [0, 0, 0]


@cocotb.test
@cocotb.parametrize(k_stop=(1, 3), skips=("none", "some"))
async def fewer_steps(dut, k_stop, skips):
    """Frames of fewer steps to a hit, that is fewer digits of t."""
    random = bench.rng(k_stop)
    await start(dut)
    for scene in ("gallery", "torus"):
        frame = trace_golden(compiled_frame(scene), CONFIG.with_(k_stop=k_stop))
        await compare(dut, random, frame, ("boxes", "early") if skips == "some" else (), k_stop=k_stop)


@cocotb.test
@cocotb.parametrize(skips=("rootless", "boxes", "both"))
async def dropped_rays_have_no_hit(dut, skips):
    """Each reason alone, and both: a ray without records has no hit in the golden model, and is told once."""
    random = bench.rng(skips)
    skips = ("rootless", "boxes") if skips == "both" else (skips,)
    await start(dut)
    counts = [0, 0, 0]
    for scene in ("gallery", "torus"):
        frame = trace_golden(compiled_frame(scene), CONFIG)
        counts = [a + b for a, b in zip(counts, await compare(dut, random, frame, skips), strict=True)]
    assert counts[HIDDEN] == 0 and (counts[ROOTLESS] > 0) == ("rootless" in skips), counts
    assert (counts[BEYOND] > 0) == ("boxes" in skips) or len(skips) == 2, counts


@cocotb.test
@cocotb.parametrize(scene=("gallery", spirals.MIXED))
async def hidden_pixels_have_no_ray(dut, scene):
    """Random limits: exactly the pixels whose limit is nearer than the near plane are left out, of both kinds.

    Items end in the rings, too.
    """
    random = bench.rng(scene)
    await start(dut)
    frame = trace_golden(compiled_frame(scene), CONFIG)
    counts = await compare(dut, random, frame, ("rootless", "boxes", "depth", "early"), share=0.9)
    assert counts[HIDDEN] > 10, counts


@cocotb.test
async def helices(dut):
    """Helices and a sphere: nothing skipped, then everything that can be, with random limits."""
    random = bench.rng()
    await start(dut)
    own = {field: bench.parameter(dut, name) for field, name in (("n1", "N1"), ("steps", "K"), ("degree", "D"))}
    config = CONFIG.with_(**own, lanes=None, k_stop=None)
    frame = trace_golden(compile_scene(spirals.load(spirals.HELICES, 16, 12), config), config)
    assert frame.counts()["hits"] > 10
    assert await compare(dut, random, frame, stall=0.3, k_stop=config.k_stop) == [0, 0, 0]
    skips = ("rootless", "boxes", "depth", "early")
    counts = await compare(dut, random, frame, skips, share=0.9, k_stop=config.k_stop)
    assert counts[HIDDEN] > 0 and counts[ROOTLESS] > 0, counts


ALGEBRAIC = ["equals_golden/scene=torus", "hidden_pixels_have_no_ray/scene=gallery"]
ALGEBRAIC += [f"dropped_rays_have_no_hit/skips={skips}" for skips in ("rootless", "boxes", "both")]
EVERY = [f"equals_golden/scene={scene}" for scene in ("glass", spirals.MIXED)]
EVERY += [f"fewer_steps/k_stop={k}/skips={skips}" for k in (1, 3) for skips in ("none", "some")]
EVERY += ["papers_rule", "full_queues_lose_nothing", *ALGEBRAIC, f"hidden_pixels_have_no_ray/scene={spirals.MIXED}"]
# Left to make regress: what runs without spirals or with one evaluator, too, and two of the four kinds of fewer steps.
LATER = [*ALGEBRAIC, "hidden_pixels.*", "fewer_steps/k_stop=1/skips=none", "fewer_steps/k_stop=3/skips=some"]


def test_cast():
    """Quartics, quadrics and spirals; not the helices, for which one without quartics takes a tenth of the time."""
    bench.run(__name__, "rdx_cast", parameters(CONFIG), EVERY, LATER)


def test_cast_without_spirals():
    """The same where no evaluator of vector sums is built."""
    bench.run(__name__, "rdx_cast", parameters(CONFIG.with_(vecsum="none")), ALGEBRAIC)


def test_cast_with_one_evaluator():
    """Helices alone on the smallest rings: a digit a step, one unit each."""
    config = CONFIG.with_(n1=1, steps=6, degree=2, units=1, rules="certified", vecsum="helix", lanes=1)
    bench.run(__name__, "rdx_cast", parameters(config), ["helices"])
