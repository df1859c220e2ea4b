# SPDX-License-Identifier: Apache-2.0
"""Implicit forms, bounding boxes and gradients of the surface types; the spiral's indicator."""

from collections.abc import Callable

import numpy as np
import pytest
from mpmath import mp, mpf

from raydix import scene, spiral, surfaces

CLIP = ((-2.0, -2.0, -2.0), (2.0, 2.0, 2.0))
COEFFICIENTS = (1.0, 1.2, 1.5, 0.8, -0.6, -0.9, 0.2, -0.1, 0.3, -1.3)
Q1 = (0.4, 3.0, 3.0, 0.1, -0.2, 0.3, 0.1, 0.0, -0.2, -1.0)
Q2 = (3.0, 2.0, 0.4, 0.2, 0.1, 0.1, -0.1, 0.2, 0.3, -1.1)
Q3 = (0.1, 0.2, -0.1, 0.3, 0.2, -0.2, 0.1, -0.1, 0.1, -0.3)
FAR = (-9.0, -5.0, -7.0, 0.3, 0.2, -0.2, 2.0, -1.0, 1.0, -80.0)  # a Q3 that carries the surface outwards


def quadric(q, x, y, z):
    monomials = (x * x, y * y, z * z, x * y, y * z, z * x, x, y, z, 1)
    return sum(c * m for c, m in zip(q, monomials, strict=True))


def torus(R, r):
    def equation(x, y, z):
        return (x**2 + y**2 + z**2 + R**2 - r**2) ** 2 - 4 * R**2 * (x**2 + y**2)

    return scene.Torus(type="torus", R=R, r=r), equation, True


def cyclide(a, b, d):
    def equation(x, y, z):
        c = (a * a - b * b) ** 0.5
        return (x**2 + y**2 + z**2 + b**2 - d**2) ** 2 - 4 * (a * x - c * d) ** 2 - 4 * b**2 * y**2

    return scene.Cyclide(type="cyclide", a=a, b=b, d=d), equation, True


def negated(q):
    return tuple(-c for c in q)


