# SPDX-License-Identifier: Apache-2.0
"""Where golden model and RTL part: the first step of a ray, and the first signal of it, in which they differ."""

from pathlib import Path

from .compile import CompiledFrame, CompiledSurface
from .config import Config
from .processor import run_frames
from .scene import Scene
from .trace_ray import Step, alone, follow
from .waves import Output, step_outputs


def difference(step: Step, output: Output | None) -> str:
    """The first field in which the RTL differs, with both values; empty where none does."""
    if output is None:
        return "step: RTL took none"
    pairs = [(name, getattr(step, name), getattr(output, name)) for name in ("status", "t", "next_t")]
    if step.status == "run":  # of a step after which there is no other the control points mean nothing
        pairs += [(f"b[{i}]", a, b) for i, (a, b) in enumerate(zip(step.after, output.after, strict=True))]
    if step.status in ("run", "hit"):
        pairs.append(("depth", step.depth, output.depth))
    return next((f"{name}: golden {a}, RTL {b}" for name, a, b in pairs if a != b), "")


def follow_both(
    scene: Scene, compiled: CompiledFrame, surface: CompiledSurface, config: Config, x: int, y: int, wave: Path
) -> tuple[list[Step], list[str]]:
    """Steps of the golden model on a surface, and in what the RTL's differ from each: empty where in nothing.

    The processor renders a frame of the pixel (x, y) alone and skips nothing; ``wave`` is the waveform (VCD) it writes.
    Raises ValueError where the surface's rectangle does not have the pixel, RtlError.
    """
    steps = follow(surface, config, x, y)
    run_frames([(scene, alone(compiled, surface, x, y))], config, skips=frozenset(), wave=wave)
    outputs = {output.number: output for output in step_outputs(wave)}
    differences = [difference(step, outputs.get(step.number)) for step in steps]
    if not any(differences) and len(outputs) > len(steps):
        differences[-1] = f"step: RTL took {len(outputs)}"
    return steps, differences


def first_difference(steps: list[Step], differences: list[str]) -> str:
    """The first step that differs, with its signal and both values; empty where none does."""
    found = ((step, text) for step, text in zip(steps, differences, strict=True) if text)
    return next((f"step {step.number}, {text}" for step, text in found), "")


def surfaces_at(compiled: CompiledFrame, x: int, y: int, surface: int | None) -> list[CompiledSurface]:
    """Those whose rectangles have the pixel, or the one of this number, if it is one of them."""
    inside = [s for s in compiled.surfaces if s.rect[0] <= x <= s.rect[2] and s.rect[1] <= y <= s.rect[3]]
    return [s for s in inside if surface in (None, s.index)]
