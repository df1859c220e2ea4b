# SPDX-License-Identifier: Apache-2.0
"""Whole frames: the RTL under Verilator equals the golden model in every bit, in every configuration and rule."""

import functools
from pathlib import Path

import numpy as np
import pytest

import latency
import spirals
from raydix.compile import compile_scene
from raydix.config import VECSUMS, Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.hits import differing_bits
from raydix.rtl import RtlError, _collect, trace_rtl

SCENES = Path(__file__).resolve().parents[1] / "scenes"
EVERY = sorted(path.stem for path in SCENES.glob("*.toml"))
QUADRICS = ("cone", "cylinder", "ellipsoid", "hyperboloid", "hyperboloid_one_sheet", "paraboloid", "saddle", "sphere")

# One build each: n1, K, W, D, U and rules that differ in everything; then the scenes that are run on it, small.
# With vector sums beside the algebraic surfaces, and alone.
BUILDS = {
    "reference, both rules, one unit": (
        Config(3, 8, 36, 4, 1, "both", vecsum="general", lanes=3, vector_units=2),
        (*EVERY, spirals.MIXED),
    ),
    "paper's digits one by one, n = 20": (
        Config(1, 20, 24, 4, 3, "both", vecsum="general"),
        ("torus", "glass", "gallery", "flat_spiral", spirals.MIXED),
    ),
    "n1 = 2, n = 32, K not a multiple of U": (
        Config(2, 16, 40, 4, 3, "both", vecsum="helix"),
        ("cyclide", "glass", "saddle", "spiral", spirals.HELICES),
    ),
    "n1 = 4, certified only": (
        Config(4, 6, 36, 4, 2, "certified", vecsum="general", lanes=1, vector_drop=8),
        ("torus", "quartic", "glass", "shell", spirals.MIXED),
    ),
    "quadrics only, full pipeline": (Config(3, 8, 32, 2, 8, "certified"), QUADRICS),
    "quadrics, paper only, n1 = 4, n = 32": (Config(4, 8, 36, 2, 1, "paper", "paper"), ("quadric", "plane", "cone")),
    "one step": (Config(3, 1, 16, 2, 1, "both"), ("sphere", "hyperboloid")),
    "vector sums only, full pipeline": (
        Config(4, 6, degree=0, units=1, rules="certified", vecsum="general", lanes=1, vector_units=6),
        ("spiral", "flat_spiral"),
    ),
}
# builds that `make test` leaves to `make regress`
LONG = ("paper's digits one by one, n = 20", "n1 = 2, n = 32, K not a multiple of U", "quadrics only, full pipeline",
        "quadrics, paper only, n1 = 4, n = 32", "vector sums only, full pipeline")  # fmt: skip
CASES = [
    pytest.param(config.with_(rule=rule), scene, id=f"{name}-{scene}-{rule}", marks=[pytest.mark.long] * (name in LONG))
    for name, (config, scenes) in BUILDS.items()
    for scene in scenes
    for rule in (("certified", "paper") if config.rules == "both" else (config.rules,))
]


def test_every_scene_is_run():
    """Each scene of ``scenes/`` stands in a build that can do it."""
    for scene in EVERY:
        needed = families(spirals.load(scene, 8, 6))
        configs = [config for config, scenes in BUILDS.values() if scene in scenes]
        assert configs, scene
        for config in configs:
            assert config.degree >= needed["degree"], scene
            assert VECSUMS.index(config.vecsum) >= VECSUMS.index(needed["vecsum"]), scene


@functools.cache
def compiled_frame(scene, width, height, config):
    """The words of a scene and the golden model's hits."""
    compiled = compile_scene(spirals.load(scene, width, height), config)
    return compiled, trace_golden(compiled, config)


@pytest.mark.parametrize(("config", "scene"), CASES)
def test_rtl_equals_golden(config, scene):
    """Digits, depth, point and steps of every ray agree, with random stalls at both ports."""
    compiled, golden = compiled_frame(scene, 72, 54, config)
    rtl = trace_rtl(compiled, config, stall=1)
    assert golden.counts()["hits"] > 50
    assert differing_bits(golden, rtl) == 0


@pytest.mark.long
def test_full_pipeline_takes_a_ray_a_clock():
    """Torus, 640x480, reference configuration, U = K: equal bits, at most 1.02 cycles a ray, 1.01 * needed steps."""
    config = Config(3, 8, 36, 4, 8, "certified")
    compiled, golden = compiled_frame("torus", 640, 480, config)
    rtl = trace_rtl(compiled, config)
    counts = rtl.counts()
    print(f"\n{rtl.cycles / counts['rays']:.4f} cycles a ray, {rtl.seconds:.2f} s of simulation; {counts}")
    assert differing_bits(golden, rtl) == 0
    assert rtl.cycles <= 1.02 * counts["rays"]
    needed = config.steps * counts["hit_rays"] + counts["rays"] - counts["hit_rays"]
    assert counts["steps"] <= 1.01 * needed


def test_one_unit_does_one_step_a_clock():
    """U = 1: the unit is never idle while rays wait, so cycles are steps, but for one in a hundred."""
    config = Config(3, 8, 36, 4, 1, "both")
    compiled, golden = compiled_frame("torus", 200, 150, config)
    rtl = trace_rtl(compiled, config)
    assert differing_bits(golden, rtl) == 0
    assert rtl.cycles <= 1.01 * rtl.counts()["steps"] + 500


def test_vector_sums_take_a_place_each_phase():
    """The unit of the vector-sum ring is never idle while rays wait: an item every ceil((J-1)/lanes) clocks."""
    config = BUILDS["n1 = 4, certified only"][0]
    compiled, golden = compiled_frame("shell", 200, 150, config)
    rtl = trace_rtl(compiled, config)
    assert differing_bits(golden, rtl) == 0
    steps, phases = rtl.counts()["steps"], latency.phases(config.cells - 1, config.lanes)
    assert phases * steps <= rtl.cycles <= 1.01 * phases * steps + 3000


def test_difference_is_counted():
    """One flipped bit in one output is one differing bit."""
    config = Config(3, 8, 36, 4, 1, "both")
    compiled, golden = compiled_frame("torus", 72, 54, config)
    other = trace_golden(compiled, config)
    for name in ("t", "depth", "point", "enters", "steps"):
        array = getattr(other.surfaces[0], name)
        array.flat[array.size // 2] ^= 1
        assert differing_bits(golden, other) == 1
        array.flat[array.size // 2] ^= 1
    assert differing_bits(golden, other) == 0


@pytest.mark.parametrize("damage", ["lost", "twice", "outside"])
def test_incomplete_stream_is_refused(damage):
    """A ray without its last record, with two of them, or a record from nowhere is an error, not a picture."""
    from raydix.rtl import RECORD

    config = Config(3, 8, 36, 4, 1, "both")
    compiled, _ = compiled_frame("torus", 24, 18, config)
    x0, y0, x1, y1 = compiled.surfaces[0].rect
    y, x = np.mgrid[y0 : y1 + 1, x0 : x1 + 1]
    records = np.zeros(x.size, RECORD)
    records["x"], records["y"], records["last"] = x.ravel(), y.ravel(), 1
    assert len(_collect(compiled, records)) == 1
    broken = {"lost": records[1:], "twice": np.concatenate([records, records[:1]]), "outside": records.copy()}[damage]
    if damage == "outside":
        broken["x"][0] = x1 + 1
    with pytest.raises(RtlError):
        _collect(compiled, broken)
