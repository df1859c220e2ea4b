# SPDX-License-Identifier: Apache-2.0
"""Constants of the materials: what shading knows of a surface. Source: docs/processor.md, "Shading".

Computed with 256-bit floating point from the scene, like the descriptors (``compile.py``), and rounded once.
The places are those of ``formats.MATERIAL``; the gradient is taken in scaled coordinates p, local = origin + unit*p.
"""

from collections.abc import Sequence

import mpmath as mp

from .compile import PRECISION, _cross, _unit, _vector, clip_box
from .compile_swirl import swirl_words
from .formats import MATERIAL_INDEX, MATERIAL_WORDS, SWIRL_FIRST, UNIT_FRAC
from .gradient import CONSTANT_FRAC
from .scene import Scene
from .surfaces import Quadric, form

LARGEST = (1 << CONSTANT_FRAC) - 1  # of a constant: just below 1
LIMIT = mp.mpf(2) - mp.mpf(2) ** -8  # of g, w and q of a quartic, which are s2p16
REACH = mp.mpf(2)  # of a coordinate, s2p30


def material_words(scene: Scene, surface, origin: Sequence[float], unit: Sequence[float]) -> tuple[int, ...]:
    """The 64 words of a surface's material; ``origin`` and ``unit`` are those of the compiled surface."""
    words = [0] * MATERIAL_WORDS
    with mp.workprec(PRECISION):
        parts = {
            "light": _light(scene, surface, unit),
            "color": [int(mp.nint(mp.ldexp(mp.mpf(c), UNIT_FRAC))) for c in surface.color],
            "opacity": [int(mp.nint(mp.ldexp(mp.mpf(surface.opacity), UNIT_FRAC)))],
            "vector": [int(surface.type == "spiral")],
        }
        if surface.type == "spiral":
            swirl = swirl_words(surface, origin, unit)
            words[SWIRL_FIRST : SWIRL_FIRST + len(swirl)] = swirl
        else:
            parts |= _quadrics(surface, origin, unit)
    for name, values in parts.items():
        words[MATERIAL_INDEX[name] : MATERIAL_INDEX[name] + len(values)] = values
    return tuple(words)


def _rounded(values, factor) -> list[int]:
    """The values times ``factor`` as s1p17."""
    return [int(mp.nint(v * factor * LARGEST)) for v in values]


def _light(scene, surface, unit) -> list[int]:
    """T by rows: the gradient in scaled coordinates to the world, to two axes across the light and the light's."""
    third = _unit(_vector(scene.light.direction))
    least = min(range(3), key=lambda axis: abs(third[axis]))
    first = _unit(_cross(mp.matrix([mp.mpf(axis == least) for axis in range(3)]), third))
    basis = mp.matrix([list(first), list(_cross(third, first)), list(third)])
    to_world = (mp.matrix(surface.matrix) * mp.mpf(surface.scale)) ** -1
    matrix = basis * to_world.T * mp.diag([1 / mp.mpf(u) for u in unit])
    return _rounded(matrix, 1 / max(abs(v) for v in matrix))


def _substituted(q: Quadric, origin, unit) -> tuple[list, list, mp.mpf]:
    """Matrix (2xx, 2yy, 2zz, xy, yz, zx), linear part and constant of a quadric in scaled coordinates."""
    o, u = _vector(origin), _vector(unit)
    xx, yy, zz, xy, yz, zx = q[:6]
    full = mp.matrix([[2 * xx, xy, zx], [xy, 2 * yy, yz], [zx, yz, 2 * zz]])
    slope = full * o + mp.matrix(q[6:9])
    constant = (sum((slope[i] + q[6 + i]) * o[i] for i in range(3))) / 2 + q[9]
    scaled = [full[i, j] * u[i] * u[j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]
    return scaled, [slope[i] * u[i] for i in range(3)], constant


def _bound(matrix, linear, constant, reach) -> mp.mpf:
    """Of g, w and q where no coordinate is beyond ``reach``: magnitudes added."""
    xx, yy, zz, xy, yz, zx = (abs(v) for v in matrix)
    rows = [sum(m * r for m, r in zip(row, reach, strict=True)) for row in ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz))]
    steep = max(row + 2 * abs(part) for row, part in zip(rows, linear, strict=True))
    value = sum((row / 2 + abs(part)) * x for row, part, x in zip(rows, linear, reach, strict=True)) + abs(constant)
    return max(steep, value)


def _quadrics(surface, origin, unit) -> dict[str, list[int]]:
    """Constants of Q3, and of Q1 and Q2 where the surface is a quartic: Q3's factor is the product of theirs."""
    shape = form(surface)
    matrix3, linear3, _ = _substituted(shape.q3, origin, unit)
    largest3 = max(abs(v) for v in (*matrix3, *linear3))
    if shape.q1 is None or shape.q2 is None:
        factor = 1 / largest3
        return {"q3_matrix": _rounded(matrix3, factor), "q3_linear": _rounded(linear3, factor)}
    low, high, _ = clip_box(surface)
    reach = [min(REACH, (high[i] - low[i]) / 2 / mp.mpf(unit[i])) for i in range(3)]
    quadrics = [_substituted(q, origin, unit) for q in (shape.q1, shape.q2)]
    factors = []
    for matrix, linear, constant in quadrics:
        largest = max(abs(v) for v in (*matrix, *linear, constant))
        factors.append(1 / (max(largest, _bound(matrix, linear, constant, reach) / LIMIT) or mp.mpf(1)))
    if largest3 * factors[0] * factors[1] > 1:
        less = 1 / mp.sqrt(largest3 * factors[0] * factors[1])
        factors = [factor * less for factor in factors]
    parts = {}
    for name, (matrix, linear, constant), factor in zip(("q1", "q2"), quadrics, factors, strict=True):
        parts[f"{name}_matrix"] = _rounded(matrix, factor)
        parts[f"{name}_linear"] = _rounded(linear, factor)
        parts[f"{name}_constant"] = _rounded([constant], factor)
    both = factors[0] * factors[1] * LARGEST / mp.ldexp(1, CONSTANT_FRAC)  # each factor comes with LARGEST once
    parts["q3_matrix"], parts["q3_linear"] = _rounded(matrix3, both), _rounded(linear3, both)
    return parts
