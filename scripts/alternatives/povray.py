# SPDX-License-Identifier: Apache-2.0
"""The same rays in POV-Ray: its own shapes, isosurfaces, and a helix of cylinders; depth is read from the colours.

The scene is in the surface's local coordinates. A pixel's colour is its depth, 16 bits in red and what a 4096th is
divided into in green; blue is the background. Time is POV-Ray's own trace time on one thread, without parsing, of
another run with one plain colour.
"""

import re
import shutil
import subprocess
import tempfile
from math import hypot, pi
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from .frame import Problem, Rendered

FINE = 4096  # parts of the range of depths that green divides
CYLINDERS = 256  # of a turn of a helix
SQUARE, LINEAR = ((2, 0, 0), (0, 2, 0), (0, 0, 2)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))
POWERS = (*SQUARE, (1, 1, 0), (0, 1, 1), (1, 0, 1), *LINEAR, (0, 0, 0))  # of x, y, z in a quadric's ten coefficients
MIXED = ((1, 1, 0), (1, 0, 1), (0, 1, 1))  # as POV-Ray has them
GRID = 41  # points along each edge of the box where the gradient is sampled for its bound

SCENE = """
#version 3.7;
global_settings {{ assumed_gamma 1 ambient_light 1 }}
background {{ rgb <0, 0, 1> }}
camera {{ perspective location {eye} direction {forward} right {right} up {up} }}
{functions}
object {{ {shape} {texture} }}
"""
PLAIN = "pigment { rgb <1, 0, 0> } finish { ambient 1 diffuse 0 }"
CODED = "texture { Coded }"
CODE = """
#declare Depth = function(x, y, z) {{ {depth} }}
#declare Fine = function(x, y, z) {{ {fine}*Depth(x, y, z) }}
#declare Coded = texture {{
  pigment {{
    average pigment_map {{
      [1 function {{ Depth(x, y, z) }} color_map {{ [0 rgb 0] [1 rgb <2, 0, 0>] }}]
      [1 function {{ Fine(x, y, z) - floor(Fine(x, y, z)) }} color_map {{ [0 rgb 0] [1 rgb <0, 2, 0>] }}]
    }}
  }}
  finish {{ ambient 1 diffuse 0 }}
}}
"""


def vector(v) -> str:
    """A vector of the scene language."""
    return "<" + ", ".join(f"{x:.17g}" for x in v) + ">"


def box(problem: Problem) -> str:
    """The surface's box."""
    return f"box {{ {vector(problem.low)}, {vector(problem.high)} }}"


def clipped(shape: str, problem: Problem) -> str:
    """What of an infinite shape is inside the box, without faces."""
    return f"{shape} clipped_by {{ {box(problem)} }} bounded_by {{ clipped_by }}"


def terms(problem: Problem) -> dict[tuple[int, int, int], float]:
    """The surface's polynomial: coefficients by powers of x, y, z."""
    powers = [
        (2, 0, 0),
        (0, 2, 0),
        (0, 0, 2),
        (1, 1, 0),
        (0, 1, 1),
        (1, 0, 1),
        (1, 0, 0),
        (0, 1, 0),
        (0, 0, 1),
        (0, 0, 0),
    ]
    q1, q2, q3 = (dict(zip(powers, q, strict=True)) for q in problem.quadrics)
    found = dict(q3)
    for a, ca in q1.items():
        for b, cb in q2.items():
            power = a[0] + b[0], a[1] + b[1], a[2] + b[2]
            found[power] = found.get(power, 0.0) + ca * cb
    return found


