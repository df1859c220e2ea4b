# SPDX-License-Identifier: Apache-2.0
"""Scene files: TOML text to validated, immutable objects.

Whatever is wrong with a file comes out as one `SceneError`, with a line for each problem found:
"FILE: KEY: found X; allowed: Y". Lengths are in scene units, angles in degrees, colours linear in [0, 1].
"""

import difflib
import math
import re
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError
from pydantic import model_validator as _model_validator
from pydantic_core import PydanticCustomError

from raydix import surfaces
from raydix.formats import MAX_IMAGE, MAX_SURFACES

LARGEST = 1e9  # magnitude of any length, coordinate or coefficient
MAX_FRAMES = 10_000  # of a sequence
SMALLEST = 1e-9  # of a length that must be positive

Problem = tuple[str, str, str]  # key below the table ("" = the value itself), what was found, what is allowed


class SceneError(ValueError):
    """A scene that cannot be used: one line per problem, "FILE: KEY: found X; allowed: Y"."""


# ---- Values ------------------------------------------------------------------------------------------------


def _refuse(*problems: Problem) -> PydanticCustomError:
    return PydanticCustomError("scene", "scene problem", {"problems": problems})


class _Rule:
    """A validator function for pydantic: passes an accepted value on, else says what is allowed."""

    def __init__(self, allowed: str, accepts: Callable[[Any], bool]):
        self.allowed, self.accepts = allowed, accepts

    def __call__(self, value: Any) -> Any:
        if not self.accepts(value):
            raise _refuse(("", _show(value), self.allowed))
        return value


def _before(allowed: str, accepts: Callable[[Any], bool]) -> BeforeValidator:
    return BeforeValidator(_Rule(allowed, accepts))


def _after(allowed: str, accepts: Callable[[Any], bool]) -> AfterValidator:
    return AfterValidator(_Rule(allowed, accepts))


def _number(allowed: str, accepts: Callable[[float], bool]) -> BeforeValidator:
    """A TOML integer or float (not a boolean) within a range; nan and inf fail every range."""
    return _before(allowed, lambda v: isinstance(v, int | float) and not isinstance(v, bool) and accepts(v))


def _array(n: int, what: str) -> BeforeValidator:
    return _before(what, lambda v: isinstance(v, list | tuple) and len(v) == n)


def _is_pixel_count(v: Any) -> bool:
    return isinstance(v, int) and not isinstance(v, bool) and 1 <= v <= MAX_IMAGE


def _length(v: tuple[float, ...]) -> float:
    return math.hypot(*v)


