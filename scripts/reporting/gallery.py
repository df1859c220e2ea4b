# SPDX-License-Identifier: Apache-2.0
"""Rendered scenes as views for a page: pictures of golden model and RTL, difference, depth, normals, steps."""

import base64
import io
import json
from dataclasses import dataclass, field
from pathlib import Path
from zipfile import BadZipFile

import matplotlib
import numpy as np
from PIL import Image

from raydix.image import ImageError, read_image
from raydix.progress import track

MISS = (38, 44, 58)  # colour of a pixel without a hit where a view has no value


@dataclass
class View:
    """A picture in a page.

    label   what it shows
    source  data: address
    legend  what its colours stand for; empty where they are colours
    """

    label: str
    source: str
    legend: str = ""


@dataclass
class Card:
    """A scene: its views, figures for its table, and whether both sides are equal.

    figures  label -> (golden model, RTL)
    """

    name: str
    equal: bool
    verdict: str
    described: str
    golden: View
    rtl: View
    views: list[View] = field(default_factory=list)
    figures: dict[str, tuple[str, str]] = field(default_factory=dict)


def data_address(rgb: np.ndarray) -> str:
    """A PNG of uint8 (H, W, 3) as the text of a data: address."""
    buffer = io.BytesIO()
    Image.fromarray(rgb).save(buffer, "PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()


def depth_picture(depth: np.ndarray) -> tuple[np.ndarray, str]:
    """Near is light, far is dark: uint8 (H, W, 3), and the legend. ``depth``: float (H, W), inf = miss."""
    hit = np.isfinite(depth)
    picture = np.full((*depth.shape, 3), MISS, np.uint8)
    if not hit.any():
        return picture, "nothing is hit"
    near, far = depth[hit].min(), depth[hit].max()
    shade = 255 - np.round((depth[hit] - near) / max(far - near, np.finfo(float).tiny) * 215)
    picture[hit] = shade[:, None].astype(np.uint8)
    return picture, f"light: {near:.4g}, dark: {far:.4g} from the camera along its axis"


def normal_picture(normal: np.ndarray, surface: np.ndarray) -> tuple[np.ndarray, str]:
    """x, y, z of unit normals (H, W, 3) as red, green, blue, -1 to 1 as 0 to 255."""
    picture = np.full(normal.shape, MISS, np.uint8)
    hit = surface >= 0
    picture[hit] = np.round((normal[hit] + 1) / 2 * 255).astype(np.uint8)
    return picture, "red, green, blue: x, y, z of the unit normal, −1 to 1"


def steps_picture(steps: np.ndarray, most: int) -> tuple[np.ndarray, str]:
    """Steps (H, W) from dark to light; ``most`` is the lightest."""
    colors = matplotlib.colormaps["viridis"]((steps - 1) / max(most - 1, 1), bytes=True)[..., :3].copy()
    colors[steps == 0] = MISS
    return colors, f"dark: one step, yellow: {most:,}; grey: none. {int(steps.sum()):,} in all"


def _pair(figures: dict, name: str, form: str = ",") -> tuple[str, str]:
    return tuple(f"{figures[side][name]:{form}}" if figures[side].get(name) else "–" for side in ("golden", "rtl"))


def _figures(figures: dict) -> dict[str, tuple[str, str]]:
    rows = {
        "rays": _pair(figures, "rays"),
        "rays that hit": _pair(figures, "hit_rays"),
        "hits": _pair(figures, "hits"),
        "steps": _pair(figures, "steps"),
        "steps per hitting ray": _pair(figures, "steps_per_hit", ".3f"),
        "clocks": _pair(figures, "cycles"),
        "seconds": _pair(figures, "seconds", ".3f"),
    }
    skipped = {name.removeprefix("skipped_"): n for name, n in figures["rtl"].items() if name.startswith("skipped_")}
    return rows | {f"skipped: {name}": ("–", f"{number:,}") for name, number in skipped.items()}


def card(folder: Path) -> Card:
    """What `raydix verify` left in ``folder``, whose name is the scene's.

    Raises :class:`~raydix.image.ImageError` where a file is missing or is none of verify's.
    """
    name = folder.name
    try:
        figures = json.loads((folder / f"{name}.json").read_text())
        data = np.load(folder / "golden" / f"{name}.npz")
        steps = np.load(folder / f"{name}-steps.npz")
        differing, config = figures["differing"], figures["config"]
        pictures = [read_image(folder / path) for path in (f"golden/{name}.png", f"rtl/{name}.png")]
        views = [View("difference", data_address(read_image(folder / f"{name}-difference.png")), "red: differs")]
        depth, normals = depth_picture(data["depth"]), normal_picture(data["normal"], data["surface"])
        for label, (rgb, legend) in (("depth", depth), ("normals", normals)):
            views.append(View(label, data_address(rgb), legend))
        most = int(max(steps["golden"].max(), steps["rtl"].max()))
        for side, label in (("golden", "steps, golden model"), ("rtl", "steps, RTL")):
            rgb, legend = steps_picture(steps[side], most)
            views.append(View(label, data_address(rgb), legend))
        rows = _figures(figures)
        size = f"{figures['width']}×{figures['height']}"
    except (OSError, EOFError, BadZipFile, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ImageError(f"{folder}: found no output of raydix verify ({error}); make render writes one") from None
    equal = not (differing["hit_bits"] or differing["image_bits"])
    verdict = (
        "equal in every bit"
        if equal
        else f"{differing['pixels']:,} pixels differ, {differing['hit_bits'] + differing['image_bits']:,} bits"
    )
    described = f"{size}, {config['rule']} rule, n1 = {config['n1']}, K = {config['steps']}, W = {config['width']}"
    described = described.replace(" = ", "\u00a0=\u00a0")  # no end of a line there
    golden, rtl = (View(label, data_address(rgb)) for label, rgb in zip(("golden model", "RTL"), pictures, strict=True))
    return Card(name, equal, verdict, described, golden, rtl, views, rows)


def cards(folder: Path) -> list[Card]:
    """One for each scene under ``folder`` that has figures, those of the paper's figure 2 first."""
    first = ("torus", "hyperboloid", "spiral")
    found = [path.parent for path in folder.glob("*/*.json") if path.stem == path.parent.name]
    found.sort(key=lambda p: (first.index(p.name) if p.name in first else 3, p.name))
    return [card(path) for path in track(found, "scenes")]
