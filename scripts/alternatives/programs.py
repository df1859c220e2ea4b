# SPDX-License-Identifier: Apache-2.0
"""Programs that a user would take instead, where they are installed."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from . import embree, povray
from .frame import Problem, Rendered


class Program(NamedTuple):
    """A program with one way to use it.

    name    of it and of the way
    knob    what its values are, from coarse to fine
    render  of a problem and a value
    missing why it cannot be had, or nothing
    can     whether it can do a problem
    """

    name: str
    knob: str
    values: Sequence[float]
    render: Callable[[Problem, float], Rendered]
    missing: Callable[[], str]
    can: Callable[[Problem], bool]


def helix(problem: Problem) -> bool:
    """Whether it is a spiral of a turn at least whose radii do not grow."""
    return problem.kind == "spiral" and problem.sizes[3] >= 1 and not problem.sizes[4:].any()


PROGRAMS = (
    Program("POV-Ray, own shape", "", (0,), povray.own_shape, povray.missing, lambda p: p.kind != "spiral"),
    Program("POV-Ray, Sturm", "", (0,), povray.own_shape_sturm, povray.missing, lambda p: p.degree == 4),
    Program("POV-Ray, cylinders", "", (0,), povray.helix_of_cylinders, povray.missing, helix),
    Program(
        "POV-Ray, isosurface", "accuracy", (1e-3, 1e-5), povray.by_isosurface, povray.missing,
        lambda p: p.kind != "spiral" or helix(p),
    ),
    Program(
        "Embree", "triangles", (6e4, 1e6, 4e6), embree.render, embree.missing,
        lambda p: p.kind in embree.KINDS and (p.kind != "spiral" or helix(p)),
    ),
)  # fmt: skip


def programs_for(problem: Problem) -> tuple[list[Program], list[str]]:
    """The programs that can do a problem and are installed; and why others are not."""
    able = [program for program in PROGRAMS if program.can(problem)]
    return [p for p in able if not p.missing()], list(dict.fromkeys(p.missing() for p in able if p.missing()))
