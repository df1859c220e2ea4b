# SPDX-License-Identifier: Apache-2.0
"""Hits among the layers of a pixel for the tests of the modules that keep them: structs, random hits, a plain model."""

import bench
from raydix.formats import COORD_WIDTH, DEPTH_WIDTH, SURFACE_WIDTH

ENTRY = bench.Struct(("opaque", 1), ("enters", 1), ("surface", SURFACE_WIDTH), ("depth", -DEPTH_WIDTH),
                     ("point", -COORD_WIDTH, 3))  # fmt: skip
LAYER = bench.Struct(("shade", 1), ("first", 1), ("last", 1), ("enters", 1), ("surface", SURFACE_WIDTH),
                     ("point", -COORD_WIDTH, 3))  # fmt: skip


def key(entry):
    """The order of layers; what is equal in it stays in the order in which it came."""
    return entry["depth"], entry["surface"]


def place(entries, hit, layers):
    """The list with the hit, at most ``layers`` long, nothing behind an opaque one; whether one had no room."""
    ordered = sorted([*entries, hit], key=key)  # stable: the hit is behind its equals
    walls = [number for number, entry in enumerate(ordered) if entry["opaque"]]
    seen = ordered[: walls[0] + 1] if walls else ordered
    return seen[:layers], len(seen) > layers


def depth(random):
    """Any depth, often one of a few that are equal or neighbours."""
    return random.choice((0, 1, 2, bench.high(DEPTH_WIDTH), random.getrandbits(random.randint(1, DEPTH_WIDTH - 1))))


def entry(random, surface=None, opaque=None):
    """A random hit."""
    return {
        "opaque": random.getrandbits(1) if opaque is None else int(opaque),
        "enters": random.getrandbits(1),
        "surface": random.getrandbits(SURFACE_WIDTH) if surface is None else surface,
        "depth": depth(random),
        "point": [bench.signed(random.getrandbits(COORD_WIDTH), COORD_WIDTH) for _ in range(3)],
    }


def listed(random, layers, most=None):
    """A random list of layers, as hits would leave it."""
    entries = []
    for _ in range(random.randint(0, most or layers)):
        entries, _ = place(entries, entry(random, opaque=random.random() < 0.2), layers)
    return entries


def padded(random, entries, layers):
    """Words of ``layers`` entries: those of the list, then noise."""
    return [ENTRY.pack(e) for e in entries] + [random.getrandbits(ENTRY.width) for _ in range(layers - len(entries))]


def meant(entries, layers):
    """Words of ``layers`` entries, None behind the list's end."""
    return [ENTRY.pack(e) for e in entries] + [None] * (layers - len(entries))