# name: (surface, its equation written out, closed)
CASES: dict[str, tuple[scene.Surface, Callable, bool]] = {
    "plane": (scene.Plane(type="plane", clip=CLIP), lambda x, y, z: z, False),
    "sphere": (scene.Sphere(type="sphere", R=0.7), lambda x, y, z: x**2 + y**2 + z**2 - 0.7**2, True),
    "ellipsoid": (
        scene.Ellipsoid(type="ellipsoid", a=1.6, b=0.9, c=0.7),
        lambda x, y, z: (x / 1.6) ** 2 + (y / 0.9) ** 2 + (z / 0.7) ** 2 - 1,
        True,
    ),
    "cylinder": (
        scene.Cylinder(type="cylinder", R=0.7, clip=CLIP),
        lambda x, y, z: x**2 + y**2 - 0.7**2,
        False,
    ),
    "cone": (
        scene.Cone(type="cone", k=0.6, clip=CLIP),
        lambda x, y, z: x**2 + y**2 - 0.6**2 * z**2,
        False,
    ),
    "paraboloid": (
        scene.Paraboloid(type="paraboloid", a=0.9, b=0.8, clip=CLIP),
        lambda x, y, z: (x / 0.9) ** 2 + (y / 0.8) ** 2 - z,
        False,
    ),
    "hyperbolic_paraboloid": (
        scene.HyperbolicParaboloid(type="hyperbolic_paraboloid", a=0.9, b=0.8, clip=CLIP),
        lambda x, y, z: (x / 0.9) ** 2 - (y / 0.8) ** 2 - z,
        False,
    ),
    "hyperboloid_one_sheet": (
        scene.HyperboloidOneSheet(type="hyperboloid_one_sheet", a=0.5, b=0.6, c=0.7, clip=CLIP),
        lambda x, y, z: (x / 0.5) ** 2 + (y / 0.6) ** 2 - (z / 0.7) ** 2 - 1,
        False,
    ),
    "hyperboloid_two_sheet": (
        scene.HyperboloidTwoSheet(type="hyperboloid_two_sheet", a=0.5, b=0.6, c=0.7, clip=CLIP),
        lambda x, y, z: (x / 0.5) ** 2 + (y / 0.6) ** 2 - (z / 0.7) ** 2 + 1,
        False,
    ),
    "quadric": (
        scene.Quadric(type="quadric", coefficients=COEFFICIENTS),
        lambda x, y, z: quadric(COEFFICIENTS, x, y, z),
        True,
    ),
    "quadric, negative definite": (
        scene.Quadric(type="quadric", coefficients=negated(COEFFICIENTS)),
        lambda x, y, z: quadric(COEFFICIENTS, x, y, z),
        True,
    ),
    "quadric, indefinite": (
        scene.Quadric(type="quadric", coefficients=(-1.0, *COEFFICIENTS[1:]), clip=CLIP),
        lambda x, y, z: quadric((-1.0, *COEFFICIENTS[1:]), x, y, z),
        False,
    ),
    "torus": torus(1.0, 0.4),
    "torus, spindle": torus(0.4, 1.0),
    "cyclide, ring": cyclide(1.0, 0.9, 0.5),
    "cyclide, horn": cyclide(1.0, 0.7, 0.3),
    "cyclide, spindle": cyclide(1.0, 0.8, 1.4),
    "cyclide, torus": cyclide(1.0, 1.0, 0.3),
    "quartic": (
        scene.Quartic(type="quartic", Q1=Q1, Q2=Q2, Q3=Q3),
        lambda x, y, z: quadric(Q1, x, y, z) * quadric(Q2, x, y, z) + quadric(Q3, x, y, z),
        True,
    ),
    "quartic, negative Q3": (
        scene.Quartic(type="quartic", Q1=Q1, Q2=Q2, Q3=FAR),
        lambda x, y, z: quadric(Q1, x, y, z) * quadric(Q2, x, y, z) + quadric(FAR, x, y, z),
        True,
    ),
    "quartic, opposite signs": (
        scene.Quartic(type="quartic", Q1=negated(Q1), Q2=Q2, Q3=negated(Q3)),
        lambda x, y, z: quadric(Q1, x, y, z) * quadric(Q2, x, y, z) + quadric(Q3, x, y, z),
        True,
    ),
    "quartic, open": (
        scene.Quartic(type="quartic", Q1=Q1, Q2=(-1.0, *Q2[1:]), Q3=Q3, clip=CLIP),
        lambda x, y, z: quadric(Q1, x, y, z) * quadric((-1.0, *Q2[1:]), x, y, z) + quadric(Q3, x, y, z),
        False,
    ),
}
TIGHT = [name for name, (surface, _, closed) in CASES.items() if closed and surface.type != "quartic"]
cases = pytest.mark.parametrize("name", CASES)


