# SPDX-License-Identifier: Apache-2.0
"""Spirals for the tests of vector sums: compiled scenes, and rays and items as the golden model has them."""

from pathlib import Path

from raydix.compile import compile_scene
from raydix.config import Config
from raydix.core import FORM_AT
from raydix.ends import ends
from raydix.fdiff import ROWS, next_pixel, next_row
from raydix.files import ROOT
from raydix.item import AGAIN, DONE, HIT, ROOTS, RUN, SIZE, STATUS
from raydix.kernel import words, zeros
from raydix.raster import LANES, header, load_lanes, roots_wanted, sample
from raydix.ring import enter, more, restart
from raydix.scene import load_scene
from raydix.step import new_work, step
from raydix.vecsum import new_lanes

MIXED, HELICES, COIL, NESTED = "mixed", "helices", "coil", "nested"  # of tb/scenes
HELIX = (
    ("spiral", 0),
    (HELICES, 0),
    (HELICES, 2),
    (COIL, 0),
)  # scene, surface: what the evaluator without General does
GENERAL = (("shell", 0), ("flat_spiral", 0), (MIXED, 0), (MIXED, 3), (HELICES, 0), (COIL, 1))  # and what the other does


def load(name, width, height):
    """A scene of ``tb/scenes`` or ``scenes`` at another size."""
    paths = (ROOT / folder / f"{name}.toml" for folder in ("tb/scenes", "scenes"))
    return load_scene(next(filter(Path.is_file, paths)), width, height)


def compiled(name, n1, width=16, height=12, rule="certified"):
    """Words of a scene with spirals and other surfaces of any kind."""
    return compile_scene(load(name, width, height), Config(n1=n1, steps=1, units=1, vecsum="general", rule=rule))


def surface(name, index, n1, rule="certified"):
    """One spiral, compiled."""
    return next(s for s in compiled(name, n1, rule=rule).surfaces if s.index == index)


def form(found):
    """The constants of a compiled spiral, for the kernels."""
    return words(found.words[FORM_AT:])


def rays(found):
    """(x, y, item, first) of each pixel: rule, box and roots in ``item``, ends and depths in ``first``."""
    descriptor = words(found.words)
    state, item, first = zeros(ROWS * LANES).reshape(ROWS, LANES), zeros(SIZE), zeros(SIZE)
    header(descriptor, item, first)
    item[ROOTS] = roots_wanted(descriptor)
    load_lanes(state, descriptor)
    x0, y0, x1, y1 = found.rect
    for y in range(y0, y1 + 1):
        for x in range(x0, x1 + 1):
            sample(state, first, zeros(9))
            yield x, y, item.copy(), first.copy()
            next_pixel(state)
        next_row(state)


def descent(item, first, constants, n1, steps, general, drop):
    """The item at the start of each of its steps."""
    work = new_work(n1, 1, drop)
    ends(first, new_lanes(2, drop), constants, general)
    enter(item, first, 1)
    while True:
        while item[STATUS] == RUN:
            yield item.copy()
            step(item, constants, work, n1, steps, 0, 1, general)
        if item[STATUS] == HIT and more(item):
            item[ROOTS] -= 1
            item[STATUS] = AGAIN
        if item[STATUS] in (HIT, DONE):
            return
        restart(item, first, 1)


def items(random, found, n1, steps, general, count, drop=0):
    """``count`` items at the start of steps of random rays."""
    choice = list(rays(found))
    constants = form(found)
    while True:
        _, _, item, first = random.choice(choice)
        for copy in descent(item.copy(), first.copy(), constants, n1, steps, general, drop):
            if not count:
                return
            count -= 1
            yield copy
