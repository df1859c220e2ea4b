# SPDX-License-Identifier: Apache-2.0
"""Scene files: what is accepted, and how bad input is refused."""

import math
import string
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from raydix import scene
from raydix.scene import SceneError, load_scene

SCENES = sorted((Path(__file__).parent.parent / "scenes").glob("*.toml"))

CAMERA = "[camera]\neye = [3.0, -4.0, 2.5]\nlook_at = [0, 0, 0]\n"
TORUS = "[[surface]]\ntype = 'torus'\nR = 1.0\nr = 0.4\n"
PLANE = "[[surface]]\ntype = 'plane'\n"
BOX = "clip = [[-1, -1, -1], [1, 1, 1]]\n"
ZEROS = "[0, 0, 0, 0, 0, 0, 0, 0, 0, 1]"
OPEN = "this surface is open (unbounded): give clip = [[x0,y0,z0],[x1,y1,z1]]"
PIXELS = "an integer from 1 to 4096 (the largest image for the configured pixel words)"
ANY = "a number from -1e9 to 1e9"
LENGTH = "a number from 1e-9 to 1e9"
TYPES = (
    "plane, sphere, ellipsoid, cylinder, cone, paraboloid, hyperbolic_paraboloid, hyperboloid_one_sheet, "
    "hyperboloid_two_sheet, quadric, torus, cyclide, quartic, spiral"
)
REGULAR = "a matrix that is not singular (|det| >= 1e-6 * product of its row lengths)"
S0 = "surface[0] (torus)"
SPIRAL = "[[surface]]\ntype = 'spiral'\n"
HELIX = SPIRAL + "R = 0.6\nr = 0.1\npitch = 0.35\nturns = 3.0\n"
S1 = "surface[0] (spiral)"
TURNS = "a number above 0 (from 1e-3), up to 100"


def write(folder: Path, text: str | bytes) -> Path:
    path = folder / "bad.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def surface(body: str) -> str:
    return CAMERA + "[[surface]]\n" + body