def surface_points(surface: scene.Surface, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Points of the surface on random chords of a box (low, high), by sign changes and bisection."""
    rng = np.random.default_rng(1)
    f = surfaces.form(surface)
    start, end = (rng.uniform(low, high, (20_000, 3)) for _ in range(2))
    t = np.linspace(0, 1, 33)
    chords = start[:, None] + t[:, None] * (end - start)[:, None]
    positive = surfaces.value(f, chords) > 0
    ray, cell = np.nonzero(positive[:, 1:] != positive[:, :-1])
    a, b, sign = chords[ray, cell], chords[ray, cell + 1], positive[ray, cell]
    for _ in range(48):
        middle = (a + b) / 2
        same = ((surfaces.value(f, middle) > 0) == sign)[:, None]
        a, b = np.where(same, middle, a), np.where(same, b, middle)
    return a


def box_of(surface: scene.Surface) -> np.ndarray:
    box = surfaces.bounding_box(surface)
    assert box is not None
    return np.array(box, dtype=np.float64)


@cases
def test_form_is_the_equation(name):
    """The form equals the type's equation, written out, at random points; degree <= 2 has q3 alone."""
    surface, equation, _ = CASES[name]
    f = surfaces.form(surface)
    assert (f.q1 is None) == (f.q2 is None) == (surface.type not in ("torus", "cyclide", "quartic"))
    points = np.random.default_rng(2).uniform(-3, 3, (1000, 3))
    expected = equation(*points.T)
    np.testing.assert_allclose(surfaces.value(f, points), expected, rtol=1e-9, atol=1e-11)


def test_form_keeps_the_binary_value():
    """A length enters the form exactly: 0.1 is the float64 nearest to one tenth, squared without rounding."""
    with mp.workprec(256):
        exact = -(mpf(3602879701896397) ** 2) / mpf(2) ** 110
        assert surfaces.form(scene.Sphere(type="sphere", R=0.1)).q3[9] == exact
        ellipsoid = surfaces.form(scene.Ellipsoid(type="ellipsoid", a=0.1, b=1, c=1))
        assert abs(ellipsoid.q3[0] * -exact - 1) < mpf(2) ** -250


@cases
def test_only_closed_surfaces_have_a_box(name):
    """Open surfaces have no box; closed ones have one, and F is positive outside it."""
    surface, _, closed = CASES[name]
    box = surfaces.bounding_box(surface)
    assert (box is not None) == closed
    if closed:
        low, high = box_of(surface)
        direction = np.random.default_rng(3).normal(size=(1000, 3))
        direction /= np.abs(direction).max(axis=1, keepdims=True)
        outside = (low + high) / 2 + 1.001 * direction * (high - low) / 2
        assert (surfaces.value(surfaces.form(surface), outside) > 0).all()


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case[2]])
def test_box_holds_the_surface(name):
    """Every point of the surface found on chords of a box twice the size lies in the box."""
    surface = CASES[name][0]
    low, high = box_of(surface)
    margin = (high - low) / 2
    points = surface_points(surface, low - margin, high + margin)
    assert len(points) > 500
    assert (points >= low - 1e-9).all()
    assert (points <= high + 1e-9).all()


@pytest.mark.parametrize("name", TIGHT)
def test_box_is_tight(name):
    """Each face of the box comes within 1 % of its width of a point of the surface."""
    low, high = box_of(CASES[name][0])
    points = surface_points(CASES[name][0], low, high)
    assert (points.min(axis=0) - low <= 0.01 * (high - low)).all()
    assert (high - points.max(axis=0) <= 0.01 * (high - low)).all()


def test_box_of_a_skewed_ellipsoid_is_exact():
    """The quadric's box touches the surface: F and two derivatives vanish at the touching points."""
    q = surfaces.form(CASES["quadric"][0]).q3
    low, high = surfaces.bounding_box(CASES["quadric"][0])
    a = np.array([[q[0], q[3] / 2, q[5] / 2], [q[3] / 2, q[1], q[4] / 2], [q[5] / 2, q[4] / 2, q[2]]], float)
    inverse = np.linalg.inv(a)
    for i in range(3):
        centre = np.array([(lo + hi) / 2 for lo, hi in zip(low, high, strict=True)], float)
        half = float(high[i] - low[i]) / 2
        touch = centre + half * inverse[i] / inverse[i, i]
        gradient = surfaces.gradient(surfaces.form(CASES["quadric"][0]), touch)
        assert abs(surfaces.value(surfaces.form(CASES["quadric"][0]), touch)) < 1e-12
        assert np.abs(np.delete(gradient, i)).max() < 1e-12


def test_empty_ellipsoid_has_a_box_of_no_size():
    """x^2 + y^2 + z^2 - 2x + 5 = 0 has no real point; the box is its centre."""
    surface = scene.Quadric(type="quadric", coefficients=(1, 1, 1, 0, 0, 0, -2, 0, 0, 5))
    assert surfaces.bounding_box(surface) == ((1, 0, 0), (1, 0, 0))


@pytest.mark.parametrize("coefficients", [(1, 1, 0, 0, 0, 0, 0, 0, -1, 0), (1, 1, 0.25, 0, 1, 0, 0, 0, 0, -1)])
def test_singular_quadric_is_open(coefficients):
    """A quadratic part of rank 2 is not definite, though its other eigenvalues have one sign."""
    surface = scene.Quadric(type="quadric", coefficients=coefficients, clip=CLIP)
    assert surfaces.bounding_box(surface) is None


