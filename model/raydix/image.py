# SPDX-License-Identifier: Apache-2.0
"""Picture files: PNG, multi-channel EXR and npz. Written under a temporary name first, so none is ever half written."""

import os
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

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
    if out is None or not out.open(str(path), spec) or not out.write_image(np.ascontiguousarray(pixels)):
        raise ImageError(f"{path}: {out.geterror() if out else oiio.geterror()}")
    out.close()


def _replace(path: Path, write) -> None:
    """Call ``write`` with a temporary name beside ``path`` and move the result there when it is complete."""
    work = path.with_name(f".{path.stem}.part{os.getpid()}{path.suffix}")
    try:
        write(work)
        os.replace(work, path)
    except OSError as error:
        raise ImageError(f"{path}: {error.strerror or error}") from None
    finally:
        work.unlink(missing_ok=True)


def write_png(path: Path, rgb: np.ndarray) -> None:
    """An 8-bit PNG from uint8 (H, W, 3)."""
    _replace(path, lambda work: _write_image(work, rgb, ("R", "G", "B"), "uint8"))


def read_image(path: Path) -> np.ndarray:
    """Pixels (H, W, channels) of a PNG or EXR in the file's own type."""
    image = oiio.ImageInput.open(str(path))
    if image is None:
        raise ImageError(f"{path}: {oiio.geterror()}")
    pixels = image.read_image(image.spec().format)
    image.close()
    return np.atleast_3d(pixels)


def arrays(frame: Frame) -> dict[str, np.ndarray]:
    """The arrays of the npz file."""
    return {name: getattr(frame, name) for name in ("depth", "t", "surface", "normal", "rgb")}


def write_frame(frame: Frame, out: Path, name: str) -> list[Path]:
    """Write ``name``.png, .exr and .npz into the folder ``out``, which is made if missing; returns the paths.

    EXR channels, float32: R, G, B (linear), Z (camera depth, inf = miss), normal.X/Y/Z, surface (-1 = miss).
    npz: depth float64, t int64, surface int16, normal float32, rgb uint8; see :class:`~raydix.shade.Frame`.
    Raises :class:`ImageError`.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ImageError(f"{out}: {error.strerror}") from None
    layers = np.concatenate(
        [frame.linear, frame.depth[..., None], frame.normal, frame.surface[..., None]], axis=2
    ).astype(np.float32)
    paths = [out / f"{name}{ending}" for ending in (".png", ".exr", ".npz")]
    write_png(paths[0], frame.rgb)
    _replace(paths[1], lambda work: _write_image(work, layers, CHANNELS, "float"))
    _replace(paths[2], lambda work: np.savez_compressed(work, **arrays(frame)))
    return paths
