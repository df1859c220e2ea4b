# SPDX-License-Identifier: Apache-2.0
"""The gradient of spirals for shading: RTL equals the model in every bit; the model is near the definition.

Materials and points for the tests of its parts, too.
"""

import math
import os
import random
from typing import NamedTuple

import cocotb
import numpy as np
import pytest
from cocotb.triggers import FallingEdge

import bench
import latency
from raydix import formats, spiral
from raydix.compile import compile_scene
from raydix.compile_spiral import Oversize, needs_general
from raydix.compile_swirl import swirl_words
from raydix.config import Config
from raydix.cordic import gain
from raydix.core import FORM_AT
from raydix.files import ROOT
from raydix.kernel import words, zeros
from raydix.multiply import scaled
from raydix.scene import load_scene
from raydix.swirl import (
    GROWTH_DROP,
    HEIGHT,
    PITCH,
    RADIUS,
    RADIUS_GROWTH,
    SCALE,
    START_REACH,
    STOP_REACH,
    _polar,
    swirl,
    turn,
)  # fmt: skip
from test_vecsum import Form, beside, points, random_form

LOOSE = ("tube", "pitch_radian", "radius_radian", "tube_radian", "near", "bend", "start_reach", "stop_reach")
LOOSE += ("start", "stop", "split")
SCENES = ("spiral", "shell", "flat_spiral", "families")
MATERIAL = bench.Struct(("bank", 1), ("surface", formats.SURFACE_WIDTH))
WRITE = bench.Struct(("we", 1), ("material", MATERIAL.width), ("constant", 6), ("data", 32))


# ---------------------------------------------------------------- spirals, their constants


class Swirl(NamedTuple):
    """A compiled spiral and the constants of its gradient."""

    form: Form
    words: np.ndarray  # by formats.SWIRL_INDEX


def _swirl(form):
    return Swirl(form, words(swirl_words(form.surface, form.origin, form.unit)))


def scene_swirls():
    """Every spiral of the scenes."""
    for name in SCENES:
        scene = load_scene(ROOT / "scenes" / f"{name}.toml")
        for found in compile_scene(scene, Config(vecsum="general")).surfaces:
            surface = scene.surfaces[found.index]
            if surface.type == "spiral":
                yield _swirl(Form(surface, words(found.words[FORM_AT:]), found.origin, found.unit))


def random_swirl(dice, general, sizes=None):
    """A spiral of random sizes whose constants fit; unless ``general`` a helix."""
    while True:
        try:
            return _swirl(random_form(dice, general, sizes))
        except Oversize:
            continue


def loosen(dice, found, general):
    """Other constants than a spiral's, ends of their ranges among them, where none can make anything overflow."""
    for field in formats.SWIRL:
        for place in range(field.count) if field.name in LOOSE else ():
            width = field.width - (field.name == "tube")  # to which the growth is added
            any_bits = bench.signed(dice.getrandbits(width), width)
            word = dice.choice((bench.low(width), bench.high(width), any_bits, any_bits))
            found.words[formats.SWIRL_INDEX[field.name] + place] = word
    if not general:  # a helix has one radius
        found.words[STOP_REACH] = found.words[START_REACH]


def leg_at_its_end(dice, found, general, point):
    """Change a constant so that a leg of ``point`` is exactly the longest that does not count, or one ulp less or more.

    Returns whether that is possible: the constant fits, and the scale has such a length.
    """
    x, y, z = (int(v) >> (formats.COORD_FRAC - formats.SWIRL_FRAC) for v in point)
    rho, azimuth = _polar(x, y)
    place, _ = turn(rho, z, azimuth, found.words, general)
    ulp = 64 >> int(found.words[SCALE])
    length = dice.choice((-1, 1)) * ((1 << 17) - 1 + dice.choice((-1, 0, 0, 1))) * ulp
    if dice.random() < 0.5:
        grown = scaled(place, found.words[RADIUS_GROWTH], GROWTH_DROP) if general else 0
        index, word = RADIUS, rho - grown - length
    else:
        index, word = HEIGHT, z - scaled(place, found.words[PITCH], GROWTH_DROP) - length
    if ulp and abs(word) < 1 << (formats.SWIRL_WIDTH - 1):
        found.words[index] = word
        return True
    return False


