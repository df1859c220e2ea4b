# SPDX-License-Identifier: Apache-2.0
"""What an intersection core gives back, in the same arrays whichever core it was."""

from dataclasses import dataclass, field

import numpy as np

from .compile import CompiledFrame, CompiledSurface
from .formats import STEPS_MAX


@dataclass
class SurfaceHits:
    """Hits of one surface over its screen rectangle (h rows, w columns, R roots wanted).

    t      int64 (h, w, R), digits; -1 where there is no (further) root. In order of t.
    depth  int32 (h, w, R), s1p31 of the frame's depth scale; 0 where t is -1
    point  int32 (h, w, R, 3), s2p30 of the surface's local scale; 0 where t is -1
    enters uint8 (h, w, R), 1 where the indicator is positive before the hit; 0 where t is -1
    steps  uint32 (h, w), steps that the item took
    """

    surface: CompiledSurface
    t: np.ndarray
    depth: np.ndarray
    point: np.ndarray
    enters: np.ndarray
    steps: np.ndarray

    @classmethod
    def empty(cls, surface: CompiledSurface) -> "SurfaceHits":
        """Arrays for ``surface`` without a hit."""
        x0, y0, x1, y1 = surface.rect
        shape = (y1 - y0 + 1, x1 - x0 + 1, surface.roots)
        return cls(
            surface,
            np.full(shape, -1, np.int64),
            np.zeros(shape, np.int32),
            np.zeros((*shape, 3), np.int32),
            np.zeros(shape, np.uint8),
            np.zeros(shape[:2], np.uint32),
        )


@dataclass
class FrameHits:
    """All surfaces of a frame, with how long it took.

    seconds  time in the core alone, without set-up
    cycles   clock cycles (RTL), 0 for the golden model
    """

    compiled: CompiledFrame
    surfaces: list[SurfaceHits] = field(default_factory=list)
    seconds: float = 0.0
    cycles: int = 0

    def counts(self) -> dict[str, float]:
        """Rays, items that hit, hits, steps per item that hit and that missed, and items that were given up."""
        none = np.zeros(0, np.int64)  # so that a frame without surfaces has something to join
        steps = np.concatenate([none, *(s.steps.astype(np.int64).ravel() for s in self.surfaces)])
        found = np.concatenate([none, *((s.t >= 0).sum(axis=2).ravel() for s in self.surfaces)])
        hit = found > 0
        return {
            "rays": int(steps.size),
            "hit_rays": int(hit.sum()),
            "hits": int(found.sum()),
            "steps": int(steps.sum()),
            "steps_per_hit": float(steps[hit].mean()) if hit.any() else 0.0,
            "steps_per_miss": float(steps[~hit].mean()) if (~hit).any() else 0.0,
            "given_up": int((steps == STEPS_MAX).sum()),
        }


def differing_bits(a: FrameHits, b: FrameHits) -> int:
    """Bits that differ in any output of two runs of the same compiled frame."""
    total = 0
    for one, other in zip(a.surfaces, b.surfaces, strict=True):
        for name in ("t", "depth", "point", "enters", "steps"):
            total += int(np.bitwise_count(getattr(one, name) ^ getattr(other, name)).sum())
    return total


def differing_bits_of(part: FrameHits, whole: FrameHits) -> int:
    """Bits of the hits of ``part`` that differ from those in the same place of ``whole``; ``part`` may lack any."""
    total = 0
    for one, other in zip(part.surfaces, whole.surfaces, strict=True):
        there = one.t >= 0
        for name in ("t", "depth", "point", "enters"):
            a, b = (getattr(hits, name)[there] for hits in (one, other))
            total += int(np.bitwise_count(a ^ b).sum())
    return total
