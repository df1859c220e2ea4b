# SPDX-License-Identifier: Apache-2.0
"""The evaluator of spirals: RTL equals the model in every bit; the model is within its bound of the definition.

Forms and points for the tests of its parts, too.
"""

import math
import os
import random
from typing import NamedTuple

import cocotb
import mpmath as mp
import numpy as np
import pytest
from pydantic import ValidationError

import bench
import latency
from raydix import formats, spiral
from raydix.compile import compile_scene
from raydix.compile_spiral import Oversize, needs_general, spiral_words
from raydix.config import Config
from raydix.cordic import gain
from raydix.core import FORM_AT
from raydix.files import ROOT
from raydix.kernel import words
from raydix.scene import Spiral, load_scene
from raydix.vecsum import DROPS, evaluate, iterations, new_lanes
from test_cordic import bounds

SCENES = ("spiral", "shell", "flat_spiral")
MOST = (7 << (formats.COORD_FRAC - 2)) - 1  # largest coordinate of a point
LONG = {"r": 0.004, "pitch": 0.02, "turns": 100, "R_growth": 0.001}
ULP = 1 / (1 << formats.VECTOR_FRAC)  # of a length


# ---------------------------------------------------------------- forms and points


class Form(NamedTuple):
    """A compiled spiral."""

    surface: Spiral
    words: np.ndarray  # by formats.FORM_INDEX
    origin: tuple  # of the coordinates, and their unit, in the surface's
    unit: tuple


def scene_form(name):
    """The spiral of a scene."""
    scene = load_scene(ROOT / "scenes" / f"{name}.toml")
    found = compile_scene(scene, Config(vecsum="general")).surfaces[0]
    return Form(scene.surfaces[0], words(found.words[FORM_AT:]), found.origin, found.unit)


def random_sizes(random, general):
    """Sizes of a spiral, of both hands, thick and thin, long and short; they may be impossible."""
    sign = random.choice((-1, 1))
    sizes = {
        "r": random.choice((0.99, random.uniform(0.05, 0.6), 10 ** random.uniform(-3, 0))),
        "pitch": random.choice((0, sign * random.uniform(0.1, 1), sign * 10 ** random.uniform(-2, 1))),
        "turns": random.choice((1, random.uniform(1, 6), 10 ** random.uniform(0, 2))),
    }
    if general:
        sizes["turns"] = random.choice((sizes["turns"], sizes["turns"], random.uniform(0.05, 1)))
        grow = random.choice((0, random.uniform(-1, 1) / sizes["turns"], 10 ** random.uniform(-2, 1)))
        most, part = 0.89 * math.hypot(sizes["pitch"], grow), sizes["r"] / sizes["turns"]
        swell = random.choice((0, random.uniform(-1, 2) * part, -min(most, 0.99 * part), most))
        sizes |= {"R_growth": grow, "r_growth": swell}
    return sizes


def random_form(random, general, sizes=None):
    """A spiral of random sizes, or of those given, compiled for a random ray; unless ``general`` a helix."""
    while True:
        reach = 10 ** random.uniform(-1, 1)
        ray = [mp.matrix([random.uniform(-reach, reach) for _ in range(3)]) for _ in range(2)]
        h, e = ((point, mp.zeros(3, 1), mp.zeros(3, 1)) for point in ray)
        try:
            surface = Spiral(type="spiral", R=1, **(sizes or random_sizes(random, general)))
            _, found, origin, unit = spiral_words(surface, h, e, None, None, (False,) * 3, 1, 1, 3)
        except (ValidationError, Oversize):
            continue
        return Form(surface, words(found), origin, unit)


def forms(random, general, count):
    """The spirals of the scenes that the evaluator is made for, one of many turns, then ``count`` random ones."""
    found = [scene_form(name) for name in SCENES]
    yield from (form for form in found if general or not needs_general(form.surface))
    if general:
        yield random_form(random, general, LONG)
    for _ in range(count):
        yield random_form(random, general)


def coordinates(form, place):
    """Coordinates of a place in the surface's unit; brought into their range."""
    scaled = [(v - o) / u * (1 << formats.COORD_FRAC) for v, o, u in zip(place, form.origin, form.unit, strict=True)]
    return [max(-MOST, min(MOST, round(v))) for v in scaled]


def beside(random, form):
    """A point on the tube or an end's ball, or off by any part of its radius; half of them half a turn on in height."""
    shape, sign = form.surface, random.choice((-1, 1))
    s = random.choice((0, shape.turns, random.uniform(0, shape.turns), random.uniform(0, shape.turns)))
    off = 1 + random.choice((0, random.uniform(-1, 1), sign * 10 ** random.uniform(-9, 0)))
    size, slope = (shape.r + shape.r_growth * s) * off, random.uniform(0, 2 * math.pi)
    tilt = random.choice((0, 0, random.uniform(0, 2 * math.pi)))  # out of the half plane: of a ball
    x = shape.R + shape.R_growth * s + size * math.cos(slope) * math.cos(tilt)
    y, z = size * math.cos(slope) * math.sin(tilt), size * math.sin(slope) + shape.pitch * s
    turn, up = 2 * math.pi * s, random.choice((0, 0, sign * shape.pitch / 2))
    return coordinates(form, (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), z + up))


