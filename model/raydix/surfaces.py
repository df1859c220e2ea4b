# SPDX-License-Identifier: Apache-2.0
"""Surfaces in local coordinates: implicit form, bounding box, gradient.

Every surface but the spiral is algebraic: F(x, y, z) = 0 with F = q1*q2 + q3 (degree 4) or F = q3 (degree at
most 2), where each q is a quadric given by ten coefficients in the order of `MONOMIALS`. F is positive outside
a closed surface. The spiral has an indicator instead, in `raydix.spiral`. Coefficients and boxes are mpmath
numbers of 256 bits, computed from the scene's float64 numbers taken as the exact binary values they are.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from mpmath import mp, mpf

from raydix import spiral

if TYPE_CHECKING:
    from raydix.scene import Spiral, Surface

PRECISION = 256

# Exponents of x, y, z for the ten coefficients: xx, yy, zz, xy, yz, zx, x, y, z, 1.
MONOMIALS = ((2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 1, 0), (0, 1, 1), (1, 0, 1),
             (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0))  # fmt: skip

Quadric = tuple[mpf, ...]
Box = tuple[tuple[mpf, mpf, mpf], tuple[mpf, mpf, mpf]]


class Form(NamedTuple):
    """F = q1*q2 + q3, or F = q3 where q1 and q2 are None; ten mpf coefficients each."""

    q1: Quadric | None
    q2: Quadric | None
    q3: Quadric


def _quadric(xx=0, yy=0, zz=0, xy=0, yz=0, zx=0, x=0, y=0, z=0, one=0) -> Quadric:
    return tuple(mpf(c) for c in (xx, yy, zz, xy, yz, zx, x, y, z, one))


def _negate(q: Quadric) -> Quadric:
    return tuple(-c for c in q)


def _matrix(q: Quadric):
    """The symmetric 3x3 matrix of the quadratic part."""
    xx, yy, zz, xy, yz, zx = q[:6]
    return mp.matrix([[xx, xy / 2, zx / 2], [xy / 2, yy, yz / 2], [zx / 2, yz / 2, zz]])


def _eigenvalues(q: Quadric) -> list[mpf]:
    """Of the quadratic part, smallest first."""
    return sorted(mp.eigsy(_matrix(q), eigvals_only=True))


def _definite(q: Quadric) -> int:
    """Sign of the quadratic part if it is definite, else 0; one below 2^-100 of the largest counts as 0."""
    low, _, high = _eigenvalues(q)
    zero = mp.ldexp(max(-low, high), -100)
    return (low > zero) - (high < -zero)


@mp.workprec(PRECISION)
def form(surface: "Surface") -> Form:
    """The implicit form of a surface of the scene, in its local coordinates.

    Raises ValueError for a surface that is not algebraic: a spiral.
    """
    s = surface
    match s.type:
        case "plane":
            return Form(None, None, _quadric(z=1))
        case "sphere":
            return Form(None, None, _quadric(1, 1, 1, one=-(mpf(s.R) ** 2)))
        case "ellipsoid":
            xx, yy, zz = _inverse_squares(s.a, s.b, s.c)
            return Form(None, None, _quadric(xx, yy, zz, one=-1))
        case "cylinder":
            return Form(None, None, _quadric(1, 1, 0, one=-(mpf(s.R) ** 2)))
        case "cone":
            return Form(None, None, _quadric(1, 1, -(mpf(s.k) ** 2)))
        case "paraboloid":
            xx, yy = _inverse_squares(s.a, s.b)
            return Form(None, None, _quadric(xx, yy, z=-1))
        case "hyperbolic_paraboloid":
            xx, yy = _inverse_squares(s.a, s.b)
            return Form(None, None, _quadric(xx, -yy, z=-1))
        case "hyperboloid_one_sheet" | "hyperboloid_two_sheet":
            xx, yy, zz = _inverse_squares(s.a, s.b, s.c)
            return Form(None, None, _quadric(xx, yy, -zz, one=-1 if s.type == "hyperboloid_one_sheet" else 1))
        case "quadric":
            q = _quadric(*s.coefficients)
            return Form(None, None, _negate(q) if _definite(q) < 0 else q)
        case "torus":
            R2, r2 = mpf(s.R) ** 2, mpf(s.r) ** 2
            q = _quadric(1, 1, 1, one=R2 - r2)
            return Form(q, q, _quadric(-4 * R2, -4 * R2))
        case "cyclide":
            a, b, d = mpf(s.a), mpf(s.b), mpf(s.d)
            cd = mp.sqrt((a - b) * (a + b)) * d
            q = _quadric(1, 1, 1, one=b**2 - d**2)
            return Form(q, q, _quadric(-4 * a**2, -4 * b**2, x=8 * a * cd, one=-4 * cd**2))
        case "quartic":
            q1, q2, q3 = _quadric(*s.Q1), _quadric(*s.Q2), _quadric(*s.Q3)
            if _definite(q1) * _definite(q2) < 0:
                q1, q3 = _negate(q1), _negate(q3)
            return Form(q1, q2, q3)
    raise ValueError(f"no implicit form for surface type {s.type!r}")


def _inverse_squares(*lengths: float) -> tuple[mpf, ...]:
    return tuple(1 / mpf(v) ** 2 for v in lengths)


def is_constant(q1: Sequence[float], q2: Sequence[float], q3: Sequence[float]) -> bool:
    """Whether q1*q2 + q3 does not depend on the point; exact."""
    total: defaultdict[tuple[int, ...], Fraction] = defaultdict(Fraction)
    for m, c in zip(MONOMIALS, q3, strict=True):
        total[m] += Fraction(c)
    for m1, c1 in zip(MONOMIALS, q1, strict=True):
        for m2, c2 in zip(MONOMIALS, q2, strict=True):
            total[tuple(i + j for i, j in zip(m1, m2, strict=True))] += Fraction(c1) * Fraction(c2)
    return not any(c for m, c in total.items() if any(m))


@mp.workprec(PRECISION)
def bounding_box(surface: "Surface") -> Box | None:
    """Corners (low, high) of a local box that holds the whole surface; None if the surface is unbounded.

    Tight for every closed type but `quartic`, whose box is the cube about a sphere that holds it, and a `spiral`
    that grows: then x and y have a margin. A quartic counts as closed only if the quadratic parts of Q1 and Q2
    are both definite. An empty ellipsoid gives a box of no size.
    """
    s = surface
    match s.type:
        case "sphere":
            return _centred(s.R, s.R, s.R)
        case "ellipsoid":
            return _centred(s.a, s.b, s.c)
        case "quadric":
            return _ellipsoid_box(form(s).q3)
        case "torus":
            return _centred(mpf(s.R) + s.r, mpf(s.R) + s.r, s.r)
        case "cyclide":
            return _cyclide_box(mpf(s.a), mpf(s.b), mpf(s.d))
        case "quartic":
            radius = _radius(form(s))
            return None if radius is None else _centred(radius, radius, radius)
        case "spiral":
            return _spiral_box(s)
    return None


def _centred(*half: mpf | float, centre: Iterable[mpf] = (mpf(0),) * 3) -> Box:
    pairs = [(c, mpf(h)) for c, h in zip(centre, half, strict=True)]
    return tuple(c - h for c, h in pairs), tuple(c + h for c, h in pairs)  # type: ignore[return-value]


def _ellipsoid_box(q: Quadric) -> Box | None:
    """Box of x'Ax + b'x + c = 0: centre m = -A^-1 b/2, half-widths sqrt(k (A^-1)_ii), k = m'Am - c."""
    if _definite(q) <= 0:
        return None
    inverse = _matrix(q) ** -1
    centre = inverse * mp.matrix(q[6:9]) / -2
    k = -q[9] - sum(b * m for b, m in zip(q[6:9], centre, strict=True)) / 2
    half = [mp.sqrt(max(k, mpf(0)) * inverse[i, i]) for i in range(3)]
    return _centred(*half, centre=centre)


