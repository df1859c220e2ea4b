# SPDX-License-Identifier: Apache-2.0
"""The shading of docs/scenes.md in float64, written by itself: the oracle of the integer shading's tests."""

import numpy as np

from raydix.hits import FrameHits
from raydix.scene import Scene
from raydix.shade import _basis, _local, _normals
from raydix.surfaces import normal_direction


def encoded(linear: np.ndarray) -> np.ndarray:
    """255 times the sRGB-encoded intensity of a linear one in [0, 1] (IEC 61966-2-1)."""
    v = np.clip(linear, 0, 1)
    return 255 * np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def linear_picture(scene: Scene, frame: FrameHits) -> np.ndarray:
    """Linear colour (H, W, 3) of all hits of a frame, sorted and blended in float64, not cut off at any number."""
    height, width = frame.compiled.height, frame.compiled.width
    basis = _basis(scene)
    light = np.array(scene.light.direction) / np.linalg.norm(scene.light.direction)
    parts = []
    for hits in frame.surfaces:
        where = np.nonzero(hits.t >= 0)
        rows, columns = where[0] + hits.surface.rect[1], where[1] + hits.surface.rect[0]
        surface = scene.surfaces[hits.surface.index]
        normal = _normals(scene, hits, hits.point[where], basis, columns, rows)
        level = scene.light.ambient + (1 - scene.light.ambient) * np.maximum(0, normal @ light)
        number = np.full(rows.shape, hits.surface.index)
        shade = level[:, None] * np.array(surface.color)
        parts.append((rows * width + columns, number, hits.depth[where], where[2], shade,
                      np.full(rows.shape, surface.opacity)))  # fmt: skip
    linear, through = np.zeros((height * width, 3)), np.ones((height * width, 1))
    if parts:
        pixel, number, depth, root, shade, opacity = (np.concatenate(p) for p in zip(*parts, strict=True))
        order = np.lexsort((root, number, depth, pixel))
        pixel, shade, opacity = pixel[order], shade[order], opacity[order]
        rank = np.arange(pixel.size) - np.searchsorted(pixel, pixel)
        for now in (np.nonzero(rank == r)[0] for r in range(rank.max(initial=-1) + 1)):
            at, a = pixel[now], opacity[now, None]
            linear[at] += through[at] * a * shade[now]
            through[at] *= 1 - a
    return (linear + through * np.array(scene.background.color)).reshape(height, width, 3)


def with_enters(scene: Scene, frame: FrameHits) -> FrameHits:
    """The frame; where the core did not say which hits enter, from the float gradient."""
    forward, right, up, pixel, width, height = _basis(scene)
    for hits in frame.surfaces:
        if hasattr(hits, "enters"):
            continue
        surface, where = scene.surfaces[hits.surface.index], np.nonzero(hits.t >= 0)
        rows, columns = where[0] + hits.surface.rect[1], where[1] + hits.surface.rect[0]
        local = _local(hits.surface, hits.point[where])
        normal = normal_direction(surface, local) @ np.linalg.inv(np.array(surface.matrix))
        ray = (
            forward
            + ((columns + 0.5 - width / 2) * pixel)[:, None] * right
            + ((height / 2 - rows - 0.5) * pixel)[:, None] * up
        )
        hits.enters = np.zeros(hits.t.shape, np.uint8)
        hits.enters[where] = (normal * ray).sum(axis=1) < 0
    return frame
