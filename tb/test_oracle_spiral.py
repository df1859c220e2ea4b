# SPDX-License-Identifier: Apache-2.0
"""The oracle's spirals against the torus's quartic, closed forms and plain numpy that samples much denser."""

from types import SimpleNamespace

import numpy as np
import pytest

from raydix import oracle, oracle_spiral
from raydix.oracle_spiral import spiral_chord_roots, spiral_value
from test_oracle import TURNED, along, scene, surface

RING = dict(R=0.7, r=0.25)
HELIX = dict(R=0.75, r=0.125, pitch=0.5, turns=3.0)
GROWN = {
    "flat": dict(R=0.2, r=0.03, pitch=0.0, turns=3.6, R_growth=0.18, r_growth=0.01),
    "shell": dict(R=0.9, r=0.3, pitch=0.45, turns=2.75, R_growth=-0.25, r_growth=-0.09),
    "cone": dict(R=0.3, r=0.1, pitch=-0.3, turns=4.0, R_growth=0.15, r_growth=0.02),
    "overlapping": dict(R=0.6, r=0.2, pitch=0.07, turns=5.3, R_growth=-0.01, r_growth=0.0),
    "steep": dict(R=0.4, r=0.15, pitch=3.0, turns=0.8, R_growth=0.3, r_growth=-0.1),
    "arc": dict(R=0.8, r=0.2, pitch=0.2, turns=0.15, R_growth=0.0, r_growth=0.3),
}


def spiral(clip=None, **parameters):
    """Stand-in for a spiral of a scene; what is not given is one turn of a ring."""
    placement = {key: parameters.pop(key) for key in ("center", "matrix", "scale") if key in parameters}
    values = dict(pitch=0.0, turns=1.0, R_growth=0.0, r_growth=0.0) | parameters
    return surface("spiral", clip, **placement, **values)


def centre(shape, s):
    """The centre curve at s (...), and the tube's radius there: (..., 3), (...)."""
    a = shape.R + shape.R_growth * s
    curve = np.stack([a * np.cos(2 * np.pi * s), a * np.sin(2 * np.pi * s), shape.pitch * s], axis=-1)
    return curve, shape.r + shape.r_growth * s


def chords(shape, count, seed):
    """Ends (count, 3) of random chords from a sphere about the solid.

    A quarter passes close to the axis, from 1e-9 on, and half goes through or past the tube.
    """
    dice = np.random.default_rng(seed)
    size = max(shape.R + shape.r, shape.R + shape.r + (shape.R_growth + shape.r_growth) * shape.turns)
    height = shape.pitch * shape.turns
    ends = dice.normal(size=(2, count, 3))
    ends *= 1.1 * (size + abs(height) / 2) / np.linalg.norm(ends, axis=2, keepdims=True)
    ends[..., 2] += height / 2
    h, e = ends
    quarter = count // 4
    ends[:, :quarter, :2] *= 10 ** dice.uniform(-9, 0, (2, quarter, 1))
    middle, radius = centre(shape, dice.uniform(0, shape.turns, 2 * quarter))
    middle += radius[:, None] * dice.normal(size=middle.shape)
    e[-2 * quarter :] = 2 * middle - h[-2 * quarter :]
    return h, e


def counted(roots):
    """How many roots each chord has."""
    return np.isfinite(roots).sum(axis=1)


def one(shape, h, e, **options):
    """Roots and clearance of one chord."""
    roots, clearance = spiral_chord_roots(shape, np.array([h]), np.array([e]), **options)
    return roots[0][np.isfinite(roots[0])], clearance[0]


def value(s, points):
    """f at points (..., 3) as it is defined: rotate the point into each disk's half plane, try all disks and balls."""
    x, y, z = np.moveaxis(points, -1, 0)
    theta = np.angle(x + 1j * y) / (2 * np.pi)
    theta = np.where(theta < 0, theta + 1, theta)
    best = np.full(x.shape, np.inf)
    for end in (0.0, s.turns):
        middle, radius = centre(s, end)
        best = np.minimum(best, np.linalg.norm(points - middle, axis=-1) - radius)
    for m in range(int(s.turns) + 1):
        turn = m + theta
        distance = np.hypot(np.hypot(x, y) - s.R - s.R_growth * turn, z - s.pitch * turn) - s.r - s.r_growth * turn
        best = np.where(turn <= s.turns, np.minimum(best, distance), best)
    return best


# ---------------------------------------------------------------- against the quartic


