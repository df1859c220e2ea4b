# SPDX-License-Identifier: Apache-2.0
"""Compares two outputs of ``raydix render``, value by value."""

from pathlib import Path
from zipfile import is_zipfile

import numpy as np

from .image import ImageError, read_image

ENDINGS = (".npz", ".exr", ".png")
ALLOWED = f"a file {', '.join(ENDINGS)}, or a folder with one of each at most"


def _load(path: Path) -> dict[str, np.ndarray]:
    """The arrays of a file: those of an npz, or the pixels of a picture."""
    if path.suffix in (".png", ".exr"):
        return {"pixels": read_image(path)}
    allowed = "allowed: an .npz file as render writes it"
    if not is_zipfile(path):
        raise ImageError(f"{path}: not a readable npz file: found no zip archive, or one cut short; {allowed}")
    try:
        with np.load(path, allow_pickle=False) as data:
            found = {name: data[name] for name in data.files}
    except Exception as error:  # whatever a damaged file makes zipfile, zlib or numpy say
        raise ImageError(f"{path}: not a readable npz file: {type(error).__name__}: {error}; {allowed}") from None
    other = [name for name, value in found.items() if not isinstance(value, np.ndarray)]
    if other or not found:
        what = f"{', '.join(other)}, no array" if other else "no array"
        raise ImageError(f"{path}: found {what} in the archive; {allowed}")
    return found


def _files(path: Path) -> dict[str, Path]:
    """By ending: a file itself, or the one file of each kind in a folder."""
    if path.is_file():
        if path.suffix not in ENDINGS:
            raise ImageError(f"{path}: found the ending '{path.suffix}'; allowed: {ALLOWED}")
        return {path.suffix: path}
    if not path.is_dir():
        raise ImageError(f"{path}: found no such file or folder; allowed: {ALLOWED}")
    found = {}
    for ending in ENDINGS:
        files = sorted(path.glob(f"*{ending}"))
        if len(files) > 1:
            raise ImageError(f"{path}: found {len(files)} files *{ending}; allowed: one, or name the file itself")
        if files:
            found[ending] = files[0]
    if not found:
        raise ImageError(f"{path}: found a folder without such a file; allowed: {ALLOWED}")
    return found


def _difference(name: str, a: np.ndarray, b: np.ndarray) -> str | None:
    """What differs between two arrays, in one line; None if nothing does. NaN equals NaN."""
    if a.shape != b.shape or a.dtype != b.dtype:
        return f"{name}: {a.dtype} {a.shape} against {b.dtype} {b.shape}"
    different = a != b
    if np.issubdtype(a.dtype, np.floating):
        different &= ~(np.isnan(a) & np.isnan(b))
    if not different.any():
        return None
    where = tuple(int(i) for i in np.argwhere(different)[0])
    first = f"first at {where}: {a[where]} against {b[where]}"
    return f"{name}: {np.count_nonzero(different)} of {a.size} values differ, {first}"


def compare(a: Path, b: Path) -> list[str]:
    """Differences between two outputs (files, or folders with one output each), a line each; empty if equal.

    Raises :class:`~raydix.image.ImageError` where there is nothing to compare.
    """
    files_a, files_b = _files(a), _files(b)
    if a.is_file() and b.is_file() and a.suffix != b.suffix:
        raise ImageError(f"{a} and {b}: found the endings '{a.suffix}' and '{b.suffix}'; allowed: the same ending")
    lines = []
    for ending in ENDINGS:
        if (ending in files_a) != (ending in files_b):
            lines.append(f"{ending}: only in {a if ending in files_a else b}")
        if ending not in files_a or ending not in files_b:
            continue
        one, other = _load(files_a[ending]), _load(files_b[ending])
        for name in sorted(one.keys() | other.keys()):
            label = f"{files_a[ending].name} {name}"
            if name not in one or name not in other:
                lines.append(f"{label}: only in {a if name in one else b}")
                continue
            line = _difference(label, one[name], other[name])
            if line:
                lines.append(line)
    return lines
