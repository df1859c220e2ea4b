# SPDX-License-Identifier: Apache-2.0
"""Scene and camera to fixed-point words: the only place between the scene and the picture with real numbers.

Everything here is computed with 256-bit floating point (mpmath), then rounded once into a word. The words
define exactly what the hardware and the golden model intersect. Source: docs/method.md, "Set-up".
"""

from itertools import product as combinations
from typing import NamedTuple

import mpmath as mp
import numpy as np

from .compile_spiral import Oversize, linear_lane, needs_general, spiral_words
from .config import Config
from .extent import extent
from .formats import (
    BOX_WIDTH,
    COORD_ACC_WIDTH,
    DEPTH_WIDTH,
    OPERAND_SHIFT,
    PRODUCT_DROP,
    QUAD_ACC_WIDTH,
)
from .raster import BOX_AT, OPAQUE_AT, PAPER_AT, QUARTIC_AT, ROOTS_AT, VECTOR_AT
from .scene import Scene, SceneError
from .surfaces import bounding_box, form

PRECISION = 256  # bits of the working precision
MARGIN = mp.mpf(2) ** -16  # by which a bounding box is widened, relative to its size
THINNEST = mp.mpf(2) ** -8  # of the depth: a segment that is shorter has more digits than the words of its depth
QUAD_LIMIT = mp.mpf(2) ** (QUAD_ACC_WIDTH - 2) - mp.mpf(2) ** (OPERAND_SHIFT + 1)  # |accumulator| below 2^62
QUADRIC_LIMIT = mp.mpf(2) ** 60  # |Q3| alone: 6*Q3 fits 64 bits
QUARTIC_LIMIT = mp.mpf(2) ** 59  # |Q3| beside a product below 2^58: 6*(2^58 + 2^59) fits 64 bits
MAX_BOX = 20  # largest box exponent: the thinnest clip box keeps 5 bits


class CompiledSurface(NamedTuple):
    """One surface's words and how to read what comes back.

    index     number of the surface in the scene
    words     the descriptor: signed 64-bit integers
    rect      first column, first row, last column, last row
    near, far camera depth of t = 0 and of t = 1, in scene units
    roots     roots wanted on a ray
    origin, unit   local coordinate of axis i = origin[i] + unit[i] * (s2p30 word / 2^30)
    """

    index: int  # type: ignore[assignment]  # hides the tuple's method
    words: tuple[int, ...]
    rect: tuple[int, int, int, int]
    near: float
    far: float
    roots: int
    origin: tuple[float, float, float]
    unit: tuple[float, float, float]

    @property
    def is_vector_sum(self) -> bool:
        """Whether the vector-sum ring intersects it, not the algebraic one."""
        return bool(self.words[0] >> VECTOR_AT & 1)


class CompiledFrame(NamedTuple):
    """All that one frame needs: size in pixels and the surfaces in view, in scene order."""

    width: int
    height: int
    surfaces: tuple[CompiledSurface, ...]


class Camera(NamedTuple):
    """Pinhole camera in 256-bit precision: point at depth z is eye + z*(forward + a*right + b*up)."""

    eye: mp.matrix
    forward: mp.matrix
    right: mp.matrix
    up: mp.matrix
    pixel: mp.mpf  # a per pixel column
    width: int
    height: int

    def a(self, column):
        """Slope to the right at a pixel column's centre."""
        return (column + mp.mpf(1) / 2 - mp.mpf(self.width) / 2) * self.pixel

    def b(self, row):
        """Slope upwards at a pixel row's centre; row 0 is on top."""
        return (mp.mpf(self.height) / 2 - row - mp.mpf(1) / 2) * self.pixel


def _vector(values):
    return mp.matrix([mp.mpf(v) for v in values])


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def _cross(a, b):
    return mp.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _unit(v):
    return v / mp.sqrt(_dot(v, v))