# id: (text of the scene, key, found, allowed); one problem each
BAD = {
    # unknown keys and types
    "unknown table": (CAMERA + TORUS + "[lights]\n", "lights", "unknown key",
                      "camera, light, background, turntable, frame, surface (did you mean light?)"),
    "unknown camera key": (CAMERA + "vfow = 3\n" + TORUS, "camera.vfow", "unknown key",
                           "eye, look_at, up, vfov, width, height (did you mean vfov?)"),
    "unknown light key": ("[light]\npower = 3\n" + CAMERA + TORUS, "light.power", "unknown key",
                          "direction, ambient"),
    "unknown surface key": (CAMERA + TORUS + "colour = 1\n", S0 + ".colour", "unknown key",
                            "center, rotation, axis, angle, scale, clip, color, opacity, type, R, r "
                            "(did you mean color?)"),
    "key of two lines": (CAMERA + TORUS + '"a\\nb" = 1\n', S0 + ".'a\\nb'", "unknown key",
                         "center, rotation, axis, angle, scale, clip, color, opacity, type, R, r"),
    "name is no key": ("name = 'x'\n" + CAMERA + TORUS, "name", "unknown key",
                       "camera, light, background, turntable, frame, surface (did you mean frame?)"),
    "unknown type": (surface("type = 'torsu'"), "surface[0].type", "unknown type 'torsu'",
                     TYPES + " (did you mean torus?)"),
    "type like no other": (surface("type = 'cube'"), "surface[0].type", "unknown type 'cube'", TYPES),
    "type not a string": (surface("type = ['torus']"), "surface[0].type", "unknown type ['torus']", TYPES),
    "no type": (CAMERA + TORUS + "[[surface]]\nR = 1\n", "surface[1].type", "nothing", TYPES),
    # missing
    "no camera": (TORUS, "camera", "nothing",
                  "a table with the keys eye, look_at, up, vfov, width, height"),
    "no eye": ("[camera]\nlook_at = [0, 0, 0]\n" + TORUS, "camera.eye", "nothing",
               "three numbers [x, y, z]"),
    "no look_at": ("[camera]\neye = [0, 0, 0]\n" + TORUS, "camera.look_at", "nothing",
                   "three numbers [x, y, z]"),
    "no surface": (CAMERA, "surface", "nothing", "1 to 64 tables [[surface]]"),
    "no surfaces": ("surface = []\n" + CAMERA, "surface", "[]", "1 to 64 tables [[surface]]"),
    "too many surfaces": (CAMERA + 65 * TORUS, "surface", "[" + 12 * "a table, " + "…]",
                          "1 to 64 tables [[surface]]"),
    "no radius": (surface("type = 'sphere'"), "surface[0] (sphere).R", "nothing", LENGTH),
    "no coefficients": (surface("type = 'quadric'"), "surface[0] (quadric).coefficients", "nothing",
                        "ten numbers: xx, yy, zz, xy, yz, zx, x, y, z, 1"),
    # wrong types
    "camera not a table": ("camera = 3\n" + TORUS, "camera", "3",
                           "a table with the keys eye, look_at, up, vfov, width, height"),
    "light not a table": ("light = 'on'\n" + CAMERA + TORUS, "light", "'on'",
                          "a table with the keys direction, ambient"),
    "surface a single table": (CAMERA + TORUS.replace("[[surface]]", "[surface]"), "surface", "a table",
                               "1 to 64 tables [[surface]]"),
    "surface not a table": ("surface = [1]\n" + CAMERA, "surface[0]", "1", "a table with a type"),
    "string for a number": (CAMERA + TORUS + "scale = '1'\n", S0 + ".scale", "'1'", LENGTH),
    "boolean for a number": (CAMERA + TORUS + "scale = true\n", S0 + ".scale", "true", LENGTH),
    "boolean in a vector": (CAMERA + TORUS + "center = [0, false, 0]\n", S0 + ".center[1]", "false", ANY),
    "date for a number": (CAMERA + TORUS + "scale = 2000-01-01\n", S0 + ".scale", "2000-01-01", LENGTH),
    "boolean for an integer": (CAMERA + "width = true\n" + TORUS, "camera.width", "true", PIXELS),
    "float for an integer": (CAMERA + "height = 480.0\n" + TORUS, "camera.height", "480.0", PIXELS),
    "vector too short": (CAMERA + TORUS + "center = [0, 1]\n", S0 + ".center", "[0, 1]",
                         "three numbers [x, y, z]"),
    "vector not an array": (CAMERA + TORUS + "center = 0\n", S0 + ".center", "0", "three numbers [x, y, z]"),
    "nine coefficients": (surface("type = 'quadric'\ncoefficients = [1, 1, 1, 0, 0, 0, 0, 0, 0]"),
                          "surface[0] (quadric).coefficients", "[1, 1, 1, 0, 0, 0, 0, 0, 0]",
                          "ten numbers: xx, yy, zz, xy, yz, zx, x, y, z, 1"),
    # not finite, out of range
    "nan": (CAMERA + TORUS + "center = [0, nan, 0]\n", S0 + ".center[1]", "nan", ANY),
    "inf": (CAMERA + TORUS + "angle = -inf\naxis = [0, 0, 1]\n", S0 + ".angle", "-inf", ANY),
    "overflow to inf": (CAMERA + TORUS + "scale = 1e999\n", S0 + ".scale", "inf", LENGTH),
    "endless integer": (CAMERA + TORUS + "scale = 0x" + 5000 * "f", S0 + ".scale",
                        "an integer of 20000 bits", LENGTH),
    "coordinate too large": (CAMERA + TORUS + "center = [0, 0, -1.1e9]\n", S0 + ".center[2]",
                             "-1100000000.0", ANY),
    "length zero": (surface("type = 'sphere'\nR = 0"), "surface[0] (sphere).R", "0", LENGTH),
    "length negative": (surface("type = 'ellipsoid'\na = 1\nb = -1.0\nc = 1"), "surface[0] (ellipsoid).b",
                        "-1.0", LENGTH),
    "length too small": (surface("type = 'cylinder'\nR = 1e-10\n" + BOX), "surface[0] (cylinder).R",
                         "1e-10", LENGTH),
    "length too large": (surface("type = 'torus'\nR = 2e9\nr = 1"), S0 + ".R", "2000000000.0", LENGTH),
    "cone slope zero": (surface("type = 'cone'\nk = 0\n" + BOX), "surface[0] (cone).k", "0", LENGTH),
    "tube radius zero": (surface("type = 'torus'\nR = 1\nr = 0"), S0 + ".r", "0", LENGTH),
    "cyclide b above a": (surface("type = 'cyclide'\na = 1\nb = 2\nd = 1"), "surface[0] (cyclide).b", "2.0",
                          "at most a = 1.0"),
    "cyclide d zero": (surface("type = 'cyclide'\na = 1\nb = 1\nd = 0"), "surface[0] (cyclide).d", "0",
                       LENGTH),
    "coefficient too large": (surface("type = 'quadric'\ncoefficients = [2e9, 1, 1, 0, 0, 0, 0, 0, 0, -1]"),
                              "surface[0] (quadric).coefficients[0]", "2000000000.0", ANY),
    "quadric constant": (surface(f"type = 'quadric'\ncoefficients = {ZEROS}\n{BOX}"),
                         "surface[0] (quadric).coefficients",
                         "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]",
                         "one of the first nine not zero"),
    "quartic constant": (surface(f"type = 'quartic'\nQ1 = {ZEROS}\nQ2 = {ZEROS}\nQ3 = {ZEROS}\n"),
                         "surface[0] (quartic).Q1", "Q1*Q2 + Q3 that is constant",
                         "Q1*Q2 + Q3 that depends on x, y or z"),
    "spiral without pitch": (CAMERA + HELIX.replace("pitch = 0.35\n", ""), S1 + ".pitch", "nothing", ANY),
    "spiral without turns": (CAMERA + HELIX.replace("turns = 3.0\n", ""), S1 + ".turns", "nothing", TURNS),
    "unknown spiral key": (CAMERA + HELIX + "R_grow = 1\n", S1 + ".R_grow", "unknown key",
                           "center, rotation, axis, angle, scale, clip, color, opacity, type, R, r, pitch, turns, "
                           "R_growth, r_growth (did you mean R_growth?)"),
    "turns zero": (CAMERA + HELIX.replace("3.0", "0"), S1 + ".turns", "0", TURNS),
    "too many turns": (CAMERA + HELIX.replace("3.0", "100.5"), S1 + ".turns", "100.5", TURNS),
    "tube reaches the axis": (CAMERA + HELIX.replace("r = 0.1", "r = 0.596"), S1 + ".r", "0.596",
                              "at most 0.99 * R = 0.594"),
    "tube runs out": (CAMERA + HELIX + "r_growth = -0.0625\n", S1 + ".r_growth", "-0.0625, r is -0.0875 at the far end",
                      "r at least 1e-9 at both ends"),
    "tube grows to the axis": (CAMERA + HELIX + "R_growth = -0.03125\nr_growth = 0.135\n", S1 + ".r_growth",
                               "0.135, r is 0.505 and R is 0.50625 at the far end",
                               "r at most 0.99 * R at both ends"),
    "spiral shrinks to the axis": (CAMERA + HELIX + "R_growth = -0.1875\nr_growth = 0.015625\n", S1 + ".R_growth",
                                   "-0.1875, r is 0.146875 and R is 0.0375 at the far end",
                                   "r at most 0.99 * R at both ends"),
    "spiral runs through the axis": (CAMERA + HELIX + "R_growth = -0.25\n", S1 + ".R_growth",
                                     "-0.25, r is 0.1 and R is -0.15 at the far end",
                                     "r at most 0.99 * R at both ends"),
    "turns swallow others": (CAMERA + HELIX.replace("0.35", "-0.4") + "R_growth = 0.3\nr_growth = 0.46\n",
                             S1 + ".r_growth", "0.46",
                             "a magnitude of at most 0.9 * hypot(R_growth, pitch) = 0.45, as turns is above 1"),
    "turns swallowed by others": (CAMERA + HELIX.replace("0.35", "0").replace("0.1", "0.5") + "r_growth = -0.125\n",
                                  S1 + ".r_growth", "-0.125",
                                  "a magnitude of at most 0.9 * hypot(R_growth, pitch) = 0.0, as turns is above 1"),
    "spiral too large": (CAMERA + HELIX.replace("0.35", "4e8"), S1 + ".clip", "nothing",
                         "this surface reaches farther than 1e9: give clip = [[x0,y0,z0],[x1,y1,z1]]"),
    "scale zero": (CAMERA + TORUS + "scale = 0.0\n", S0 + ".scale", "0.0", LENGTH),
    "color above 1": (CAMERA + TORUS + "color = [0, 0, 1.5]\n", S0 + ".color[2]", "1.5",
                      "a number from 0 to 1"),
    "background below 0": ("[background]\ncolor = [-0.1, 0, 0]\n" + CAMERA + TORUS, "background.color[0]",
                           "-0.1", "a number from 0 to 1"),
    "opacity zero": (CAMERA + TORUS + "opacity = 0\n", S0 + ".opacity", "0", "a number above 0, up to 1"),
    "opacity above 1": (CAMERA + TORUS + "opacity = 1.1\n", S0 + ".opacity", "1.1",
                        "a number above 0, up to 1"),
    "ambient above 1": ("[light]\nambient = 2\n" + CAMERA + TORUS, "light.ambient", "2",
                        "a number from 0 to 1"),
    "light direction zero": ("[light]\ndirection = [0, 0, 0]\n" + CAMERA + TORUS, "light.direction",
                             "[0.0, 0.0, 0.0]", "a vector that is not zero (length at least 1e-9)"),
    "vfov zero": (CAMERA + "vfov = 0\n" + TORUS, "camera.vfov", "0",
                  "degrees above 0 (from 1e-9), up to 170"),
    "vfov too wide": (CAMERA + "vfov = 170.5\n" + TORUS, "camera.vfov", "170.5",
                      "degrees above 0 (from 1e-9), up to 170"),
    "image empty": (CAMERA + "width = 0\n" + TORUS, "camera.width", "0", PIXELS),
    "image too wide": (CAMERA + "width = 4097\n" + TORUS, "camera.width", "4097", PIXELS),
    "image too high": (CAMERA + "height = 100000\n" + TORUS, "camera.height", "100000", PIXELS),
    # camera
    "eye at look_at": ("[camera]\neye = [1, 2, 3]\nlook_at = [1, 2, 3]\n" + TORUS, "camera.look_at",
                       "[1.0, 2.0, 3.0], at the eye", "a point at least 1e-9 from camera.eye"),
    "up zero": (CAMERA + "up = [0, 0, 0]\n" + TORUS, "camera.up", "[0.0, 0.0, 0.0]",
                "a vector that is not zero (length at least 1e-9)"),
    "up along the view": (CAMERA + "up = [-6, 8, -5.0]\n" + TORUS, "camera.up",
                          "[-6.0, 8.0, -5.0], along the view",
                          "a vector that is not along look_at - eye (sine of the angle above 1e-6)"),
    "up nearly along": (CAMERA + "up = [-6, 8, -5.000001]\n" + TORUS, "camera.up",
                        "[-6.0, 8.0, -5.000001], along the view",
                        "a vector that is not along look_at - eye (sine of the angle above 1e-6)"),
    # transform
    "rotation singular": (CAMERA + TORUS + "rotation = [[1, 2, 3], [4, 5, 6], [7, 8, 9]]\n", S0 + ".rotation",
                          "[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]",
                          REGULAR),
    "rotation with a zero row": (CAMERA + TORUS + "rotation = [[1, 0, 0], [0, 0, 0], [0, 0, 1]]\n",
                                 S0 + ".rotation", "[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]",
                                 REGULAR),
    "rotation nearly singular": (CAMERA + TORUS + "rotation = [[1, 0, 0], [1, 1e-07, 0], [0, 0, 1]]\n",
                                 S0 + ".rotation", "[[1.0, 0.0, 0.0], [1.0, 1e-07, 0.0], [0.0, 0.0, 1.0]]",
                                 REGULAR),
    "rotation of two rows": (CAMERA + TORUS + "rotation = [[1, 0, 0], [0, 1, 0]]\n", S0 + ".rotation",
                             "[[1, 0, 0], [0, 1, 0]]", "three rows of three numbers"),
    "rotation and axis": (CAMERA + TORUS + "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\naxis = [0, 0, 1]\n",
                          S0 + ".rotation", "rotation together with axis or angle",
                          "either rotation, or axis with angle"),
    "axis alone": (CAMERA + TORUS + "axis = [0, 0, 1]\n", S0 + ".angle", "axis without angle",
                   "axis and angle together"),
    "angle alone": (CAMERA + TORUS + "angle = 0\n", S0 + ".axis", "angle without axis",
                    "axis and angle together"),
    "axis zero": (CAMERA + TORUS + "axis = [0, 0, 0]\nangle = 1\n", S0 + ".axis", "[0.0, 0.0, 0.0]",
                  "a vector that is not zero (length at least 1e-9)"),
    # boxes
    "open plane": (CAMERA + PLANE, "surface[0] (plane).clip", "nothing", OPEN),
    "open cylinder": (surface("type = 'cylinder'\nR = 1"), "surface[0] (cylinder).clip", "nothing", OPEN),
    "open cone": (surface("type = 'cone'\nk = 1"), "surface[0] (cone).clip", "nothing", OPEN),
    "open paraboloid": (surface("type = 'paraboloid'\na = 1\nb = 1"), "surface[0] (paraboloid).clip",
                        "nothing", OPEN),
    "open saddle": (surface("type = 'hyperbolic_paraboloid'\na = 1\nb = 1"),
                    "surface[0] (hyperbolic_paraboloid).clip", "nothing", OPEN),
    "open hyperboloid": (surface("type = 'hyperboloid_one_sheet'\na = 1\nb = 1\nc = 1"),
                         "surface[0] (hyperboloid_one_sheet).clip", "nothing", OPEN),
    "open two sheets": (surface("type = 'hyperboloid_two_sheet'\na = 1\nb = 1\nc = 1"),
                        "surface[0] (hyperboloid_two_sheet).clip", "nothing", OPEN),
    "open quadric": (surface("type = 'quadric'\ncoefficients = [1, 1, -1, 0, 0, 0, 0, 0, 0, 1]"),
                     "surface[0] (quadric).clip", "nothing", OPEN),
    "open quartic": (surface(f"type = 'quartic'\nQ1 = [1, 1, 1, 0, 0, 0, 0, 0, 0, -1]\nQ2 = {ZEROS}\n"
                             f"Q3 = {ZEROS}"), "surface[0] (quartic).clip", "nothing", OPEN),
    "reaches too far": (surface("type = 'quadric'\ncoefficients = [1, 1, 1e-20, 0, 0, 0, 0, 0, 0, -1]"),
                        "surface[0] (quadric).clip", "nothing",
                        "this surface reaches farther than 1e9: give clip = [[x0,y0,z0],[x1,y1,z1]]"),
    "clip upside down": (CAMERA + PLANE + "clip = [[-1, -1, 1], [1, 1, -1]]\n", "surface[0] (plane).clip",
                         "[[-1.0, -1.0, 1.0], [1.0, 1.0, -1.0]]",
                         "x0 < x1, y0 < y1, z0 < z1 (by at least 1e-9)"),
    "clip flat": (CAMERA + PLANE + "clip = [[-1, -1, 0], [1, 1, 0]]\n", "surface[0] (plane).clip",
                  "[[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]]", "x0 < x1, y0 < y1, z0 < z1 (by at least 1e-9)"),
    "clip of six numbers": (CAMERA + PLANE + "clip = [0, 0, 0, 1, 1, 1]\n", "surface[0] (plane).clip",
                            "[0, 0, 0, 1, 1, 1]", "two corners [[x0, y0, z0], [x1, y1, z1]]"),
    # the file
    "bad TOML": (CAMERA + "width 3\n", "file",
                 "bad TOML: Expected '=' after a key in a key/value pair (at line 4, column 7)", "TOML 1.0"),
    "key twice": (CAMERA + "eye = 3\n", "file", "bad TOML: Cannot overwrite a value (at line 4, column 8)",
                  "TOML 1.0"),
    "nested without end": ("x = " + 5000 * "[" + 5000 * "]", "file", "bad TOML: nested too deeply",
                           "tables and arrays of a scene"),
    "bad UTF-8": (b"# \xff\n", "file", "a byte that is not UTF-8 at offset 2", "a TOML file in UTF-8"),
    "empty file": ("", "camera", "nothing", "a table with the keys eye, look_at, up, vfov, width, height"),
}  # fmt: skip


