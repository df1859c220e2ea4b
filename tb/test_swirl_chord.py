# SPDX-License-Identifier: Apache-2.0
"""sin^2(pi v)/v: RTL equals the model in every bit; the model is within its bound."""

import math

import cocotb

import bench
import latency
from raydix.formats import SWIRL_CHORDS, SWIRL_FRAC
from raydix.swirl import chord

LARGEST = (1 << (SWIRL_FRAC - 1)) - 1
STEP = (LARGEST + 1) // SWIRL_CHORDS


@cocotb.test
async def equals_model(dut):
    """Both ends of every interval, and anywhere."""
    random = bench.rng()
    places = [i * STEP + k for i in range(SWIRL_CHORDS) for k in (0, 1, STEP - 1)]
    places += [random.randint(0, LARGEST) for _ in range(3000)]
    await bench.start(dut)
    items = ({"turns_i": place} for place in places)
    await bench.pipeline(dut, items, lambda item: {"chord_o": chord(item["turns_i"])}, latency.SWIRL_CHORD)


def test_chord():
    """The whole range."""
    bench.run(__name__, "rdx_swirl_chord")


def test_error():
    """At most 2^-11.5 off, and 2^-13 at small angles, where the chord itself is small."""
    errors = []
    for place in range(0, LARGEST + 1, 97):
        v = place / (1 << SWIRL_FRAC)
        errors.append(abs(chord(place) / (1 << 15) - (math.sin(math.pi * v) ** 2 / v if v else 0)))
    print(f"largest error {max(errors):.3g}")
    assert 2**-13 < max(errors) < 2**-11.5
    assert max(errors[: len(errors) // 8]) < 2**-13