def gradient(found, point, general):
    """The model's."""
    out = zeros(3)
    swirl(*point, found.words, int(general), out)
    return [int(v) for v in out]


# ---------------------------------------------------------------- inside of the simulator


async def write_constants(dut, random, materials):
    """All constants of the materials, in any order, among writes of other constants and of none."""
    orders = []
    for (bank, surface), found in materials.items():
        for number, word in enumerate(found.words):
            orders.append((1, bank, surface, formats.SWIRL_FIRST + number, int(word)))
        orders += [(0, bank, surface, random.randrange(64), random.getrandbits(32)) for _ in range(20)]
        orders += [(1, bank, surface, random.randrange(formats.SWIRL_FIRST), random.getrandbits(32)) for _ in range(20)]
    random.shuffle(orders)
    port = bench.Port(dut, "write_i", WRITE)
    for we, bank, surface, constant, data in orders:
        material = MATERIAL.pack({"bank": bank, "surface": surface})
        port.write({"we": we, "material": material, "constant": constant, "data": data})
        await FallingEdge(dut.clk_i)
    port.write({"we": 0, "material": 0, "constant": 0, "data": 0})


async def write_named(dut, spirals):
    """Some constants of materials, {(bank, surface): {name: word}}, and others among them, which must not count."""
    port = bench.Port(dut, "write_i", WRITE)
    for place, named in spirals.items():
        for name, word in named.items():
            constant = formats.SWIRL_FIRST + formats.SWIRL_INDEX[name]
            for number, data in ((constant, int(word)), (constant ^ 32, ~int(word))):
                port.write({"we": 1, "material": reading(place), "constant": number, "data": data})
                await FallingEdge(dut.clk_i)
    port.write({"we": 0, "material": 0, "constant": 0, "data": 0})


def reading(place):
    """The word of ``material_i``."""
    return MATERIAL.pack({"bank": place[0], "surface": place[1]})


@cocotb.test
async def equals_model(dut):
    """Every bit, SwirlLatency clocks later, with another spiral or bank in each clock; also after a reset."""
    dice, general, surfaces = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "Surfaces")
    await bench.start(dut)
    numbers = range(surfaces) if surfaces < 9 else (0, *dice.sample(range(1, surfaces - 1), 5), surfaces - 1)
    for turns in range(8):
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 1
        ready = [s for s in scene_swirls() if general or not needs_general(s.form.surface)] if turns == 0 else []
        dice.shuffle(ready)
        places = [(bank, surface) for bank in range(2) for surface in numbers]
        materials = {place: ready.pop() if ready else random_swirl(dice, general) for place in places}
        for found in materials.values():
            if turns and dice.random() < 0.4:
                loosen(dice, found, general)
            dut._log.info(f"{found.form.surface}")
        stimuli = []
        for place, found in materials.items():
            spot = points(dice, found.form, 1)[0]
            if turns and dice.random() < 0.7 and leg_at_its_end(dice, found, general, spot):
                stimuli += [(place, spot)] * 3
        await write_constants(dut, dice, materials)
        for place, found in materials.items():
            stimuli += [(place, point) for point in points(dice, found.form, 120)]
            stimuli += [(place, beside(dice, found.form)) for _ in range(120)]
        dice.shuffle(stimuli)
        spirals = iter([materials[place] for place, _ in stimuli])
        await bench.pipeline(
            dut,
            ({"material_i": reading(place), "point_i": point} for place, point in stimuli),
            lambda item, s=spirals: {"gradient_o": gradient(next(s), item["point_i"], general)},
            latency.SWIRL,
        )


PARAMETERS = [dict(General=g, Surfaces=n) for g, n in ((0, 1), (0, 5), (1, 1), (1, 64))]


@pytest.mark.parametrize("parameters", PARAMETERS, ids=bench.label)
def test_gradient(parameters):
    """The evaluator of helices, and that of every spiral, of one surface and of several."""
    bench.run(__name__, "rdx_swirl", parameters)