def refusal(path: Path, **size) -> str:
    with pytest.raises(SceneError) as info:
        load_scene(path, **size)
    return str(info.value)


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_refused(tmp_path, name):
    """Bad input raises SceneError with a line that names file, key, what was found and what is allowed."""
    text, key, found, allowed = BAD[name]
    path = write(tmp_path, text)
    lines = refusal(path).splitlines()
    assert lines[0] == f"{path}: {key}: found {found}; allowed: {allowed}"
    if name != "empty file":
        assert len(lines) == 1


def test_missing_file_is_refused(tmp_path):
    """A file that cannot be read is refused like any bad input."""
    path = tmp_path / "none.toml"
    assert refusal(path) == f"{path}: file: found No such file or directory; allowed: a readable TOML file"
    assert refusal(tmp_path) == f"{tmp_path}: file: found Is a directory; allowed: a readable TOML file"
    assert "allowed: a readable TOML file" in refusal("nul\0.toml")


def test_all_problems_are_reported(tmp_path):
    """One refusal lists the problems of all tables, a line each, and nothing of pydantic's."""
    text = CAMERA.replace("2.5", "nan") + "vfov = 0\n" + TORUS + "scale = 0\nshine = 1\n" + PLANE + "angle = 1\n"
    lines = refusal(write(tmp_path, text)).splitlines()
    keys = [line.split(": ")[1] for line in lines]
    assert keys == ["camera.eye[2]", "camera.vfov", S0 + ".scale", S0 + ".shine",
                    "surface[1] (plane).axis", "surface[1] (plane).clip"]  # fmt: skip
    assert all(line.count("found ") == line.count("; allowed: ") == 1 for line in lines)
    assert "pydantic" not in "".join(lines)


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_scenes_of_the_project_load(path):
    """Every file in scenes/ is a valid scene of 640x480 whose name is the file's stem."""
    loaded = load_scene(path)
    assert (loaded.name, loaded.path) == (path.stem, path)
    assert (loaded.camera.width, loaded.camera.height) == (640, 480)


