# SPDX-License-Identifier: Apache-2.0
"""Constants of a spiral's gradient (formats.SWIRL), with 256 bits, rounded once. Source: docs/modules/swirl.md."""

import mpmath as mp

from .compile import PRECISION
from .compile_spiral import rounded, tube_of
from .cordic import gain
from .formats import ANGLE_ITERATIONS, SWIRL

LARGEST_SCALE = 7
LARGEST_SIZE = mp.mpf("0.98")  # scaled; rounding must not make it 1
LEAST_SLANT = mp.mpf("0.01")  # of the square, what the tube's growth must leave of it; more than a turn has 0.19


def _nearest(radius, height, tube, growth, pitch, swell) -> dict:
    """The turn with the least power as a linear function of radius and height."""
    square = growth**2 + pitch**2
    power = square - swell**2
    if not square or power < LEAST_SLANT * square:  # every turn is the same one, or there is one at most
        return dict.fromkeys(("turn_z", "turn_rho", "turn_offset"), mp.mpf(0))
    offset = tube * swell - radius * growth - height * pitch
    return {"turn_z": pitch / power, "turn_rho": growth / power, "turn_offset": offset / power}


def _ends(unit, radius, stop_radius, size, bend) -> dict:
    """What the choice between tube and ball needs."""
    scale = max(0, min(LARGEST_SCALE, int(mp.floor(mp.log(LARGEST_SIZE / size, 2))) + 1))
    up = mp.ldexp(1, scale - 1)
    values = {"near": mp.mpf(1), "bend": up * bend / (4 * mp.pi)}
    values |= {"start_reach": up * radius / mp.pi, "stop_reach": up * stop_radius / mp.pi}
    largest = max(abs(v) for v in values.values())
    common = mp.ldexp(1, -1 - int(mp.floor(mp.log(largest, 2))))
    if largest * common > 1 - mp.ldexp(1, -18):  # would be rounded to 1
        common /= 2
    return {"scale": mp.mpf(scale)} | {name: v * common for name, v in values.items()}


def _plane(ends) -> dict:
    """Where both balls have the same distance squared less radius squared; ends are (x, y, K z, K radius)."""
    factors = (mp.mpf(1), mp.mpf(1), gain(ANGLE_ITERATIONS) ** -2)
    normal = [2 * f * (b - a) for f, a, b in zip(factors, *(e[:3] for e in ends), strict=True)]
    powers = [sum(f * c**2 for f, c in zip((*factors, -factors[2]), e, strict=True)) for e in ends]
    offset = powers[1] - powers[0]
    largest = max(*(abs(v) for v in normal), abs(offset) / 7)
    up = mp.mpf("0.99") / largest if largest else mp.mpf(0)
    return {"plane": [v * up for v in normal], "plane_offset": offset * up}


def swirl_words(surface, origin, unit) -> list[int]:
    """Constants of a spiral in the order of SWIRL; origin and unit of its coordinates as compile gives them.

    Raises :class:`compile_spiral.Oversize`.
    """
    with mp.workprec(PRECISION):
        shape = tube_of(surface)
        across = gain(ANGLE_ITERATIONS) / mp.mpf(unit[0])
        middle = mp.mpf(origin[2])
        radius, growth, tube, swell, pitch = (
            across * v for v in (shape.radius, shape.radius_growth, shape.size, shape.size_growth, shape.pitch)
        )
        height, turns, whole = -across * middle, shape.turns, 2 * mp.pi
        centres = []
        for place in (mp.mpf(0), turns):
            at = (shape.radius + shape.radius_growth * place) / mp.mpf(unit[0])
            centres.append((at * mp.cos(whole * place), at * mp.sin(whole * place), height + pitch * place))
        values = {
            **_nearest(radius, height, tube, growth, pitch, swell),
            **_ends(
                across,
                radius,
                radius + growth * turns,
                max(tube, tube + swell * turns),
                growth**2 + pitch**2 - swell**2,
            ),
            "turns": turns,
            "radius": radius,
            "height": height,
            "tube": tube,
            "pitch": pitch,
            "radius_growth": growth,
            "tube_growth": swell,
            "pitch_radian": pitch / whole,
            "radius_radian": growth / whole,
            "tube_radian": swell / whole,
            "start": centres[0],
            "stop": centres[1],
            "split": height + pitch * turns / 2,
            "down": mp.mpf(int(pitch < 0)),
            **_plane([(*c, tube + swell * s) for c, s in zip(centres, (0, turns), strict=True)]),
        }
        return rounded(SWIRL, values)
