# SPDX-License-Identifier: Apache-2.0
"""Whether the golden model has lost against the alternatives since a baseline."""

import math
from collections.abc import Sequence

from .rows import RAYDIX, REFERENCE, Row

LOSS = 1.10  # a ratio to the baseline that is bad news


def standing(rows: Sequence[Row]) -> tuple[float, float]:
    """The golden model's time over that of each compiled alternative, geometric mean; and its spread."""
    others = [r for r in rows if r.method != RAYDIX]
    own = next(r for r in rows if r.method == RAYDIX and r.variant == REFERENCE)
    return math.exp(sum(math.log(1 / r.ratio) for r in others) / len(others)), own.spread


def comparable(rows: Sequence[Row], before: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """Of one scene, the rows of both that have the same method, variant and number of pixels; no programs of others.

    Those are not there on every machine.
    """
    mine, its = ({(r.method, r.variant, r.pixels): r for r in some if not r.program} for some in (rows, before))
    both = [key for key in mine if key in its]
    return [mine[key] for key in both], [its[key] for key in both]


def lost(rows: Sequence[Row], before: Sequence[Row]) -> list[str]:
    """Golden-model times, each to those of the alternatives in its turn, that are worse than the baseline's.

    They must be above the baseline's by more than a tenth and both spreads. A scene that cannot be compared is told.
    """
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        now, then = comparable([r for r in rows if r.scene == scene], [r for r in before if r.scene == scene])
        if len({r.method for r in now}) < 2 or not any(r.variant == REFERENCE for r in now):
            found.append(f"{scene}: found nothing to compare with; allowed: scenes and sizes of the baseline")
            continue
        (mean, noise), (its, other) = standing(now), standing(then)
        if mean > its * (LOSS + noise + other):
            found.append(f"{scene}: {mean / its:.2f} times the baseline; allowed: {LOSS + noise + other:.2f}")
    return found
