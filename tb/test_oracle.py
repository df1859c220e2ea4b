# SPDX-License-Identifier: Apache-2.0
"""The float64 oracle against 50-digit arithmetic, closed forms and hand-made corner cases; its statistics."""

from pathlib import Path
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from mpmath import mp, mpf

from raydix import oracle
from raydix.accuracy import depth_errors
from raydix.scene import load_scene

IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
TURNED = [[0.48, -0.8, 0.36], [0.6, 0.0, -0.8], [0.64, 0.6, 0.48]]
BOX = ((-1.2, -1.1, -1.0), (1.0, 1.3, 0.9))


def surface(kind, clip=None, center=(0.0, 0.0, 0.0), matrix=IDENTITY, scale=1.0, **parameters):
    """Stand-in for a surface of a scene."""
    return SimpleNamespace(type=kind, clip=clip, center=center, matrix=matrix, scale=scale, opacity=1.0, **parameters)


def scene(*surfaces, eye=(3.0, -4.0, 2.5), look_at=(0.0, 0.0, 0.0), vfov=30.0, width=1, height=1):
    """Stand-in for a scene; by default one pixel, whose ray is the view axis."""
    camera = SimpleNamespace(eye=eye, look_at=look_at, up=(0.0, 0.0, 1.0), vfov=vfov, width=width, height=height)
    return SimpleNamespace(camera=camera, surfaces=list(surfaces))


def along(axis_point, **parameters):
    """Scene arguments for one ray in the direction -x through the given (y, z), from x = 5."""
    y, z = axis_point
    return dict(eye=(5.0, y, z), look_at=(0.0, y, z), **parameters)


# ---------------------------------------------------------------- 50 digits

# The implicit functions as the scene format defines them: name -> (parameters, clip, F(s, x, y, z)).
TYPES = {
    "plane": ({}, BOX, lambda s, x, y, z: z),
    "sphere": ({"R": 1.1}, None, lambda s, x, y, z: x**2 + y**2 + z**2 - s.R**2),
    "ellipsoid": (
        {"a": 1.2, "b": 0.5, "c": 0.8},
        None,
        lambda s, x, y, z: x**2 / s.a**2 + y**2 / s.b**2 + z**2 / s.c**2 - 1,
    ),
    "cylinder": ({"R": 0.7}, BOX, lambda s, x, y, z: x**2 + y**2 - s.R**2),
    "cone": ({"k": 0.6}, BOX, lambda s, x, y, z: x**2 + y**2 - s.k**2 * z**2),
    "paraboloid": ({"a": 0.9, "b": 1.3}, BOX, lambda s, x, y, z: x**2 / s.a**2 + y**2 / s.b**2 - z),
    "hyperbolic_paraboloid": (
        {"a": 0.9, "b": 1.3},
        BOX,
        lambda s, x, y, z: x**2 / s.a**2 - y**2 / s.b**2 - z,
    ),
    "hyperboloid_one_sheet": (
        {"a": 0.5, "b": 0.6, "c": 0.7},
        BOX,
        lambda s, x, y, z: x**2 / s.a**2 + y**2 / s.b**2 - z**2 / s.c**2 - 1,
    ),
    "hyperboloid_two_sheet": (
        {"a": 0.5, "b": 0.6, "c": 0.3},
        BOX,
        lambda s, x, y, z: x**2 / s.a**2 + y**2 / s.b**2 - z**2 / s.c**2 + 1,
    ),
    "quadric": (
        {"coefficients": [1.0, 0.75, -0.5, 0.3, -0.7, 0.2, 0.1, -0.25, 0.4, -0.3]},
        BOX,
        lambda s, x, y, z: ten(s.coefficients, x, y, z),
    ),
    "torus": (
        {"R": 0.9, "r": 0.3},
        None,
        lambda s, x, y, z: (x**2 + y**2 + z**2 + s.R**2 - s.r**2) ** 2 - 4 * s.R**2 * (x**2 + y**2),
    ),
    "cyclide": (
        {"a": 0.9, "b": 0.85, "d": 0.4},
        None,
        lambda s, x, y, z: (
            (x**2 + y**2 + z**2 + s.b**2 - s.d**2) ** 2
            - 4 * (s.a * x - mp.sqrt(s.a**2 - s.b**2) * s.d) ** 2
            - 4 * s.b**2 * y**2
        ),
    ),
    "quartic": (
        {
            "Q1": [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, -0.4],
            "Q2": [0.0, 1.0, 1.0, 0.2, 0.0, 0.0, 0.0, 0.3, 0.0, -0.3],
            "Q3": [0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.05, -0.02],
        },
        BOX,
        lambda s, x, y, z: ten(s.Q1, x, y, z) * ten(s.Q2, x, y, z) + ten(s.Q3, x, y, z),
    ),
}