def native(problem: Problem, sturm: bool) -> str:
    """POV-Ray's own shape; with ``sturm`` the quartic is solved by Sturm's sequence."""
    solver = " sturm" if sturm else ""
    if problem.kind == "sphere":
        return f"sphere {{ <0, 0, 0>, {problem.sizes[0]:.17g} }}"
    if problem.kind == "torus":
        return f"torus {{ {problem.sizes[0]:.17g}, {problem.sizes[1]:.17g}{solver} rotate 90*x }}"
    known = terms(problem)
    if problem.degree == 4:
        order = [(i, j, k) for i in range(4, -1, -1) for j in range(4 - i, -1, -1) for k in range(4 - i - j, -1, -1)]
        return clipped(f"poly {{ 4, {vector(known.get(power, 0.0) for power in order)}{solver} ", problem) + " }"
    square, mixed, linear = (
        [(2, 0, 0), (0, 2, 0), (0, 0, 2)],
        [(1, 1, 0), (1, 0, 1), (0, 1, 1)],
        [(1, 0, 0), (0, 1, 0), (0, 0, 1)],
    )
    parts = ", ".join(vector(known[power] for power in group) for group in (square, mixed, linear))
    return clipped(f"quadric {{ {parts}, {known[0, 0, 0]:.17g} ", problem) + " }"


def steepest(problem: Problem) -> float:
    """The largest gradient of the polynomial on a grid in the box, corners included, and a twentieth more."""
    x = np.stack(np.meshgrid(*np.linspace(problem.low, problem.high, GRID).T, indexing="ij"))
    known = terms(problem)
    gradient = np.zeros_like(x)
    for power, c in known.items():
        for axis in range(3):
            if power[axis]:
                less = [n - (i == axis) for i, n in enumerate(power)]
                gradient[axis] += c * power[axis] * x[0] ** less[0] * x[1] ** less[1] * x[2] ** less[2]
    return 1.05 * float(np.sqrt((gradient**2).sum(axis=0)).max())


def formula(problem: Problem) -> tuple[str, str, float]:
    """Helper functions, the indicator as a text, and a bound of its gradient in the box."""
    if problem.kind == "sphere":
        return "", f"sqrt(x*x + y*y + z*z) - {problem.sizes[0]:.17g}", 1.0
    if problem.kind == "torus":
        ring, tube = problem.sizes[:2]
        return "", f"sqrt(pow(sqrt(x*x + y*y) - {ring:.17g}, 2) + z*z) - {tube:.17g}", 1.0
    if problem.kind != "spiral":
        known = [(c, p) for p, c in terms(problem).items() if c]
        text = " + ".join("*".join([f"({c:.17g})", *"x" * p[0], *"y" * p[1], *"z" * p[2]]) for c, p in known)
        return "", text, steepest(problem)
    ring, tube, pitch, turns = problem.sizes[:4]
    ends = [(ring * np.cos(2 * pi * u), ring * np.sin(2 * pi * u), pitch * u) for u in (0.0, turns)]
    balls = [f"sqrt(pow(x - ({a:.17g}), 2) + pow(y - ({b:.17g}), 2) + pow(z - ({c:.17g}), 2))" for a, b, c in ends]
    functions = f"""
#declare Turn = function(x, y, z) {{ atan2(y, x)/{2 * pi:.17g} }}
#declare Near = function(x, y, z) {{ z/{pitch:.17g} - Turn(x, y, z) }}
#declare Whole = function(x, y, z) {{
  min(max(floor(Near(x, y, z) + 0.5), ceil(-Turn(x, y, z))), floor({turns:.17g} - Turn(x, y, z)))
}}
#declare Tube = function(x, y, z) {{
  sqrt(pow(sqrt(x*x + y*y) - {ring:.17g}, 2) + pow(z - {pitch:.17g}*(Whole(x, y, z) + Turn(x, y, z)), 2))
}}"""
    # near the axis the angle runs away; half of the free space about it is said to be that far from the tube, no more
    free = (ring - tube) / 2
    text = f"min(Tube(x, y, z), min({balls[0]}, {balls[1]})) - {tube:.17g}"
    return functions, f"select(sqrt(x*x + y*y) - {free:.17g}, {free:.17g}, {text})", hypot(1.0, pitch / (2 * pi * free))


def cylinders(problem: Problem) -> str:
    """A helix of cylinders with balls between them."""
    ring, tube, pitch, turns = problem.sizes[:4]
    count = round(CYLINDERS * turns)
    u = np.linspace(0.0, turns, count + 1)
    points = np.stack([ring * np.cos(2 * pi * u), ring * np.sin(2 * pi * u), pitch * u], axis=1)
    parts = [f"sphere {{ {vector(p)}, {tube:.17g} }}" for p in points]
    parts += [
        f"cylinder {{ {vector(a)}, {vector(b)}, {tube:.17g} open }}" for a, b in zip(points, points[1:], strict=False)
    ]
    return "union { " + "\n".join(parts) + " }"


