# SPDX-License-Identifier: Apache-2.0
"""The processor as its host sees it: ``rdx_top`` under Verilator, driven by its registers (``tb/frame/top.cpp``)."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import csr
from .compile import CompiledFrame
from .config import Config
from .hits import FrameHits
from .material import material_words
from .rtl import RECORD, TOP, RtlError, _collect, build, simulate
from .scene import Scene, SceneError
from .shade import units

WRITE, UNTIL, READ, INTERRUPT = range(4)  # kinds of operations
SKIPS = ("rectangle", "boxes", "rootless", "depth", "early")
ALL = frozenset(SKIPS)
COUNTERS = (
    "CYCLES_LOW", "CYCLES_HIGH", "STEPS_LOW", "STEPS_HIGH", "RAYS", "HITS", "SKIPPED_RECTANGLE", "SKIPPED_ROOTLESS",
    "SKIPPED_DEPTH", "SKIPPED_BOXES", "SKIPPED_CELLS", "SKIPPED_EARLY", "VISIBLE", "LAYERS_LOST", "GIVEN_UP", "STALLED",
)  # fmt: skip


class Host:
    """Operations of a host on registers and tables, one after the other: four words each, see ``tb/frame/top.cpp``."""

    def __init__(self):
        self.map = csr.address_map()
        self.operations: list[tuple[int, int, int, int]] = []

    def address(self, name: str) -> int:
        """Of a register or a window."""
        return (self.map.REGISTERS | self.map.WINDOWS)[name]["address"]

    def mask(self, name: str, field: str) -> tuple[int, int]:
        """Lowest bit and mask of a register's field."""
        f = self.map.REGISTERS[name]["fields"][field]
        return f["low"], ((1 << f["width"]) - 1) << f["low"]

    def write(self, name: str, *, offset: int = 0, **fields: int) -> None:
        """Write a register's fields, the others 0; or ``value`` at an offset into a window."""
        value = fields.pop("value", 0)
        for field, number in fields.items():
            low, mask = self.mask(name, field)
            value |= number << low & mask
        self.operations.append((WRITE, self.address(name) + offset, value & 0xFFFFFFFF, 0))

    def until(self, name: str, field: str, number: int) -> None:
        """Read a register until a field has this value."""
        low, mask = self.mask(name, field)
        self.operations.append((UNTIL, self.address(name), number << low, mask))

    def read(self, name: str) -> None:
        """Read a register; the bench prints its value."""
        self.operations.append((READ, self.address(name), 0, 0))

    def frame(
        self, scene: Scene, compiled: CompiledFrame, config: Config, skips=ALL, k_stop: int | None = None
    ) -> None:
        """Tables and registers of a frame, then its start."""
        for slot, surface in enumerate(compiled.surfaces):
            for number, word in enumerate(surface.words):
                for half in range(2):
                    value = word >> 32 * half & 0xFFFFFFFF
                    self.write("DESCRIPTORS", offset=1024 * slot + 8 * number + 4 * half, value=value)
            words = material_words(scene, scene.surfaces[surface.index], surface.origin, surface.unit)
            for number, word in enumerate(words):
                self.write("MATERIALS", offset=256 * surface.index + 4 * number, value=int(word))
        self.write("SIZE", width=compiled.width, height=compiled.height)
        self.write("COUNT", count=len(compiled.surfaces))
        self.write("K_STOP", k_stop=config.k_stop)
        self.write("SKIP", **{name: int(name in skips) for name in SKIPS})
        self.write("AMBIENT", ambient=int(units([scene.light.ambient])[0]))
        red, green, blue = (int(v) for v in units(scene.background.color))
        self.write("BACKGROUND_R", red=red)
        self.write("BACKGROUND_G", green=green)
        self.write("BACKGROUND_B", blue=blue)
        self.write("CONTROL", start=1)


@dataclass
class Output:
    """What left the processor.

    rgb       uint8 (frames, H, W, 3)
    hits      of the first frame: those that left the rings; rays that were skipped have none
    counters  of the last frame, by register name in small letters
    frames, lines   marks in the pixel stream
    """

    rgb: np.ndarray
    hits: FrameHits
    counters: dict[str, int]
    frames: int
    lines: int


def run_frames(
    frames: list[tuple[Scene, CompiledFrame]],
    config: Config,
    skips=ALL,
    stall: int | None = None,
    wave: Path | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Output:
    """Render frames of one size by the RTL, each loaded while the one before is made.

    skips   what may be skipped, names of SKIPS
    stall   seed of random stalls on both buses; wave, progress: see :func:`~raydix.rtl.trace_rtl`
    Raises :class:`~raydix.rtl.RtlError`, and SceneError where a frame does not fit the configuration.
    """
    width, height = frames[0][1].width, frames[0][1].height
    for scene, compiled in frames:
        if (compiled.width, compiled.height) != (width, height):
            raise RtlError(f"frames: found {compiled.width}×{compiled.height}; allowed: {width}×{height}, as the first")
        for name, found, allowed in (
            ("camera.width", width, config.max_width),
            ("surface: number", len(scene.surfaces), config.surfaces),
        ):
            if found > allowed:
                raise SceneError(f"{scene.path}: {name}: found {found}; allowed: up to {allowed} in this configuration")
    binary = build(config, wave.suffix[1:] if wave else None, TOP)
    host = Host()
    for scene, compiled in frames:
        host.until("STATUS", "queued", 0)
        host.frame(scene, compiled, config, skips)
    host.until("FRAMES", "count", len(frames))
    for name in COUNTERS:
        host.read(name)
    host.read("ERROR")
    total = len(frames) * width * height
    with tempfile.TemporaryDirectory() as folder:
        program, image, records = (Path(folder, name) for name in ("program", "image", "records"))
        np.array(host.operations, np.uint32).tofile(program)
        report = simulate([binary, program, total, image, records], total, stall, wave, progress)
        rgb = np.fromfile(image, np.uint8).reshape(len(frames), height, width, 3)
        items = np.fromfile(records, RECORD)
    *values, error = report["values"]
    if error:
        raise RtlError(f"the processor reports error {error & 15} of slot {error >> 8}")
    named = dict(zip(map(str.lower, COUNTERS), values, strict=True))
    for name in ("cycles", "steps"):
        named[name] = named.pop(f"{name}_low") | named.pop(f"{name}_high") << 32
    surfaces = _collect(frames[0][1], items, every=False) if len(frames) == 1 else []
    hits = FrameHits(frames[0][1], surfaces, report["seconds"], named["cycles"])
    return Output(rgb, hits, named, report["frames"], report["lines"])
