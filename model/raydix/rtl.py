# SPDX-License-Identifier: Apache-2.0
"""Builds the RTL with Verilator and runs frames through it: ``tb/frame/frame.cpp`` around ``rdx_core``.

The processor, ``rdx_top``, is run by ``processor.py``.
"""

import hashlib
import json
import os
import platform
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from contextlib import nullcontext
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import runtime
from .building import building, locked
from .compile import CompiledFrame, descriptor_array
from .config import Config
from .files import (
    GENERATED_CONTROL,
    LINT_CONTROL,
    ROOT,
    RTL,
    TRACE_CONTROL,
    environment,
    has_fst,
    sources,
    top_sources,
)
from .hits import FrameHits, SurfaceHits
from .replacing import replacing

BENCH = ROOT / "tb" / "frame"
BUILD = ROOT / "build" / "rtl"
RULES = {"certified": 1, "paper": 2, "both": 3}
VECSUMS = {"none": 0, "helix": 1, "general": 2}

# layout of Record in tb/frame/frame.cpp
RECORD = np.dtype(
    [
        ("x", "<u2"),
        ("y", "<u2"),
        ("surface", "u1"),
        ("hit", "u1"),
        ("last", "u1"),
        ("enters", "u1"),
        ("t", "<u4"),
        ("depth", "<i4"),
        ("point", "<i4", 3),
        ("steps", "<u4"),
    ]
)


class RtlError(RuntimeError):
    """Verilator or the simulation failed; the text says what and where the log is."""


def parameters(config: Config) -> dict[str, int]:
    """Parameters of ``rdx_core`` for a configuration."""
    return {
        "N1": config.n1,
        "K": config.steps,
        "W": config.width,
        "D": config.degree,
        "U": config.units,
        "Rules": RULES[config.rules],
        "Clip": int(config.clip),
        "HalveStages": config.halve_stages,
        "Vecsum": VECSUMS[config.vecsum],
        "Lanes": config.lanes,
        "VectorUnits": config.vector_units,
        "VectorDrop": config.vector_drop,
        "Rings": config.rings,
        "VectorRings": config.vector_rings,
    }


def top_parameters(config: Config) -> dict[str, int]:
    """Parameters of ``rdx_top`` for a configuration."""
    return parameters(config) | {
        "Surfaces": config.surfaces,
        "Layers": config.layers,
        "MaxWidth": config.max_width,
        "Pixels": config.beat,
    }


class Design(NamedTuple):
    """What is simulated at full speed, and its bench."""

    top: str
    parameters: Callable[[Config], dict[str, int]]
    sources: Callable[[], list[Path]]
    bench: Path


CORE = Design("rdx_core", parameters, sources, BENCH / "frame.cpp")
TOP = Design("rdx_top", top_parameters, top_sources, BENCH / "top.cpp")


# The packaged verilated.mk lacks the flag for precompiled headers; OPT_FAST speeds up the simulation.
# In place of a header of each design's own that of the runtime is compiled ahead.
HEADERS = f"VK_PCH_H={runtime.HEADER} VK_PCH_I_FAST='-include {runtime.FAST}' VK_PCH_I_SLOW='-include {runtime.SLOW}'"
MAKE_FLAGS = f"CFG_CXXFLAGS_PCH_I=-include {HEADERS} OPT_FAST='-O2 -march=native'"


def _trace_arguments(trace: str | None) -> list[str]:
    """What Verilator needs for a simulator that writes waveforms, and frame.cpp to know of it."""
    if trace is None:
        return []
    if trace not in ("vcd", "fst"):
        raise RtlError(f"waveform format: found '{trace}'; allowed: vcd, fst")
    if trace == "fst" and not has_fst():
        raise RtlError(
            "waveform format: found 'fst'; allowed: vcd (fst needs lz4.h, Debian: apt-get install liblz4-dev)"
        )
    return [f"--trace-{trace}", "--trace-structs", str(TRACE_CONTROL), "-CFLAGS", f"-DRDX_TRACE_{trace.upper()}"]


def build(config: Config, trace: str | None = None, design: Design = CORE) -> Path:
    """The simulator of a design for ``config``, built unless the same sources were built before.

    trace   "vcd" or "fst" for one that can write waveforms
    Raises :class:`RtlError` with the compiler's last lines.
    """
    arguments = [f"-G{name}={value}" for name, value in design.parameters(config).items()]
    arguments += ["--cc", "--exe", "--build", "-j", "2", "-Wall", "--assert", "-O3", "--x-assign", "fast"]
    arguments += ["--x-initial", "fast", "--top-module", design.top, f"-I{RTL}", "-MAKEFLAGS", MAKE_FLAGS]
    arguments += _trace_arguments(trace)
    arguments += [str(GENERATED_CONTROL), str(LINT_CONTROL)] if design is TOP else [str(LINT_CONTROL)]
    files = [*design.sources(), *sorted(RTL.glob("*.svh")), design.bench, *sorted(BENCH.glob("*.h"))]
    content = b"".join(p.read_bytes() for p in files) + repr((arguments, _processor())).encode()
    binary = BUILD / hashlib.sha256(content).hexdigest()[:20]
    BUILD.mkdir(parents=True, exist_ok=True)
    with locked(binary.with_suffix(".lock")):  # a second process waits for the first one's build
        if not binary.exists():
            options = repr((MAKE_FLAGS, trace, version("verilator"), _processor(), runtime.compiler())).encode()
            cache = BUILD / f"runtime-{hashlib.sha256(options).hexdigest()[:20]}"
            _verilate(arguments, binary, design, cache)
    return binary