def ten(q, x, y, z):
    """A quadric from its ten coefficients xx, yy, zz, xy, yz, zx, x, y, z, 1."""
    terms = (x * x, y * y, z * z, x * y, y * z, z * x, x, y, z, 1)
    return sum(a * b for a, b in zip(q, terms, strict=True))


def exact_hits(scene, item, implicit, x, y):
    """Accepted depths of pixel (x, y) to 50 digits, from the definitions of camera, transform and surface."""
    vec = mpmath.matrix

    def cross(a, b):
        return vec([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])

    camera = scene.camera
    exact = SimpleNamespace(**{k: numbers(v) for k, v in vars(item).items()})
    eye = vec(list(camera.eye))
    forward = vec(list(camera.look_at)) - eye
    forward /= mp.norm(forward)
    right = cross(forward, vec(list(camera.up)))
    right /= mp.norm(right)
    up = cross(right, forward)
    pixel = 2 * mp.tan(mp.radians(mpf(camera.vfov)) / 2) / camera.height
    half = mpf(1) / 2
    direction = (
        forward + (x + half - mpf(camera.width) / 2) * pixel * right + (mpf(camera.height) / 2 - y - half) * pixel * up
    )
    inverse = mpmath.inverse(vec(exact.matrix))
    origin = inverse * (eye - vec(exact.center)) / exact.scale
    direction = inverse * direction / exact.scale

    # F(t) about t = 5 from five values: interpolation is exact for degree <= 4
    samples = [mpf(t) for t in (-2, -1, 0, 1, 2)]
    values = [implicit(exact, *(origin + (t + 5) * direction)) for t in samples]
    c = list(mpmath.lu_solve(vec([[t**k for k in range(5)] for t in samples]), vec(values)))
    while len(c) > 1 and abs(c[-1]) < mpf(10) ** -40:
        c.pop()
    roots = mpmath.polyroots(c, asc=True, maxsteps=500, extraprec=400) if len(c) > 1 else []
    depths = sorted(mp.re(r) + 5 for r in roots if abs(mp.im(r)) < mpf(10) ** -30)
    return [t for t in depths if t > 0 and inside(exact.clip, origin + t * direction)]


def numbers(value):
    """The same structure with every float as an mpf, so that no operation falls back to float64."""
    if isinstance(value, (list, tuple)):
        return [numbers(v) for v in value]
    return mpf(value) if isinstance(value, float) else value


def inside(clip, point):
    return clip is None or all(lo <= p <= hi for lo, p, hi in zip(clip[0], point, clip[1], strict=True))


@pytest.mark.parametrize("kind", TYPES)
def test_all_roots_agree_with_50_digits(kind):
    """Every type, turned, scaled and moved: the same number of roots, each to 2e-14 relative or better."""
    parameters, clip, implicit = TYPES[kind]
    item = surface(kind, clip, (0.1, -0.2, 0.05), TURNED, 1.25, **parameters)
    view = scene(item, eye=(4.2, 1.5, 0.6), width=15, height=12, vfov=35.0)
    hits = oracle.ideal_hits(view, 0)
    worst = 0.0
    with mp.workdps(50):
        for y, x in np.ndindex(hits.count.shape):
            exact = exact_hits(view, item, implicit, x, y)
            assert hits.count[y, x] == len(exact), (kind, x, y, exact, hits.depth[y, x])
            assert np.all(np.isinf(hits.depth[y, x, len(exact) :]))
            for t, depth in zip(exact, hits.depth[y, x], strict=False):
                worst = max(worst, float(abs(t - mpf(float(depth))) / t))
    most = {"torus": 4, "cyclide": 4, "quartic": 4, "plane": 1}.get(kind, 2)
    assert hits.count.max() >= most, "the view tests too little"
    assert (hits.count == 0).any(), "the view has no miss"
    assert worst < 2e-14


# ---------------------------------------------------------------- closed forms and corners


def test_sphere_depth_is_the_closed_form():
    """On the view axis a sphere is hit at distance - R and distance + R, wherever it is and however large."""
    center = np.array([-1.0, 2.0, 0.5])
    eye = np.array([3.0, -4.0, 2.5])
    distance = np.linalg.norm(center - eye)
    for radius in (1e-3, 0.5, 7.0):
        item = surface("sphere", center=tuple(center), scale=2.0, R=radius / 2)
        hits = oracle.ideal_hits(scene(item, look_at=tuple(center)), 0)
        expected = [t for t in (distance - radius, distance + radius) if t > 0]
        assert hits.count[0, 0] == len(expected)
        assert hits.depth[0, 0, : len(expected)] == pytest.approx(expected, rel=1e-14)


