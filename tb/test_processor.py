# SPDX-License-Identifier: Apache-2.0
"""Frames out of the chip: pixels through the stream equal the golden model's, whatever is skipped, stalled or built."""

import functools

import numpy as np
import pytest

import spirals
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.fit import families, frame_parameters
from raydix.golden import trace_golden
from raydix.hits import differing_bits_of
from raydix.processor import ALL, SKIPS, run_frames
from raydix.rtl import RtlError
from raydix.scene import SceneError
from raydix.shade import compose
from test_frames import EVERY

# One build each, and the scenes that are run on it
ALGEBRAIC = Config(3, 8, 36, 4, 1, "both", rings=2, surfaces=16, layers=4, max_width=64, beat=2)
SPIRALS = Config(3, 8, 36, 4, 2, "both", vecsum="general", lanes=1, surfaces=8, layers=2, max_width=48)
HELIX = Config(1, 24, degree=0, units=1, rules="certified", vecsum="helix", vector_rings=2, surfaces=1, layers=1,
               max_width=52, beat=4)  # fmt: skip
TORUS = Config(3, 8, 28, 4, 1, "certified", rings=4, clip=False, halve_stages=1, surfaces=1, layers=1, max_width=64,
               beat=2)  # fmt: skip
QUADRIC = Config(2, 10, 32, 2, 1, "paper", "paper", surfaces=1, layers=1, max_width=41)
BUILDS = {
    "every algebraic surface": (ALGEBRAIC, None, (50, 37)),
    "both families": (SPIRALS, ("families", "shell", "flat_spiral", spirals.MIXED), (40, 30)),
    "helices, digit by digit, four pixels a beat": (HELIX, ("spiral",), (50, 38)),
    "one torus, a halving a clock": (TORUS, ("torus", "cyclide"), (64, 40)),
    "one quadric by the paper's rule": (QUADRIC, ("hyperboloid", "sphere", "plane"), (41, 31)),
}
LONG = ("both families",)  # builds that `make test` leaves to `make regress`
CASES = [
    pytest.param(
        config.with_(rule=rule), scene, size, id=f"{name}-{scene}-{rule}", marks=[pytest.mark.long] * (name in LONG)
    )
    for name, (config, scenes, size) in BUILDS.items()
    for scene in (scenes or [s for s in EVERY if families(spirals.load(s, 8, 6))["vecsum"] == "none"])
    for rule in (("certified", "paper") if config.rules == "both" and scene != "families" else (config.rule,))
]


def test_every_scene_is_run():
    """Each scene of ``scenes/`` is rendered by the processor."""
    assert {case.values[1] for case in CASES} >= set(EVERY)


@functools.cache
def golden(scene, size, config):
    """Scene, words and the golden model's frame."""
    loaded = spirals.load(scene, *size)
    compiled = compile_scene(loaded, config)
    return loaded, compiled, compose(loaded, trace_golden(compiled, config), config, config.layers)


def rectangles(compiled):
    """Pixels of the surfaces' rectangles."""
    return sum((x1 - x0 + 1) * (y1 - y0 + 1) for x0, y0, x1, y1 in (s.rect for s in compiled.surfaces))


@pytest.mark.parametrize(("config", "scene", "size"), CASES)
def test_pixels_equal_golden(config, scene, size):
    """Every pixel, every hit that left the rings, and what was counted, with random stalls on both buses."""
    loaded, compiled, frame = golden(scene, size, config)
    output = run_frames([(loaded, compiled)], config, stall=3)
    assert (output.rgb[0] == frame.rgb).all()
    assert (output.frames, output.lines) == (1, size[1])
    assert differing_bits_of(output.hits, frame.hits) == 0
    seen = compose(loaded, output.hits, config, config.layers)
    for name in ("t", "surface", "depth"):
        assert (getattr(seen, name) == getattr(frame, name)).all(), name
    counted = output.counters
    skipped = sum(counted[f"skipped_{name}"] for name in ("depth", "rootless", "boxes"))
    assert counted["rays"] + skipped == rectangles(compiled)
    assert counted["skipped_rectangle"] == len(compiled.surfaces) * size[0] * size[1] - rectangles(compiled)
    assert counted["hits"] == sum(int((s.t >= 0).sum()) for s in output.hits.surfaces)
    assert counted["steps"] == sum(int(s.steps.astype(np.int64).sum()) for s in output.hits.surfaces)
    assert counted["visible"] >= int((frame.surface >= 0).sum()) > 20
    assert counted["given_up"] == 0


@pytest.mark.long
@pytest.mark.parametrize(("scene", "rings"), [("torus", 4), ("hyperboloid", 3)])
def test_full_hd(scene, rings):
    """1920x1080: every pixel, at most 1.1 times the work that is needed, few more clocks than the slowest part takes.

    Needed are K steps for each visible hit and one for each other ray that was looked at in a ring. The walk takes a
    clock for a pixel of the rectangle, a ring one for a step, the reading of a line one for a beat and a further hit.
    """
    loaded = spirals.load(scene, 1920, 1080)
    config = Config(3, 8, units=1, rings=rings, rules="certified", **families(loaded), **frame_parameters(loaded, 2))
    loaded, compiled, frame = golden(scene, (1920, 1080), config)
    output = run_frames([(loaded, compiled)], config)
    assert (output.rgb[0] == frame.rgb).all()
    counted = output.counters
    needed = config.steps * counted["visible"] + counted["rays"] - counted["visible"]
    print(f"\n{counted['cycles']} cycles, {counted['steps']} steps, {needed} needed, {rectangles(compiled)} pixels")
    assert counted["steps"] <= 1.1 * needed
    read = (1920 * 1080 + counted["visible"]) / 2
    assert counted["cycles"] <= 1.2 * max(rectangles(compiled), counted["steps"] / rings, read)