def a_point(random, form):
    """Anywhere in the range, near the surface, on the axis or near it, at the seam of the azimuth."""
    x, y, z = (random.randint(-MOST, MOST) for _ in range(3))
    few = [random.choice((0, 1, -1, bench.signed(random.getrandbits(31), random.randint(1, 31)))) for _ in range(2)]
    few = [max(-MOST, min(MOST, v)) for v in few]
    near = beside(random, form)
    return random.choice(([x, y, z], [*few, z], [*few, near[2]], [abs(near[0]), few[0], near[2]], near, near, near))


def points(random, form, count):
    """Corners of the range, both ends, then ``count`` random points."""
    corners = [[x * MOST, y * MOST, z * MOST] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    ends = [[int(v) for v in form.words[at : at + 3]] for at in (formats.FORM_INDEX[n] for n in ("start", "stop"))]
    return corners + ends + [a_point(random, form) for _ in range(count)]


async def with_forms(dut, all_forms, inputs, expect, clocks):
    """RTL and model for each form, without and with stalls; ``inputs`` and ``expect`` get the form, too."""
    await bench.start(dut)
    form_i = bench.Port(dut, "form_i", bench.FORM)
    for form in all_forms:
        dut._log.info(f"{form.surface}")
        await bench.noise(dut, "form_i")
        form_i.write(bench.form_fields(form.words))
        for stall in (0.0, 0.4):
            await bench.pipeline(dut, inputs(form), lambda item, f=form: expect(f, item), clocks, stall=stall)


# ---------------------------------------------------------------- inside of the simulator


def model(form, all_points, general, drop=0):
    """Indicator at points by the golden model; the radius, too."""
    count = len(all_points)
    lanes = new_lanes(count, drop)
    for lane, values in zip((lanes.x, lanes.y, lanes.z), zip(*all_points, strict=True), strict=True):
        lane[:] = words(values)
    evaluate(lanes, count, form.words, int(general))
    return lanes.value, lanes.rho


@cocotb.test
async def equals_model(dut):
    """Every bit of the indicator is the model's, vecsum_latency clocks in which en_i = 1 later."""
    dice, general, drop = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "VectorDrop")
    await with_forms(
        dut,
        forms(dice, general, 20),
        lambda form: ({"point_i": point} for point in points(dice, form, 100)),
        lambda form, item: {"value_o": int(model(form, [item["point_i"]], general, drop)[0][0])},
        latency.vecsum(drop),
    )


@cocotb.test
async def on_the_surface(dut):
    """Where the distance is 0 to the bit a point is inside, and what limits the indicator keeps that sign.

    No spiral has a guard above 0 there, so it is raised until it is in force.
    """
    dice, general, drop = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "VectorDrop")
    found, points_of = [], {}
    for form in forms(dice, general, 12):
        near = [beside(dice, form) for _ in range(300)]
        zero = [point for point, value in zip(near, model(form, near, general, drop)[0], strict=True) if value == 0]
        raised = form._replace(words=form.words.copy())
        raised.words[formats.FORM_INDEX["guard"]] = bench.high(formats.VECTOR_WIDTH)
        if zero:
            assert (model(raised, zero, general, drop)[0] < 0).all()
            found.append(raised)
            points_of[id(raised)] = zero
    assert sum(map(len, points_of.values())) >= 5
    await with_forms(
        dut,
        found,
        lambda form: ({"point_i": point} for point in points_of[id(form)]),
        lambda form, item: {"value_o": int(model(form, [item["point_i"]], general, drop)[0][0])},
        latency.vecsum(drop),
    )


INDICATORS = [dict(General=g, VectorDrop=d) for g, d in ((0, 0), (1, 0), (0, 12), (1, 8), (0, 4))]


@pytest.mark.parametrize("parameters", INDICATORS, ids=bench.label)
def test_indicator(parameters):
    """The evaluator of helices, and that of every spiral; with all digits, and fewer."""
    bench.run(__name__, "rdx_vecsum", parameters)


# ---------------------------------------------------------------- outside of the simulator


class Exact(NamedTuple):
    """The definition at points, arrays (N); lengths in ulp."""

    value: np.ndarray  # K^2 times the distance
    allowed: np.ndarray  # how far the model's may be off