def test_constant_quartic_is_recognised_exactly():
    """Q1*Q2 + Q3 is constant only if every other coefficient cancels, to the last bit."""
    q1, q2 = (0,) * 6 + (0.1, 0, 0, 1), (0,) * 6 + (0, 0, 0, 0.5)
    q3 = [0.0] * 6 + [-0.05, 0, 0, 7]
    assert surfaces.is_constant(q1, q2, q3)
    q3[6] = np.nextafter(q3[6], 0)
    assert not surfaces.is_constant(q1, q2, q3)


@cases
def test_gradient_is_the_derivative(name):
    """The gradient equals central differences of the equation, for any leading shape."""
    surface, equation, _ = CASES[name]
    points = np.random.default_rng(4).uniform(-1.5, 1.5, (10, 20, 3))
    got = surfaces.gradient(surfaces.form(surface), points)
    assert got.shape == points.shape
    h = 1e-5
    for i in range(3):
        step = h * np.eye(3)[i]
        slope = (equation(*np.moveaxis(points + step, -1, 0)) - equation(*np.moveaxis(points - step, -1, 0))) / (2 * h)
        np.testing.assert_allclose(got[..., i], slope, rtol=1e-6, atol=1e-6)


@cases
def test_normal_direction_is_the_gradient(name):
    """For an algebraic type the direction of the normal is the gradient of its form."""
    surface = CASES[name][0]
    points = np.random.default_rng(5).uniform(-1.5, 1.5, (10, 20, 3))
    expected = surfaces.gradient(surfaces.form(surface), points)
    np.testing.assert_array_equal(surfaces.normal_direction(surface, points), expected)


# ---- Spiral ------------------------------------------------------------------------------------------------


def tube(R, r, pitch, turns, R_growth=0.0, r_growth=0.0):
    keys = {"R": R, "r": r, "pitch": pitch, "turns": turns, "R_growth": R_growth, "r_growth": r_growth}
    return scene.Spiral(type="spiral", **keys)


SPIRALS = {
    "helix": tube(0.6, 0.1, 0.35, 3.0),
    "helix, left-handed": tube(0.6, 0.15, -0.25, 2.3),
    "helix, fused": tube(0.6, 0.3, 0.2, 2.6),
    "shell": tube(0.09, 0.08, -0.22, 3.7, 0.18, 0.125),
    "flat": tube(0.2, 0.05, 0.0, 4.0, 0.18),
    "shrinking": tube(0.9, 0.2, 0.1, 2.5, -0.2, -0.05),
    "counter-growing": tube(0.5, 0.3, 0.3, 1.9, 0.2, -0.1),
    "one turn": tube(0.7, 0.2, 0.5, 1.0),
    "ring": tube(1.0, 0.4, 0.0, 1.0),
    "horseshoe": tube(0.6, 0.1, 0.1, 0.8, 0.2, 0.1),
    "half": tube(0.6, 0.1, 0.1, 0.6),
    "arc": tube(0.6, 0.1, -0.4, 0.35, -0.5, 0.2),
    "piece": tube(0.6, 0.1, 0.3, 0.1, 1.5, 0.3),
}
spirals = pytest.mark.parametrize("name", SPIRALS)


