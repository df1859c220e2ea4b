# SPDX-License-Identifier: Apache-2.0
"""Words of a spiral: coordinate lanes of one scale, and the constants of the evaluator (formats.FORM).

All with 256 bits, rounded once. Source: docs/spirals.md.
"""

from typing import NamedTuple

import mpmath as mp

from .cordic import gain
from .formats import ANGLE_ITERATIONS, COORD_ACC_WIDTH, COORD_FRAC, FORM, LENGTH_ITERATIONS, ZONES

REACH = mp.mpf(7) / 4  # largest coordinate: the longest leg then stays below 16
NEVER = 63  # a level that there is not
SLACK = 1 + mp.mpf(2) ** -20  # by which the bounds are widened, for rounded coordinates


class Tube(NamedTuple):
    """Derived sizes of a spiral in local units; growth is per turn, places are in turns."""

    radius: mp.mpf  # of the centre curve at its start
    radius_growth: mp.mpf
    size: mp.mpf  # radius of the tube at its start
    size_growth: mp.mpf
    pitch: mp.mpf
    turns: mp.mpf
    clear: mp.mpf  # distance between axis and solid
    slant: mp.mpf  # how far the centre curve's trace in the half plane moves in a turn


def tube_of(surface) -> Tube:
    """The sizes that the words are made of."""
    radius, growth = mp.mpf(surface.R), mp.mpf(surface.R_growth)
    size, size_growth = mp.mpf(surface.r), mp.mpf(surface.r_growth)
    turns, pitch = mp.mpf(surface.turns), mp.mpf(surface.pitch)
    last, last_size = radius + growth * turns, size + size_growth * turns
    clear = min(radius - size, last - last_size)
    return Tube(radius, growth, size, size_growth, pitch, turns, clear, mp.hypot(growth, pitch))


def linear_lane(lane, factor) -> list[int]:
    """Words of a linear forward-difference lane (value, per column, per row), times ``factor``."""
    return [int(mp.nint(v * factor)) for v in lane]


def needs_general(surface) -> bool:
    """Whether the evaluator for helices is not enough: a radius grows, or there is less than a turn."""
    return bool(surface.R_growth or surface.r_growth or surface.turns < 1)


def bounds(tube: Tube, near) -> tuple[mp.mpf, mp.mpf]:
    """Lipschitz constant G and bound M of the second derivative (1/length) at a distance from the axis and beyond."""
    slope = (tube.slant + abs(tube.size_growth)) / (2 * mp.pi * near)
    lipschitz = mp.sqrt(1 + slope**2)
    return lipschitz, lipschitz**2 / _thinnest(tube, near) + 1 / near + slope / near


def epsilon(tube: Tube, scale, digits: int):
    """Bound of the evaluator's error, scaled coordinates: what may be missed or seen too much has less clearance.

    Source: docs/spirals.md, "Error of the evaluator".
    """
    lipschitz, _ = bounds(tube, tube.clear)
    return mp.ldexp((2 * digits + 16) * lipschitz + 32 * tube.slant * scale + 2 * tube.turns, -31)


def _thinnest(tube: Tube, near):
    """Least distance from the centre curve of a point outside of the solid, ``near`` or farther from the axis.

    The least over all places of the larger of the tube's radius and what is left between centre and ``near``.
    """
    places = [mp.mpf(0), tube.turns]
    growth = tube.size_growth + tube.radius_growth
    if growth:
        places.append(min(max((near - tube.radius - tube.size) / growth, mp.mpf(0)), tube.turns))
    return min(max(tube.size + tube.size_growth * s, near - tube.radius - tube.radius_growth * s) for s in places)


def _zones(tube: Tube, scale, length, n1) -> dict:
    """Bounds over a segment of scaled ``length``, and from which level on they hold, for each zone."""
    gain_length = gain(LENGTH_ITERATIONS)
    squared = gain(ANGLE_ITERATIONS) * gain_length
    lists: dict[str, list] = {"lipschitz": [], "curvature": [], "from_level": []}
    for zone in range(ZONES):
        inner = mp.ldexp(1, zone + 1 - ZONES) if zone else mp.mpf(0)
        clear = tube.clear * scale
        lipschitz, bend = bounds(tube, max(inner, clear) / scale / 2)
        # the cells of a zone stay beyond half of its inner radius; about the axis, those that do not stay beyond half
        # of the clear distance are excluded by the guard
        longest = inner if inner > clear else clear / (1 + gain_length / mp.mpf("1.5") * lipschitz)
        curvature = bend / scale * length**2 / 2 * squared
        level = 0
        while length * mp.ldexp(1, -n1 * (level + 1)) >= longest:
            level += 1
        curvature = mp.ldexp(curvature, -2 * n1 * (level + 1))  # over a cell of that level
        lists["lipschitz"].append(lipschitz * length * squared)
        lists["curvature"].append(curvature)
        lists["from_level"].append(mp.mpf(min(level, NEVER)))
    return lists


def _turns(tube: Tube, scale, middle) -> dict:
    """The nearest turn as a linear function of radius and height, and its shift by a growing tube."""
    names = ("turn_z", "turn_rho", "turn_offset", "skew_z", "skew_rho", "skew_offset", "skew_back")
    if not tube.slant:
        return dict.fromkeys(names, mp.mpf(0))  # every turn is the same one
    along = (tube.radius_growth, tube.pitch)
    square, ratio = tube.slant**2, abs(tube.size_growth) / tube.slant
    skew = ratio / mp.sqrt(1 - ratio**2) if ratio < mp.mpf("0.95") else mp.mpf(0)  # one turn at most: none to choose
    return {
        "turn_z": along[1] / (square * scale),
        "turn_rho": along[0] / (square * scale),
        "turn_offset": (middle * along[1] - tube.radius * along[0]) / square,
        "skew_z": -skew * along[0] / (square * scale),
        "skew_rho": skew * along[1] / (square * scale),
        "skew_offset": -skew * (middle * along[0] + tube.radius * along[1]) / square,
        "skew_back": mp.mpf(int(tube.size_growth < 0)),
    }


