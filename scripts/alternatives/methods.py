# SPDX-License-Identifier: Apache-2.0
"""The list of alternatives: name, what trades time for accuracy, and which surfaces each can do."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from . import distances, polynomials
from .frame import Problem, batch_renderer, renderer


class Method(NamedTuple):
    """An alternative.

    name      of the method; knob: what its values are
    values    from coarse to fine
    make      of a value: the compiled solver
    algebraic whether it solves a polynomial (else it asks for distances)
    kinds     surfaces it can do; empty: every algebraic one
    batch     whether it solves all rays at a time
    """

    name: str
    knob: str
    values: Sequence[float]
    make: Callable
    algebraic: bool
    kinds: Sequence[str] = ()
    batch: bool = False

    def renderer(self, value: float) -> Callable[[Problem], np.ndarray]:
        """A function of a problem that gives its depth by this method."""
        solve = self.make(value)
        return batch_renderer(solve) if self.batch else renderer(solve, self.algebraic)


DIGITS = (12, 16, 20, 24)
TOLERANCES = (1e-3, 1e-5, 1e-7)

METHODS = (
    Method("closed form", "", (0,), polynomials.closed_form, True),
    Method("companion matrix", "", (0,), polynomials.companion, True, batch=True),
    Method("64 samples, bisection", "digits", DIGITS, polynomials.bisection, True),
    Method("64 samples, regula falsi", "tolerance", TOLERANCES, polynomials.regula_falsi, True),
    Method("64 samples, Newton", "tolerance", TOLERANCES, polynomials.newton, True),
    Method("interval bisection", "tolerance", TOLERANCES, polynomials.interval_bisection, True),
    Method("Bézier clipping", "tolerance", TOLERANCES, polynomials.bezier_clipping, True),
    *(
        Method(name, knob, values, partial(make, kind), False, (kind,))
        for kind in distances.DISTANCES
        for name, knob, values, make in (
            ("sphere tracing", "tolerance", TOLERANCES, distances.sphere_tracing),
            *(
                (
                    ("256 samples, bisection", "digits", DIGITS, distances.sampled_bisection),
                    ("256 samples, regula falsi", "tolerance", TOLERANCES, distances.sampled_regula_falsi),
                )
                if kind == "spiral"
                else ()
            ),
        )
    ),
)


def methods_for(problem: Problem) -> list[Method]:
    """The methods that can do a surface."""
    return [m for m in METHODS if (problem.kind in m.kinds if m.kinds else problem.kind != "spiral")]