def test_one_flat_turn_is_a_torus():
    """20,000 chords: as many roots as the torus's quartic has, within 1e-9, but for chords nearly tangent."""
    h, e = chords(spiral(**RING), 20_000, 1)
    roots, clearance = spiral_chord_roots(spiral(**RING), h, e)
    exact = oracle.chord_roots(oracle.quadrics(surface("torus", **RING)), h, e)
    same = counted(roots) == counted(exact)
    assert (counted(exact) == 4).sum() > 1000 and (counted(exact) == 2).sum() > 5000
    assert (same | (clearance < 1e-6)).all()
    assert (clearance < 1e-6).sum() < 10 and (clearance < 1e-3).sum() > 50
    assert np.nanmax(np.abs(roots[:, :4] - exact)[same]) < 1e-9
    assert np.isnan(roots[:, 4:]).all()


@pytest.mark.parametrize("clip", [None, ((-0.8, -0.9, -0.2), (0.85, 0.6, 0.15))], ids=["whole", "clipped"])
@pytest.mark.parametrize("eye", [(2.6, -1.9, 1.4), (0.35, 0.1, 0.3), (0.9, 0.1, 0.2)], ids=["far", "in the hole", "in"])
def test_image_of_a_torus(eye, clip):
    """Turned, scaled, moved, clipped, from inside and outside: the depths of the torus's quartic."""
    placed = dict(center=(0.1, -0.2, 0.05), matrix=TURNED, scale=1.25)
    items = spiral(clip, **placed, **RING), surface("torus", clip, **placed, **RING)
    ours, theirs = (oracle.ideal_hits(scene(item, eye=eye, vfov=50.0, width=96, height=72), 0) for item in items)
    same = ours.count == theirs.count
    assert (same | (ours.clearance < 1e-6)).all()
    assert (~same).sum() <= 2
    assert len(np.unique(theirs.count)) >= (2 if clip is None else 3)
    assert np.array_equal(np.isinf(ours.depth[same]), np.isinf(theirs.depth[same]))
    seen = same[..., None] & np.isfinite(ours.depth)
    assert np.abs(ours.depth[seen] / theirs.depth[seen] - 1).max() < 1e-9
    assert ours.clearance[ours.count > 0].max() < 1.0


# ---------------------------------------------------------------- closed forms


def test_no_length_is_a_ball():
    """Two balls in one place: the roots of the sphere."""
    ball = spiral(R=0.5, r=0.3, pitch=1.0, turns=1e-13)
    h, e = chords(ball, 2000, 2)
    roots, _ = spiral_chord_roots(ball, h, e)
    exact = oracle.chord_roots(oracle.quadrics(surface("sphere", R=0.3)), h - [0.5, 0, 0], e - [0.5, 0, 0])
    assert np.array_equal(counted(roots), counted(exact)) and counted(roots).sum() > 500
    assert np.nanmax(np.abs(roots[:, :4] - exact)) < 1e-9


def test_ends_are_balls():
    """A quarter of a turn, growing: along the tangents beyond its ends the balls' poles are the roots."""
    arc = spiral(R=1.0, r=0.25, pitch=0.4, turns=0.25, R_growth=-0.8, r_growth=0.2)
    start, _ = one(arc, (1.0, -1.0, 0.0), (1.0, -0.1, 0.0))
    assert start == pytest.approx([0.75 / 0.9], rel=1e-14)
    stop, _ = one(arc, (-1.0, 0.8, 0.1), (-0.1, 0.8, 0.1))
    assert stop == pytest.approx([0.7 / 0.9], rel=1e-14)


def test_helix_along_its_axis():
    """On the axis and next to it there is nothing: R - r away, at the height of each turn; across it f jumps."""
    for x in (0.0, 1e-300, 1e-12, 1e-6):
        roots, clearance = one(spiral(**HELIX), (x, 0.0, -1.0), (x, 0.0, 3.0))
        assert len(roots) == 0
        assert clearance == pytest.approx(0.625, abs=2 * x + 1e-15)
    width = np.sqrt(0.125**2 - 0.05**2)  # half a turn on is a disk at z = 0.25
    for y in (0.0, 1e-12):
        roots, clearance = one(spiral(**HELIX), (-2.0, y, 0.2), (2.0, y, 0.2))
        assert roots == pytest.approx([(1.25 - width) / 4, (1.25 + width) / 4], rel=1e-11)
        assert clearance == pytest.approx(0.075, abs=1e-11)