def test_every_type_has_a_scene():
    """scenes/ shows every surface type."""
    assert {s.type for path in SCENES for s in load_scene(path).surfaces} == set(TYPES.split(", "))


def test_defaults(tmp_path):
    """The keys that may be left out have the documented defaults; integers become floats."""
    loaded = load_scene(write(tmp_path, CAMERA + TORUS))
    assert loaded.camera == scene.Camera(
        eye=(3, -4, 2.5), look_at=(0, 0, 0), up=(0, 0, 1), vfov=30, width=640, height=480
    )
    assert loaded.light == scene.Light(direction=(-0.36, -0.48, 0.80), ambient=0.1)
    assert loaded.background == scene.Background(color=(0, 0, 0))
    (torus,) = loaded.surfaces
    assert (torus.center, torus.scale, torus.clip, torus.opacity) == ((0, 0, 0), 1, None, 1)
    assert torus.matrix == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    assert all(isinstance(v, float) for v in loaded.camera.look_at)


def test_limits_are_allowed(tmp_path):
    """The ends of every range are accepted, and a tube thicker than its ring."""
    camera = CAMERA + "vfov = 170\nwidth = 4096\nheight = 1\n"
    text = camera + "[light]\nambient = 1\n" + TORUS.replace("0.4", "2") + "opacity = 1\nscale = 1e-9\n" + (
        "[[surface]]\ntype = 'sphere'\nR = 1e9\n"
        "[[surface]]\ntype = 'cyclide'\na = 1\nb = 1\nd = 1e-9\ncolor = [0, 1, 0.5]\n"
    )  # fmt: skip
    assert len(load_scene(write(tmp_path, text)).surfaces) == 3
    assert len(load_scene(write(tmp_path, CAMERA + 64 * TORUS)).surfaces) == 64


