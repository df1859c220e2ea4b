# SPDX-License-Identifier: Apache-2.0
"""Hits to a picture: layers, light, blending, sRGB (mirrors ``rtl/rdx_shade.sv``), and float normals for the files.

The same code for the golden model and the RTL. Colours are integers: docs/processor.md, "Shading".
"""

from dataclasses import dataclass, field

import mpmath as mp
import numpy as np

from .blend import add_layer, finish
from .compile import PRECISION, camera_of
from .config import Config
from .formats import COORD_FRAC, MATERIAL_INDEX, MATERIAL_WORDS, SWIRL_FIRST, UNIT_FRAC
from .gradient import gradient
from .hits import FrameHits
from .kernel import kernel, zeros
from .layers import Layers, layers_of
from .light import color, cosine
from .material import material_words
from .scene import Scene
from .srgb import srgb
from .surfaces import normal_direction
from .swirl import swirl

ONE = 1 << UNIT_FRAC
LAYERS = 4  # of a pixel, if not asked for otherwise
AT_OPACITY, AT_VECTOR = (MATERIAL_INDEX[name] for name in ("opacity", "vector"))
WORK = 21  # words of room for a pixel: gradient (12), normal, colour, sum


@dataclass
class Frame:
    """A finished frame of H rows and W columns.

    depth    float64 (H, W), camera-space distance along the view axis, inf = miss
    t        int64 (H, W), digits of the visible hit, -1 = miss
    surface  int16 (H, W), number of the visible surface, -1 = miss
    normal   float32 (H, W, 3), unit length in world space, towards the viewer, 0 = miss
    linear   float32 (H, W, 3), linear colour, multiples of 2^-16
    rgb      uint8 (H, W, 3), sRGB-encoded colour
    ulp      float64 (surfaces of the scene), depth of one unit in the last place of t; nan if not in view
    dropped  int64 (H, W), layers that had no place
    hits     what the core gave back
    counters  those of the processor, by name; none of the golden model
    """

    depth: np.ndarray
    t: np.ndarray
    surface: np.ndarray
    normal: np.ndarray
    linear: np.ndarray
    rgb: np.ndarray
    ulp: np.ndarray
    dropped: np.ndarray
    hits: FrameHits
    counters: dict[str, int] = field(default_factory=dict)


def _normals(scene: Scene, hits, point, basis, columns, rows) -> np.ndarray:
    """Unit normals (N, 3) in world space, towards the viewer; straight to the viewer where the gradient vanishes."""
    surface = scene.surfaces[hits.surface.index]
    local = _local(hits.surface, point)
    normal = normal_direction(surface, local) @ np.linalg.inv(np.array(surface.matrix, np.float64))
    forward, right, up, pixel, width, height = basis
    ray = (
        forward
        + ((columns + 0.5 - width / 2) * pixel)[:, None] * right
        + ((height / 2 - rows - 0.5) * pixel)[:, None] * up
    )
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    good = length > 0
    normal = np.where(good, normal / np.where(good, length, 1), -ray / np.linalg.norm(ray, axis=1, keepdims=True))
    away = (normal * ray).sum(axis=1) > 0
    return np.where(away[:, None], -normal, normal)


def _local(surface, point) -> np.ndarray:
    """Points (N, 3) of the hit record in local coordinates, float64."""
    return np.array(surface.origin) + point / float(1 << COORD_FRAC) * np.array(surface.unit)


def _basis(scene: Scene):
    """The camera in float64: forward, right, up, slope per pixel, width, height."""
    with mp.workprec(PRECISION):
        camera = camera_of(scene)
        vectors = [np.array([float(x) for x in v]) for v in (camera.forward, camera.right, camera.up)]
        return (*vectors, float(camera.pixel), camera.width, camera.height)


def units(values) -> np.ndarray:
    """Numbers from 0 to 1 as u1p16."""
    return np.array([int(mp.nint(mp.ldexp(mp.mpf(v), UNIT_FRAC))) for v in values], zeros(0).dtype)


