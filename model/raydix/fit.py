# SPDX-License-Identifier: Apache-2.0
"""The hardware that a scene needs: what it does not need is not built."""

from .compile import clip_box
from .compile_spiral import needs_general
from .scene import Scene
from .surfaces import form

MOST_LAYERS = 8  # that are built if not asked for otherwise


def families(scene: Scene) -> dict:
    """`degree`, `clip` and `vecsum` of the smallest :class:`~raydix.config.Config` that can render the scene."""
    spirals = [s for s in scene.surfaces if s.type == "spiral"]
    algebraic = [s for s in scene.surfaces if s.type != "spiral"]
    degree = max((2 if form(s).q1 is None else 4 for s in algebraic), default=0)
    vecsum = "none" if not spirals else "general" if any(map(needs_general, spirals)) else "helix"
    return {"degree": degree, "clip": any(any(clip_box(s)[2]) for s in algebraic), "vecsum": vecsum}


def frame_parameters(scene: Scene, beat: int = 1) -> dict:
    """`surfaces`, `layers` and `max_width` of the smallest processor that shows the whole scene.

    A transparent surface can be met as often as it has roots, so the layers are those of all transparent surfaces
    and one opaque, at most :data:`MOST_LAYERS`.
    """
    layers = 1
    for s in scene.surfaces:
        if s.opacity < 1:
            layers += 4 if s.type == "spiral" or form(s).q1 is not None else 2
    return {
        "surfaces": max(1, len(scene.surfaces)),
        "layers": min(layers, MOST_LAYERS),
        "max_width": -(-scene.camera.width // beat) * beat,
        "beat": beat,
    }
