# SPDX-License-Identifier: Apache-2.0
"""Rows as tables: all, what is faster than the certified rule at no larger error, and all scenes at a glance."""

import statistics
from collections.abc import Sequence

from .clocks import COLUMNS as CLOCKS
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
PROJECTED = CLOCKS.index("projected, ms")
GROUPS = {  # column of the table of every scene: how its methods' names begin
    "closed form": "closed form",
    "companion matrix": "companion matrix",
    "samples": ("64 samples", "256 samples"),
    "interval bisection": "interval bisection",
    "Bézier clipping": "Bézier clipping",
    "sphere tracing": "sphere tracing",
    "POV-Ray, own shape": ("POV-Ray, own shape", "POV-Ray, Sturm", "POV-Ray, cylinders"),
    "POV-Ray, isosurface": "POV-Ray, isosurface",
    "Embree": "Embree",
}
EVERY = ("scene", "ms", "99.9 % error", "silhouette", *GROUPS, "placed engine, ms")


def cells(row: Row) -> list[str]:
    """A row of the table."""
    length = (f"{v:.1e}" for v in (row.rms, row.p999, row.max))
    times = f"{1e3 * row.median:.1f}", f"{row.spread:.0%}", f"{1e9 * row.median / row.pixels:.0f}", f"{row.ratio:.2f}"
    seen = "same" if row.psnr is None else f"{row.psnr:.1f}", f"{row.flip:.5f}"
    return [row.scene, row.method, row.variant, *times, *length, f"{row.silhouette:,}", *seen]


def rival(row: Row, own: Sequence[Row]) -> Row | None:
    """The fastest of ``own`` with neither a larger 99.9 % error nor more silhouette pixels than a row."""
    good = [r for r in own if r.p999 <= row.p999 and r.silhouette <= row.silhouette]
    return min(good, key=lambda r: r.median, default=None)


def over(row: Row, other: Row) -> float:
    """Time over the other's, median of the turns."""
    return statistics.median(a / b for a, b in zip(row.seconds, other.seconds, strict=True))


def beaten(rows: Sequence[Row]) -> list[list[str]]:
    """For each scene: alternatives that are faster than the certified rule is at any setting as good.

    As good: neither a larger 99.9 % error nor more silhouette pixels. Where no setting is, those that are faster than
    the reference.
    """
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [r for r in rows if r.scene == scene and r.method == RAYDIX and r.variant.startswith("certified")]
        for row in (r for r in rows if r.scene == scene and r.method != RAYDIX):
            best = rival(row, own)
            reference = next(r for r in own if r.variant == REFERENCE)
            if best is None and row.median < reference.median:
                found.append([scene, row.method, row.variant, "none as good", "", f"{row.p999:.1e}"])
            elif best is not None and row.median < best.median:
                ratio = f"{over(row, best):.2f}"
                found.append([scene, row.method, row.variant, best.variant, ratio, f"{row.p999:.1e}"])
    return found


def glance(rows: Sequence[Row], clock_rows: Sequence[Sequence[str]]) -> list[list[str]]:
    """A line for each scene: the reference, and of each group of alternatives the least time at its error.

    Over the fastest certified setting as good (:func:`rival`); where none is, over the reference, and in brackets.
    Last the time of the fastest placed engine, from the rows of :func:`~benchmarks.clocks.clocks`.
    """
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        mine = [r for r in rows if r.scene == scene]
        own = [r for r in mine if r.method == RAYDIX and r.variant.startswith("certified")]
        (reference,) = (r for r in own if r.variant == REFERENCE)
        line = [scene, f"{1e3 * reference.median:.1f}", f"{reference.p999:.1e}", str(reference.silhouette)]
        for names in GROUPS.values():
            pairs = [(r, rival(r, own)) for r in mine if r.method.startswith(names)]
            matched = [over(r, best) for r, best in pairs if best is not None]
            beyond = [over(r, reference) for r, best in pairs if best is None]
            least = [f"{ratio:.2f}" for ratio in sorted(matched)[:1]]
            line.append(" ".join(least + [f"({ratio:.2f})" for ratio in sorted(beyond)[:1]]))
        times = [float(row[PROJECTED]) for row in clock_rows if row[0] == scene]
        found.append([*line, f"{min(times):.2f}" if times else ""])
    return found
