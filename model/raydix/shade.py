# SPDX-License-Identifier: Apache-2.0
"""Hits to a picture: order by depth, normals, light, transparency. The same code for the golden model and the RTL."""

from dataclasses import dataclass

import mpmath as mp
import numpy as np

from .compile import PRECISION, camera_of
from .config import Config
from .formats import COORD_FRAC
from .hits import FrameHits, SurfaceHits
from .scene import Scene
from .surfaces import normal_direction


@dataclass
class Frame:
    """A finished frame of H rows and W columns.

    depth    float64 (H, W), camera-space distance along the view axis, inf = miss
    t        int64 (H, W), digits of the visible hit, -1 = miss
    surface  int16 (H, W), number of the visible surface, -1 = miss
    normal   float32 (H, W, 3), unit length in world space, towards the viewer, 0 = miss
    linear   float32 (H, W, 3), linear colour
    rgb      uint8 (H, W, 3), sRGB-encoded colour
    ulp      float64 (surfaces of the scene), depth of one unit in the last place of t; nan if not in view
    hits     what the core gave back
    """

    depth: np.ndarray
    t: np.ndarray
    surface: np.ndarray
    normal: np.ndarray
    linear: np.ndarray
    rgb: np.ndarray
    ulp: np.ndarray
    hits: FrameHits


def srgb(linear: np.ndarray) -> np.ndarray:
    """Linear colour in [0, 1] to sRGB-encoded uint8 (IEC 61966-2-1)."""
    v = np.clip(linear.astype(np.float64), 0, 1)
    encoded = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)
    return np.rint(encoded * 255).astype(np.uint8)


@dataclass
class _Layer:
    """Hits of a frame as flat vectors of N, ordered by pixel, then from front to back."""

    pixel: np.ndarray
    surface: np.ndarray
    depth: np.ndarray
    t: np.ndarray
    normal: np.ndarray
    shade: np.ndarray  # (N, 3) linear colour
    opacity: np.ndarray
    rank: np.ndarray  # 0 for the nearest hit of a pixel, 1 for the next, …


def _normals(scene: Scene, hits: SurfaceHits, where, basis, columns, rows) -> np.ndarray:
    """Unit normals (N, 3) in world space, towards the viewer; straight to the viewer where the gradient vanishes."""
    surface = scene.surfaces[hits.surface.index]
    local = np.array(hits.surface.origin) + hits.point[where] / float(1 << COORD_FRAC) * np.array(hits.surface.unit)
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


def _basis(scene: Scene):
    """The camera in float64: forward, right, up, slope per pixel, width, height."""
    with mp.workprec(PRECISION):
        camera = camera_of(scene)
        vectors = [np.array([float(x) for x in v]) for v in (camera.forward, camera.right, camera.up)]
        return (*vectors, float(camera.pixel), camera.width, camera.height)


def _layers(scene: Scene, frame: FrameHits, digits: int) -> _Layer:
    """All hits of the frame, shaded and ordered; equal depth words go to the lower surface number."""
    basis = _basis(scene)
    light = np.array(scene.light.direction, np.float64)
    light /= np.linalg.norm(light)
    parts = []
    for hits in frame.surfaces:
        where = np.nonzero(hits.t >= 0)
        x0, y0, _, _ = hits.surface.rect
        rows, columns = where[0] + y0, where[1] + x0
        normal = _normals(scene, hits, where, basis, columns, rows)
        surface = scene.surfaces[hits.surface.index]
        lambert = np.maximum(0, normal @ light)
        level = scene.light.ambient + (1 - scene.light.ambient) * lambert
        t = hits.t[where]
        near, far = hits.surface.near, hits.surface.far
        parts.append(
            (
                rows * frame.compiled.width + columns,
                np.full(t.shape, hits.surface.index),
                hits.depth[where],
                where[2],
                near + (t + 0.5) * 2.0**-digits * (far - near),
                t,
                normal,
                level[:, None] * np.array(surface.color),
                np.full(t.shape, float(surface.opacity)),
            )
        )
    if not parts:
        none = np.zeros(0, np.int64)
        return _Layer(none, none, none, none, np.zeros((0, 3)), np.zeros((0, 3)), none, none)
    pixel, index, word, root, depth, t, normal, shade, opacity = (np.concatenate(p) for p in zip(*parts, strict=True))
    order = np.lexsort((root, index, word, pixel))
    pixel = pixel[order]
    first = np.searchsorted(pixel, pixel)
    rank = np.arange(pixel.size) - first
    return _Layer(pixel, index[order], depth[order], t[order], normal[order], shade[order], opacity[order], rank)


def compose(scene: Scene, frame: FrameHits, config: Config) -> Frame:
    """The picture of ``frame``: nearest hits, normals, and colours composited from front to back.

    Shade = ambient + (1 - ambient) * max(0, n·l), times the surface's colour; n towards the viewer.
    """
    height, width = frame.compiled.height, frame.compiled.width
    layers = _layers(scene, frame, config.digits)
    front = layers.rank == 0
    at = layers.pixel[front]

    def plane(value, fill, dtype, *tail):
        out = np.full((height * width, *tail), fill, dtype)
        out[at] = value[front]
        return out.reshape(height, width, *tail)

    linear = np.zeros((height * width, 3))
    through = np.ones((height * width, 1))
    for rank in range(int(layers.rank.max()) + 1 if layers.rank.size else 0):
        now = layers.rank == rank
        pixel, opacity = layers.pixel[now], layers.opacity[now][:, None]
        linear[pixel] += through[pixel] * opacity * layers.shade[now]
        through[pixel] *= 1 - opacity
    linear += through * np.array(scene.background.color)
    linear = linear.reshape(height, width, 3).astype(np.float32)
    ulp = np.full(len(scene.surfaces), np.nan)
    for s in frame.compiled.surfaces:
        ulp[s.index] = (s.far - s.near) * 2.0**-config.digits
    return Frame(
        plane(layers.depth, np.inf, np.float64),
        plane(layers.t, -1, np.int64),
        plane(layers.surface, -1, np.int16),
        plane(layers.normal, 0, np.float32, 3),
        linear,
        srgb(linear),
        ulp,
        frame,
    )