def test_limits_of_a_spiral_are_allowed(tmp_path):
    """The ends of the spiral's ranges are accepted; up to one turn the tube may grow as fast as it likes."""
    bodies = (
        "R = 1\nr = 0.99\npitch = 0\nturns = 1e-3\n",
        "R = 1\nr = 1e-9\npitch = -1e7\nturns = 100\n",
        "R = 1\nr = 0.5\npitch = 0\nturns = 1\nr_growth = 0.49\n",
        "R = 1\nr = 0.5\npitch = 0\nturns = 1\nr_growth = -0.499999999\n",
        "R = 1\nr = 0.5\npitch = -0.4\nturns = 2\nR_growth = 0.3\nr_growth = 0.2\n",
        "R = 3\nr = 0.5\npitch = 0.4\nturns = 1.001\nR_growth = -0.3\nr_growth = 0.45\n",
        "R = 1\nr = 0.5\npitch = 0\nturns = 2\n",
    )
    loaded = load_scene(write(tmp_path, CAMERA + "".join(SPIRAL + body for body in bodies)))
    assert len(loaded.surfaces) == len(bodies)
    assert (loaded.surfaces[-1].R_growth, loaded.surfaces[-1].r_growth) == (0, 0)


def test_far_end_is_judged_without_rounding(tmp_path):
    """r + r_growth * turns is exact: 9.35e-10 is refused though float64 makes it 1.9e-9, 3.7e-9 is accepted for 0."""
    text = SPIRAL + "R = 1e8\nr = 1e7\npitch = 0\nturns = 0.1\nr_growth = -99999999.99999999\n"
    line = refusal(write(tmp_path, CAMERA + text))
    assert "r_growth: found -99999999.99999999, r is 9.35005e-10 at the far end" in line
    text = SPIRAL + "R = 5e8\nr = 1e8\npitch = 1e8\nturns = 3\nr_growth = -33333333.333333332\n"
    assert 1e8 - 33333333.333333332 * 3 == 0
    load_scene(write(tmp_path, CAMERA + text))


