# SPDX-License-Identifier: Apache-2.0
"""A file that is whole or not there: written under another name beside its own, then renamed."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def part_of(path: Path) -> Path:
    """The name beside ``path`` under which this process writes it; the suffix is the same."""
    return path.with_name(f".{path.stem}.part{os.getpid()}{path.suffix}")


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """The name to write under; what is there at the end becomes ``path``. After an exception ``path`` is as it was."""
    part = part_of(path)
    try:
        yield part
        if part.exists():
            os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
