# SPDX-License-Identifier: Apache-2.0
"""Which design points are best: fronts of two figures, and the one to take for a goal."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from .designs import SIZE

GOOD = 1e-5  # largest 99.9 % error of the depth, scene units, of a design that is recommended
REAL_TIME = 60  # frames of 1920×1080 a second
SCALE = (1080 / SIZE[1]) ** 2  # what is seen of the scene has so many pixels more there; the margins are empty


class Point(NamedTuple):
    """A placed design.

    name, family   which it is
    lut4, dsp, bram  cells; ff flip-flops
    fmax           MHz
    rate           Mray/s: clock times rays a clock in a frame
    frames         of the scene a second at 1920×1080: clock over clocks of the frame measured, times SCALE
    per_klut       Mray/s for 1,000 LUT4
    latency        ns from the start of a frame of one ray to its hit
    error          99.9 % of the errors of the depth, scene units; silhouette: pixels wrong
    """

    name: str
    family: str
    lut4: int
    ff: int
    dsp: int
    bram: int
    fmax: float
    rate: float
    frames: float
    per_klut: float
    latency: float
    error: float
    silhouette: int


def point_of(name: str, result: dict) -> Point:
    """The figures of a result of :func:`exploration.measure.measure` that was placed."""
    fmax, lut4 = result["fmax"], result["lut4"]
    rate = fmax * result["rays"] / result["cycles"]
    return Point(
        name,
        result["design"]["family"],
        *(result[kind] for kind in ("lut4", "ff", "dsp", "bram")),
        fmax,
        rate,
        1e6 * fmax / (result["cycles"] * SCALE),
        1e3 * rate / lut4,
        1e3 * result["latency"] / fmax,
        result["p999"],
        result["silhouette"],
    )


class Figure(NamedTuple):
    """A figure of a point and whether less of it is better."""

    title: str
    of: Callable[[Point], float]
    less: bool = True

    def cost(self, point: Point) -> float:
        """What is better is less."""
        return self.of(point) if self.less else -self.of(point)


AREA = Figure("LUT4", lambda p: p.lut4)
RATE = Figure("Mray/s", lambda p: p.rate, False)
DENSITY = Figure("Mray/s per 1,000 LUT4", lambda p: p.per_klut, False)
LATENCY = Figure("ns", lambda p: p.latency)
ERROR = Figure("error", lambda p: p.error)
FRONTS = {"rate": (AREA, RATE), "latency": (AREA, LATENCY), "error": (ERROR, DENSITY)}


def front(points: Sequence[Point], figures: Sequence[Figure]) -> list[Point]:
    """The points that no other one beats: as good in every figure and better in one."""

    def beats(a: Point, b: Point) -> bool:
        mine, its = [[figure.cost(p) for figure in figures] for p in (a, b)]
        return all(x <= y for x, y in zip(mine, its, strict=True)) and mine != its

    return [p for p in points if not any(beats(other, p) for other in points)]


def recommended(points: Sequence[Point]) -> dict[str, Point | None]:
    """For each goal the design to take, of those that are right: no silhouette pixel wrong, error at most GOOD."""
    right = [p for p in points if p.silhouette == 0 and p.error <= GOOD]
    fast = [p for p in right if p.frames >= REAL_TIME]

    def best(some: Sequence[Point], figure: Figure) -> Point | None:
        return min(some, key=figure.cost, default=None)

    return {
        "least area": best(right, AREA),
        "1080p60, least area": best(fast, AREA),
        "lowest latency": best(right, LATENCY),
        "most rays": best(right, RATE),
        "most rays for the area": best(right, DENSITY),
    }
