# SPDX-License-Identifier: Apache-2.0
"""The turn of a spiral that is nearest to a point (mirrors ``rtl/rdx_turn.sv``)."""

from .formats import ANGLE_WIDTH, FORM_INDEX, TURN_FRAC, VECTOR_FRAC
from .kernel import kernel
from .multiply import scaled

TURNS = FORM_INDEX["turns"]
TURN_Z = FORM_INDEX["turn_z"]
TURN_RHO = FORM_INDEX["turn_rho"]
TURN_OFFSET = FORM_INDEX["turn_offset"]
SKEW_Z = FORM_INDEX["skew_z"]
SKEW_RHO = FORM_INDEX["skew_rho"]
SKEW_OFFSET = FORM_INDEX["skew_offset"]
SKEW_BACK = FORM_INDEX["skew_back"]

RHO_DROP = VECTOR_FRAC - 31  # radius: s5p33 to an operand s5p31
Z_UP = 1  # height: s2p30 to an operand s5p31
TURN_DROP = 31 + 26 - TURN_FRAC  # s5p31 times s10p26 to turns


@kernel
def nearest(rho, z, angle, form, second, general):
    """Place on the centre curve, in turns (s8p28), of the turn nearest to a point; -1: none passes its azimuth.

    rho     K times the distance from the axis, s5p33
    z       K times the height, s2p30
    angle   azimuth, u0p32
    second  0 or 1: which of the two turns about the place where the distance is least (``general`` only)
    Without ``general`` neither radius grows, and the nearest turn is the one nearest in height.
    Source: docs/spirals.md, "The nearest turn".
    """
    azimuth = angle >> (ANGLE_WIDTH - TURN_FRAC)
    height = z << Z_UP
    at = scaled(height, form[TURN_Z], TURN_DROP) + form[TURN_OFFSET] - azimuth
    if general:
        radius = rho >> RHO_DROP
        at += scaled(radius, form[TURN_RHO], TURN_DROP)
        skew = scaled(height, form[SKEW_Z], TURN_DROP) + scaled(radius, form[SKEW_RHO], TURN_DROP)
        skew = abs(skew + form[SKEW_OFFSET])
        at += -skew if form[SKEW_BACK] else skew
        turn = (at >> TURN_FRAC) + second
    else:
        turn = (at + (1 << (TURN_FRAC - 1))) >> TURN_FRAC
    last = (form[TURNS] - azimuth) >> TURN_FRAC  # of the turns at this azimuth; -1: there is none
    turn = max(min(turn, last), 0)
    return -1 if last < 0 else (turn << TURN_FRAC) + azimuth