def camera_of(scene: Scene) -> Camera:
    """The camera's basis; right-handed, z up."""
    cam = scene.camera
    eye = _vector(cam.eye)
    forward = _unit(_vector(cam.look_at) - eye)
    right = _unit(_cross(forward, _vector(cam.up)))
    pixel = 2 * mp.tan(mp.radians(mp.mpf(cam.vfov)) / 2) / cam.height
    return Camera(eye, forward, right, _cross(right, forward), pixel, cam.width, cam.height)


class Placed(NamedTuple):
    """A surface seen from the camera, in its local coordinates: point at depth z is e + z*(f + a*r + b*u)."""

    e: mp.matrix
    f: mp.matrix
    r: mp.matrix
    u: mp.matrix

    def at(self, z, a, b):
        """Local point at depth z on the ray of slopes a, b."""
        return self.e + z * (self.f + a * self.r + b * self.u)


def clip_box(surface):
    """The local box (low, high) that holds all that is to be seen, and which axes the clip box cuts."""
    bounds = bounding_box(surface)
    clip = surface.clip
    if bounds is None:
        return _vector(clip[0]), _vector(clip[1]), (True, True, True)
    size = max(bounds[1][i] - bounds[0][i] for i in range(3)) * MARGIN
    low = [bounds[0][i] - size for i in range(3)]
    high = [bounds[1][i] + size for i in range(3)]
    if clip is None:
        return _vector(low), _vector(high), (False, False, False)
    cut = tuple(clip[0][i] > low[i] or clip[1][i] < high[i] for i in range(3))
    low = [max(low[i], clip[0][i]) for i in range(3)]
    high = [min(high[i], clip[1][i]) for i in range(3)]
    return _vector(low), _vector(high), cut


def _corners(low, high):
    return [mp.matrix(c) for c in combinations(*((low[i], high[i]) for i in range(3)))]


def _rectangle(camera, right, up):
    """Screen rectangle (first column, first row, last column, last row) of a range of slopes; None if empty."""
    columns = [a / camera.pixel + mp.mpf(camera.width) / 2 for a in right]
    rows = [mp.mpf(camera.height) / 2 - b / camera.pixel for b in reversed(up)]
    x0, x1 = max(0, int(mp.floor(columns[0])) - 1), min(camera.width - 1, int(mp.ceil(columns[1])))
    y0, y1 = max(0, int(mp.floor(rows[0])) - 1), min(camera.height - 1, int(mp.ceil(rows[1])))
    return (x0, y0, x1, y1) if x0 <= x1 and y0 <= y1 else None


class Quadratic(NamedTuple):
    """c00 + c10 x + c01 y + c20 x² + c11 xy + c02 y² of the pixel (x, y) counted from the rectangle's first."""

    c00: mp.mpf
    c10: mp.mpf
    c01: mp.mpf
    c20: mp.mpf
    c11: mp.mpf
    c02: mp.mpf

    def bound(self, columns, rows):
        """A bound over [0, columns] x [0, rows]: the largest Bernstein coefficient or difference of the lane."""
        x, y = columns, rows
        a = {(0, 0): self.c00, (1, 0): self.c10 * x, (0, 1): self.c01 * y, (2, 0): self.c20 * x * x}
        a |= {(1, 1): self.c11 * x * y, (0, 2): self.c02 * y * y}
        share = ((1, 0, 0), (1, mp.mpf(1) / 2, 0), (1, 1, 1))  # of x^p in Bernstein coefficient i
        inside = max(
            abs(sum(share[i][p] * share[j][q] * value for (p, q), value in a.items()))
            for i in range(3)
            for j in range(3)
        )
        return max(inside, *(abs(v) for v in self.differences()))

    def differences(self):
        """Forward differences at the rectangle's first pixel: value, dx, dy, dxx, dxy, dyy."""
        return self.c00, self.c10 + self.c20, self.c01 + self.c02, 2 * self.c20, self.c11, 2 * self.c02

    def lane(self, factor):
        """Words of the forward-difference lane: the differences times ``factor``."""
        return [int(mp.nint(v * factor)) for v in self.differences()]


