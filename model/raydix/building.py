# SPDX-License-Identifier: Apache-2.0
"""A folder to build in that is there no longer than its process: the next build removes what a killed one has left."""

import fcntl
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path


@contextmanager
def locked(path: Path, wait: bool = True) -> Iterator[bool]:
    """Hold the lock of a file, which is made; the system frees it when the process ends, in whatever way.

    Gives whether it is held: without ``wait`` it is not where another process has it.
    """
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        except BlockingIOError:
            yield False
        else:
            yield True


@contextmanager
def building(where: Path) -> Iterator[Path]:
    """A new folder ``building-*`` in ``where``, which is made; those of processes that are gone are removed."""
    where.mkdir(parents=True, exist_ok=True)
    guard = where / "building.lock"  # held while a folder comes or goes
    with ExitStack() as held:
        with locked(guard):
            for old in where.glob("building-*"):
                with locked(old / "lock", wait=False) as gone:
                    if gone:
                        shutil.rmtree(old, ignore_errors=True)  # its compiler may still write there
            folder = Path(tempfile.mkdtemp(prefix="building-", dir=where))
            held.enter_context(locked(folder / "lock"))
        try:
            yield folder
        finally:
            with locked(guard):
                shutil.rmtree(folder)
