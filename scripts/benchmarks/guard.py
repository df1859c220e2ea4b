# SPDX-License-Identifier: Apache-2.0
"""Whether the golden model has lost against the alternatives since a baseline."""

import math
from collections.abc import Sequence

from .rows import RAYDIX, REFERENCE, Row

LOSS = 1.10  # a ratio to the baseline that is bad news


def standing(rows: Sequence[Row], scene: str) -> tuple[float, float]:
    """The golden model's time over that of each compiled alternative, geometric mean of a scene; and its spread."""
    others = [r for r in rows if r.scene == scene and r.method != RAYDIX and not r.program]
    own = next(r for r in rows if r.scene == scene and r.method == RAYDIX and r.variant == REFERENCE)
    return math.exp(sum(math.log(1 / r.ratio) for r in others) / len(others)), own.spread


def lost(rows: Sequence[Row], baseline: Sequence[dict]) -> list[str]:
    """Golden-model times, each to those of the alternatives in its turn, that are worse than the baseline's.

    They must be above the baseline's by more than a tenth and both spreads. Other people's programs do not count: they
    are not there on every machine.
    """
    before = [Row(**row) for row in baseline]
    known = {row.scene for row in before}
    found = []
    for scene in dict.fromkeys(row.scene for row in rows if row.scene in known):
        (now, noise), (then, its) = standing(rows, scene), standing(before, scene)
        if now > then * (LOSS + noise + its):
            found.append(f"{scene}: {now / then:.2f} times the baseline; allowed: {LOSS + noise + its:.2f}")
    return found
