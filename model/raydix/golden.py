# SPDX-License-Identifier: Apache-2.0
"""Runs the golden model over a compiled frame, on any number of threads."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from .compile import CompiledFrame, CompiledSurface
from .config import Config
from .core import renderer, scratch
from .formats import VECTOR_WIDTH
from .hits import FrameHits, SurfaceHits
from .item import FIRST
from .kernel import words

ROWS = 16  # rows of a piece of work


def _piece(surface: CompiledSurface, descriptor, config: Config, hits: SurfaceHits, begin: int, end: int) -> int:
    """Rows ``begin`` to ``end - 1`` of a surface; returns the number of rays."""
    rows, columns, roots = hits.t.shape
    places = rows * columns * roots
    if surface.is_vector_sum:
        width, degree, general = VECTOR_WIDTH, 1, int(config.vecsum == "general")
    else:
        width, degree, general = config.width, config.degree, 0
    state, item, *others = scratch(config, degree)
    item[FIRST] = config.steps - config.k_stop
    render_rows = renderer(config.n1, config.steps, width, degree, general)
    render_rows(
        descriptor,
        begin,
        end,
        state,
        item,
        *others,
        hits.t.reshape(places),
        hits.depth.reshape(places),
        hits.point.reshape(places, 3),
        hits.enters.reshape(places),
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
    for kind in (False, True):  # no rows: compiles the kernels, or loads them from the cache, before the clock runs
        first = next((piece for piece in work if piece[0].is_vector_sum == kind), None)
        if first:
            _piece(*first[:4], 0, 0)
    started = time.perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        for count in pool.map(lambda piece: _piece(*piece), work):
            done += count
            if progress:
                progress(done, total)
    frame.seconds = time.perf_counter() - started
    return frame