def test_size_override(tmp_path):
    """Width and height given to load_scene replace the camera's before they are checked."""
    path = write(tmp_path, CAMERA + "width = 5000\n" + TORUS)
    camera = load_scene(path, width=320, height=200).camera
    assert (camera.width, camera.height) == (320, 200)
    assert refusal(path, height=0).count("\n") == 1
    assert refusal(path, width=4097) == f"{path}: camera.width: found 4097; allowed: {PIXELS}"
    assert "camera: found nothing" in refusal(write(tmp_path, TORUS), width=1)


def test_scene_is_immutable(tmp_path):
    """Nothing of a loaded scene can be assigned to."""
    loaded = load_scene(write(tmp_path, CAMERA + TORUS))
    with pytest.raises(AttributeError):
        loaded.name = "x"
    with pytest.raises(ValidationError):
        loaded.camera.width = 1
    with pytest.raises(ValidationError):
        loaded.surfaces[0].R = 2.0


def test_axis_and_angle():
    """axis and angle turn right-handed about the axis, whatever its length; the rows are orthonormal."""
    quarter = scene.Torus(type="torus", R=1, r=0.4, axis=(0, 0, 5), angle=90).matrix
    np.testing.assert_allclose(quarter, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15)
    axis, angle = np.array([1.0, -2.0, 0.5]), 35.0
    matrix = np.array(scene.Torus(type="torus", R=1, r=0.4, axis=tuple(axis), angle=angle).matrix)
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(matrix @ axis, axis, atol=1e-15)
    v = np.cross(axis, [0, 0, 1])
    turned = math.cos(math.radians(angle)) * v + math.sin(math.radians(angle)) * np.cross(
        axis / np.linalg.norm(axis), v
    )
    np.testing.assert_allclose(matrix @ v, turned, atol=1e-15)