def _cyclide_box(a: mpf, b: mpf, d: mpf) -> Box:
    """The cyclide is the envelope of the spheres about (a cos u, b sin u, 0) of radius |d - c cos u|.

    With s(u) = centre coordinate + radius: x is extreme at u = 0 (a + |d - c|) and u = pi (a + d + c);
    y where b sin u - c cos u is sqrt(b^2 + c^2) = a; z at u = pi.
    """
    c = mp.sqrt((a - b) * (a + b))
    return (-(a + c + d), -(a + d), -(c + d)), (a + abs(d - c), a + d, c + d)


def _spiral_box(s: "Spiral") -> Box:
    """The end balls and, across the axis, the tube: R(s) -+ r(s) times the range of the azimuth's cosine or sine.

    R, r and z grow evenly with s, so that R - r, R + r and z -+ r are extreme at the ends.
    """
    ends = (mpf(0), mpf(s.turns))
    a, r, z = [s.R + s.R_growth * t for t in ends], [s.r + s.r_growth * t for t in ends], [s.pitch * t for t in ends]
    inner, outer = _reach(a, r)
    sides = []
    for curve in (mp.cospi, mp.sinpi):
        least, most = _range(curve, ends[1])
        low, high = _reach([radius * curve(2 * t) for radius, t in zip(a, ends, strict=True)], r)
        tube = least * (outer if least < 0 else inner), most * (outer if most > 0 else inner)
        sides.append((min(low, tube[0]), max(high, tube[1])))
    low, high = zip(*sides, _reach(z, r), strict=True)
    return low, high