def isosurface(problem: Problem, accuracy: float) -> tuple[str, str]:
    """Helper functions and the isosurface."""
    functions, text, bound = formula(problem)
    shape = f"isosurface {{ function {{ {text} }} contained_by {{ {box(problem)} }} open accuracy {accuracy:.17g} "
    return functions, shape + f"max_gradient {bound:.17g} }}"


def own_shape(problem: Problem, _) -> Rendered:
    """POV-Ray's own shape."""
    return render(problem, "", native(problem, False))


def own_shape_sturm(problem: Problem, _) -> Rendered:
    """The same by Sturm's sequence."""
    return render(problem, "", native(problem, True))


def helix_of_cylinders(problem: Problem, _) -> Rendered:
    """Cylinders and balls."""
    return render(problem, "", cylinders(problem))


def by_isosurface(problem: Problem, accuracy: float) -> Rendered:
    """An isosurface."""
    return render(problem, *isosurface(problem, accuracy))


def missing() -> str:
    """Why POV-Ray cannot be had, or nothing."""
    return "" if shutil.which("povray") else "POV-Ray is not installed (Debian: apt-get install povray)"


def render(problem: Problem, functions: str, shape: str) -> Rendered:
    """Seconds of tracing, and how to get the depth. Raises ValueError where POV-Ray fails."""
    p = problem
    view = dict(
        eye=vector(p.eye), forward=vector(p.forward), right=vector(p.width * p.right), up=vector(p.height * p.up)
    )
    scene = dict(view, shape=shape)
    seconds, _ = trace(p, SCENE.format(functions=functions, texture=PLAIN, **scene))
    return seconds, lambda: depth_of(p, functions, scene)


def depth_of(p: Problem, functions: str, scene: dict[str, str]) -> np.ndarray:
    """Depth (height, width), inf where nothing is hit, from a run whose colours are the depth."""
    corners = np.array(np.meshgrid(*zip(p.low, p.high, strict=True))).reshape(3, -1).T
    scale = p.forward @ p.forward
    depths = (corners - p.eye) @ p.forward / scale
    near, span = depths.min(), np.ptp(depths)
    direction = p.forward / (scale * span)
    shares = [f"({c:.17g})*({axis} - ({e:.17g}))" for c, axis, e in zip(direction, "xyz", p.eye, strict=True)]
    code = CODE.format(depth=" + ".join([*shares, f"({-near / span:.17g})"]), fine=FINE)
    _, colours = trace(p, SCENE.format(functions=code + functions, texture=CODED, **scene))
    fine = colours[..., 1]
    part = (np.rint(FINE * colours[..., 0] - fine) + fine) / FINE
    return np.where(colours[..., 2] < 0.5, near + span * part, np.inf)


def seconds_of(report: str) -> float | None:
    """Seconds of tracing as POV-Ray prints them, at least one unit of their last digit; None: it printed none."""
    spent = re.findall(r"Trace Time:.*\(([\d.]+) seconds\)", report)
    return max(float(spent[-1]), 1e-3) if spent else None


def trace(p: Problem, text: str) -> tuple[float, np.ndarray]:
    """Run POV-Ray: seconds, colours (height, width, 3), 0 to 1. Raises ValueError where it fails."""
    with tempfile.TemporaryDirectory() as folder:
        scene, picture = Path(folder, "scene.pov"), Path(folder, "scene.png")
        scene.write_text(text)
        command = ["povray", f"+I{scene}", f"+O{picture}", f"+W{p.width}", f"+H{p.height}", "+FN16", "File_Gamma=1.0"]
        command += ["-D", "-A", "-J", "+WT1", "-P"]
        run = subprocess.run(command, capture_output=True, text=True, cwd=folder)
        seconds = seconds_of(run.stderr)
        if run.returncode or seconds is None:
            raise ValueError(f"povray failed: {' '.join(run.stderr.splitlines()[-3:])}")
        return seconds, oiio.ImageBuf(str(picture)).get_pixels(oiio.UINT16).astype(np.float64) / 65535
