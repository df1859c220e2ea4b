# SPDX-License-Identifier: Apache-2.0
"""Compares two outputs of ``raydix render``, value by value."""

from pathlib import Path

import numpy as np

from .image import ImageError, read_image

ENDINGS = (".npz", ".exr", ".png")


def _load(path: Path) -> dict[str, np.ndarray]:
    """The arrays of a file: those of an npz, or the pixels of a picture."""
    if path.suffix in (".png", ".exr"):
        return {"pixels": read_image(path)}
    try:
        data = np.load(path, allow_pickle=False)
        if not isinstance(data, np.lib.npyio.NpzFile):
            raise ValueError("a single array")
        with data:
            return {name: data[name] for name in data.files}
    except Exception as error:  # whatever a damaged file makes zipfile, zlib or numpy say
        raise ImageError(f"{path}: not a readable npz file: {type(error).__name__}: {error}") from None


def _files(path: Path) -> dict[str, Path]:
    """By ending: a file itself, or the one file of each kind in a folder."""
    if path.is_file():
        if path.suffix not in ENDINGS:
            raise ImageError(f"{path}: found the ending '{path.suffix}'; allowed: {', '.join(ENDINGS)} or a folder")
        return {path.suffix: path}
    if not path.is_dir():
        raise ImageError(f"{path}: no such file or folder")
    found = {}
    for ending in ENDINGS:
        files = sorted(path.glob(f"*{ending}"))
        if len(files) > 1:
            raise ImageError(f"{path}: found {len(files)} files *{ending}; allowed: one, or name the file itself")
        if files:
            found[ending] = files[0]
    if not found:
        raise ImageError(f"{path}: no file {', '.join('*' + e for e in ENDINGS)} in it")
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