@pytest.mark.parametrize("y", [0.0, 1e-12, -1e-12])
def test_helix_along_its_seam(y):
    """Up through both ends and the whole turns between them, where the azimuth goes from 1 to 0: eight roots."""
    h, e = (0.75, y, -1.0), (0.75, y, 3.0)
    wanted = [0.5 * turn + side for turn in range(4) for side in (-0.125, 0.125)]
    roots, clearance = one(spiral(**HELIX), h, e)
    assert roots * 4 - 1 == pytest.approx(wanted, abs=1e-11)
    assert clearance == pytest.approx(0.125, abs=1e-11)
    first, also = one(spiral(**HELIX), h, e, max_roots=3)
    assert np.array_equal(first, roots[:3]) and also == clearance

    quarter, _ = one(spiral(**HELIX), (y, 0.75, 3.0), (y, 0.75, -1.0))  # a quarter turn on, downwards: no ends
    wanted = [0.5 * (turn + 0.25) + side for turn in (2, 1, 0) for side in (0.125, -0.125)]
    assert 3 - quarter * 4 == pytest.approx(wanted, abs=1e-11)


def test_chord_ends_count():
    """Roots outside of the chord are none, and its ends add to the clearance where they are near."""
    for epsilon in (1e-3, 1e-7, 1e-12):
        for side, wanted in ((1, 0), (-1, 1)):
            outside, rim = (2.0, 0.3, -0.2), (0.95 + side * epsilon, 0.0, 0.0)
            for h, e in ((outside, rim), (rim, outside)):
                roots, clearance = one(spiral(**RING), h, e)
                assert len(roots) == wanted
                assert clearance == pytest.approx(epsilon, rel=1e-6, abs=2e-16)
    assert one(spiral(**RING), (2.0, 0.0, 0.0), (1.1, 0.0, 0.0)) == (pytest.approx([]), np.inf)
    assert one(spiral(**RING), (0.0, 0.0, 2.0), (1e9, 0.0, 2.0))[1] == np.inf


@pytest.mark.parametrize("epsilon", [1e-3, 1e-6, 1e-9, 1e-12])
def test_tangent_outside_and_between_turns(epsilon):
    """Over the top of a ring, and between turns that nearly touch: clearance is the distance that decides."""
    for side, wanted in ((1, 0), (-1, 4)):
        top = RING["r"] + side * epsilon
        roots, clearance = one(spiral(**RING), (-2.0, 0.0, top), (2.0, 0.0, top))
        assert len(roots) == wanted
        assert clearance == pytest.approx(epsilon, rel=1e-3, abs=1e-15)
    for side, wanted in ((1, 8), (-1, 2)):
        pile = spiral(R=0.75, r=0.125, pitch=0.25 + 2 * side * epsilon, turns=3.0)
        roots, clearance = one(pile, (0.75, 0.0, -1.0), (0.75, 0.0, 3.0))
        assert len(roots) == wanted
        assert clearance == pytest.approx(epsilon, rel=1e-3, abs=1e-15)


# ---------------------------------------------------------------- against dense samples


@pytest.mark.parametrize("name", GROWN)
def test_dense_samples(name):
    """Fifty thousand samples of f as it is defined: as many sign changes, each root in its interval, f = 0 there."""
    shape = spiral(**GROWN[name])
    h, e = chords(shape, 400, 3)
    roots, clearance = spiral_chord_roots(shape, h, e)
    assert counted(roots).max() >= (2 if shape.turns < 1 else 4) and (counted(roots) > 0).sum() > 100
    points = h[:, None] + roots[..., None] * (e - h)[:, None]
    assert np.nanmax(np.abs(value(shape, points))) < 1e-12

    rich = np.argsort(counted(roots), kind="stable")[-12:]
    t = np.linspace(0, 1, 50_001)
    for i in [*range(8), *range(200, 208), *rich]:
        f = value(shape, h[i] + t[:, None] * (e - h)[i])
        changes = np.flatnonzero((f[1:] > 0) != (f[:-1] > 0))
        found = roots[i][np.isfinite(roots[i])]
        if clearance[i] > 1e-6:
            assert np.array_equal(np.searchsorted(t, found) - 1, changes), (name, i)
        least, most = (f[1:-1] <= f[:-2]) & (f[1:-1] <= f[2:]), (f[1:-1] >= f[:-2]) & (f[1:-1] >= f[2:])
        nearest = np.abs([f[0], f[-1], *f[1:-1][least | most]]).min()
        if min(nearest, clearance[i]) < 0.01:
            assert clearance[i] == pytest.approx(nearest, abs=2e-4), (name, i)