# ---------------------------------------------------------------- outside of the simulator


def on_surface(dice, found, count):
    """Points of the surface, as s2p30 and in the surface's unit: of the tube, of its ends, of the balls."""
    shape, form = found.form.surface, found.form
    numbers = np.random.default_rng(dice.getrandbits(32))
    kind = numbers.integers(0, 5, count)
    near_end = np.abs(numbers.normal(0, 0.02, count)) % shape.turns
    s = np.choose(kind, [numbers.uniform(0, shape.turns, count)] * 2 + [near_end, 0 * near_end, 0 * near_end])
    s = np.where(numbers.random(count) < 0.5, s, shape.turns - s)
    slope, turn = numbers.uniform(0, 2 * np.pi, count), 2 * np.pi * s
    section = np.stack([np.cos(slope) * np.cos(turn), np.cos(slope) * np.sin(turn), np.sin(slope)], axis=1)
    any_way = numbers.normal(size=(count, 3))
    any_way /= np.linalg.norm(any_way, axis=1, keepdims=True)
    ways = np.where((kind > 2)[:, None], any_way, section)
    place = spiral._centre(shape, s) + ways * spiral._radius(shape, s)[:, None]
    coordinates = np.rint((place - form.origin) / form.unit * (1 << formats.COORD_FRAC)).astype(np.int64)
    place = coordinates / (1 << formats.COORD_FRAC) * form.unit + form.origin
    on = np.abs(spiral.value(shape, place)) < 1e-7 * form.unit[0]
    return coordinates[on], place[on]


class Candidates(NamedTuple):
    """What a point may belong to, arrays (candidates, N); lengths in scaled coordinates."""

    gradient: np.ndarray  # (candidates, N, 3), unit length
    allowed: np.ndarray  # error of its direction
    doubtful: np.ndarray  # whether it is as near as the nearest, but for what the choice may be off


def _unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-300)


def candidates(found, place):
    """Both balls and every turn, with bounds that are derived here; scaled coordinates, without K.

    legs    16 roundings of the radius, and the constants, 2^-17; the azimuth, off by 2^-15 and by 16 roundings over the
            radius, in radians, times the rise of a radian; 17 digits of the largest radius. Over the distance from the
            centre, which is the radius where the point belongs to it
    side    legs times the rise of a radian, in the component around the axis, which is divided by rho
    turned  rho has 15 digits and multiplies twice, x and y have 16, the slope's constants 15
    short   each of two normalizations shifts by 7 places at most: of K^2 r 2^E rho the first leaves 22 digits, of that
            times rho the second leaves 26
    A vector that is off by q of its length is off in direction by sqrt(2 - 2 sqrt(1 - q^2)), from 1 on in any way.
    choice  powers: 2^-13 where the constants are scaled to 1; the turn's place by 2^-15; over twice the radius
    """
    shape, scale, gain_angle = found.form.surface, 1 / found.form.unit[0], float(gain(formats.SWIRL_ITERATIONS))
    parts = []
    for s in (0.0, shape.turns):
        s = np.full(len(place), s)
        ball = spiral._ball_gradient(shape, place, s)
        away, radius = np.linalg.norm(place - spiral._centre(shape, s), axis=-1), spiral._radius(shape, s)
        parts.append((away - radius, ball, radius, away))
    for m in range(-1, int(shape.turns) + 2):
        s = m + spiral._azimuth(place)
        _, across, along = spiral._offsets(shape, place, s)
        away, radius = np.hypot(across, along), np.abs(spiral._radius(shape, s)) + 1e-300
        within = (s > -1e-5) & (s < shape.turns + 1e-5)
        distance = np.where(within, away - radius, np.inf)
        parts.append((distance, spiral._disk_gradient(shape, place, s), radius, away))
    distance, exact, radius, away = (np.stack(part) for part in zip(*parts, strict=True))
    rho, radius = np.hypot(place[:, 0], place[:, 1]) * scale, radius * scale
    size = np.minimum(radius, away * scale) + 1e-300
    largest = scale * max(shape.r, shape.r + shape.r_growth * shape.turns)
    slant = math.hypot(shape.pitch, shape.R_growth) * scale / (2 * math.pi)
    up = 2.0 ** (float(found.words[SCALE]) - 1)
    legs = (2.0**-17 + (2.0**-15 + 2.0**-18 / rho) * slant) / size + 2.0**-15 * largest / size
    short = 3**0.5 * (2.0**-22 + 2.0**-26 / rho) / (gain_angle**2 * up * size * rho)
    part = legs * (1 + slant / rho) + 2.0**-15 * (1 + 2.5 / rho) + short
    allowed = np.where(part < 1, np.sqrt(2 - 2 * np.sqrt(1 - np.minimum(part, 1) ** 2)), 2.0)
    near = float(found.words[formats.SWIRL_INDEX["near"]]) / (1 << 17)
    power = 4 * math.pi * 2.0**-13 / near / up / gain_angle**2
    choice = (power + 2.0**-15 * (2 * math.pi * slant) ** 2) / (2 * radius) + 2.0**-18 + 2.0**-15 * slant
    doubtful = distance * scale <= (distance * scale).min(axis=0) + choice
    return Candidates(_unit(exact * found.form.unit), allowed, doubtful)


