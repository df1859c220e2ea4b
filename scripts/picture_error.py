# SPDX-License-Identifier: Apache-2.0
"""How far a picture is from the ideal one: its depth, its silhouette, its colours as numbers and as they are seen."""

import flip_evaluator
import numpy as np

from raydix.oracle import camera_rays
from raydix.scene import Scene
from raydix.surfaces import normal_direction


def depth_errors(depth: np.ndarray, ideal: np.ndarray) -> dict:
    """Errors of depths (H, W), inf where nothing is hit, over the pixels where both hit; and where only one does."""
    hit, wanted = np.isfinite(depth), np.isfinite(ideal)
    both = hit & wanted
    error = np.abs(depth[both] - ideal[both]) if both.any() else np.array([np.nan])
    return {
        "rms": float(np.sqrt(np.mean(error**2))),
        "p999": float(np.percentile(error, 99.9)),
        "max": float(error.max()),
        "silhouette": int((hit != wanted).sum()),
    }


def encode(linear: np.ndarray) -> np.ndarray:
    """Linear colours as sRGB, uint8."""
    curve = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)
    return np.rint(255 * np.clip(curve, 0, 1)).astype(np.uint8)


def shaded(scene: Scene, depth: np.ndarray) -> np.ndarray:
    """The picture (H, W, 3), uint8, of a scene with one opaque surface, from its depth (H, W), in float64."""
    (surface,), camera = scene.surfaces, scene.camera
    eye, forward, right, up = camera_rays(camera)
    rows, columns = np.nonzero(np.isfinite(depth))
    dx, dy = columns + 0.5 - camera.width / 2, camera.height / 2 - rows - 0.5
    ray = forward + dx[:, None] * right + dy[:, None] * up
    point = eye + depth[rows, columns, None] * ray
    matrix = np.asarray(surface.matrix, np.float64)
    normal = normal_direction(surface, (point - np.asarray(surface.center)) @ matrix / surface.scale) @ matrix.T
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    normal = np.where(((normal * ray).sum(axis=1) > 0)[:, None], -normal, normal)
    light = np.asarray(scene.light.direction, np.float64)
    cosine = np.maximum(0.0, normal @ (light / np.linalg.norm(light)))
    share = scene.light.ambient + (1 - scene.light.ambient) * cosine
    linear = np.empty((*depth.shape, 3))
    linear[:] = scene.background.color
    linear[rows, columns] = share[:, None] * np.asarray(surface.color)
    return encode(linear)


def picture_errors(rgb: np.ndarray, ideal: np.ndarray) -> dict:
    """Of pictures (H, W, 3), uint8: PSNR in dB, None where they are the same, and the mean of FLIP, 0 to 1."""
    squares = np.mean((rgb.astype(np.float64) - ideal) ** 2)
    wanted, found = (np.ascontiguousarray(p.astype(np.float32) / 255) for p in (ideal, rgb))
    _, flip, _ = flip_evaluator.evaluate(wanted, found, "LDR", applyMagma=False)
    return {"psnr": float(10 * np.log10(255**2 / squares)) if squares else None, "flip": float(flip)}