@pytest.mark.parametrize("name", GROWN)
def test_value(name):
    """f of the oracle is f as it is defined, next to the axis, too."""
    shape = spiral(**GROWN[name])
    points = np.concatenate(chords(shape, 2000, 4))
    points *= np.random.default_rng(4).uniform(0, 1, (len(points), 1))
    assert np.abs(spiral_value(shape, points) - value(shape, points)).max() < 1e-14
    assert spiral_value(shape, points[0]).shape == ()


def assert_denser_is_no_better(monkeypatch, shape, h, e):
    """With a twentieth of the spacing there are the same roots, and the same clearance where it is small."""
    roots, clearance = spiral_chord_roots(shape, h, e)
    plain = oracle_spiral.tube(shape)
    monkeypatch.setattr(oracle_spiral, "tube", lambda _: plain._replace(spacing=plain.spacing / 20))
    more, finer = spiral_chord_roots(shape, h, e)
    assert np.array_equal(counted(roots), counted(more))
    assert np.nanmax(np.abs(roots - more)) < 1e-11
    near = np.minimum(clearance, finer) < 3e-3 * shape.r
    assert near.sum() >= 3 and np.abs(clearance[near] - finer[near]).max() < 1e-11


@pytest.mark.parametrize("name", GROWN)
def test_denser_sampling_finds_nothing_more(name, monkeypatch):
    """A twentieth of the spacing on 3000 chords."""
    shape = spiral(**GROWN[name])
    assert_denser_is_no_better(monkeypatch, shape, *chords(shape, 3000, 5))


def test_past_the_axis(monkeypatch):
    """A tall screw that leaves a hole of R / 100, and chords that pass its axis at about that distance."""
    shape = spiral(R=1.0, r=0.99, pitch=30.0, turns=0.7)
    dice, count = np.random.default_rng(7), 4000
    across, phase = 0.01 * 10 ** dice.uniform(-0.5, 1, count), dice.uniform(0, 2 * np.pi, count)
    middle = np.stack([across * np.cos(phase), across * np.sin(phase), dice.uniform(0, 21, count)], axis=-1)
    rise = 30 * dice.normal(size=count) * 10 ** dice.uniform(-2, 1, count)
    ahead = np.stack([-np.sin(phase), np.cos(phase), rise], axis=-1)
    assert_denser_is_no_better(monkeypatch, shape, middle - ahead, middle + ahead)


@pytest.mark.parametrize("name", GROWN)
def test_chord_moved_until_tangent(name):
    """A chord through the tube is moved out until it has no root: there the clearance is 0, and rises beside it."""
    shape = spiral(**GROWN[name])
    dice = np.random.default_rng(6)
    count = 20
    middle, _ = centre(shape, dice.uniform(0, shape.turns, count))
    ahead, aside = np.moveaxis(np.linalg.qr(dice.normal(size=(count, 3, 2)))[0], 2, 0)

    def moved(offset):
        at = middle + offset[:, None] * aside
        roots, clearance = spiral_chord_roots(shape, at - 20 * ahead, at + 20 * ahead)
        return counted(roots), clearance

    hit, miss = np.zeros(count), np.full(count, 20.0)
    assert (moved(hit)[0] >= 2).all() and (moved(miss)[0] == 0).all()
    while (miss - hit > 4e-15).any():
        offset = (hit + miss) / 2
        empty = moved(offset)[0] == 0
        hit, miss = np.where(empty, hit, offset), np.where(empty, offset, miss)
    assert max(moved(hit)[1].max(), moved(miss)[1].max()) < 1e-13
    slope, inside = moved(miss + 1e-7)[1] / 1e-7, moved(hit - 1e-7)[1] / 1e-7
    assert (slope > 0.1).all() and (slope < 10).all()
    assert inside == pytest.approx(slope, rel=1e-3)


# ---------------------------------------------------------------- images

AXIS_X = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]  # local z is world x, local x world y


def upright(clip=None, **parameters):
    """The helix with its axis along the view of `along`."""
    return spiral(clip, matrix=AXIS_X, **(HELIX | parameters))


def test_the_nearest_four_of_eight():
    """Along the seam, from above: the first four roots, at 5 - z."""
    hits = oracle.ideal_hits(scene(upright(), **along((0.75, 0.0))), 0)
    assert hits.count[0, 0] == 4
    assert hits.depth[0, 0] == pytest.approx([3.375, 3.625, 3.875, 4.125], rel=1e-14)
    assert hits.clearance[0, 0] == pytest.approx(0.125 / 0.875, rel=1e-12)
    clip = ((-1.0, -1.0, 0.55), (1.0, 1.0, 1.2))
    hits = oracle.ideal_hits(scene(upright(clip), **along((0.75, 0.0))), 0)
    assert hits.count[0, 0] == 3
    assert hits.depth[0, 0, :3] == pytest.approx([3.875, 4.125, 4.375], rel=1e-14)
    assert np.isinf(hits.depth[0, 0, 3])