def test_rotation_may_be_any_regular_matrix(tmp_path):
    """A shear with unequal scales is accepted as it stands, and so is a nearly singular matrix."""
    text = CAMERA + TORUS + "rotation = [[2, 1, 0], [0, -1e-3, 0], [0, 3, 100]]\n"
    assert load_scene(write(tmp_path, text)).surfaces[0].matrix == ((2, 1, 0), (0, -1e-3, 0), (0, 3, 100))
    load_scene(write(tmp_path, CAMERA + TORUS + "rotation = [[1, 0, 0], [1, 1e-5, 0], [0, 0, 1]]\n"))


VALID = (
    CAMERA + "width = 64\n[light]\nambient = 0.2\n" + TORUS + "axis = [0, 0, 1]\nangle = 30\n"
    + "color = [1, 0, 0.5]\n"
    + PLANE + BOX + "[[surface]]\ntype = 'quadric'\ncoefficients = [1, 1.2, 1.5, 0.8, 0, 0, 0, 0, 0, -1]\n"
    + "[[surface]]\ntype = 'cyclide'\na = 1\nb = 0.9\nd = 0.5\nrotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
    + HELIX + "R_growth = 0.1\nr_growth = 0.05\n"
)  # fmt: skip
VALUES = ["nan", "-inf", "0", "-1", "1e300", "1e-300", "true", "''", "[]", "{}", "[[0]]", "12:00:00",
          "0x" + 999 * "f", "'torus'", "'plane'", "[0, 0, 0]", "1.5", "99999", "", "[1, 2"]  # fmt: skip


