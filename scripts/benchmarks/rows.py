# SPDX-License-Identifier: Apache-2.0
"""Measures a scene: the golden model in many configurations, and what else a user would take, in turns."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from alternatives import Problem, methods_for, problem_of, programs_for
from picture_error import depth_errors, picture_errors, shaded
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.fit import families
from raydix.golden import trace_golden
from raydix.oracle import ideal_frame
from raydix.scene import Scene
from raydix.shade import compose

DIGITS = (12, 16, 20, 24)  # of t, about; in whole steps
WIDTHS = (24, 28, 32)  # of control points, beside 36
RAYDIX = "Raydix, golden model"
REFERENCE = "certified, n1 3, K 8"
Run = Callable[[], tuple[float, Callable[[], tuple[np.ndarray, np.ndarray]]]]


@dataclass
class Row:
    """A method with what it was set to: seconds of each turn, and its errors (scene units, and pixels)."""

    scene: str
    method: str
    variant: str
    pixels: int
    rms: float
    p999: float
    max: float
    silhouette: int
    psnr: float | None  # dB; None: every colour is the ideal one
    flip: float
    program: bool = False  # a program of others: whether it is there differs from machine to machine
    seconds: list[float] = field(default_factory=list)
    ratio: float = float("nan")  # to the reference, median over the turns

    @property
    def median(self) -> float:
        """Seconds."""
        return statistics.median(self.seconds)

    @property
    def spread(self) -> float:
        """Half of the range of the middle half of the turns, relative to the median."""
        low, high = np.percentile(self.seconds, (25, 75))
        return float(high - low) / 2 / self.median


def measurable(scene: Scene) -> bool:
    """Whether it is one picture of one opaque surface."""
    return len(scene.surfaces) == 1 and not scene.cameras and scene.surfaces[0].opacity == 1


def configurations(scene: Scene) -> dict[str, Config]:
    """Configurations of the golden model by name: digits of a step and of t, both rules, widths."""
    fixed = dict(units=1, **families(scene))
    found = {}
    for n1 in (1, 2, 3, 4):
        for digits in DIGITS:  # k_stop: the same steps as with a smaller K, without another kernel to compile
            steps = digits // n1
            found[f"certified, n1 {n1}, K {steps}"] = Config(
                n1=n1, steps=24 // n1, k_stop=steps, rules="certified", **fixed
            )
    for n1 in (1, 2, 3, 4):
        found[f"paper, n1 {n1}, K {24 // n1}"] = Config(n1=n1, steps=24 // n1, rule="paper", rules="paper", **fixed)
    if fixed["degree"]:
        for width in WIDTHS:
            found[f"{REFERENCE}, W {width}"] = Config(n1=3, steps=8, width=width, rules="certified", **fixed)
    return found


def golden(scene: Scene, config: Config) -> Run:
    """A function that renders once: seconds in the core, and how to get depth and colours."""
    compiled = compile_scene(scene, config)

    def run():
        hits = trace_golden(compiled, config, 1)

        def picture():
            frame = compose(scene, hits, config, config.layers)
            return frame.depth, frame.rgb

        return hits.seconds, picture

    return run


def alternative(scene: Scene, problem: Problem, render) -> Run:
    """The same for a method that gives the depth of a problem; timed here."""

    def run():
        begun = time.perf_counter()
        depth = render(problem)
        return time.perf_counter() - begun, lambda: (depth, shaded(scene, depth))

    return run


def program(scene: Scene, problem: Problem, render, value: float) -> Run:
    """The same for a program that gives its seconds and a way to get the depth."""

    def run():
        seconds, depth_of = render(problem, value)

        def picture():
            depth = depth_of()
            return depth, shaded(scene, depth)

        return seconds, picture

    return run


def runs_of(scene: Scene, problem: Problem) -> tuple[dict[tuple[str, str, bool], Run], list[str]]:
    """Everything that is measured, by method, variant and whether it is a program; and what is not to be had."""
    runs = {(RAYDIX, name, False): golden(scene, config) for name, config in configurations(scene).items()}
    for method in methods_for(problem):
        for value in method.values:
            variant = f"{method.knob} {value:g}" if method.knob else ""
            runs[method.name, variant, False] = alternative(scene, problem, method.renderer(value))
    programs, missing = programs_for(problem)
    for p in programs:
        for value in p.values:
            runs[p.name, f"{p.knob} {value:g}" if p.knob else "", True] = program(scene, problem, p.render, value)
    return runs, missing


def measure(scene: Scene, repeats: int, tick: Callable[[str, int], None]) -> tuple[list[Row], list[str]]:
    """All rows of a scene, and what could not be had. ``tick`` is told what comes, and how many turns have ended."""
    problem, ideal = problem_of(scene), ideal_frame(scene).depth
    wanted = shaded(scene, ideal)
    runs, missing = runs_of(scene, problem)
    rows = {}
    for key, run in runs.items():  # the first time compiles
        tick(f"{scene.name}: {' '.join(key[:2])}", 0)
        _, picture = run()
        depth, rgb = picture()
        method, variant, outside = key
        errors = depth_errors(depth, ideal) | picture_errors(rgb, wanted)
        rows[key] = Row(scene.name, method, variant, ideal.size, **errors, program=outside)
    for number in range(repeats):
        tick(f"{scene.name}: turn {number + 1} of {repeats}", 1)
        for key, run in runs.items():
            rows[key].seconds.append(run()[0])
    tick(scene.name, 1)
    reference = rows[RAYDIX, REFERENCE, False].seconds
    for row in rows.values():
        row.ratio = statistics.median(a / b for a, b in zip(row.seconds, reference, strict=True))
    return list(rows.values()), missing