def _blossom(q, p, pw, s, sw):
    """Symmetric bilinear form of a quadric (ten coefficients) at homogeneous points (p, pw), (s, sw)."""
    xx, yy, zz, xy, yz, zx, x, y, z, one = q
    total = xx * p[0] * s[0] + yy * p[1] * s[1] + zz * p[2] * s[2]
    total += (xy * (p[0] * s[1] + p[1] * s[0]) + yz * (p[1] * s[2] + p[2] * s[1])) / 2
    total += zx * (p[2] * s[0] + p[0] * s[2]) / 2
    total += (x * (p[0] * sw + pw * s[0]) + y * (p[1] * sw + pw * s[1]) + z * (p[2] * sw + pw * s[2])) / 2
    return total + one * pw * sw


def _control_points(q, h, e):
    """q(h,h), q(h,e), q(e,e) as quadratics of the pixel; h and e are (start, per column, per row) local vectors."""

    def quadratic(first, second):
        f0, fx, fy = first
        s0, sx, sy = second
        return Quadratic(
            _blossom(q, f0, 1, s0, 1),
            _blossom(q, fx, 0, s0, 1) + _blossom(q, f0, 1, sx, 0),
            _blossom(q, fy, 0, s0, 1) + _blossom(q, f0, 1, sy, 0),
            _blossom(q, fx, 0, sx, 0),
            _blossom(q, fx, 0, sy, 0) + _blossom(q, fy, 0, sx, 0),
            _blossom(q, fy, 0, sy, 0),
        )

    return [quadratic(h, h), quadratic(h, e), quadratic(e, e)]


def _quadric_words(shape, h, e, columns, rows):
    """Words of the lanes of Q3, and of Q1 and Q2 where the surface is a quartic."""

    def points_and_bound(q):
        points = _control_points(q, h, e)
        return points, max(p.bound(columns, rows) for p in points)

    q3, bound3 = points_and_bound(shape.q3)
    if shape.q1 is None:
        factor = QUADRIC_LIMIT / bound3 if bound3 else mp.mpf(1)
        return [w for p in q3 for w in p.lane(factor)]
    q1, bound1 = points_and_bound(shape.q1)
    q2, bound2 = points_and_bound(shape.q2)
    factor1 = QUAD_LIMIT / bound1 if bound1 else mp.mpf(1)
    factor2 = QUAD_LIMIT / bound2 if bound2 else mp.mpf(1)
    factor3 = factor1 * factor2 / mp.mpf(2) ** (2 * OPERAND_SHIFT + PRODUCT_DROP)
    if bound3 * factor3 > QUARTIC_LIMIT:
        less = mp.sqrt(QUARTIC_LIMIT / (bound3 * factor3))
        factor1, factor2, factor3 = factor1 * less, factor2 * less, factor3 * less * less
    lanes = [(q3, factor3), (q1, factor1), (q2, factor2)]
    return [w for points, factor in lanes for p in points for w in p.lane(factor)]


def _coordinate_words(scene, surface, index, h, e, low, high, cut, columns, rows):
    """Words of the coordinate lanes, the box exponents, and origin and unit of each axis."""
    words, box, origin, unit = [], [], [], []
    limit = 2 - mp.mpf(2) ** -20
    for axis in range(3):
        middle, half = (low[axis] + high[axis]) / 2, (high[axis] - low[axis]) / 2
        ends = [
            v[0][axis] + x * v[1][axis] + y * v[2][axis] - middle
            for v in (h, e)
            for x in (0, columns)
            for y in (0, rows)
        ]
        largest = max(abs(v) for v in ends)
        cuts = cut[axis] and largest
        exponent = max(0, int(mp.ceil(mp.log(2 * largest / (limit * half), 2)))) if cuts else 0
        if exponent > MAX_BOX:
            raise SceneError(
                f"{scene.path}: surface[{index}] ({surface.type}).clip: found a box whose side {'xyz'[axis]} is less "
                f"than 2^-{MAX_BOX} of what the view sees of it; allowed: a thicker box for the configured words"
            )
        factor = mp.mpf(2) ** (1 - exponent) / half if cut[axis] else limit / (largest or 1)
        box.append(exponent)
        origin.append(float(middle))
        unit.append(float(1 / factor))
        for v in (h, e):
            lane = (v[0][axis] - middle, v[1][axis], v[2][axis])
            words += linear_lane(lane, factor * mp.mpf(2) ** (COORD_ACC_WIDTH - 2))
    return words, box, tuple(origin), tuple(unit)