def definition(form, all_points, rho, general, drop):
    """The distance by its definition, and a bound of the model's error, derived here.

    All in ulp of a length, 2^-33. ``step`` is 2^drop, the ulp of the CORDICs' lengths. Where digits are left away each
    floor takes up to a step: of x and y before the radius, which turns the azimuth, too, of the radius of the centre
    curve, of the height, of the tube's radius, of the three legs to the centre of a ball and of the ball's radius.
    place   the azimuth: what the CORDIC's angle is off, and its 28 digits; in units of 2^-28 turns, of 32 ulp times the
            length of a turn and the tube's growth in it
    radius  of the point: the CORDIC; of the centre curve: half an ulp of ``radius``, half an ulp of ``radius_growth``
            (an ulp is 8 here) in each turn, the floor of the product
    height  the same of ``height`` and ``pitch``
    tube    the length of both by the CORDIC, and the same for the tube's radius
    ball    half an ulp of each coordinate of the centre (an ulp is 8 here); the CORDIC for the length in the plane,
            whose gain is a little less than that of the azimuth's; the CORDIC for the length
    A helix's nearest turn is found by the height: half an ulp of ``turn_z`` makes 3.5 units of place, half an ulp of
    ``turn_offset`` and the floors of product and azimuth 2. So near to the middle of two turns the other may be taken.
    """
    shape, gain_angle = form.surface, float(gain(formats.ANGLE_ITERATIONS))
    gain_length = float(gain(formats.LENGTH_ITERATIONS))
    across = gain_angle / form.unit[0]
    place = np.array(all_points, float) / (1 << formats.COORD_FRAC) * form.unit + form.origin
    value = spiral.value(shape, place) * across * gain_length / ULP

    def product(growth):
        return (4 * shape.turns + 1) * (growth != 0)

    step = 1 << drop
    less = step if drop else 0  # what a floor takes at most
    around, _, along = iterations(drop)
    longest = np.abs(value) + (shape.r + max(0, shape.r_growth * shape.turns)) * across * gain_length / ULP
    length_error = bounds(longest / step, along)[0] * step
    radius_error, _, angle_error = bounds(np.asarray(rho, float) / step, around, drop)
    radius_error, angle_error = radius_error * step + 2 * gain_angle * less, angle_error * step
    turned = np.arcsin(np.minimum(1, 1.5 * gain_angle * less / np.maximum(rho, 1))) / (2 * np.pi)
    angle_error += turned * (1 << formats.ANGLE_WIDTH)
    units = 1 + angle_error / (1 << (formats.ANGLE_WIDTH - formats.TURN_FRAC))
    turn = (math.hypot(shape.pitch, shape.R_growth) + abs(shape.r_growth)) * across
    radius = radius_error + 0.5 + product(shape.R_growth) + less
    height = 0.5 + product(shape.pitch) + less
    moved = np.hypot(radius, height) + 32 * turn * units
    tube = gain_length * moved + length_error + 0.5 + product(shape.r_growth) + less
    plane = gain_length * math.hypot(4 + less, 4 + less) + length_error + longest * (gain_angle / gain_length - 1)
    ball = gain_length * np.hypot(plane, 4 + less) + length_error + 0.5 + less
    allowed = np.maximum(tube, ball)
    if shape.pitch and not general:
        azimuth = np.arctan2(place[:, 1], place[:, 0]) / (2 * np.pi)
        off_middle = np.abs((place[:, 2] / shape.pitch - azimuth) % 1 - 0.5) * (1 << formats.TURN_FRAC)
        allowed += (off_middle < 5.5 + units) * gain_length * 32 * turn * 2 * (5.5 + units)
    return Exact(value, allowed)


@pytest.mark.parametrize("drop", DROPS)
@pytest.mark.parametrize("general", [False, True], ids=["helices", "general"])
def test_error(general, drop):
    """Where no limit is active the indicator is within its bound of the distance; elsewhere its sign is the distance's.

    Wherever the bound leaves no doubt about the sign, and everywhere about the axis. The worst is 0.96 of the bound
    (8,000 random forms), where a long spiral multiplies what `pitch` is rounded by; 33 ulp in the three scenes.
    """
    dice = random.Random(int(os.environ.get("SEED") or 1))
    worst, count = [], 0
    for tried, form in enumerate(forms(dice, general, 400)):
        if tried >= 40 and max(worst) > 1 / 3:  # few seeds take more
            break
        everywhere = points(dice, form, 1000)
        got, rho = (np.asarray(v, float) for v in model(form, everywhere, general, drop))
        rho *= 1 << drop
        exact = definition(form, everywhere, rho, general, drop)
        guard = float(form.words[formats.FORM_INDEX["guard"]]) - 1.5 * rho
        free = (np.abs(got) < 0.75 * rho - (2 << drop)) & (np.abs(got) > guard + (2 << drop))
        parts = np.where(free, np.abs(got - exact.value) / exact.allowed, 0)
        sure = np.abs(exact.value) > exact.allowed
        wrong = np.where(sure, (got > 0) != (exact.value > 0), (guard > exact.allowed) & (got <= 0))
        number = int(np.argmax(np.where(wrong, np.inf, parts)))
        assert parts.max() <= 1 and not wrong.any(), (
            f"{form.surface}\n  point {everywhere[number]}: {got[number]}, exactly {exact.value[number]}, "
            f"allowed {exact.allowed[number]}, radius {rho[number]}"
        )
        worst.append(parts.max())
        count += int(free.sum())
    print(f"{count} points, {max(worst):.2f} of the bound")
    assert count > 10_000 and max(worst) > 1 / 3