def test_eye_within_the_tube():
    """From the centre of a disk: its rim in front, not the one behind; a mirrored eye sees the same."""
    hits = oracle.ideal_hits(scene(upright(), eye=(0.5, 0.75, 0.0), look_at=(-5.0, 0.75, 0.0)), 0)
    assert hits.count[0, 0] == 3
    assert hits.depth[0, 0, :3] == pytest.approx([0.125, 0.375, 0.625], rel=1e-14)
    close = oracle.ideal_hits(scene(upright(), eye=(0.625 + 1e-9, 0.75, 0.0), look_at=(-5.0, 0.75, 0.0)), 0)
    assert close.count[0, 0] == 4
    assert close.clearance[0, 0] == pytest.approx(1e-9 / 0.875, rel=1e-6)


def test_clearance_is_relative_to_the_size():
    """In an image |f| counts in R + r at the larger end, whatever the scale."""
    for scale in (0.01, 3.0):
        for side, wanted in ((1, 0), (-1, 4)):
            view = scene(spiral(scale=scale, **RING), **along((0.0, scale * (0.25 + side * 1e-6))))
            hits = oracle.ideal_hits(view, 0)
            assert hits.count[0, 0] == wanted
            assert hits.clearance[0, 0] == pytest.approx(1e-6 / 0.95, rel=1e-6)
    grown = spiral(R=0.5, r=0.25, R_growth=-0.2, r_growth=-0.1)  # start and stop are balls in the half plane y = 0
    hits = oracle.ideal_hits(scene(grown, eye=(0.5, -9.0, 0.2501), look_at=(0.5, 0.0, 0.2501)), 0)
    assert hits.count[0, 0] == 0
    assert hits.clearance[0, 0] == pytest.approx(1e-4 / 0.75, rel=1e-3)


def test_clearance_at_the_clip_box():
    """A root close to a face of the box makes the clearance small, whichever side it is on."""
    for shift, wanted in ((1e-7, 2), (-1e-7, 1)):
        clip = ((-1.0, -1.0, 0.375 - 0.1), (1.0, 1.0, 0.625 + shift))
        hits = oracle.ideal_hits(scene(upright(clip), **along((0.75, 0.0))), 0)
        assert hits.count[0, 0] == wanted
        assert hits.clearance[0, 0] == pytest.approx(1e-7 / 0.175, rel=1e-4)


def test_extrema_outside_the_clip_box():
    """A ray that touches the ring outside of the box is as far from another count as the touch is from the box."""
    clip = ((-0.6965, -1.0, -1.0), (0.6965, 1.0, 1.0))
    hits = oracle.ideal_hits(scene(spiral(clip, **RING), **along((0.0, 0.25 + 1e-9))), 0)
    assert hits.count[0, 0] == 0
    assert hits.clearance[0, 0] == pytest.approx(0.7 / 0.6965 - 1, rel=1e-3)


def test_frame_of_several_surfaces():
    """A spiral takes its place among the others."""
    view = scene(spiral(**RING), surface("sphere", R=0.45), surface("torus", **RING), width=64, height=48)
    frame = oracle.ideal_frame(view)
    assert set(np.unique(frame.surface)) - {2} == {-1, 0, 1}
    assert (frame.surface == 2).sum() + (frame.surface == 0).sum() > 300
    ours, theirs = (oracle.ideal_frame(scene(view.surfaces[i], width=64, height=48)).depth for i in (0, 2))
    both = np.isfinite(ours)
    assert np.array_equal(both, np.isfinite(theirs)) and np.abs(ours[both] - theirs[both]).max() < 1e-12


@pytest.mark.parametrize(
    "wrong", [dict(r=0.0), dict(R=0.0), dict(turns=0.0), dict(r_growth=-0.25), dict(R_growth=-0.7), dict(r=np.nan)]
)
def test_no_tube(wrong):
    """Radii that are not positive from end to end are refused."""
    with pytest.raises(ValueError, match="not all positive"):
        oracle.ideal_hits(scene(spiral(**(RING | wrong))), 0)
    bare = SimpleNamespace(**(dict(pitch=0.0, turns=1.0, R_growth=0.0, r_growth=0.0) | RING | wrong))
    with pytest.raises(ValueError, match="not all positive"):
        spiral_chord_roots(bare, np.zeros((1, 3)), np.ones((1, 3)))
