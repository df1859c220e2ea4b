# SPDX-License-Identifier: Apache-2.0
"""Scene to frame through either core, and both side by side."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .compile import compile_scene
from .config import Config
from .golden import trace_golden
from .hits import FrameHits, differing_bits
from .image import frame_writers, png_writer, write_files
from .rtl import trace_rtl
from .scene import Scene
from .shade import Frame, compose


def render_golden(scene: Scene, config: Config, threads: int = 1, progress=None) -> Frame:
    """Render ``scene`` by the golden model. Raises SceneError where the scene does not fit the configuration."""
    compiled = compile_scene(scene, config)
    return compose(scene, trace_golden(compiled, config, threads, progress), config)


def render_rtl(scene: Scene, config: Config, progress=None, wave: Path | None = None) -> Frame:
    """Render ``scene`` by the RTL under Verilator. Raises SceneError, and RtlError where a tool fails."""
    compiled = compile_scene(scene, config)
    return compose(scene, trace_rtl(compiled, config, wave=wave, progress=progress), config)


@dataclass
class Verdict:
    """The golden model and the RTL side by side.

    hit_bits    bits that differ in what the cores gave back (digits, depth, point, steps)
    image_bits  bits that differ in the finished frames (depth, t, surface, normal, rgb)
    """

    golden: Frame
    rtl: Frame
    hit_bits: int
    image_bits: int


def _image_bits(a: Frame, b: Frame) -> int:
    total = 0
    for name in ("depth", "t", "surface", "normal", "rgb"):
        one, other = (np.ascontiguousarray(getattr(f, name)).view(np.uint8) for f in (a, b))
        total += int(np.bitwise_count(one ^ other).sum())
    return total


def verify(scene: Scene, config: Config, threads: int = 1, progress=None) -> Verdict:
    """Render ``scene`` by both cores and count the bits that differ. Raises SceneError, RtlError.

    progress  two functions, of the golden model and of the RTL
    """
    compiled = compile_scene(scene, config)
    of_golden, of_rtl = progress or (None, None)
    golden: FrameHits = trace_golden(compiled, config, threads, of_golden)
    rtl: FrameHits = trace_rtl(compiled, config, progress=of_rtl)
    frames = [compose(scene, hits, config) for hits in (golden, rtl)]
    return Verdict(*frames, differing_bits(golden, rtl), _image_bits(*frames))


def write_verdict(verdict: Verdict, out: Path, name: str) -> list[Path]:
    """Write both outputs (``out``/golden, ``out``/rtl) and the difference picture: black where they are equal."""
    a, b = verdict.golden, verdict.rtl
    differs = (a.rgb != b.rgb).any(axis=2) | (a.t != b.t) | (a.surface != b.surface) | (a.depth != b.depth)
    picture = np.zeros_like(a.rgb)
    picture[differs] = (255, 0, 0)
    writers = frame_writers(a, out / "golden", name) | frame_writers(b, out / "rtl", name)
    return write_files(writers | {out / f"{name}-difference.png": png_writer(picture)})