@st.composite
def mutations(draw):
    """The valid scene with a few lines dropped, doubled, moved, given another value, or cut up."""
    lines = VALID.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        i, j = (draw(st.integers(0, len(lines) - 1)) for _ in range(2))
        key = lines[i].split("=")[0]
        match draw(st.integers(0, 5)):
            case 0:
                lines[i] = ""
            case 1:
                lines.insert(j, lines[i])
            case 2:
                lines[i], lines[j] = lines[j], lines[i]
            case 3:
                lines[i] = key + "= " + draw(st.sampled_from(VALUES))
            case 4:
                lines[i] = key + "= " + draw(st.text(string.printable, max_size=8))
            case 5:
                cut = draw(st.integers(0, len(lines[i])))
                lines[i] = lines[i][:cut] + draw(st.text(max_size=3)) + lines[i][cut + 1 :]
    return "\n".join(lines)


def test_scene_to_mutate_is_valid(tmp_path):
    """The mutations start from a scene that loads."""
    assert len(load_scene(write(tmp_path, VALID)).surfaces) == 5


@settings(max_examples=400, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(mutations())
def test_mutated_scenes_load_or_are_refused(tmp_path, text):
    """Whatever becomes of a scene's text, it is loaded or refused with well-formed lines."""
    path = write(tmp_path, text.encode("utf-8", "surrogatepass"))
    try:
        load_scene(path)
    except SceneError as error:
        for line in str(error).split("\n"):
            assert line.startswith(f"{path}: ") and ": found " in line and "; allowed: " in line
