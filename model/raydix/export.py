# SPDX-License-Identifier: Apache-2.0
"""A frame's stimulus and its expected answer as text files, for a test bench of the user's own."""

import csv
import json
from dataclasses import asdict
from pathlib import Path

from .compile import compile_scene, descriptor_array
from .config import Config
from .golden import trace_golden
from .image import write_files
from .rtl import parameters
from .scene import Scene


def export(scene: Scene, config: Config, out: Path, progress=None) -> list[Path]:
    """Write ``words.hex``, ``hits.csv`` and ``parameters.json`` into the folder ``out``; returns the paths.

    words.hex        the descriptor stream, a 64-bit word a line ($readmemh)
    hits.csv         the golden model's hits by surface, row, column and root, with the fields of the hit record
                     (docs/number-formats.md); a ray without a root has one line with hit = 0. The RTL may give rays in
                     another order. steps_of_ray is what the ray's last record says
    parameters.json  parameters of rdx_core, and the configuration
    Raises SceneError, ImageError.
    """
    compiled = compile_scene(scene, config)
    hits = trace_golden(compiled, config, 1, progress)

    def write_words(path: Path) -> None:
        path.write_text("".join(f"{int(word) & (1 << 64) - 1:016x}\n" for word in descriptor_array(compiled)))

    def write_hits(path: Path) -> None:
        with path.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["surface", "x", "y", "hit", "t", "depth", "px", "py", "pz", "steps_of_ray"])
            for found in hits.surfaces:
                x0, y0, _, _ = found.surface.rect
                rows, columns, roots = found.t.shape
                for y in range(rows):
                    for x in range(columns):
                        steps = found.steps[y, x]
                        place = found.surface.index, x + x0, y + y0
                        if found.t[y, x, 0] < 0:
                            writer.writerow([*place, 0, 0, 0, 0, 0, 0, steps])
                        for root in range(roots):
                            if found.t[y, x, root] >= 0:
                                point = found.point[y, x, root]
                                writer.writerow(
                                    [*place, 1, found.t[y, x, root], found.depth[y, x, root], *point, steps]
                                )

    def write_parameters(path: Path) -> None:
        path.write_text(json.dumps({"rdx_core": parameters(config), "configuration": asdict(config)}, indent=2) + "\n")

    writers = {"words.hex": write_words, "hits.csv": write_hits, "parameters.json": write_parameters}
    return write_files({out / name: write for name, write in writers.items()})
