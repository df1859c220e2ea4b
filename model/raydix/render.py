# SPDX-License-Identifier: Apache-2.0
"""Scene to frame through either core."""

from .compile import compile_scene
from .config import Config
from .golden import trace_golden
from .scene import Scene
from .shade import Frame, compose


def render_golden(scene: Scene, config: Config, threads: int = 1, progress=None) -> Frame:
    """Render ``scene`` by the golden model. Raises SceneError where the scene does not fit the configuration."""
    compiled = compile_scene(scene, config)
    return compose(scene, trace_golden(compiled, config, threads, progress), config)
