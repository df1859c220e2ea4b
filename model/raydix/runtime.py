# SPDX-License-Identifier: Apache-2.0
"""Verilator's runtime and its headers, compiled once for all designs that are built with the same options.

Without it half of what the compiler does for a processor is the same for each. g++ takes ``runtime.h.fast.gch``
in place of ``runtime.h.fast`` where its options are the same, and reads the header where they are not.
"""

import contextlib
import functools
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

HEADER = "runtime.h"
FAST, SLOW = f"{HEADER}.fast", f"{HEADER}.slow"
COMPILED = f"{FAST}.gch"
INCLUDES = "".join(f"#include <{h}>\n" for h in ("verilated.h", "verilated_vpi.h", "iostream", "memory", "sstream"))


@functools.cache
def compiler() -> str:
    """What the C++ compiler calls itself, empty where there is none: another one cannot use what this one has made."""
    try:
        return subprocess.run(["c++", "--version"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""


def place(work: Path, cache: Path) -> None:
    """Put the header and what ``cache`` has into the folder ``work`` of a build, before make runs there."""
    for name in (HEADER, FAST, SLOW):
        (work / name).write_text(INCLUDES)
    for file in cache.glob("*"):
        shutil.copyfile(file, work / file.name)
        os.utime(work / file.name, (time.time() + 3600,) * 2)  # else make finds the generated makefile younger


def keep(work: Path, cache: Path) -> None:
    """Keep what a build has compiled that is not its design's, unless ``cache`` is there."""
    if cache.exists():
        return
    cache.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="runtime-", dir=cache.parent) as folder:
        new = Path(folder, cache.name)
        new.mkdir()
        for file in (*work.glob("verilated*.o"), *work.glob(f"{HEADER}.*.gch")):
            shutil.move(file, new)
        with contextlib.suppress(OSError):  # another build was first
            os.replace(new, cache)