def test_depth_is_measured_along_the_view_axis():
    """A plane across the view is at one depth for all pixels, right to the corners."""
    item = surface("plane", ((-9.0, -9.0, -1.0), (9.0, 9.0, 1.0)), matrix=[[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    hits = oracle.ideal_hits(scene(item, **along((0.0, 0.0)), vfov=90.0, width=8, height=6), 0)
    assert (hits.count == 1).all()
    assert hits.depth[..., 0] == pytest.approx(5.0, rel=1e-14)


def test_image_orientation():
    """Row 0 is on top, x grows to the right: looking along +y, world +x is right and +z is up."""
    item = surface("sphere", center=(1.0, 0.0, 0.5), R=0.2)
    frame = oracle.ideal_frame(scene(item, eye=(0.0, -5.0, 0.0), vfov=30.0, width=80, height=60))
    rows, columns = np.nonzero(frame.surface == 0)
    pixel = 2 * np.tan(np.radians(15)) / 60
    assert columns.mean() + 0.5 == pytest.approx(40 + 1.0 / 5 / pixel, abs=0.3)
    assert rows.mean() + 0.5 == pytest.approx(30 - 0.5 / 5 / pixel, abs=0.3)


@pytest.mark.parametrize("epsilon", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    "item, edge",
    [
        (surface("sphere", R=0.75), 0.75),
        (
            surface("cylinder", ((-1, -1, -1), (1, 1, 1)), matrix=[[1, 0, 0], [0, 0, 1], [0, 1, 0]], R=0.75),
            0.75,
        ),
        (surface("torus", R=1.0, r=0.25), 0.25),
    ],
    ids=["sphere", "cylinder", "torus"],
)
def test_tangent_rays(item, edge, epsilon):
    """A ray just below the top edge hits, one just above misses, and clearance shrinks with the distance."""
    below = oracle.ideal_hits(scene(item, **along((0.0, edge * (1 - epsilon)))), 0)
    above = oracle.ideal_hits(scene(item, **along((0.0, edge * (1 + epsilon)))), 0)
    assert below.count[0, 0] == (4 if item.type == "torus" else 2)
    assert above.count[0, 0] == 0
    for hits in (below, above):
        assert 0 < hits.clearance[0, 0] < 4 * epsilon
    if item.type != "torus":
        chord = 2 * edge * np.sqrt(epsilon * (2 - epsilon))
        assert np.diff(below.depth[0, 0, :2])[0] == pytest.approx(chord, rel=1e-15 / epsilon + 1e-9)


def test_touching_ray():
    """Exactly tangent: zero counts as not positive, so a touch from the positive side has no or two roots."""
    hits = oracle.ideal_hits(scene(surface("sphere", R=0.75), **along((0.0, 0.75))), 0)
    assert hits.clearance[0, 0] == 0.0
    if hits.count[0, 0]:
        assert hits.depth[0, 0, :2] == pytest.approx([5.0, 5.0])


def test_degenerate_degree():
    """Rays on which the leading coefficient vanishes: along a paraboloid's axis, along an asymptote."""
    axis_x = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]  # local z is world x
    box = ((-3.0, -3.0, -3.0), (3.0, 3.0, 3.0))
    bowl = surface("paraboloid", box, matrix=axis_x, a=1.0, b=1.0)
    hits = oracle.ideal_hits(scene(bowl, **along((0.5, 1.0))), 0)
    assert hits.count[0, 0] == 1
    assert hits.depth[0, 0, 0] == pytest.approx(5.0 - 1.25, rel=1e-14)

    waist = surface("hyperboloid_one_sheet", box, a=1.0, b=1.0, c=1.0)
    toward = scene(waist, eye=(5.0, 0.0, 4.5), look_at=(4.0, 0.0, 3.5))  # x = z + 1/2: x^2 - z^2 = 1 once
    hits = oracle.ideal_hits(toward, 0)
    assert hits.count[0, 0] == 1
    assert hits.depth[0, 0, 0] == pytest.approx((5.0 - 1.25) * np.sqrt(2), rel=1e-14)

    inside_plane = scene(surface("plane", box), **along((0.5, 0.0)))
    assert oracle.ideal_hits(inside_plane, 0).count[0, 0] == 0


def test_clip_box_is_closed_and_adds_no_faces():
    """Half a sphere: one root is kept, the one outside is not, and the cut is open."""
    half = surface("sphere", ((-2.0, -2.0, -2.0), (0.0, 2.0, 2.0)), R=1.0)
    hits = oracle.ideal_hits(scene(half, **along((0.0, 0.0))), 0)
    assert hits.depth[0, 0, 0] == pytest.approx(6.0, rel=1e-14) and hits.count[0, 0] == 1

    tight = surface("plane", ((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)), (0.3, 0.1, 0.2), TURNED, 1.1)
    loose = surface("plane", ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)), (0.3, 0.1, 0.2), TURNED, 1.1)
    both = scene(tight, loose, width=32, height=24)
    assert oracle.ideal_hits(both, 0).count.sum() > 50
    assert np.array_equal(oracle.ideal_hits(both, 0).count, oracle.ideal_hits(both, 1).count)


