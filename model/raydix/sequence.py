# SPDX-License-Identifier: Apache-2.0
"""Sequences: the frames of a scene one after the other, and an animated preview of them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from .compile import compile_scene
from .config import Config
from .processor import run_frames
from .render import render_golden
from .scene import Scene

PREVIEW = 320  # columns of the preview at most
FRAME_TIME = 80  # ms


def render_sequence(
    scene: Scene, config: Config, backend: str, threads: int = 1, progress: Callable[[int, int], None] | None = None
) -> list[np.ndarray]:
    """Pictures uint8 (H, W, 3) of all frames of ``scene``.

    backend  "golden", or "rtl": one run of the processor, each frame loaded while the one before is made
    Raises SceneError, and RtlError where a tool fails.
    """
    frames = scene.frames()
    if backend == "rtl":
        compiled = [(frame, compile_scene(frame, config)) for frame in frames]
        return list(run_frames(compiled, config, progress=progress).rgb)
    pictures = []
    for number, frame in enumerate(frames):
        pictures.append(render_golden(frame, config, threads).rgb)
        if progress:
            progress(number + 1, len(frames))
    return pictures


def preview_writer(pictures: list[np.ndarray]) -> Callable[[Path], None]:
    """Writes an animated GIF, at most PREVIEW columns wide, that repeats for ever."""

    def write(work: Path) -> None:
        images = [Image.fromarray(rgb) for rgb in pictures]
        for image in images:
            image.thumbnail((PREVIEW, PREVIEW))
        images[0].save(work, "GIF", save_all=True, append_images=images[1:], duration=FRAME_TIME, loop=0)

    return write
