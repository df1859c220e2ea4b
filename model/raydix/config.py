# SPDX-License-Identifier: Apache-2.0
"""The hardware parameters and run-time choices of one Raydix."""

from dataclasses import dataclass, replace

RULES = ("certified", "paper")


class ConfigError(ValueError):
    """A parameter outside what the hardware can be built with."""


@dataclass(frozen=True)
class Config:
    """Parameters of the RTL (`n1, steps, width, degree, units, rules`) and the run-time `rule`.

    n1     binary digits fixed per step, 1 to 4 (J = 2**n1 cells)
    steps  K, steps to a hit; n = n1*K <= 32 digits of t
    width  W, bits of a control point, 16 to 48
    degree D, 4 (quartics too) or 2 (quadrics only)
    units  U, step units in the ring, 1 to K
    rules  selection rules built in: "certified", "paper" or "both"
    rule   the rule used for this frame

    Raises :class:`ConfigError` with the parameter, what was found and what is allowed.
    """

    n1: int = 3
    steps: int = 8
    width: int = 36
    degree: int = 4
    units: int = 8
    rules: str = "both"
    rule: str = "certified"

    def __post_init__(self):
        def check(ok, name, allowed):
            if not ok:
                raise ConfigError(f"{name}: found {getattr(self, name)!r}; allowed: {allowed}")

        for name in ("n1", "steps", "width", "degree", "units"):
            check(isinstance(getattr(self, name), int), name, "an integer")
        check(1 <= self.n1 <= 4, "n1", "1 to 4")
        check(1 <= self.steps <= 32 // self.n1, "steps", f"1 to {32 // self.n1} (n1*steps is at most 32)")
        check(16 <= self.width <= 48, "width", "16 to 48")
        check(self.degree in (2, 4), "degree", "2 (quadrics) or 4 (quartics too)")
        check(1 <= self.units <= self.steps, "units", f"1 to {self.steps} (the number of steps)")
        check(self.rules in (*RULES, "both"), "rules", "certified, paper or both")
        check(self.rule in RULES, "rule", "certified or paper")
        check(self.rules in ("both", self.rule), "rule", f"{self.rules} (the rules built in)")

    @property
    def digits(self) -> int:
        """n, the binary digits of t."""
        return self.n1 * self.steps

    @property
    def cells(self) -> int:
        """J, the cells of a step."""
        return 1 << self.n1

    def with_(self, **changes) -> "Config":
        """A copy with other values."""
        return replace(self, **changes)
