# SPDX-License-Identifier: Apache-2.0
"""Runs the golden model over a compiled frame, on any number of threads."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from .compile import CompiledFrame, CompiledSurface
from .config import Config
from .core import renderer, scratch
from .hits import FrameHits, SurfaceHits
from .kernel import words

ROWS = 16  # rows of a piece of work


def _piece(surface: CompiledSurface, descriptor, config: Config, hits: SurfaceHits, begin: int, end: int) -> int:
    """Rows ``begin`` to ``end - 1`` of a surface; returns the number of rays."""
    rows, columns, roots = hits.t.shape
    places = rows * columns * roots
    render_rows = renderer(config.n1, config.steps, config.width, config.degree)
    render_rows(
        descriptor,
        begin,
        end,
        *scratch(config),
        hits.t.reshape(places),
        hits.depth.reshape(places),
        hits.point.reshape(places, 3),
        hits.steps.reshape(rows * columns),
    )
    return (end - begin) * columns


def trace_golden(
    compiled: CompiledFrame, config: Config, threads: int = 1, progress: Callable[[int, int], None] | None = None
) -> FrameHits:
    """Hits of all surfaces of ``compiled`` under ``config``.

    threads   rows are shared out over this many threads; the result does not depend on it
    progress  called with (rays done, rays in all)
    """
    frame = FrameHits(compiled, [SurfaceHits.empty(s) for s in compiled.surfaces])
    work = []
    for hits in frame.surfaces:
        descriptor = words(hits.surface.words)
        rows = hits.t.shape[0]
        for begin in range(0, rows, ROWS):
            work.append((hits.surface, descriptor, config, hits, begin, min(rows, begin + ROWS)))
    total = sum(hits.steps.size for hits in frame.surfaces)
    done = 0
    if work:  # no rows: compiles the kernel, or loads it from the cache, before the clock runs
        _piece(*work[0][:4], 0, 0)
    started = time.perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        for count in pool.map(lambda piece: _piece(*piece), work):
            done += count
            if progress:
                progress(done, total)
    frame.seconds = time.perf_counter() - started
    return frame