def directions(dice, found, count):
    """Errors of the model's directions at points of the surface: plain, and against the best of what is in doubt.

    Returns both, and what is allowed for the second.
    """
    coordinates, place = on_surface(dice, found, count)
    general = needs_general(found.form.surface)
    got = _unit(
        np.array([gradient(found, [int(v) for v in point], general) for point in coordinates], float).reshape(-1, 3)
    )
    exact = _unit(spiral.gradient(found.form.surface, place) * found.form.unit)
    possible = candidates(found, place)
    error = np.linalg.norm(possible.gradient - got, axis=-1)
    error = np.where(possible.doubtful, error, np.inf)
    best = np.argmin(error / possible.allowed, axis=0)[None]
    error = np.take_along_axis(error, best, 0)[0]
    return np.linalg.norm(got - exact, axis=-1), error, np.take_along_axis(possible.allowed, best, 0)[0]


@pytest.mark.parametrize("seed", [1, None], ids=["always", "drawn"])
def test_error(seed):
    """The direction is within its bound of the definition's; what a point is taken for is nearly always the same."""
    dice = random.Random(seed or int(os.environ.get("SEED") or 2))
    found = [*scene_swirls(), *(random_swirl(dice, number % 2) for number in range(40))]
    worst, plain, doubtful, seen, any_direction = [], [], [], [], []
    for each in found:
        error, chosen, allowed = directions(dice, each, 1500)
        if not len(chosen):
            continue  # all of it is inside of itself
        part = chosen / allowed
        number = int(np.argmax(part))
        assert part.max() <= 1, f"{each.form.surface}: {chosen[number]}, {part[number]} of the bound"
        worst.append(part.max())
        plain.append(error)
        any_direction.append(allowed >= 2)  # no two directions are farther apart
        doubtful.append(error > 2 * chosen)
        if 0.02 < each.form.surface.r / each.form.surface.R < 0.9:
            seen.append(chosen)
    nothing = np.mean(np.concatenate(any_direction))
    plain, seen, rate = np.concatenate(plain), np.concatenate(seen), np.mean(np.concatenate(doubtful))
    rms, median, most = np.sqrt(np.mean(seen**2)), np.median(seen), np.quantile(seen, 0.999)
    print(f"{plain.size} points, {max(worst):.2f} of the bound, {rate:.2g} chosen otherwise, {nothing:.2g} unbounded")
    print(f"{seen.size} of spirals neither thin nor near the axis: rms {rms:.2g}, median {median:.2g}, "
          f"99.9 % {most:.2g}, max {seen.max():.2g}")  # fmt: skip
    assert plain.size > 20_000 and len(worst) >= 30 and max(worst) > 1 / 4 and nothing < 1 / 8
    assert rate < 2.0**-7 and median < 2.0**-13
    if seed:  # of the spirals drawn some are thinner or nearer to the axis than these
        assert max(worst) > 1 / 3 and rate < 2.0**-9 and rms < 2.0**-12
