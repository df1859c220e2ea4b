# SPDX-License-Identifier: Apache-2.0
"""Where golden model and RTL part: the first step of a ray and its first signal that differ, or what does after."""

from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

from .compile import CompiledFrame, CompiledSurface
from .config import Config
from .golden import trace_golden
from .hits import FrameHits
from .processor import run_frames
from .scene import Scene
from .shade import compose
from .trace_ray import Step, alone, follow
from .waves import Output, step_outputs


class Followed(NamedTuple):
    """A ray on a surface, alone in the processor.

    steps        of the golden model
    differences  in what the RTL's differ from each: empty where in nothing
    behind       in what the hits, or the pixel's colour, differ though every step is the same; empty where in nothing
    """

    steps: list[Step]
    differences: list[str]
    behind: str

    @property
    def first(self) -> str:
        """The first step that differs, or what does behind the steps, with both values; empty where nothing does."""
        found = ((step, text) for step, text in zip(self.steps, self.differences, strict=True) if text)
        behind = f"behind the steps, {self.behind}" if self.behind else ""
        return next((f"step {step.number}, {text}" for step, text in found), behind)


def difference(step: Step, output: Output | None) -> str:
    """The first field in which the RTL differs, with both values; empty where none does."""
    if output is None:
        return "step: RTL took none"
    pairs = []
    if len(output.control) == len(step.control):
        pairs += [
            (f"b[{i}] before it", a, b) for i, (a, b) in enumerate(zip(step.control, output.control, strict=True))
        ]
    pairs += [(name, getattr(step, name), getattr(output, name)) for name in ("status", "t", "next_t")]
    if step.status == "run":  # of a step after which there is no other the control points mean nothing
        pairs += [(f"b[{i}]", a, b) for i, (a, b) in enumerate(zip(step.after, output.after, strict=True))]
    if step.status in ("run", "hit"):
        pairs.append(("depth", step.depth, output.depth))
    pairs.append(("steps", step.number, output.number))
    return next((f"{name}: golden {a}, RTL {b}" for name, a, b in pairs if a != b), "")


def follow_both(
    scene: Scene, compiled: CompiledFrame, surface: CompiledSurface, config: Config, x: int, y: int, wave: Path
) -> Followed:
    """The ray of the pixel (x, y) on a surface through golden model and RTL.

    The processor renders a frame of the pixel alone and skips nothing; ``wave`` is the waveform (VCD) it writes.
    Raises ValueError where the surface's rectangle does not have the pixel, RtlError.
    """
    steps = follow(surface, config, x, y)
    one = alone(compiled, surface, x, y)
    output = run_frames([(scene, one)], config, skips=frozenset(), wave=wave)
    outputs = step_outputs(wave)
    pairs = zip_longest(steps, outputs[: len(steps)])
    differences = [difference(step, other) for step, other in pairs]
    if not any(differences) and len(outputs) > len(steps):
        differences[-1] = f"step: RTL took {len(outputs)}"
    if any(differences):
        return Followed(steps, differences, "")
    golden = trace_golden(one, config)
    colours = compose(scene, golden, config, config.layers).rgb, output.rgb
    return Followed(steps, differences, hit_difference(golden, output.hits) or colour_difference(*colours))


def hit_difference(golden: FrameHits, rtl: FrameHits) -> str:
    """The first field of the first hit of a frame of one pixel and one surface in which the RTL differs."""
    (one,), (other,) = golden.surfaces, rtl.surfaces
    for i in range(one.t.shape[2]):
        for name in ("t", "depth", "point", "enters"):
            a, b = (getattr(hits, name)[0, 0, i].tolist() for hits in (one, other))
            if a != b:
                return f"{name} of hit {i + 1}: golden {a}, RTL {b}"
    return ""


def colour_difference(golden, rtl) -> str:
    """The first channel of the first pixel in which the RTL differs; colours are uint8 (…, 3)."""
    pairs = zip(
        ("red", "green", "blue"), golden.reshape(-1, 3)[0].tolist(), rtl.reshape(-1, 3)[0].tolist(), strict=True
    )
    return next((f"{name}: golden {a}, RTL {b}" for name, a, b in pairs if a != b), "")


def surfaces_at(compiled: CompiledFrame, x: int, y: int, surface: int | None) -> list[CompiledSurface]:
    """Those whose rectangles have the pixel, or the one of this number, if it is one of them."""
    inside = [s for s in compiled.surfaces if s.rect[0] <= x <= s.rect[2] and s.rect[1] <= y <= s.rect[3]]
    return [s for s in inside if surface in (None, s.index)]
