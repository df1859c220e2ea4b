# SPDX-License-Identifier: Apache-2.0
"""Which signals of the RTL are fixed-point numbers: by the name of the last part of their path, and their width."""

import re
from typing import NamedTuple

from raydix.formats import (
    ANGLE_WIDTH,
    COORD_ACC_WIDTH,
    COORD_FRAC,
    COORD_WIDTH,
    DEPTH_WIDTH,
    LIMIT_WIDTH,
    NORMAL_WIDTH,
    TURN_FRAC,
    TURN_WIDTH,
    UNIT_FRAC,
    VECTOR_FRAC,
    VECTOR_WIDTH,
)


class Number(NamedTuple):
    """How the bits of a signal are read: signed or not, and how many are behind the point."""

    signed: bool
    fraction: int

    def value(self, bits: int, width: int) -> float:
        """What ``width`` bits stand for."""
        if self.signed and bits >> (width - 1):
            bits -= 1 << width
        return bits / (1 << self.fraction)


class Form(NamedTuple):
    """A row of the table below.

    name      the whole of the signal's last part, without index and register suffix
    width     bits; None: any
    fraction  bits behind the point, or what is subtracted from the width for it if that is negative or 0
    """

    name: str
    width: int | None
    signed: bool
    fraction: int

    def number(self, width: int) -> Number:
        """For a signal of ``width`` bits."""
        return Number(self.signed, self.fraction if self.fraction > 0 else width + self.fraction)


# The first that fits counts. docs/number-formats.md has the formats.
FORMS = (
    Form(r"t|t_min|t_next|digits?", None, False, 0),  # part of the segment, from 0 to 1
    Form(r"(points?|coords?|low|high|start|stop|end|ends|h|e|x|y|z|middle|origin)\w*", COORD_WIDTH, True, COORD_FRAC),
    Form(r"b|points|chosen", None, True, -2),  # control points, as part of what W bits can hold
    Form(r"(near_|far_)?depth(_\w+)?", DEPTH_WIDTH, True, DEPTH_WIDTH - 1),
    Form(r"limit", LIMIT_WIDTH, False, LIMIT_WIDTH),
    Form(r"(azimuth|angle)\w*", ANGLE_WIDTH, False, ANGLE_WIDTH),
    Form(r"(turn|place)\w*", TURN_WIDTH, True, TURN_FRAC),
    Form(r"\w+", VECTOR_WIDTH, True, VECTOR_FRAC),
    Form(r"(coords?|accumulator|value)\w*", COORD_ACC_WIDTH, True, COORD_ACC_WIDTH - 2),
    Form(r"(linear|opacity|ambient|cosine|through|red|green|blue|total|color)\w*", UNIT_FRAC + 1, False, UNIT_FRAC),
    Form(r"(normal|gradient)\w*", NORMAL_WIDTH, True, NORMAL_WIDTH - 1),
)


def number_of(name: str, width: int) -> Number | None:
    """How a signal is read; None where it is no fixed-point number. ``name``: with or without indices."""
    plain = re.sub(r"\[\d+\]", "", name).rpartition(".")[2]
    plain = re.sub(r"_(i|o|q+)$", "", plain)
    fitting = (f for f in FORMS if f.width in (None, width) and re.fullmatch(f.name, plain))
    form = next(fitting, None) if width > 8 else None
    return form and form.number(width)