@pytest.mark.parametrize("scene", ["gallery", "glass"])
def test_skipping_changes_no_pixel(scene):
    """All skipping off, and each kind off by itself: the same bits; a counter is 0 where its kind is off."""
    loaded, compiled, frame = golden(scene, (50, 37), ALGEBRAIC)
    cycles = {}
    for off in (frozenset(), ALL, *(frozenset([name]) for name in SKIPS)):
        output = run_frames([(loaded, compiled)], ALGEBRAIC, skips=ALL - off)
        assert (output.rgb[0] == frame.rgb).all(), off
        for name in off - {"early"}:
            assert output.counters[f"skipped_{name}"] == 0, name
        ended = output.counters["skipped_cells"]  # the front of glass lets light through
        assert ended == 0 if "depth" in off or scene == "glass" else ended > 20
        cycles[off] = output.counters["cycles"]
    assert cycles[ALL] > 1.1 * cycles[frozenset()]


def test_items_end_behind_the_nearest_hit():
    """Surfaces of both kinds within each other: what is left of an item behind the nearest hit is not searched.

    The hits that are missing are those behind that hit, and the picture is the same.
    """
    loaded, compiled, frame = golden(spirals.NESTED, (48, 36), SPIRALS)
    short, whole = (run_frames([(loaded, compiled)], SPIRALS, skips=ALL - off) for off in (frozenset(), {"depth"}))
    for output in (short, whole):
        assert (output.rgb[0] == frame.rgb).all()
        assert differing_bits_of(output.hits, frame.hits) == 0
    assert whole.counters["skipped_cells"] == whole.counters["skipped_depth"] == 0
    missing = 0
    for some, every in zip(short.hits.surfaces, whole.hits.surfaces, strict=True):
        x0, y0, x1, y1 = some.surface.rect
        nearest = frame.depth[y0 : y1 + 1, x0 : x1 + 1, None]
        gone = (some.t < 0) & (every.t >= 0)
        assert (every.depth > nearest)[gone].all()
        if some.surface.index != 1:  # the first one has no limits, the second one few
            assert gone.any() == (some.surface.index > 1), some.surface.index
        missing += int(gone.any(axis=2).sum())
    assert short.counters["skipped_cells"] + short.counters["skipped_depth"] >= missing > 100
    assert short.counters["steps"] < whole.counters["steps"]
    assert short.counters["cycles"] < 0.9 * whole.counters["cycles"]


def test_frames_follow_each_other():
    """Three frames, each loaded while the one before is made: each is as if it were the only one."""
    names = ("torus", "glass", "cyclide")
    frames = [golden(name, (50, 37), ALGEBRAIC) for name in names]
    output = run_frames([frame[:2] for frame in frames], ALGEBRAIC, stall=5)
    assert output.frames == 3
    for name, rgb, frame in zip(names, output.rgb, frames, strict=True):
        assert (rgb == frame[2].rgb).all(), name


def test_layers_at_their_limit():
    """Two layers where the scene has more: the nearest two, as in the golden model, and what was lost is counted."""
    config = ALGEBRAIC.with_(layers=2)
    loaded, compiled, frame = golden("glass", (50, 37), config)
    output = run_frames([(loaded, compiled)], config)
    assert (output.rgb[0] == frame.rgb).all()
    assert output.counters["layers_lost"] > 0 and frame.dropped.any()
    whole = golden("glass", (50, 37), ALGEBRAIC.with_(layers=8))[2]
    assert (whole.rgb != frame.rgb).any() and not whole.dropped.any()


def test_smallest_processor():
    """What a scene needs: its surfaces, its line, a layer where all is opaque, and more where not."""
    assert frame_parameters(spirals.load("torus", 50, 37), 4) == dict(surfaces=1, layers=1, max_width=52, beat=4)
    assert frame_parameters(spirals.load("glass", 50, 37))["layers"] == 7
    assert frame_parameters(spirals.load("gallery", 50, 37))["surfaces"] == 7


def test_what_does_not_fit_is_refused():
    """A line too long, too many surfaces, frames of different sizes: a message, and no simulation."""
    loaded, compiled, _ = golden("gallery", (50, 37), ALGEBRAIC)
    for config in (ALGEBRAIC.with_(max_width=48), ALGEBRAIC.with_(surfaces=6)):
        with pytest.raises(SceneError, match="allowed: up to"):
            run_frames([(loaded, compiled)], config)
    with pytest.raises(RtlError, match="allowed: 50×37"):
        run_frames([(loaded, compiled), golden("gallery", (40, 30), ALGEBRAIC)[:2]], ALGEBRAIC)


def test_a_wrong_pixel_is_seen(monkeypatch):
    """The comparison of pictures sees a single code."""
    from raydix import render

    honest = render.run_frames

    def faulty(*arguments, **keywords):
        output = honest(*arguments, **keywords)
        output.rgb[0, 9, 9, 1] ^= 1
        return output

    monkeypatch.setattr(render, "run_frames", faulty)
    verdict = render.verify(spirals.load("torus", 50, 37), ALGEBRAIC)
    assert (verdict.hit_bits, verdict.image_bits) == (0, 1)