def roots_wanted(surface, config: Config) -> int:
    """Roots looked for on a ray: one if opaque, else all, of a spiral the first four; the paper's bound is three."""
    if surface.opacity == 1:
        return 1
    most = 4 if surface.type == "spiral" or form(surface).q1 is not None else 2
    return min(most, 3 if config.rule == "paper" else 4)


def compile_scene(scene: Scene, config: Config) -> CompiledFrame:
    """The words of a frame.

    Raises :class:`~raydix.scene.SceneError` where a scene does not fit the configured words or needs a box or a degree
    that the configuration does not build.
    """
    with mp.workprec(PRECISION):
        camera = camera_of(scene)
        placed = []
        for index, surface in enumerate(scene.surfaces):
            view = _view(camera, surface)
            if view is not None:
                placed.append((index, surface, *view))
        far = max((p[-1] for p in placed), default=mp.mpf(1))
        return CompiledFrame(
            camera.width,
            camera.height,
            tuple(_compile_surface(scene, camera, config, (mp.mpf(2) ** 31 - 1) / far, *p) for p in placed),
        )


def _view(camera, surface):
    """Box, screen rectangle and depth range of a surface; None if nothing of it can be seen."""
    matrix = mp.matrix(surface.matrix) * mp.mpf(surface.scale)
    low, high, cut = clip_box(surface)
    if any(low[i] >= high[i] for i in range(3)):
        return None
    corners = [matrix * c + _vector(surface.center) - camera.eye for c in _corners(low, high)]
    points = [(_dot(c, camera.right), _dot(c, camera.up), _dot(c, camera.forward)) for c in corners]
    near, far = min(p[2] for p in points), max(p[2] for p in points)
    if far <= 0:
        return None
    if near <= 0:
        return matrix, low, high, cut, (0, 0, camera.width - 1, camera.height - 1), mp.mpf(0), far
    of_box = [[p[axis] / p[2] for p in points] for axis in (0, 1)]
    bounds = [(min(slopes), max(slopes)) for slopes in of_box] + [(near, far)]
    seen = extent(surface, *_seen_from(camera, surface, matrix, low, high))
    if seen is None:
        return None
    right, up, (near, far) = (
        (max(least, a - _more(a, b, floor)), min(most, b + _more(a, b, floor)))
        for (least, most), (a, b), floor in zip(bounds, seen, (0, 0, far * THINNEST), strict=True)
    )
    rect = _rectangle(camera, right, up)
    return None if rect is None else (matrix, low, high, cut, rect, near, far)


def _more(a, b, floor):
    """By how much a range is widened on both sides: a part of it, and until it is ``floor`` wide."""
    return (b - a) * MARGIN + max(mp.mpf(0), floor - (b - a)) / 2 if mp.isfinite(b - a) else mp.inf


def _seen_from(camera, surface, matrix, low, high):
    """What :func:`~raydix.extent.extent` needs beside the surface, in float64."""
    axes = mp.matrix([list(v) for v in (camera.right, camera.up, camera.forward)])
    values = low, high, axes * matrix, axes * (_vector(surface.center) - camera.eye)
    low, high, turned, eye = (np.array(v.tolist(), np.float64) for v in values)
    return low[:, 0], high[:, 0], turned, eye[:, 0]