def test_clearance_at_the_clip_box():
    """A root close to a face of the box makes the clearance small, whichever side it is on."""
    for z in (0.5 - 1e-7, 0.5 + 1e-7):
        slab = surface("cylinder", ((-1.0, -1.0, -0.5), (1.0, 1.0, 0.5)), R=0.7)
        hits = oracle.ideal_hits(scene(slab, **along((0.0, z))), 0)
        assert hits.count[0, 0] == (2 if z < 0.5 else 0)
        assert hits.clearance[0, 0] == pytest.approx(2e-7, rel=1e-3)


def test_eye_inside_sees_only_what_is_in_front():
    """Roots behind the eye are not accepted."""
    hits = oracle.ideal_hits(scene(surface("sphere", R=20.0), width=4, height=3), 0)
    assert (hits.count == 1).all()


def test_frame_takes_the_nearest_and_the_lower_number():
    """The nearest surface wins; at equal depth the lower surface number."""
    small, large = surface("sphere", R=0.5), surface("sphere", R=1.0)
    frame = oracle.ideal_frame(scene(small, large, large, width=41, height=31))
    assert set(np.unique(frame.surface)) == {-1, 1}
    assert np.array_equal(np.isinf(frame.depth), frame.surface == -1)

    half = surface("sphere", ((-2.0, -2.0, -2.0), (0.0, 2.0, 2.0)), R=1.0)
    frame = oracle.ideal_frame(scene(half, small, **along((0.0, 0.0))))
    assert frame.surface[0, 0] == 1 and frame.depth[0, 0] == pytest.approx(4.5, rel=1e-14)


def test_spiral_is_not_a_polynomial():
    """A surface without a polynomial is named, not guessed."""
    with pytest.raises(oracle.NotPolynomial, match="spiral"):
        oracle.quadrics(surface("spiral", R=0.6, r=0.1))


def test_scene_file():
    """The loaded torus scene and a stand-in with the same numbers give the same frame."""
    loaded = load_scene(Path(__file__).parent.parent / "scenes" / "torus.toml", 64, 48)
    tilted = [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]]
    by_hand = scene(surface("torus", matrix=tilted, R=1.0, r=0.4), width=64, height=48)
    ours, theirs = oracle.ideal_frame(by_hand), oracle.ideal_frame(loaded)
    assert np.array_equal(ours.surface, theirs.surface) and (ours.surface == 0).sum() > 1000
    assert np.array_equal(ours.depth, theirs.depth)


# ---------------------------------------------------------------- statistics


def frame(depth, surfaces, ulp=()):
    """Stand-in for a frame of one row."""
    return SimpleNamespace(depth=np.array([depth]), surface=np.array([surfaces], np.int16), ulp=np.array(ulp))


def test_depth_errors():
    """Silhouette, other surface and hit pixels are told apart; an error counts in ulp of the coarser surface."""
    inf = np.inf
    rendered = frame([1.0, 2.0, 3.0, inf, 5.0, inf], [0, 1, 0, -1, 1, -1], [0.25, 0.5])
    ideal = frame([1.5, 2.0, 3.5, 4.0, inf, inf], [0, 1, 1, 0, -1, -1])
    errors = depth_errors(rendered, ideal)
    assert (errors.pixels, errors.hit, errors.silhouette, errors.other) == (6, 4, 2, 1)
    assert errors.rms == pytest.approx(np.sqrt(0.5 / 3))
    assert (errors.max, errors.ulp, errors.ulp_max) == (0.5, 0.5, 2.0)
    assert errors.ulp_rms == pytest.approx(np.sqrt((4.0 + 0.0 + 1.0) / 3))


def test_depth_errors_without_a_common_hit():
    """With nothing to compare the errors are NaN, null in JSON: no limit is kept by accident."""
    errors = depth_errors(frame([1.0], [0], [0.5]), frame([np.inf], [-1]))
    assert errors.silhouette == 1 and np.isnan(errors.max) and errors.as_json()["ulp_max"] is None
