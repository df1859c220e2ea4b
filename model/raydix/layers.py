# SPDX-License-Identifier: Apache-2.0
"""The layers of each pixel: its nearest hits, from front to back. Source: docs/processor.md, "Layers"."""

from dataclasses import dataclass

import numpy as np

from .formats import SURFACE_WIDTH
from .hits import FrameHits
from .kernel import kernel
from .scene import Scene

NOTHING = 1 << 62  # a key behind every hit's


@dataclass
class Layers:
    """Layers of P pixels, at most L of each, of a frame's hits in one flat list.

    count    uint8 (P), layers of a pixel
    dropped  int64 (P), layers that it has beyond these
    surface  uint8 (P, L), number of the surface in the scene
    index    int64 (P, L), place of the hit in the flat list
    t, point, enters   the flat list: those of all surfaces of the frame, one after the other
    """

    count: np.ndarray
    dropped: np.ndarray
    surface: np.ndarray
    index: np.ndarray
    t: np.ndarray
    point: np.ndarray
    enters: np.ndarray


@kernel
def key_of(depth, surface):
    """Order of the hits: by depth, then by number of the surface; those of one surface come in order of t."""
    return int(depth) << SURFACE_WIDTH | surface


@kernel
def note_walls(t, depth, surface, left, top, width, wall):
    """Keep in ``wall`` the key of each pixel's nearest hit of an opaque surface."""
    for row in range(t.shape[0]):
        for column in range(t.shape[1]):
            pixel = (top + row) * width + left + column
            if t[row, column, 0] >= 0:
                wall[pixel] = min(wall[pixel], key_of(depth[row, column, 0], surface))


@kernel
def insert(t, depth, surface, left, top, width, base, wall, found, keys, index):
    """Put a surface's hits in front of the walls in their places in ``keys`` and ``index``, and count all in ``found``.

    base  place in the flat list of the surface's first hit
    """
    most = keys.shape[1]
    for row in range(t.shape[0]):
        for column in range(t.shape[1]):
            pixel = (top + row) * width + left + column
            for root in range(t.shape[2]):
                if t[row, column, root] < 0:
                    break
                key = key_of(depth[row, column, root], surface)
                if key > wall[pixel]:
                    break
                place = min(int(found[pixel]), most)
                found[pixel] += 1
                while place > 0 and keys[pixel, place - 1] > key:
                    if place < most:
                        keys[pixel, place] = keys[pixel, place - 1]
                        index[pixel, place] = index[pixel, place - 1]
                    place -= 1
                if place < most:
                    keys[pixel, place] = key
                    index[pixel, place] = base + (row * t.shape[1] + column) * t.shape[2] + root


def layers_of(scene: Scene, frame: FrameHits, most: int) -> Layers:
    """The ``most`` nearest hits of each pixel, none behind an opaque one; equal depths by the surface's number."""
    width, pixels = frame.compiled.width, frame.compiled.width * frame.compiled.height
    wall = np.full(pixels, NOTHING, np.int64)
    found = np.zeros(pixels, np.int64)
    keys, index = np.zeros((pixels, most), np.int64), np.zeros((pixels, most), np.int64)
    for hits in frame.surfaces:
        left, top, _, _ = hits.surface.rect
        if scene.surfaces[hits.surface.index].opacity == 1:
            note_walls(hits.t, hits.depth, hits.surface.index, left, top, width, wall)
    base = 0
    for hits in frame.surfaces:
        left, top, _, _ = hits.surface.rect
        insert(hits.t, hits.depth, hits.surface.index, left, top, width, base, wall, found, keys, index)
        base += hits.t.size

    def flat(name, dtype, *tail):
        parts = [getattr(hits, name).reshape(-1, *tail) for hits in frame.surfaces]
        return np.concatenate(parts) if parts else np.zeros((0, *tail), dtype)

    return Layers(
        np.minimum(found, most).astype(np.uint8),
        np.maximum(found - most, 0),
        (keys & ((1 << SURFACE_WIDTH) - 1)).astype(np.uint8),
        index,
        flat("t", np.int64),
        flat("point", np.int32, 3),
        flat("enters", np.uint8),
    )
