# SPDX-License-Identifier: Apache-2.0
"""Other ways to intersect a ray with a surface, compiled, on the rays of a scene: what Raydix is measured against.

Each finds the first root on the part of a ray inside of the surface's box. None shares code with the golden model or
with the oracle that judges both. `polynomials` solve algebraic surfaces, `distances` march or sample by a signed
distance; `programs` are others' own, POV-Ray and Embree.
"""

from .frame import Problem, problem_of
from .methods import METHODS, Method, methods_for
from .programs import PROGRAMS, Program, programs_for

__all__ = ["METHODS", "PROGRAMS", "Method", "Problem", "Program", "methods_for", "problem_of", "programs_for"]
