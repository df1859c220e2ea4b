# SPDX-License-Identifier: Apache-2.0
"""Rows as tables: all of them, and what is faster than the certified rule at no larger error."""

import statistics
from collections.abc import Sequence

from .rows import RAYDIX, REFERENCE, Row

TABLE = (
    "scene",
    "method",
    "variant",
    "ms",
    "spread",
    "ns / pixel",
    "ratio",
    "error rms",
    "99.9 %",
    "max",
    "silhouette",
    "PSNR, dB",
    "FLIP",
)
BEATEN = ("scene", "method", "variant", "fastest certified setting as good", "time over its time", "99.9 % error")
LEFT = ("scene", "method", "variant")


def cells(row: Row) -> list[str]:
    """A row of the table."""
    length = (f"{v:.1e}" for v in (row.rms, row.p999, row.max))
    times = f"{1e3 * row.median:.1f}", f"{row.spread:.0%}", f"{1e9 * row.median / row.pixels:.0f}", f"{row.ratio:.2f}"
    seen = "same" if row.psnr is None else f"{row.psnr:.1f}", f"{row.flip:.5f}"
    return [row.scene, row.method, row.variant, *times, *length, f"{row.silhouette:,}", *seen]


def beaten(rows: Sequence[Row]) -> list[list[str]]:
    """For each scene: alternatives that are faster than the certified rule is at any setting as good.

    As good: neither a larger 99.9 % error nor more silhouette pixels. Where no setting is, those that are faster than
    the reference.
    """
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [r for r in rows if r.scene == scene and r.method == RAYDIX and r.variant.startswith("certified")]
        for row in (r for r in rows if r.scene == scene and r.method != RAYDIX):
            good = [r for r in own if r.p999 <= row.p999 and r.silhouette <= row.silhouette]
            best = min(good, key=lambda r: r.median, default=None)
            reference = next(r for r in own if r.variant == REFERENCE)
            if best is None and row.median < reference.median:
                found.append([scene, row.method, row.variant, "none as good", "", f"{row.p999:.1e}"])
            elif best is not None and row.median < best.median:
                ratio = statistics.median(a / b for a, b in zip(row.seconds, best.seconds, strict=True))
                found.append([scene, row.method, row.variant, best.variant, f"{ratio:.2f}", f"{row.p999:.1e}"])
    return found
