# SPDX-License-Identifier: Apache-2.0
"""The surface families that a scene needs: what it does not need is not built."""

from .compile_spiral import needs_general
from .scene import Scene
from .surfaces import form


def families(scene: Scene) -> dict:
    """`degree` and `vecsum` of the smallest :class:`~raydix.config.Config` that can render the scene."""
    spirals = [s for s in scene.surfaces if s.type == "spiral"]
    algebraic = [s for s in scene.surfaces if s.type != "spiral"]
    degree = max((2 if form(s).q1 is None else 4 for s in algebraic), default=0)
    vecsum = "none" if not spirals else "general" if any(map(needs_general, spirals)) else "helix"
    return {"degree": degree, "vecsum": vecsum}
