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

import bench
import latency
from cocotb.triggers import FallingEdge
from raydix import formats, spiral
from raydix.compile import compile_scene
from raydix.compile_spiral import Oversize, needs_general
from raydix.compile_swirl import swirl_words
from raydix.config import Config
from raydix.core import FORM_AT
from raydix.cordic import gain
from raydix.kernel import words, zeros
from raydix.rtl import ROOT
from raydix.scene import load_scene
from raydix.swirl import swirl
from test_vecsum import Form, beside, points, random_form

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


def reading(place):
    """The word of ``material_i``."""
    return MATERIAL.pack({"bank": place[0], "surface": place[1]})


@cocotb.test
async def equals_model(dut):
    """Every bit, SwirlLatency clocks later, with another spiral or bank in each clock."""
    dice, general, surfaces = bench.rng(), bench.parameter(dut, "General"), bench.parameter(dut, "Surfaces")
    await bench.start(dut)
    for turn in range(6):
        ready = [s for s in scene_swirls() if general or not needs_general(s.form.surface)] if turn == 0 else []
        dice.shuffle(ready)
        places = [(bank, surface) for bank in range(2) for surface in range(surfaces)]
        materials = {place: ready.pop() if ready else random_swirl(dice, general) for place in places}
        for found in materials.values():
            dut._log.info(f"{found.form.surface}")
        await write_constants(dut, dice, materials)
        stimuli = []
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


PARAMETERS = [dict(General=g, Surfaces=n) for g, n in ((0, 1), (0, 5), (1, 1), (1, 8))]


@pytest.mark.parametrize("parameters", PARAMETERS, ids=bench.label)
def test_gradient(parameters):
    """The evaluator of helices, and that of every spiral, of one surface and of several."""
    bench.run(__name__, "rdx_swirl", parameters)