def _balls(tube: Tube, general: bool, scale, middle, across, squared) -> dict:
    """Centres and radii of the balls at the ends; unless ``general`` the lower one first (their radii are equal)."""
    ends = []
    for place in (mp.mpf(0), tube.turns):
        radius, angle = tube.radius + tube.radius_growth * place, 2 * mp.pi * place
        centre = radius * mp.cos(angle) * scale, radius * mp.sin(angle) * scale
        height = (tube.pitch * place - middle) * across
        ends.append((*centre, height, (tube.size + tube.size_growth * place) * squared))
    if tube.pitch < 0 and not general:
        ends.reverse()
    return {"start": ends[0][:3], "tube": ends[0][3], "stop": ends[1][:3], "tube_stop": ends[1][3]}


def _faces(low, high, cut, middle, factors) -> dict:
    """The box; an axis that it does not cut has the whole range."""
    faces: dict[str, list] = {"low": [], "high": []}
    for i in range(3):
        least, most = mp.mpf(-2), 2 - mp.ldexp(1, -COORD_FRAC)
        if cut[i]:
            origin = middle if i == 2 else 0
            least, most = max(least, (low[i] - origin) * factors[i]), min(most, (high[i] - origin) * factors[i])
        faces["low"].append(least)
        faces["high"].append(most)
    return faces


class Oversize(ValueError):
    """A constant does not fit its word; the text says which and what would fit."""


def rounded(table, values: dict) -> list[int]:
    """Values by name to words in the order of a table of fields; rounded to nearest. Raises :class:`Oversize`."""
    words = []
    for field in table:
        integer, fraction = (int(n) for n in field.token[1:].split("p"))
        signed = field.token[0] == "s"
        limit = 1 << (integer + fraction - signed)
        for value in values[field.name] if field.count > 1 else [values[field.name]]:
            word = int(mp.nint(mp.ldexp(value, fraction)))
            if not -limit * signed <= word < limit:
                raise Oversize(f"a {field.name} ({field.meaning}) of {float(value):.3g}, beyond {field.token}")
            words.append(word)
    return words


def form_words(surface, points, length, low, high, cut, n1):
    """Words of the form, the height of the coordinate origin, and the factor of each axis.

    points     local vectors that hold all ends of segments in their hull
    length     of the longest segment
    low, high  the local box, cut: which axes it cuts
    Raises :class:`Oversize`.
    """
    tube = tube_of(surface)
    gain_angle, gain_length = gain(ANGLE_ITERATIONS), gain(LENGTH_ITERATIONS)
    top = tube.pitch * tube.turns
    floor = min(-tube.size, top - tube.size - tube.size_growth * tube.turns)
    ceiling = max(tube.size, top + tube.size + tube.size_growth * tube.turns)
    middle = (floor + ceiling) / 2
    growth = (tube.radius_growth + tube.size_growth) * tube.turns
    widest = tube.radius + tube.size + max(mp.mpf(0), growth)
    largest = max(max(abs(p[0]), abs(p[1]), gain_angle * abs(p[2] - middle)) for p in points)
    scale = REACH / max(largest, widest, gain_angle * (ceiling - floor) / 2)
    factors = (scale, scale, gain_angle * scale)
    across, squared = gain_angle * scale, gain_angle * gain_length * scale
    values = {
        **_zones(tube, scale, length * SLACK * scale, n1),
        "guard": mp.mpf("1.5") * tube.clear * across,
        "turns": tube.turns,
        "radius": tube.radius * across,
        "pitch": tube.pitch * across,
        "height": -middle * across,
        "split": (top / 2 - middle) * across,
        "radius_growth": tube.radius_growth * across,
        "tube_growth": tube.size_growth * squared,
        **_faces(low, high, cut, middle, factors),
        **_turns(tube, across, middle),
        **_balls(tube, needs_general(surface), scale, middle, across, squared),
    }
    return rounded(FORM, values), middle, factors


def spiral_words(surface, h, e, low, high, cut, columns, rows, n1):
    """Coordinate words, form words, origin and unit of each axis.

    h, e       ends of the first ray's segment and their change per column and row, local vectors
    Otherwise as :func:`form_words`.
    """
    corners = [(x, y) for x in (0, columns) for y in (0, rows)]
    points = [v[0] + x * v[1] + y * v[2] for v in (h, e) for x, y in corners]
    length = max(mp.norm((e[0] - h[0]) + x * (e[1] - h[1]) + y * (e[2] - h[2])) for x, y in corners)
    words, middle, factors = form_words(surface, points, length, low, high, cut, n1)
    coordinates = []
    for axis, (origin, factor) in enumerate(zip((0, 0, middle), factors, strict=True)):
        for v in (h, e):
            lane = (v[0][axis] - origin, v[1][axis], v[2][axis])
            coordinates += linear_lane(lane, factor * mp.ldexp(1, COORD_ACC_WIDTH - 2))
    return coordinates, words, (0.0, 0.0, float(middle)), tuple(float(1 / f) for f in factors)
