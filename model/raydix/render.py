# SPDX-License-Identifier: Apache-2.0
"""Scene to frame through either core, and both side by side."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from .compile import compile_scene
from .config import Config
from .golden import trace_golden
from .hits import FrameHits, differing_bits_of
from .image import frame_writers, png_writer, text_writer, write_files
from .processor import run_frames
from .scene import Scene
from .shade import Frame, compose


def render_golden(scene: Scene, config: Config, threads: int = 1, progress=None) -> Frame:
    """Render ``scene`` by the golden model. Raises SceneError where the scene does not fit the configuration."""
    compiled = compile_scene(scene, config)
    return compose(scene, trace_golden(compiled, config, threads, progress), config, config.layers)


def render_rtl(scene: Scene, config: Config, progress=None, wave: Path | None = None, **choices) -> Frame:
    """Render ``scene`` by the processor, the RTL under Verilator: its colours are those of the pixel stream.

    Depth, t, surface and normal are those of the visible hits among the records of its rings.
    choices  see :func:`~raydix.processor.run_frames`
    Raises SceneError, and RtlError where a tool fails.
    """
    compiled = compile_scene(scene, config)
    return _frame_of(
        scene, compiled, config, run_frames([(scene, compiled)], config, wave=wave, progress=progress, **choices)
    )


def _frame_of(scene, compiled, config, output) -> Frame:
    """What left the processor as a frame."""
    frame = compose(scene, output.hits, config, config.layers)
    frame.rgb = output.rgb[0]
    frame.counters = output.counters
    return frame


@dataclass
class Verdict:
    """The golden model and the RTL side by side.

    hit_bits    bits that differ in the hits that left the rings (digits, depth, point)
    image_bits  bits that differ in the finished frames (depth, t, surface, normal, rgb)
    """

    golden: Frame
    rtl: Frame
    hit_bits: int
    image_bits: int

    def differing(self) -> np.ndarray:
        """Where the finished frames differ: bool (H, W)."""
        return _image_bits(self.golden, self.rtl) > 0

    def first_ray(self) -> tuple[int, int, int | None] | None:
        """Column, row and surface of the first ray whose hits differ.

        Where none's do, of the first pixel that differs and has rays; the surface is None: it may be any there. None,
        where no pixel that differs has a ray.
        """
        if rays := differing_rays(self.rtl.hits, self.golden.hits):
            y, x, index = rays[0]
            return x, y, index
        looked_at = np.zeros(self.golden.t.shape, bool)
        for hits in self.golden.hits.surfaces:
            x0, y0, x1, y1 = hits.surface.rect
            looked_at[y0 : y1 + 1, x0 : x1 + 1] = True
        pixels = np.argwhere(self.differing() & looked_at).tolist()
        return (pixels[0][1], pixels[0][0], None) if pixels else None


def differing_rays(part: FrameHits, whole: FrameHits) -> list[tuple[int, int, int]]:
    """Row, column and surface of each ray of ``part`` that has a hit which is not that of ``whole``, in this order."""
    rays = []
    for one, other in zip(part.surfaces, whole.surfaces, strict=True):
        differs = (one.t != other.t) | (one.depth != other.depth) | (one.enters != other.enters)
        differs |= (one.point != other.point).any(axis=3)
        x0, y0, *_ = one.surface.rect
        places = np.argwhere((differs & (one.t >= 0)).any(axis=2)) + (y0, x0)
        rays += [(y, x, one.surface.index) for y, x in places.tolist()]
    return sorted(rays)


def _image_bits(a: Frame, b: Frame) -> np.ndarray:
    """Bits that differ in each pixel: int64 (H, W)."""
    total = np.zeros(a.t.shape, np.int64)
    for name in ("depth", "t", "surface", "normal", "rgb"):
        one, other = (np.ascontiguousarray(getattr(f, name)).view(np.uint8) for f in (a, b))
        total += np.bitwise_count(one ^ other).reshape(*total.shape, -1).sum(axis=2, dtype=np.int64)
    return total


def verify(scene: Scene, config: Config, threads: int = 1, progress=None) -> Verdict:
    """Render ``scene`` by both cores and count the bits that differ. Raises SceneError, RtlError.

    progress  two functions, of the golden model and of the RTL
    """
    compiled = compile_scene(scene, config)
    of_golden, of_rtl = progress or (None, None)
    golden = compose(scene, trace_golden(compiled, config, threads, of_golden), config, config.layers)
    output = run_frames([(scene, compiled)], config, progress=of_rtl)
    rtl = _frame_of(scene, compiled, config, output)
    return Verdict(golden, rtl, differing_bits_of(rtl.hits, golden.hits), int(_image_bits(golden, rtl).sum()))


def steps_of(frame: Frame) -> np.ndarray:
    """Steps of the items of each pixel together, int64 (H, W): where the work went.

    Of the processor's frame those of the rays whose records left its rings; its counters have the sum of all.
    """
    compiled = frame.hits.compiled
    steps = np.zeros((compiled.height, compiled.width), np.int64)
    for hits in frame.hits.surfaces:
        left, top, right, bottom = hits.surface.rect
        steps[top : bottom + 1, left : right + 1] += hits.steps
    return steps


def summary(verdict: Verdict, config: Config) -> dict:
    """A verdict in figures, for JSON: each side's rays, hits, steps, seconds and cycles, and how much differs."""
    height, width = verdict.golden.t.shape
    sides = {
        side: frame.hits.counts() | {"seconds": frame.hits.seconds, "cycles": frame.hits.cycles} | frame.counters
        for side, frame in (("golden", verdict.golden), ("rtl", verdict.rtl))
    }
    pixels = {
        "pixels": int(verdict.differing().sum()),
        "hit_bits": verdict.hit_bits,
        "image_bits": verdict.image_bits,
    }
    return {"width": width, "height": height, "config": asdict(config), **sides, "differing": pixels}


def write_verdict(verdict: Verdict, out: Path, name: str, config: Config) -> list[Path]:
    """Write both outputs (``out``/golden, ``out``/rtl), and beside them what compares them.

    ``name``-difference.png: black where they are equal; ``name``-steps.npz: :func:`steps_of` of both, arrays golden and
    rtl; ``name``.json: :func:`summary`.
    """
    a, b = verdict.golden, verdict.rtl
    picture = np.zeros_like(a.rgb)
    picture[verdict.differing()] = (255, 0, 0)
    text = json.dumps(summary(verdict, config), indent=1) + "\n"
    beside = {
        out / f"{name}-difference.png": png_writer(picture),
        out / f"{name}-steps.npz": lambda work: np.savez_compressed(work, golden=steps_of(a), rtl=steps_of(b)),
        out / f"{name}.json": text_writer(text),
    }
    return write_files(frame_writers(a, out / "golden", name) | frame_writers(b, out / "rtl", name) | beside)