def _compile_surface(scene, camera, config, depth_factor, index, surface, matrix, low, high, cut, rect, near, far):
    """The descriptor of one surface in view."""
    inverse = matrix**-1
    place = Placed(
        inverse * (camera.eye - _vector(surface.center)),
        inverse * camera.forward,
        inverse * camera.right,
        inverse * camera.up,
    )
    x0, y0, x1, y1 = rect
    a, b = camera.a(x0), camera.b(y0)
    h, e = ((place.at(z, a, b), z * camera.pixel * place.r, -z * camera.pixel * place.u) for z in (near, far))
    columns, rows = x1 - x0 + 1, y1 - y0 + 1
    make = _vector_sum if surface.type == "spiral" else _algebraic
    flags, lanes, origin, unit = make(scene, config, index, surface, h, e, low, high, cut, columns, rows)
    roots = roots_wanted(surface, config)
    head = (
        index | roots << ROOTS_AT | (config.rule == "paper") << PAPER_AT | flags | (surface.opacity == 1) << OPAQUE_AT
    )
    depth = [int(mp.nint(z * depth_factor)) for z in (near, far)]
    words = [head, x0 | y0 << 16 | x1 << 32 | y1 << 48, depth[0] | depth[1] << DEPTH_WIDTH, *lanes]
    if any(abs(w) >= 1 << 63 for w in words):
        raise SceneError(
            f"{scene.path}: surface[{index}] ({surface.type}): found sizes that lie too far apart for the configured "
            "words; allowed: coordinates, scale and camera distance nearer to each other"
        )
    return CompiledSurface(index, tuple(words), rect, float(near), float(far), roots, origin, unit)


def _algebraic(scene, config, index, surface, h, e, low, high, cut, columns, rows):
    """Header flags, words of all lanes, origin and unit of an algebraic surface."""
    shape = form(surface)
    quartic = shape.q1 is not None
    if config.degree < 2 + 2 * quartic:
        allowed = "surfaces of degree 1 and 2" if config.degree else "vector-sum surfaces"
        raise SceneError(
            f"{scene.path}: surface[{index}].type: found '{surface.type}'{', a quartic' if quartic else ''}; "
            f"allowed: {allowed} in a configuration of degree {config.degree}"
        )
    if any(cut) and not config.clip:
        raise SceneError(
            f"{scene.path}: surface[{index}] ({surface.type}).clip: found a surface that a box cuts; "
            "allowed: surfaces within their boxes in a configuration without clip"
        )
    coordinates, box, origin, unit = _coordinate_words(scene, surface, index, h, e, low, high, cut, columns, rows)
    flags = quartic << QUARTIC_AT
    for axis in range(3):
        flags |= box[axis] << (BOX_AT + axis * BOX_WIDTH)
    return flags, [*coordinates, *_quadric_words(shape, h, e, columns, rows)], origin, unit


def _vector_sum(scene, config, index, surface, h, e, low, high, cut, columns, rows):
    """Header flags, words of the coordinate lanes and of the form, origin and unit of a vector-sum surface."""
    needed = "general" if needs_general(surface) else "helix"
    if config.vecsum not in (needed, "general"):
        built = {"none": "algebraic surfaces", "helix": "spirals of one turn at least whose radii do not grow"}
        raise SceneError(
            f"{scene.path}: surface[{index}].type: found '{surface.type}' that needs vecsum = {needed}; "
            f"allowed: {built[config.vecsum]} in a configuration of vecsum = {config.vecsum}"
        )
    try:
        coordinates, words, origin, unit = spiral_words(surface, h, e, low, high, cut, columns, rows, config.n1)
    except Oversize as error:
        raise SceneError(
            f"{scene.path}: surface[{index}] ({surface.type}): found {error}; allowed: sizes nearer to each other"
        ) from None
    return 1 << VECTOR_AT, [*coordinates, *words], origin, unit


def descriptor_array(frame: CompiledFrame) -> np.ndarray:
    """All descriptors of a frame one after the other, int64: what the RTL is fed."""
    return np.array([w for s in frame.surfaces for w in s.words], dtype=np.int64)
