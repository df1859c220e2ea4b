# SPDX-License-Identifier: Apache-2.0
"""Output files: PNG, multi-channel EXR, npz, texts and tables. Either all of a run are written or none."""

import csv
import io
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from .replacing import part_of
from .shade import Frame

CHANNELS = ("R", "G", "B", "Z", "normal.X", "normal.Y", "normal.Z", "surface")


class ImageError(RuntimeError):
    """A file could not be read or written; the text says which and why."""


def _write_image(path: Path, pixels: np.ndarray, names: tuple[str, ...], kind: str) -> None:
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, kind)
    spec.channelnames = names
    if path.suffix == ".exr":
        spec.attribute("compression", "zip")
    out = oiio.ImageOutput.create(str(path))
    if out is None:
        raise OSError(oiio.geterror())
    if not out.open(str(path), spec) or not out.write_image(np.ascontiguousarray(pixels)) or not out.close():
        raise OSError(out.geterror())


def check_folder(folder: Path) -> None:
    """Raises :class:`ImageError` where ``folder`` cannot be made: a file has its name, or that of a parent."""
    for path in (folder, *folder.parents):
        if path.exists():
            if not path.is_dir():
                raise ImageError(f"{path}: found a file; allowed: a folder, or a name that is not taken")
            return


def write_files(writers: dict[Path, Callable[[Path], object]]) -> list[Path]:
    """Write several files, all or none: each under a temporary name beside its own, then all are renamed.

    writers  final path -> function that writes the file under the path that it is given, or raises OSError
    Returns the paths. Folders are made. Raises :class:`ImageError`; then no file has changed.
    """
    work = {}
    path = None
    try:
        for path, write in writers.items():
            if path.is_dir():
                raise OSError("there is a folder of this name")
            check_folder(path.parent)
            path.parent.mkdir(parents=True, exist_ok=True)
            work[path] = part_of(path)
            write(work[path])
        for path, part in work.items():
            os.replace(part, path)
    except OSError as error:
        raise ImageError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        for part in work.values():
            part.unlink(missing_ok=True)
    return list(writers)


def text_writer(text: str) -> Callable[[Path], object]:
    """What :func:`write_files` needs for a text."""
    return lambda work: work.write_text(text)


def csv_writer(header: Sequence, rows: Iterable[Sequence]) -> Callable[[Path], object]:
    """The same for a table."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(header)
    writer.writerows(rows)
    return lambda work: work.write_bytes(text.getvalue().encode())


def png_writer(rgb: np.ndarray) -> Callable[[Path], None]:
    """Writes an 8-bit PNG from uint8 (H, W, 3)."""
    return lambda work: _write_image(work, rgb, ("R", "G", "B"), "uint8")


def read_image(path: Path) -> np.ndarray:
    """Pixels (H, W, channels) of a PNG or EXR in the file's own type. Raises :class:`ImageError`."""
    image = oiio.ImageInput.open(str(path))
    if image is None:
        raise ImageError(f"{path}: not a readable picture: {oiio.geterror().strip()}")
    pixels = image.read_image(image.spec().format)
    if pixels is None:
        raise ImageError(f"{path}: not a readable picture: {image.geterror().strip()}")
    image.close()
    return np.atleast_3d(pixels)


def arrays(frame: Frame) -> dict[str, np.ndarray]:
    """The arrays of the npz file."""
    return {name: getattr(frame, name) for name in ("depth", "t", "surface", "normal", "rgb")}


def frame_writers(frame: Frame, out: Path, name: str) -> dict[Path, Callable[[Path], object]]:
    """What :func:`write_files` needs for ``name``.png, .exr and .npz in the folder ``out``.

    EXR channels, float32: R, G, B (linear), Z (camera depth, inf = miss), normal.X/Y/Z, surface (-1 = miss).
    npz: depth float64, t int64, surface int16, normal float32, rgb uint8; see :class:`~raydix.shade.Frame`.
    """
    planes = [frame.linear, frame.depth[..., None], frame.normal, frame.surface[..., None]]
    layers = np.concatenate(planes, axis=2).astype(np.float32)
    return {
        out / f"{name}.png": png_writer(frame.rgb),
        out / f"{name}.exr": lambda work: _write_image(work, layers, CHANNELS, "float"),
        out / f"{name}.npz": lambda work: np.savez_compressed(work, **arrays(frame)),  # type: ignore[arg-type]
    }