def _cross(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[float, float, float]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _is_regular(rows: tuple[tuple[float, ...], ...]) -> bool:
    lengths = [_length(row) for row in rows]
    det = sum(p * q for p, q in zip(rows[0], _cross(rows[1], rows[2]), strict=True))
    return min(lengths) >= SMALLEST and abs(det) >= 1e-6 * math.prod(lengths)


Number = Annotated[float, _number("a number from -1e9 to 1e9", lambda v: abs(v) <= LARGEST)]
Length = Annotated[float, _number("a number from 1e-9 to 1e9", lambda v: SMALLEST <= v <= LARGEST)]
Unit = Annotated[float, _number("a number from 0 to 1", lambda v: 0 <= v <= 1)]
Opacity = Annotated[float, _number("a number above 0, up to 1", lambda v: 0 < v <= 1)]
Degrees = Annotated[float, _number("degrees above 0 (from 1e-9), up to 170", lambda v: SMALLEST <= v <= 170)]
Turns = Annotated[float, _number("a number above 0 (from 1e-3), up to 100", lambda v: 1e-3 <= v <= 100)]
Pixels = Annotated[
    int,
    _before(f"an integer from 1 to {MAX_IMAGE} (the largest image for the configured pixel words)",
            _is_pixel_count),
]  # fmt: skip

Frames = Annotated[
    int,
    _before(f"an integer from 1 to {MAX_FRAMES}",
            lambda v: isinstance(v, int) and not isinstance(v, bool) and 1 <= v <= MAX_FRAMES),
]  # fmt: skip

Vector = Annotated[tuple[Number, Number, Number], _array(3, "three numbers [x, y, z]")]
Direction = Annotated[
    Vector, _after("a vector that is not zero (length at least 1e-9)", lambda v: _length(v) >= SMALLEST)
]
Color = Annotated[tuple[Unit, Unit, Unit], _array(3, "three numbers [red, green, blue] from 0 to 1")]
Matrix = Annotated[
    tuple[Vector, Vector, Vector],
    _array(3, "three rows of three numbers"),
    _after("a matrix that is not singular (|det| >= 1e-6 * product of its row lengths)", _is_regular),
]
Clip = Annotated[
    tuple[Vector, Vector],
    _array(2, "two corners [[x0, y0, z0], [x1, y1, z1]]"),
    _after("x0 < x1, y0 < y1, z0 < z1 (by at least 1e-9)",
           lambda v: all(hi - lo >= SMALLEST for lo, hi in zip(*v, strict=True))),
]  # fmt: skip
Coefficients = Annotated[
    tuple[Number, Number, Number, Number, Number, Number, Number, Number, Number, Number],
    _array(10, "ten numbers: xx, yy, zz, xy, yz, zx, x, y, z, 1"),
]


# ---- Tables ------------------------------------------------------------------------------------------------


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    def _problems(self) -> Iterator[Problem]:
        """Problems between keys; asked only when each key of the table is valid by itself."""
        yield from ()

    @_model_validator(mode="after")
    def _refuse_problems(self):
        if problems := list(self._problems()):
            raise _refuse(*problems)
        return self


class Camera(_Table):
    """Pinhole, right-handed; `vfov` in degrees over the image's height."""

    eye: Vector
    look_at: Vector
    up: Direction = (0.0, 0.0, 1.0)
    vfov: Degrees = 30.0
    width: Pixels = 640
    height: Pixels = 480

    def _problems(self) -> Iterator[Problem]:
        view = tuple(b - a for a, b in zip(self.eye, self.look_at, strict=True))
        if _length(view) < SMALLEST:
            yield "look_at", f"{_show(self.look_at)}, at the eye", "a point at least 1e-9 from camera.eye"
        elif _length(_cross(self.up, view)) <= 1e-6 * _length(self.up) * _length(view):
            allowed = "a vector that is not along look_at - eye (sine of the angle above 1e-6)"
            yield "up", f"{_show(self.up)}, along the view", allowed


class Turntable(_Table):
    """The camera goes round `look_at`, about the axis `up`: `frames` steps that make `degrees` together."""

    frames: Frames
    degrees: Number = 360.0


class Keyframe(_Table):
    """A frame of a sequence: what is not given is as in `camera`."""

    eye: Vector | None = None
    look_at: Vector | None = None
    up: Direction | None = None
    vfov: Degrees | None = None


class Light(_Table):
    """`direction` points towards the light; any length but zero."""

    direction: Direction = (-0.36, -0.48, 0.80)
    ambient: Unit = 0.1


class Background(_Table):
    color: Color = (0.0, 0.0, 0.0)


class _Surface(_Table):
    """What every surface has. world = center + scale * (matrix @ local); `clip` is in local coordinates."""

    center: Vector = (0.0, 0.0, 0.0)
    rotation: Matrix | None = None
    axis: Direction | None = None
    angle: Number | None = None
    scale: Length = 1.0
    clip: Clip | None = None
    color: Color = (0.9, 0.5, 0.2)
    opacity: Opacity = 1.0

    def _problems(self) -> Iterator[Problem]:
        if self.rotation and (self.axis or self.angle is not None):
            yield "rotation", "rotation together with axis or angle", "either rotation, or axis with angle"
        elif self.axis and self.angle is None:
            yield "angle", "axis without angle", "axis and angle together"
        elif self.angle is not None and not self.axis:
            yield "axis", "angle without axis", "axis and angle together"
        if self.clip is None:
            yield from self._missing_clip()

    def _missing_clip(self) -> Iterator[Problem]:
        box = surfaces.bounding_box(self)  # type: ignore[arg-type]
        give = "give clip = [[x0,y0,z0],[x1,y1,z1]]"
        if box is None:
            yield "clip", "nothing", f"this surface is open (unbounded): {give}"
        elif max(abs(v) for corner in box for v in corner) > LARGEST:
            yield "clip", "nothing", f"this surface reaches farther than 1e9: {give}"

    @property
    def matrix(self) -> tuple[tuple[float, float, float], ...]:
        """The linear part of local to world, as three rows; from `rotation`, or `axis` and `angle`."""
        if self.rotation:
            return self.rotation
        if not self.axis or self.angle is None:
            return ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        x, y, z = (v / _length(self.axis) for v in self.axis)
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        u = 1.0 - c
        return (
            (c + x * x * u, x * y * u - z * s, x * z * u + y * s),
            (y * x * u + z * s, c + y * y * u, y * z * u - x * s),
            (z * x * u - y * s, z * y * u + x * s, c + z * z * u),
        )


class Plane(_Surface):
    type: Literal["plane"]


class Sphere(_Surface):
    type: Literal["sphere"]
    R: Length


class Ellipsoid(_Surface):
    type: Literal["ellipsoid"]
    a: Length
    b: Length
    c: Length


class Cylinder(_Surface):
    type: Literal["cylinder"]
    R: Length


class Cone(_Surface):
    type: Literal["cone"]
    k: Length


class Paraboloid(_Surface):
    type: Literal["paraboloid"]
    a: Length
    b: Length


class HyperbolicParaboloid(_Surface):
    type: Literal["hyperbolic_paraboloid"]
    a: Length
    b: Length


class HyperboloidOneSheet(_Surface):
    type: Literal["hyperboloid_one_sheet"]
    a: Length
    b: Length
    c: Length


class HyperboloidTwoSheet(_Surface):
    type: Literal["hyperboloid_two_sheet"]
    a: Length
    b: Length
    c: Length


class Quadric(_Surface):
    type: Literal["quadric"]
    coefficients: Annotated[Coefficients, _after("one of the first nine not zero", lambda v: any(v[:9]))]


class Torus(_Surface):
    type: Literal["torus"]
    R: Length
    r: Length


class Cyclide(_Surface):
    type: Literal["cyclide"]
    a: Length
    b: Length
    d: Length

    def _problems(self) -> Iterator[Problem]:
        if self.b > self.a:
            yield "b", _show(self.b), f"at most a = {_show(self.a)}"
        else:
            yield from super()._problems()


class Quartic(_Surface):
    type: Literal["quartic"]
    Q1: Coefficients
    Q2: Coefficients
    Q3: Coefficients

    def _problems(self) -> Iterator[Problem]:
        if surfaces.is_constant(self.Q1, self.Q2, self.Q3):
            yield "Q1", "Q1*Q2 + Q3 that is constant", "Q1*Q2 + Q3 that depends on x, y or z"
        else:
            yield from super()._problems()


class Spiral(_Surface):
    """A tube along a helix or a spiral; growth and pitch are per turn."""

    type: Literal["spiral"]
    R: Length
    r: Length
    pitch: Number
    turns: Turns
    R_growth: Number = 0.0
    r_growth: Number = 0.0

    def _problems(self) -> Iterator[Problem]:
        yield from self._bad_ends()
        most = 0.9 * math.hypot(self.R_growth, self.pitch)
        if self.turns > 1 and abs(self.r_growth) > most:
            allowed = f"a magnitude of at most 0.9 * hypot(R_growth, pitch) = {_show(most)}, as turns is above 1"
            yield "r_growth", _show(self.r_growth), allowed
        yield from super()._problems()

    def _bad_ends(self) -> Iterator[Problem]:
        """At the end where s = 0, else at the other: a tube of no radius or one that reaches the axis."""
        if 100 * self.r > 99 * self.R:
            yield "r", _show(self.r), f"at most 0.99 * R = {_show(0.99 * self.R)}"
            return
        turns = Fraction(self.turns)
        big, small = (Fraction(v) + Fraction(g) * turns for v, g in ((self.R, self.R_growth), (self.r, self.r_growth)))
        if small < SMALLEST:
            found = f"{_show(self.r_growth)}, r is {float(small):.6g} at the far end"
            yield "r_growth", found, "r at least 1e-9 at both ends"
        elif 100 * small > 99 * big:
            shrinks = -self.R_growth > self.r_growth
            key, growth = ("R_growth", self.R_growth) if shrinks else ("r_growth", self.r_growth)
            found = f"{_show(growth)}, r is {float(small):.6g} and R is {float(big):.6g} at the far end"
            yield key, found, "r at most 0.99 * R at both ends"


Surface = (
    Plane | Sphere | Ellipsoid | Cylinder | Cone | Paraboloid | HyperbolicParaboloid
    | HyperboloidOneSheet | HyperboloidTwoSheet | Quadric | Torus | Cyclide | Quartic | Spiral
)  # fmt: skip
_SURFACES: dict[str, type[_Surface]] = {
    get_args(cls.model_fields["type"].annotation)[0]: cls for cls in get_args(Surface)
}


def _check_type(table: Any) -> Any:
    if not isinstance(table, dict):
        raise _refuse(("", _show(table), "a table with a type"))
    kind = table.get("type")
    if not isinstance(kind, str) or kind not in _SURFACES:
        found = f"unknown type {_show(kind)}" if "type" in table else "nothing"
        raise _refuse(("type", found, _choices(kind, list(_SURFACES))))
    return table


class _Tables(_Table):
    """The tables of a scene file."""

    camera: Camera
    light: Light = Light()
    background: Background = Background()
    turntable: Turntable | None = None
    frame: Annotated[
        tuple[Keyframe, ...],
        _before(f"up to {MAX_FRAMES} tables [[frame]]", lambda v: isinstance(v, list) and len(v) <= MAX_FRAMES),
    ] = ()
    surface: Annotated[
        tuple[Annotated[Surface, Field(discriminator="type"), BeforeValidator(_check_type)], ...],
        _before(f"1 to {MAX_SURFACES} tables [[surface]]",
                lambda v: isinstance(v, list) and 1 <= len(v) <= MAX_SURFACES),
    ]  # fmt: skip


@dataclass(frozen=True)
class Scene:
    """A valid scene; `name` is the stem of the file `path`."""

    name: str
    path: Path
    camera: Camera
    light: Light
    background: Background
    surfaces: tuple[Surface, ...]
    cameras: tuple[Camera, ...] = ()  # of the frames of a sequence

    def frames(self) -> list["Scene"]:
        """The scene of each frame of a sequence, or itself."""
        return [replace(self, camera=camera) for camera in self.cameras] or [self]


def load_scene(path: str | PathLike[str], width: int | None = None, height: int | None = None) -> Scene:
    """Reads the scene file at `path`; `width` and `height`, if given, replace the camera's (pixels).

    Raises SceneError for a file that cannot be read, is not TOML, or describes no valid scene.
    """
    path = Path(path)
    data = _read(path)
    camera = data.get("camera")
    if isinstance(camera, dict):
        size = {"width": width, "height": height}
        camera.update({key: v for key, v in size.items() if v is not None})
    try:
        tables = _Tables.model_validate(data)
    except ValidationError as error:
        lines = [_line(path, *p) for e in error.errors(include_url=False) for p in _translate(e)]
        raise SceneError("\n".join(lines)) from None
    cameras = _cameras(path, tables)
    return Scene(path.stem, path, tables.camera, tables.light, tables.background, tables.surface, cameras)


def _cameras(path: Path, tables: _Tables) -> tuple[Camera, ...]:
    """The camera of each frame: those of the turntable, or of the list."""
    if tables.turntable and tables.frame:
        raise SceneError(_line(path, "frame", "frames beside a turntable", "one of [turntable] and [[frame]]"))
    base = tables.camera
    if tables.turntable:
        return tuple(_turned(base, i * tables.turntable.degrees / tables.turntable.frames)
                     for i in range(tables.turntable.frames))  # fmt: skip
    cameras = []
    for number, frame in enumerate(tables.frame):
        try:
            cameras.append(Camera.model_validate(base.model_dump() | frame.model_dump(exclude_none=True)))
        except ValidationError as error:
            lines = [_line(path, f"frame[{number}].{key.removeprefix('camera.')}", found, allowed)
                     for e in error.errors(include_url=False)
                     for key, found, allowed in _translate({**e, "loc": ("camera", *e["loc"])})]  # fmt: skip
            raise SceneError("\n".join(lines)) from None
    return tuple(cameras)


def _turned(camera: Camera, degrees: float) -> Camera:
    """The camera turned about the axis through `look_at` along `up`: Rodrigues' formula in float64."""
    angle = math.radians(degrees % 360)
    length = _length(camera.up)
    axis = tuple(c / length for c in camera.up)
    arm = tuple(e - a for e, a in zip(camera.eye, camera.look_at, strict=True))
    along = sum(k * v for k, v in zip(axis, arm, strict=True)) * (1 - math.cos(angle))
    side = _cross(axis, arm)
    turned = (v * math.cos(angle) + s * math.sin(angle) + k * along for v, s, k in zip(arm, side, axis, strict=True))
    eye = tuple(a + v for a, v in zip(camera.look_at, turned, strict=True))
    return camera.model_copy(update={"eye": camera.eye if degrees % 360 == 0 else eye})


def _read(path: Path) -> dict[str, Any]:
    try:
        text = path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        found, allowed = f"a byte that is not UTF-8 at offset {error.start}", "a TOML file in UTF-8"
    except (OSError, ValueError) as error:
        found, allowed = getattr(error, "strerror", None) or str(error), "a readable TOML file"
    else:
        try:
            return tomllib.loads(text)
        except ValueError as error:
            found, allowed = f"bad TOML: {error}", "TOML 1.0"
        except RecursionError:
            found, allowed = "bad TOML: nested too deeply", "tables and arrays of a scene"
    raise SceneError(_line(path, "file", found, allowed))


# ---- Messages ----------------------------------------------------------------------------------------------


def _line(path: Path, key: str, found: str, allowed: str) -> str:
    return f"{path}: {key}: found {found}; allowed: {allowed}"


def _translate(error: Any) -> Iterator[Problem]:
    """Turns one of pydantic's errors into problems with the full key."""
    loc: tuple[str | int, ...] = error["loc"]
    match error["type"]:
        case "scene":
            for key, found, allowed in error["ctx"]["problems"]:
                yield _key((*loc, key) if key else loc), found, allowed
        case "missing":
            field = _table_at(loc[:-1]).model_fields[str(loc[-1])]
            rules = [m.func for m in field.metadata if isinstance(m, BeforeValidator)]
            allowed = rules[0].allowed if rules else _keys(_table_at(loc))  # type: ignore[union-attr]
            yield _key(loc), "nothing", allowed
        case "extra_forbidden":
            yield _key(loc), "unknown key", _choices(loc[-1], list(_table_at(loc[:-1]).model_fields))
        case _:
            yield _key(loc), _show(error["input"]), _keys(_table_at(loc))


def _table_at(loc: tuple[str | int, ...]) -> type[_Table]:
    """The model of the table at a location; pydantic puts a surface's type after its number."""
    if not loc:
        return _Tables
    if loc[0] == "surface":
        return _SURFACES[str(loc[2])]
    tables: dict[str, type[_Table]] = {"camera": Camera, "light": Light, "background": Background}
    tables |= {"turntable": Turntable, "frame": Keyframe}
    return tables[str(loc[0])]


def _key(loc: tuple[str | int, ...]) -> str:
    text = ""
    for i, part in enumerate(loc):
        if isinstance(part, int):
            text += f"[{part}]"
        elif loc[0] == "surface" and i == 2 and part in _SURFACES:
            text += f" ({part})"
        else:
            part = part if re.fullmatch(r"[A-Za-z0-9_-]+", part) else repr(part)
            text += f".{part}" if text else part
    return text


def _keys(table: type[_Table]) -> str:
    return "a table with the keys " + ", ".join(table.model_fields)


def _choices(given: Any, known: list[str]) -> str:
    close = difflib.get_close_matches(given, known, n=1, cutoff=0.65) if isinstance(given, str) else []
    return ", ".join(known) + (f" (did you mean {close[0]}?)" if close else "")


def _show(value: Any) -> str:
    """A value as in TOML, on one line, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list | tuple):
        text = "[" + ", ".join(_show(v) for v in value[:12]) + (", …]" if len(value) > 12 else "]")
    elif isinstance(value, int) and value.bit_length() > 256:  # Python refuses to print very long ones
        text = f"an integer of {value.bit_length()} bits"
    else:
        text = repr(value) if isinstance(value, str | float) else str(value)
    return text if len(text) <= 160 else text[:157] + "..."