def materials_of(scene: Scene, frame: FrameHits) -> np.ndarray:
    """The materials (surfaces of the scene, 64) of those in view."""
    materials = zeros(len(scene.surfaces) * MATERIAL_WORDS).reshape(-1, MATERIAL_WORDS)
    for hits in frame.surfaces:
        s = hits.surface
        materials[s.index] = material_words(scene, scene.surfaces[s.index], s.origin, s.unit)
    return materials


@kernel
def _paint(count, surfaces, index, points, enters, materials, ambient, background, degree, general, work, linear, rgb):
    """Linear intensities (P, 3), u1p16, and codes of P pixels from their layers."""
    room, shade, total = work[:15], work[15:18], work[18:]
    for pixel in range(count.size):
        through = ONE
        for channel in range(3):
            total[channel] = 0
        for layer in range(count[pixel]):
            material, hit = materials[surfaces[pixel, layer]], index[pixel, layer]
            if material[AT_VECTOR]:
                x, y, z = int(points[hit, 0]), int(points[hit, 1]), int(points[hit, 2])
                swirl(x, y, z, material[SWIRL_FIRST:], general, room)
            else:
                for axis in range(3):
                    room[12 + axis] = int(points[hit, axis])
                gradient(material, room[12:], room, degree)
            cos = cosine(material, room, enters[hit], room[12:])
            color(material, ambient, cos, shade)
            through = add_layer(total, through, shade, material[AT_OPACITY])
        finish(total, through, background)
        for channel in range(3):
            linear[pixel, channel] = total[channel]
            rgb[pixel, channel] = srgb(total[channel])


def paint(scene: Scene, frame: FrameHits, layers: Layers, general: bool) -> tuple[np.ndarray, np.ndarray]:
    """Linear intensities (P, 3), u1p16 in int32, and sRGB codes (P, 3), uint8.

    general  spirals' gradients are those of the evaluator for every spiral
    """
    pixels = layers.count.size
    linear, rgb = np.empty((pixels, 3), np.int32), np.empty((pixels, 3), np.uint8)
    background = units(scene.background.color)
    ambient = int(units([scene.light.ambient])[0])
    _paint(layers.count, layers.surface, layers.index, layers.point, layers.enters, materials_of(scene, frame),
           ambient, background, 4, int(general), zeros(WORK), linear, rgb)  # fmt: skip
    return linear, rgb


def compose(scene: Scene, frame: FrameHits, config: Config, layers: int = LAYERS) -> Frame:
    """The picture of ``frame``: nearest hits, normals, and colours composited from front to back.

    layers  how many hits of a pixel are kept; the farther ones are dropped and counted
    """
    height, width = frame.compiled.height, frame.compiled.width
    near = layers_of(scene, frame, layers)
    at = np.nonzero(near.count)[0]
    index, surface = near.index[at, 0], near.surface[at, 0]
    t = near.t[index]

    def plane(value, fill, dtype, *tail):
        out = np.full((height * width, *tail), fill, dtype)
        out[at] = value
        return out.reshape(height, width, *tail)

    ulp, start = np.full(len(scene.surfaces), np.nan), np.zeros(len(scene.surfaces))
    normal, basis = np.zeros((at.size, 3)), _basis(scene)
    for hits in frame.surfaces:
        s = hits.surface
        ulp[s.index], start[s.index] = (s.far - s.near) * 2.0**-config.digits, s.near
        of = np.nonzero(surface == s.index)[0]
        normal[of] = _normals(scene, hits, near.point[index[of]], basis, at[of] % width, at[of] // width)
    linear, rgb = paint(scene, frame, near, config.vecsum == "general")
    return Frame(
        plane(start[surface] + (t + 0.5) * ulp[surface], np.inf, np.float64),
        plane(t, -1, np.int64),
        plane(surface, -1, np.int16),
        plane(normal, 0, np.float32, 3),
        (linear.reshape(height, width, 3) / ONE).astype(np.float32),
        rgb.reshape(height, width, 3),
        ulp,
        near.dropped.reshape(height, width),
        frame,
    )
