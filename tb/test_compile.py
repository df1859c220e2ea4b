# SPDX-License-Identifier: Apache-2.0
"""Scene to words: every image size compiles, and the forward differences stay within their accumulators."""

import random
from pathlib import Path

import pytest

import spirals
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.core import scratch
from raydix.fdiff import VALUE, next_pixel, next_row
from raydix.fit import families
from raydix.formats import BOX_WIDTH, COORD_ACC_WIDTH, COORD_LANES, OPERAND_SHIFT
from raydix.kernel import words
from raydix.raster import BOX_AT, load_lanes
from raydix.scene import SceneError, load_scene
from test_random_scenes import TYPES, scene_text

SIZES = [(1, 1), (1, 3), (2, 1), (3, 2), (9, 7)]

SCENES = Path(__file__).resolve().parents[1] / "scenes"


def lanes(surface):
    """Accumulators of all lanes at each pixel of the rectangle."""
    state = scratch(Config(), 4)[0]
    descriptor = words(surface.words)
    load_lanes(state, descriptor)
    x0, y0, x1, y1 = surface.rect
    for y in range(y0, y1 + 1):
        for x in range(x0, x1 + 1):
            yield [int(v) for v in state[VALUE]]
            if x < x1:
                next_pixel(state)
        if y < y1:
            next_row(state)


@pytest.mark.parametrize("size", SIZES, ids=lambda s: f"{s[0]}x{s[1]}")
def test_small_images_compile(size, tmp_path):
    """No scene is refused because of its size, and every lane is within bounds at every pixel."""
    dice = random.Random(f"small {size}")
    seen = 0
    for kind in TYPES:
        for _ in range(6):
            path = tmp_path / "scene.toml"
            path.write_text(scene_text(kind, dice))
            scene = load_scene(path, *size)
            for surface in compile_scene(scene, Config(vecsum="general")).surfaces:
                seen += 1
                for values in lanes(surface):
                    assert max(map(abs, values[:COORD_LANES])) < 1 << (COORD_ACC_WIDTH - 1)
                    assert max(map(abs, values[COORD_LANES:])) < (1 << 62) - (1 << (OPERAND_SHIFT - 1))
                    assert max(map(abs, values[COORD_LANES : COORD_LANES + 3])) <= 1 << 60
    assert seen > 40


@pytest.mark.parametrize("size", [*SIZES, (60, 45)], ids=lambda s: f"{s[0]}x{s[1]}")
def test_spirals_in_small_images(size):
    """The same for spirals: all coordinates are within 7/4, which is what the evaluator has room for."""
    seen = 0
    for name in dict.fromkeys(name for name, _ in (*spirals.HELIX, *spirals.GENERAL)):
        for surface in spirals.compiled(name, 3, *size).surfaces:
            if not surface.is_vector_sum:
                continue
            seen += 1
            for values in lanes(surface):
                # words of differences are rounded: half an ulp for each pixel
                assert max(map(abs, values[:COORD_LANES])) <= (7 << COORD_ACC_WIDTH - 4) + sum(size)
                assert not any(values[COORD_LANES:])
    assert seen == 10


@pytest.mark.parametrize("scene", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_what_a_scene_needs(scene):
    """Without boxes a scene compiles just where :func:`families` says that it needs none, to the same words."""
    loaded = load_scene(scene, 64, 48)
    config = Config(**families(loaded))
    whole = compile_scene(loaded, config.with_(clip=True))
    boxes = [s.words[0] >> BOX_AT & (1 << 3 * BOX_WIDTH) - 1 for s in whole.surfaces if not s.is_vector_sum]
    if config.clip:
        with pytest.raises(SceneError, match="clip: found a surface that a box cuts; allowed: .* without clip"):
            compile_scene(loaded, config.with_(clip=False))
    else:
        assert not any(boxes)
        assert [s.words for s in compile_scene(loaded, config).surfaces] == [s.words for s in whole.surfaces]
    assert config.clip or not any(boxes)
