# SPDX-License-Identifier: Apache-2.0
"""Stress categories with clip boxes: faces through silhouettes, edges and corners, flat boxes."""

import numpy as np

from .chords import chord_items
from .formats import COORD_FRAC
from .segments import Segments
from .stress_polynomials import fitted
from .stress_rays import grazing


def _words(h, e, scale):
    return np.rint(np.concatenate([h * scale, e * scale], axis=1) * 2.0**COORD_FRAC).astype(np.int64)


def faces(dice, count, config):
    """Clip faces through the silhouette, at its very place or 2^-4 … 2^-44 beside it."""
    for surface, h, e in grazing(dice, count):
        # the tangent point lies about the middle; a face there, in units of the box 2^(1-m)
        middle = np.abs((h + e) / 2).mean(axis=0)
        box = dice.integers(1, 4, 3)
        scale = 2.0 ** (1 - box) / np.maximum(middle, 0.05)
        largest = np.abs(np.concatenate([h, e])).max(axis=0)
        box = np.where(largest * scale >= 2, 0, box)
        scale = np.where(box == 0, 1.9 / largest, scale)
        items = chord_items(surface, h, e, config)
        yield Segments(items.b, _words(h, e, scale), tuple(int(m) for m in box))


def edges(dice, count, config):
    """A root exactly on a face, an edge or a corner of the box, or 2^-4 … 2^-44 beside it."""
    parts = 16
    share = -(-count // parts)
    for start in range(0, count, share):
        n = min(share, count - start)
        root = np.rint(dice.random(n) * 2.0**16).clip(1, 2**16 - 1) / 2.0**16
        b = np.stack([-root, 1 - root], axis=1) * dice.choice([-1, 1], (n, 1))
        b = fitted(
            np.stack([b[:, 0] + (b[:, 1] - b[:, 0]) * i / config.degree for i in range(config.degree + 1)], axis=1),
            config.width,
        )
        box = dice.integers(1, 4, 3) * (dice.random(3) < 0.7)
        face = np.ldexp(1.0, COORD_FRAC + 1 - box)
        at = (
            face
            * dice.choice([-1, 1], (n, 3))
            * (1 - 2.0 ** -dice.uniform(4, 44, (n, 3)) * dice.choice([-1, 0, 1], (n, 3)))
        )
        direction = dice.uniform(-1, 1, (n, 3)) * face / 2
        ends = np.concatenate([at - root[:, None] * direction, at + (1 - root[:, None]) * direction], axis=1)
        limit = 2.0 ** (COORD_FRAC + 1) - 1
        yield Segments(b, np.rint(ends.clip(-limit, limit)).astype(np.int64), tuple(int(m) for m in box))


CATEGORIES = {"clip faces through the silhouette": faces, "root on a face of the box": edges}
