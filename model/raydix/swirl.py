# SPDX-License-Identifier: Apache-2.0
"""Gradient of a spiral's indicator at a point of the surface (mirrors ``rtl/rdx_swirl.sv`` and its parts).

Of reduced width: what a colour of eight bits needs. Source: docs/modules/swirl.md.
"""

import mpmath as mp

from .cordic import gain, turned
from .formats import ANGLE_WIDTH, COORD_FRAC, SWIRL_CHORDS, SWIRL_FRAC, SWIRL_INDEX, SWIRL_ITERATIONS, SWIRL_STILL
from .kernel import kernel
from .multiply import scaled
from .normalize import normalize

TURN_Z = SWIRL_INDEX["turn_z"]
TURN_RHO = SWIRL_INDEX["turn_rho"]
TURN_OFFSET = SWIRL_INDEX["turn_offset"]
TURNS = SWIRL_INDEX["turns"]
RADIUS = SWIRL_INDEX["radius"]
HEIGHT = SWIRL_INDEX["height"]
TUBE = SWIRL_INDEX["tube"]
PITCH = SWIRL_INDEX["pitch"]
RADIUS_GROWTH = SWIRL_INDEX["radius_growth"]
TUBE_GROWTH = SWIRL_INDEX["tube_growth"]
SCALE = SWIRL_INDEX["scale"]
PITCH_RADIAN = SWIRL_INDEX["pitch_radian"]
RADIUS_RADIAN = SWIRL_INDEX["radius_radian"]
TUBE_RADIAN = SWIRL_INDEX["tube_radian"]
NEAR = SWIRL_INDEX["near"]
BEND = SWIRL_INDEX["bend"]
START_REACH = SWIRL_INDEX["start_reach"]
STOP_REACH = SWIRL_INDEX["stop_reach"]
START = SWIRL_INDEX["start"]
STOP = SWIRL_INDEX["stop"]
SPLIT = SWIRL_INDEX["split"]
DOWN = SWIRL_INDEX["down"]
PLANE = SWIRL_INDEX["plane"]
PLANE_OFFSET = SWIRL_INDEX["plane_offset"]

COORD_DROP = COORD_FRAC - SWIRL_FRAC
ANGLE_DROP = ANGLE_WIDTH - SWIRL_FRAC
TURN_DROP = 19  # s2p22 or s4p22 times s13p19 to turns
OFFSET_UP = SWIRL_FRAC - 16
GROWTH_DROP = 26  # turns times s6p26 to a length
HALF = 1 << (SWIRL_FRAC - 1)  # a turn
ONE = 1 << 17
PART_BITS = SWIRL_FRAC - 1 - (SWIRL_CHORDS.bit_length() - 1)  # azimuth within an interval of the table
PARTS_WIDTH = 28  # s3p25
SUM_WIDTH = 30
SUM_DROP = 7


def _chords():
    """sin^2(pi v)/v at the intervals' starts, s3p15, and what it gains in each, 2^-20."""
    with mp.workprec(128):
        places = [mp.mpf(i) / (2 * SWIRL_CHORDS) for i in range(SWIRL_CHORDS + 1)]
        values = [mp.sin(mp.pi * v) ** 2 / v if v else mp.mpf(0) for v in places]
        gains = [b - a for a, b in zip(values, values[1:], strict=False)]
        base = tuple(int(mp.nint(mp.ldexp(v, 15))) for v in values[:-1])
        return base, tuple(int(mp.nint(mp.ldexp(v, 20))) for v in gains)


CHORDS, CHORD_GAINS = _chords()


def _flat():
    """1/K^2 as s1p17."""
    with mp.workprec(128):
        return int(mp.nint(mp.ldexp(1 / gain(SWIRL_ITERATIONS) ** 2, 17)))


FLAT = _flat()


@kernel
def _fit(value, width):
    """``value`` saturated to ``width`` bits."""
    return max(min(value, (1 << (width - 1)) - 1), -(1 << (width - 1)))


@kernel
def _polar(x, y):
    """K times the distance from the axis, and the azimuth in turns, of s2p22 numbers."""
    back = x >> 63
    u, v, w = (x ^ back) - back, (y ^ back) - back, back & (1 << (ANGLE_WIDTH - 1))
    for i in range(SWIRL_ITERATIONS):
        longer, v, w = turned(u, v, w, i, 0)
        u = longer if i < SWIRL_STILL else u
    return u, (w & ((1 << ANGLE_WIDTH) - 1)) >> ANGLE_DROP


@kernel
def turn(rho, z, azimuth, words, general):
    """Place on the centre curve, s8p22, of the turn that counts at a point, and whether there is none.

    It is the turn of the least distance squared less radius squared. Mirrors ``rtl/rdx_swirl_turn.sv``.
    """
    at = scaled(z, words[TURN_Z], TURN_DROP) + (words[TURN_OFFSET] << OFFSET_UP) + HALF - azimuth
    if general:
        at += scaled(rho, words[TURN_RHO], TURN_DROP)
    last = (words[TURNS] - azimuth) >> SWIRL_FRAC
    number = max(min(at >> SWIRL_FRAC, last), 0)
    return (number << SWIRL_FRAC) + azimuth, last < 0