def _reach(centres: Sequence[mpf], radii: Sequence[mpf]) -> tuple[mpf, mpf]:
    """Least centre - radius and largest centre + radius."""
    pairs = list(zip(centres, radii, strict=True))
    return min(c - r for c, r in pairs), max(c + r for c, r in pairs)


def _range(curve: Callable[[mpf], mpf], turns: mpf) -> tuple[mpf, mpf]:
    """Least and largest of mp.cospi or mp.sinpi over the first `turns` turns: at an end or at a quarter turn."""
    quarters = [mpf(i) / 2 for i in range(1, 4) if i <= 4 * turns]
    values = [curve(u) for u in (mpf(0), *quarters, 2 * turns)]
    return min(values), max(values)


def _radius(f: Form) -> mpf | None:
    """A radius about the origin beyond which F has no zero; None if Q1 and Q2 are not definite of one sign.

    At distance s from the origin a quadric is at least e*s^2 - |b|*s + c, e its lowest eigenvalue. Q1 and
    Q2, both taken as positive, are so at least l1(s) and l2(s), and Q3 at least -u3(s), where u3
    leaves out what is positive in Q3. From the start below, l1/s and l2/s do not fall and u3/s^2 does not
    grow, so that l1*l2 - u3 changes sign at most once: the radius is there, from above.
    """
    assert f.q1 is not None and f.q2 is not None
    sign = _definite(f.q1)
    if not sign or _definite(f.q2) != sign:
        return None
    e3, b3, c3 = _lower_bound(f.q3)
    bounds = [_lower_bound(q if sign > 0 else _negate(q)) for q in (f.q1, f.q2)]
    bounds_3 = min(e3, mpf(0)), b3, min(c3, mpf(0))

    def is_beyond(s: mpf) -> bool:
        l1, l2, l3 = (e * s * s - b * s + c for e, b, c in (*bounds, bounds_3))
        return l1 * l2 + l3 >= 0

    low = max(_start(*bound) for bound in bounds)
    if is_beyond(low):
        return low
    high = low or mpf(1)
    while not is_beyond(high):
        high *= 2
    for _ in range(64):
        middle = (low + high) / 2
        low, high = (low, middle) if is_beyond(middle) else (middle, high)
    return high


def _lower_bound(q: Quadric) -> tuple[mpf, mpf, mpf]:
    """Lowest eigenvalue, length of the linear part, constant."""
    return _eigenvalues(q)[0], mp.norm(mp.matrix(q[6:9])), q[9]


def _start(e: mpf, b: mpf, c: mpf) -> mpf:
    """Where l(s) = e*s^2 - b*s + c, e > 0, is not negative and l/s does not fall any more."""
    root = b * b - 4 * e * c
    return (b + mp.sqrt(root)) / (2 * e) if root >= 0 else mp.sqrt(c / e)


def _evaluate(q: Quadric, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Value (...) and gradient (..., 3) of one quadric at points (..., 3), float64."""
    xx, yy, zz, xy, yz, zx, *linear, one = (float(c) for c in q)
    gradient_half = p @ np.array([[xx, xy / 2, zx / 2], [xy / 2, yy, yz / 2], [zx / 2, yz / 2, zz]])
    return (p * (gradient_half + linear)).sum(-1) + one, 2 * gradient_half + linear


def value(form: Form, points: np.ndarray) -> np.ndarray:
    """F in float64 at local points (..., 3); shape (...)."""
    points = np.asarray(points, dtype=np.float64)
    f = _evaluate(form.q3, points)[0]
    if form.q1 is not None and form.q2 is not None:
        f = f + _evaluate(form.q1, points)[0] * _evaluate(form.q2, points)[0]
    return f


def gradient(form: Form, points: np.ndarray) -> np.ndarray:
    """Gradient of F in float64 at local points (..., 3); shape (..., 3), not normalised."""
    points = np.asarray(points, dtype=np.float64)
    g = _evaluate(form.q3, points)[1]
    if form.q1 is not None and form.q2 is not None:
        (v1, g1), (v2, g2) = _evaluate(form.q1, points), _evaluate(form.q2, points)
        g = g + v1[..., None] * g2 + v2[..., None] * g1
    return g


def normal_direction(surface: "Surface", points: np.ndarray) -> np.ndarray:
    """Direction of the normal in float64 at local points (..., 3) of the surface; shape (..., 3), not normalised.

    It is the gradient of F or, for a spiral, of its indicator: outwards if the surface is closed, 0 at singular points.
    """
    if surface.type == "spiral":
        return spiral.gradient(surface, points)
    return gradient(form(surface), points)