def _processor() -> str:
    """What -march=native depends on, as far as the system tells."""
    try:
        return next(line for line in open("/proc/cpuinfo") if line.startswith(("flags", "Features")))
    except (OSError, StopIteration):
        return platform.processor()


def _verilate(arguments: list[str], binary: Path, design: Design, cache: Path) -> None:
    """Build in a folder of its own and move the binary to its name when it is complete; ``cache``: of the runtime."""
    for tool in ("perl", "make", "c++"):
        if shutil.which(tool) is None:
            package = "g++" if tool == "c++" else tool
            raise RtlError(f"{tool} is missing; Verilator needs it (Debian: apt-get install {package})")
    with building(BUILD) as work:
        runtime.place(work, cache)
        command = [
            "verilator",
            *arguments,
            "-Mdir",
            str(work),
            "-o",
            "frame",
            *map(str, design.sources()),
            str(design.bench),
        ]
        run = subprocess.run(command, env=environment(), capture_output=True, text=True)
        output = run.stdout + run.stderr
        if run.returncode:
            log = binary.with_suffix(".log")
            log.write_text(output)
            raise RtlError(f"verilator failed; log: {log}\n" + "\n".join(output.splitlines()[-12:]))
        os.replace(work / "frame", binary)
        runtime.keep(work, cache)


def _collect(compiled: CompiledFrame, records: np.ndarray, every: bool = True) -> list[SurfaceHits]:
    """Records in any order to arrays by pixel. Raises :class:`RtlError` where rays are missing or come twice.

    every  each pixel of the rectangles has a ray; else some may have none
    """
    surfaces = []
    for surface in compiled.surfaces:
        hits = SurfaceHits.empty(surface)
        rows, columns, roots = hits.t.shape
        mine = records[records["surface"] == surface.index]
        x, y = mine["x"].astype(np.int64) - surface.rect[0], mine["y"].astype(np.int64) - surface.rect[1]
        if ((x < 0) | (x >= columns) | (y < 0) | (y >= rows)).any():
            raise RtlError(f"surface {surface.index}: a record outside of its rectangle")
        pixel = y * columns + x
        ends = np.bincount(pixel[mine["last"] == 1], minlength=rows * columns)
        wrong = int((ends != 1).sum() if every else (ends > 1).sum())
        if wrong:
            raise RtlError(f"surface {surface.index}: {wrong} rays do not have exactly one last record")
        found = mine["hit"] == 1
        order = np.argsort(pixel[found], kind="stable")
        at = pixel[found][order]
        rank = np.arange(at.size) - np.searchsorted(at, at)
        if (rank >= roots).any():
            raise RtlError(f"surface {surface.index}: a ray has more than {roots} roots")
        for name in ("t", "depth", "point", "enters"):
            array = getattr(hits, name)
            array.reshape(rows * columns, roots, *array.shape[3:])[at, rank] = mine[name][found][order]
        last = mine["last"] == 1
        hits.steps.reshape(rows * columns)[pixel[last]] = mine["steps"][last]
        surfaces.append(hits)
    return surfaces


def simulate(command, total: int, stall: int | None, wave: Path | None, progress) -> dict:
    """Run a bench, ``command`` with its arguments; what it reports. See :func:`trace_rtl`.

    The waveform has its name once the bench has ended, also where the simulation failed; interrupted, it leaves none.
    """
    if wave:
        try:
            wave.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise RtlError(f"{wave.parent}: cannot make the folder: {error.strerror}") from None
    command = [*map(str, command)]
    command += ["--stall", str(stall)] if stall is not None else []
    command += ["--progress", str(1 << 14)] if progress else []
    line, failed = "", ""
    with replacing(wave) if wave else nullcontext() as part:
        command += ["--trace", str(part)] if part else []
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as run:
            assert run.stdout  # it is a pipe
            for line in run.stdout:
                failed = failed or (line if "%Error" in line else "")  # an assertion's; more lines say that it stops
                if progress and line.startswith("progress "):
                    progress(int(line.split()[1]), total)
    if run.returncode:
        raise RtlError(f"simulation failed: {(failed or line).strip()}")
    return json.loads(line)


def trace_rtl(
    compiled: CompiledFrame,
    config: Config,
    stall: int | None = None,
    wave: Path | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> FrameHits:
    """Hits of all surfaces of ``compiled`` from the RTL under Verilator.

    stall     seed of random stalls at both ports
    wave      waveform file to write; its ending, .vcd or .fst, names the format
    progress  called with (rays done, rays in all)
    Raises :class:`RtlError`.
    """
    total = sum(SurfaceHits.empty(s).steps.size for s in compiled.surfaces)
    binary = build(config, wave.suffix[1:] if wave else None)
    with tempfile.TemporaryDirectory() as folder:
        words, out = Path(folder, "words"), Path(folder, "records")
        words.write_bytes(descriptor_array(compiled).tobytes())
        report = simulate([binary, words, total, out], total, stall, wave, progress)
        records = np.fromfile(out, RECORD)
    return FrameHits(compiled, _collect(compiled, records), report["seconds"], report["cycles"])
