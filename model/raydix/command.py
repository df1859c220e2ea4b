# SPDX-License-Identifier: Apache-2.0
"""What programs share: numbers and sizes as arguments, and one line in place of a traceback where a user is to know."""

import argparse
import math
import re
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.pool import Pool
from pathlib import Path

from .config import ConfigError
from .image import ImageError
from .progress import tell_compilation
from .rtl import RtlError
from .scene import SceneError

USER_ERRORS = (SceneError, ConfigError, ImageError, RtlError, OSError)
INTERRUPTED = 128 + signal.SIGINT


def image_size(text: str) -> tuple[int, int]:
    """WIDTHxHEIGHT as an argument. Raises ArgumentTypeError."""
    match = re.fullmatch(r"([0-9]{1,6})[xX×]([0-9]{1,6})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed: WIDTHxHEIGHT, for example 640x480")
    return int(match[1]), int(match[2])


def whole(low: int | None = None, high: int | None = None) -> Callable[[str], int]:
    """A type of arguments: whole numbers of ``low`` to ``high``, both included. It raises ArgumentTypeError."""

    def number(text: str) -> int:
        if re.fullmatch(r"[+-]?[0-9]{1,18}", text):
            value = int(text)
            if (low is None or value >= low) and (high is None or value <= high):
                return value
        limits = "" if low is None else f", {low} or more" if high is None else f", {low} to {high}"
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed: whole numbers{limits}")

    return number


def above(low: float) -> Callable[[str], float]:
    """A type of arguments: finite numbers above ``low``. It raises ArgumentTypeError."""

    def number(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (low < value < math.inf):
            raise argparse.ArgumentTypeError(f"found '{text}'; allowed: finite numbers above {low:g}")
        return value

    return number


@contextmanager
def workers(count: int) -> Iterator[Pool]:
    """A pool of new processes. Ctrl-C is for the program, which ends them: they ignore it from their start."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # inherited, also while a worker imports
    try:
        pool = get_context("spawn").Pool(count)
    finally:
        signal.signal(signal.SIGINT, before)
    with pool:
        yield pool


INTEGER = whole()  # its limits are told where they are known
SEED = whole(0)
COUNT = whole(1)


def text_of(error: Exception) -> str:
    """What a user reads of an error: of the system's the file, too."""
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return str(error)


def status_of(main: Callable[[], int], name: str | None = None, more: str = "") -> int:
    """Call a program's ``main``; the exit status.

    2, with a line on stderr, where it raises what a user did wrong or the system refuses; 130 where it is interrupted;
    0 where the reader of its output is gone.

    name   of the program in these lines; the file's as it was called, if None
    more   said, too, where it is interrupted
    """
    name = name or Path(sys.argv[0]).stem
    if sys.stderr.isatty() and "numba" in sys.modules:
        tell_compilation()
    try:
        return main()
    except BrokenPipeError:
        return 0
    except USER_ERRORS as error:
        for line in text_of(error).splitlines():
            print(f"{name}: {line}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"{name}: interrupted; nothing half written{more}", file=sys.stderr)
        return INTERRUPTED