def curve(s: scene.Spiral, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors (n, 3) from the axis towards the centre curve, and its points (n, 3), after t turns (n)."""
    radial = np.stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t), 0 * t], axis=-1)
    return radial, (s.R + s.R_growth * t)[:, None] * radial + s.pitch * t[:, None] * np.array([0, 0, 1])


def skin(s: scene.Spiral, n: int = 200_000) -> np.ndarray:
    """Random points (2n, 3) of the rims of all disks and of the surfaces of both end balls: the solid's and within."""
    rng = np.random.default_rng(6)
    t = np.concatenate([[0, s.turns], rng.uniform(0, s.turns, n - 2)])
    radial, centre = curve(s, t)
    angle = rng.uniform(0, 2 * np.pi, n)[:, None]
    rims = centre + (s.r + s.r_growth * t)[:, None] * (np.cos(angle) * radial + np.sin(angle) * np.array([0, 0, 1]))
    t = np.where(rng.uniform(size=n) < 0.5, 0, s.turns)
    direction = rng.normal(size=(n, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.concatenate([rims, curve(s, t)[1] + (s.r + s.r_growth * t)[:, None] * direction])


def searched_value(s: scene.Spiral, point: np.ndarray) -> float:
    """The indicator at one point: follow the curve, stop where its half plane sweeps over the point."""
    t = np.linspace(0, s.turns, 20_001)
    radial, centre = curve(s, t)
    side = radial[:, 0] * point[1] - radial[:, 1] * point[0]
    i = np.nonzero((side[:-1] > 0) & (side[1:] <= 0))[0]
    passed = t[i] + side[i] / (side[i] - side[i + 1]) * (t[1] - t[0])
    t = np.concatenate([passed, [0, s.turns]])
    return float((np.linalg.norm(point - curve(s, t)[1], axis=1) - s.r - s.r_growth * t).min())


def around(s: scene.Spiral, shape: tuple[int, ...]) -> np.ndarray:
    """Random points (*shape, 3) of a box half as large again as the spiral's."""
    low, high = box_of(s)
    return np.random.default_rng(7).uniform(low - (high - low) / 4, high + (high - low) / 4, (*shape, 3))


@spirals
def test_spiral_value_is_the_distance_to_disks_and_balls(name):
    """The indicator equals that of a search along the centre curve; any leading shape."""
    s = SPIRALS[name]
    points = around(s, (4, 50))
    got = spiral.value(s, points)
    assert got.shape == (4, 50)
    expected = [searched_value(s, p) for p in points.reshape(-1, 3)]
    np.testing.assert_allclose(got.ravel(), expected, rtol=0, atol=1e-9)
    assert spiral.value(s, points[0, 0]) == got[0, 0]


def test_spiral_of_one_flat_turn_is_a_torus():
    """Without pitch and growth one turn is the torus, whose distance is known; its gradient has length 1."""
    points = around(SPIRALS["ring"], (1000,))
    rho = np.hypot(points[:, 0], points[:, 1])
    np.testing.assert_allclose(spiral.value(SPIRALS["ring"], points), np.hypot(rho - 1, points[:, 2]) - 0.4, atol=1e-14)
    gradient = spiral.gradient(SPIRALS["ring"], points)
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1), 1, atol=1e-14)


@spirals
def test_spiral_holds_its_disks_and_balls(name):
    """No point of a rim or of an end ball is outside; around the box of the spiral everything is."""
    s = SPIRALS[name]
    assert spiral.value(s, skin(s)).max() < 1e-12
    low, high = box_of(s)
    direction = np.random.default_rng(3).normal(size=(10_000, 3))
    direction /= np.abs(direction).max(axis=1, keepdims=True)
    assert (spiral.value(s, (low + high) / 2 + 1.001 * direction * (high - low) / 2) > 0).all()


@spirals
def test_spiral_box_holds_the_surface(name):
    """Every point of the rims and end balls lies in the box, whose faces are touched; if R or r grows, those of z.

    From one turn on, the sides are as far from the axis as the farthest point.
    """
    s = SPIRALS[name]
    low, high = box_of(s)
    points = skin(s)
    assert (points >= low - 1e-12).all()
    assert (points <= high + 1e-12).all()
    gap = np.array([points.min(axis=0) - low, high - points.max(axis=0)]) / (high - low)
    grows = s.R_growth or s.r_growth
    assert gap[:, 2].max() < 0.01
    assert gap.max() < (0.3 if grows else 0.01)
    if s.turns >= 1:
        reach = np.hypot(points[:, 0], points[:, 1]).max()
        np.testing.assert_allclose([-low[:2], high[:2]], reach, rtol=0.01)


@pytest.mark.parametrize(
    ("turns", "low", "high"),
    [
        (0.125, (0.5**0.5 - 0.1, -0.1), (1.1, 0.5**0.5 + 0.1)),
        (0.25, (-0.1, -0.1), (1.1, 1.1)),
        (0.375, (-(0.5**0.5) - 0.1, -0.1), (1.1, 1.1)),
        (0.5, (-1.1, -0.1), (1.1, 1.1)),
        (0.75, (-1.1, -1.1), (1.1, 1.1)),
        (0.7499, (-1.1, -np.cos(2 * np.pi * 0.0001) - 0.1), (1.1, 1.1)),
        (1.0, (-1.1, -1.1), (1.1, 1.1)),
    ],
)
def test_spiral_box_of_a_part_of_a_turn(turns, low, high):
    """Worked out by hand for R = 1, r = 0.1 without pitch."""
    got = box_of(tube(1.0, 0.1, 0.0, turns))
    np.testing.assert_allclose(got, [(*low, -0.1), (*high, 0.1)], atol=1e-15)


def test_spiral_box_keeps_the_binary_values():
    """The box is computed from the exact numbers of the scene, to 256 bits."""
    with mp.workprec(256):
        exact = mpf(0.1) * mpf(3) + mpf(0.1)
        assert surfaces.bounding_box(tube(0.6, 0.1, 0.1, 3.0))[1][2] == exact


@spirals
def test_spiral_gradient_is_the_derivative(name):
    """The gradient equals central differences of the indicator wherever that is smooth, for any leading shape."""
    s = SPIRALS[name]
    points = around(s, (20, 50))
    got = spiral.gradient(s, points)
    assert got.shape == points.shape
    h = 1e-5
    steps = [h * np.eye(3)[i] for i in range(3)]
    middle = spiral.value(s, points)
    before, after = (np.stack([spiral.value(s, points + sign * step) for step in steps], -1) for sign in (-1, 1))
    smooth = (np.abs(before + after - 2 * middle[..., None]) < 1e-7).all(axis=-1)
    assert smooth.mean() > 0.98
    np.testing.assert_allclose(got[smooth], ((after - before) / (2 * h))[smooth], rtol=0, atol=1e-5)


@spirals
def test_spiral_normal_points_out_of_the_surface(name):
    """A small step along the normal leaves the solid and one against it enters; on the surface it never vanishes."""
    s = SPIRALS[name]
    points = skin(s, 5000)
    points = points[spiral.value(s, points) > -1e-12]
    assert len(points) > 1000
    normal = surfaces.normal_direction(s, points)
    np.testing.assert_array_equal(normal, spiral.gradient(s, points))
    step = 1e-6 * normal / np.linalg.norm(normal, axis=1, keepdims=True)
    assert (spiral.value(s, points + step) > 0).all()
    assert (spiral.value(s, points - step) < 0).all()


def test_spiral_gradient_where_it_has_none():
    """0 on the axis and at the centres of disks and balls; no division by zero on the way."""
    s = tube(0.5, 0.25, 1.0, 1.5)
    points = np.array([[0, 0, 0.9], [0, 0.5, 0.25], [0.5, 0, 0], [0.5, 0, 1.0]])
    points[1] = curve(s, np.array([0.25]))[1][0]
    with np.errstate(all="raise", under="ignore"):
        gradient = spiral.gradient(s, points)
        spiral.gradient(s, np.zeros(3))
    assert np.abs(gradient[[0, 2, 3]]).max() == 0
    assert np.isfinite(gradient).all()


def test_spiral_seam():
    """Half plane 0 belongs to the turn that begins there, also for an azimuth that rounds to a whole turn."""
    s = tube(0.5, 0.1, 0.25, 2.0)
    for y in (0.0, -0.0, 1e-300, -1e-300, 1e-20, -1e-20):
        points = np.array([[0.5, y, z] for z in (0.1, 0.25, 0.5)])
        np.testing.assert_allclose(spiral.value(s, points), [0, -0.1, -0.1], atol=1e-12)
