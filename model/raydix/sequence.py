# SPDX-License-Identifier: Apache-2.0
"""Sequences: the frames of a scene one after the other, what is there of them already, and an animated preview."""

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict
from importlib import metadata
from pathlib import Path

import numpy as np
from PIL import Image

from .compile import compile_scene, descriptor_array
from .config import Config
from .files import RTL, top_sources
from .image import ImageError, png_writer, read_image, text_writer, write_files
from .processor import run_frames
from .render import render_golden
from .rtl import BENCH
from .scene import Scene

PREVIEW = 320  # columns of the preview at most
FRAME_TIME = 80  # ms
BATCH = 8  # frames in a run of the processor; what an interruption loses


def render_sequence(
    scene: Scene, config: Config, backend: str, numbers: Sequence[int], threads: int = 1, progress=None
) -> Iterator[tuple[int, np.ndarray]]:
    """The frames ``numbers`` of ``scene``, each as soon as it is there: (number, picture uint8 (H, W, 3)).

    backend  "golden", or "rtl": runs of the processor, each frame loaded while the one before is made
    progress  told the frames done and of how many
    Raises SceneError, and RtlError where a tool fails.
    """
    frames = scene.frames()
    for done in range(0, len(numbers), BATCH):
        some = numbers[done : done + BATCH]
        pictures: Iterable[np.ndarray]
        if backend == "rtl":
            pictures = run_frames([(frames[i], compile_scene(frames[i], config)) for i in some], config).rgb
        else:
            pictures = (render_golden(frames[i], config, threads).rgb for i in some)
        for place, (number, rgb) in enumerate(zip(some, pictures, strict=True)):
            yield number, rgb
            if progress:
                progress(done + place + 1, len(numbers))


def version(backend: str) -> str:
    """A name of what renders: the model's sources; of the RTL its own, its bench and Verilator, too."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    tools = ""
    if backend == "rtl":
        files += [*top_sources(), *sorted(RTL.glob("*.svh")), *sorted(BENCH.iterdir())]
        tools = metadata.version("verilator")
    content = b"".join(path.read_bytes() for path in files)
    return hashlib.sha256(f"{backend} {tools} ".encode() + content).hexdigest()


def digest(frame: Scene, config: Config, renderer: str) -> str:
    """A name of all that a frame's picture depends on: its words, what the shading takes from the scene, who renders.

    renderer  its :func:`version`
    """
    shading = [frame.light, frame.background, *frame.surfaces]
    text = json.dumps([asdict(config), *(table.model_dump(mode="json") for table in shading)], sort_keys=True)
    compiled = compile_scene(frame, config)
    words = descriptor_array(compiled).tobytes()
    return hashlib.sha256(f"{renderer} {compiled.width} {compiled.height} {text}".encode() + words).hexdigest()[:20]


class Kept:
    """The pictures of a sequence in a folder, with a list of what each was made from: ``<scene>-frames.json``."""

    def __init__(self, scene: Scene, config: Config, backend: str, out: Path):
        frames = scene.frames()
        digits = len(str(len(frames) - 1))
        self.paths = [out / f"{scene.name}-{number:0{digits}}.png" for number in range(len(frames))]
        self.list = out / f"{scene.name}-frames.json"
        renderer = version(backend)
        self.wanted = [digest(frame, config, renderer) for frame in frames]
        self.made: dict[str, str] = {}  # name of the picture: digest

    def resume(self) -> list[int]:
        """Take up what is there; the frames that are not, or were made from something else."""
        try:
            self.made = dict(json.loads(self.list.read_text()))
        except (OSError, ValueError):
            self.made = {}
        return [i for i, path in enumerate(self.paths) if not self._is_there(path, self.wanted[i])]

    def _is_there(self, path: Path, wanted: str) -> bool:
        if self.made.get(path.name) != wanted:
            return False
        try:
            read_image(path)
        except ImageError:
            return False
        return True

    def keep(self, number: int, rgb: np.ndarray) -> None:
        """Write a picture, and what it was made from; both or none. Raises ImageError."""
        made = self.made | {self.paths[number].name: self.wanted[number]}
        text = json.dumps(made, indent=1, sort_keys=True) + "\n"
        write_files({self.paths[number]: png_writer(rgb), self.list: text_writer(text)})
        self.made = made

    def preview(self, path: Path) -> None:
        """Write an animated GIF of all pictures, at most PREVIEW columns wide, that repeats for ever."""
        write_files({path: preview_writer([read_image(p) for p in self.paths])})


def preview_writer(pictures: list[np.ndarray]) -> Callable[[Path], None]:
    """Writes an animated GIF, at most PREVIEW columns wide, that repeats for ever."""

    def write(work: Path) -> None:
        images = [Image.fromarray(rgb) for rgb in pictures]
        for image in images:
            image.thumbnail((PREVIEW, PREVIEW))
        images[0].save(work, "GIF", save_all=True, append_images=images[1:], duration=FRAME_TIME, loop=0)

    return write