@kernel
def at_end(x, y, z, words, general):
    """Which ball is the nearer: 1: that at the end. Mirrors ``rtl/rdx_swirl_side.sv``."""
    if general:
        beyond = (x >> 6) * words[PLANE] + (y >> 6) * words[PLANE + 1] + (z >> 6) * words[PLANE + 2]
        return beyond >= (words[PLANE_OFFSET] << 5)
    return (z >= words[SPLIT]) != (words[DOWN] != 0)


@kernel
def part(length, scale):
    """A length s4p22 times 2^E, s1p17, saturated. Mirrors ``rtl/rdx_swirl_part.sv``."""
    return _fit((length << scale) >> 6, 18)


@kernel
def chord(turns):
    """sin^2(pi v)/v, u3p15, of v up to a half, u0p22. Mirrors ``rtl/rdx_swirl_chord.sv``."""
    index, within = turns >> PART_BITS, turns & ((1 << PART_BITS) - 1)
    return CHORDS[index] + ((CHORD_GAINS[index] * within) >> (PART_BITS + 5))


@kernel
def in_ball(place, azimuth, rho, side, words, stop):
    """Whether the ball at an end is nearer than the tube.

    side  the growth of the indicator with the azimuth, s3p25
    The sign of: distance squared less radius squared of the ball, less the same of the tube, times c 2^E / 4 pi,
    divided by the turns between them where these are below a half. Mirrors ``rtl/rdx_swirl_end.sv``.
    """
    away = words[TURNS] - place if stop else place
    beyond = (azimuth - words[TURNS] if stop else azimuth) & (2 * HALF - 1)
    folded = (beyond ^ (2 * HALF - 1)) if beyond & HALF else beyond
    small = away < HALF
    arc = chord(folded)
    distance = (away >> (SWIRL_FRAC - 17)) & (ONE - 1)
    if not small:
        arc = (arc * (folded >> (SWIRL_FRAC - 17))) >> 17
    reach = (rho * (words[STOP_REACH] if stop else words[START_REACH])) >> 17
    leaning = words[NEAR] * (side >> 10)
    leaning = ((words[BEND] * distance) >> 2) + (-leaning if stop else leaning)
    leaning = leaning >> 2 if small else ((leaning >> 18) * distance) >> 1
    return away < 2 * HALF and arc * reach + leaning < 0


@kernel
def swirl(x, y, z, words, general, out):
    """Gradient at a point near the surface, scaled coordinates: three s1p17 of a common positive factor into ``out``.

    x, y, z  the point, s2p30; z carries K
    words    constants, by formats.SWIRL_INDEX
    general  0 where neither radius grows and the spiral has a whole turn at least, else 1
    """
    x, y, z = x >> COORD_DROP, y >> COORD_DROP, z >> COORD_DROP
    rho, azimuth = _polar(x, y)
    place, none = turn(rho, z, azimuth, words, general)
    # ---- distances from the centre, of all lengths 18 bits ----
    scale = words[SCALE]
    across, growth = rho - words[RADIUS], 0
    along = part(z - words[HEIGHT] - scaled(place, words[PITCH], GROWTH_DROP), scale)
    side = along * words[PITCH_RADIAN]
    if general:
        across -= scaled(place, words[RADIUS_GROWTH], GROWTH_DROP)
        growth = part(words[TUBE] + scaled(place, words[TUBE_GROWTH], GROWTH_DROP), scale)
    across = part(across, scale)
    if general:
        side += across * words[RADIUS_RADIAN] + growth * words[TUBE_RADIAN]
    side = _fit(side >> 7, PARTS_WIDTH)
    rho = min(rho >> 7, ONE - 1)
    # ---- tube or ball ----
    stop = at_end(x, y, z, words, general)
    wide = abs(across) >= ONE - 1 or abs(along) >= ONE - 1  # no point of the tube
    ball = none or wide or in_ball(place, azimuth, rho, side, words, stop)
    # ---- the gradient turned to azimuth 0, then turned back and multiplied by the distance from the axis ----
    if ball:
        at = STOP if stop else START
        out[0] = (x - words[at]) << 3
        out[1] = (words[at + 1] - y) << 3
        out[2] = (z - words[at + 2]) << 3
        x, y, up = 1 << 16, 0, FLAT >> 1
    else:
        out[0] = (across * rho) >> 7
        out[1] = side
        out[2] = (along * rho) >> 7
        x, y, up = x >> 6, y >> 6, (rho * FLAT) >> 16
    normalize(out, 0, 3, PARTS_WIDTH, 18, 7)
    outwards, side, upwards = out[0], out[1], out[2]
    out[0] = (outwards * x + side * y) >> SUM_DROP
    out[1] = (outwards * y - side * x) >> SUM_DROP
    out[2] = (upwards * up) >> SUM_DROP
    normalize(out, 0, 3, SUM_WIDTH, 18, 7)
