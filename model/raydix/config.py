# SPDX-License-Identifier: Apache-2.0
"""The hardware parameters and run-time choices of one Raydix."""

from dataclasses import dataclass, replace

RULES = ("certified", "paper")
VECSUMS = ("none", "helix", "general")


class ConfigError(ValueError):
    """A parameter outside what the hardware can be built with."""


@dataclass(frozen=True)
class Config:
    """Parameters of the RTL and the run-time `rule`.

    n1     binary digits fixed per step, 1 to 4 (J = 2**n1 cells)
    steps  K, steps to a hit; n = n1*K <= 32 digits of t
    width  W, bits of a control point, 16 to 48
    degree D, 4 (quartics too), 2 (quadrics only) or 0 (no algebraic surfaces)
    units  U, step units in each algebraic ring, 1 to K
    rings  algebraic rings side by side; rings*units is at most 32
    rules  selection rules built in: "certified", "paper" or "both"
    rule   the rule used for this frame
    vecsum  evaluators of vector-sum surfaces: "none", "helix" (spirals of one turn at least whose radii do not grow)
           or "general" (every spiral)
    lanes  evaluators in a step unit of the vector-sum ring, 1 to J-1; they share the J-1 new boundaries of a step
    vector_units  step units in each vector-sum ring, 1 to K
    vector_rings  vector-sum rings side by side; vector_rings*vector_units is at most 32
    vector_drop   binary digits that the vector-sum evaluators leave away, 0, 4, 8 or 12: smaller, for fewer digits of t
    clip   whether boxes can cut algebraic surfaces
    halve_stages  clocks in which a cell is halved, 0 to 4: fewer take fewer registers and a slower clock, and change no
           value; two rows of averages a clock if not given
    surfaces  of the processor: descriptors, and surface numbers, 1 to 64
    layers    hits of a pixel that it keeps, 1 to 8
    max_width  pixels of its longest line, a multiple of `beat`, up to 4,096
    beat      pixels in a beat of its pixel stream: 1, 2 or 4
    k_stop    steps to a hit for this frame, 1 to K: fewer where fewer digits of t are wanted; K if not given

    Raises :class:`ConfigError` with the parameter, what was found and what is allowed.
    """

    n1: int = 3
    steps: int = 8
    width: int = 36
    degree: int = 4
    units: int = 8
    rules: str = "both"
    rule: str = "certified"
    vecsum: str = "none"
    lanes: int = None  # type: ignore[assignment]  # J-1 once it is made
    vector_units: int = 1
    rings: int = 1
    vector_rings: int = 1
    vector_drop: int = 0
    clip: bool = True
    halve_stages: int = None  # type: ignore[assignment]  # (degree + 1) // 2 once it is made
    surfaces: int = 64
    layers: int = 4
    max_width: int = 1920
    beat: int = 1
    k_stop: int = None  # type: ignore[assignment]  # K once it is made

    def __post_init__(self):
        def check(ok, name, allowed):
            if not ok:
                raise ConfigError(f"{name}: found {getattr(self, name)!r}; allowed: {allowed}")

        integers = (
            "n1",
            "steps",
            "width",
            "degree",
            "units",
            "vector_units",
            "rings",
            "vector_rings",
            "vector_drop",
            "surfaces",
            "layers",
            "max_width",
            "beat",
        )
        for name in integers:
            check(isinstance(getattr(self, name), int), name, "an integer")
        check(1 <= self.n1 <= 4, "n1", "1 to 4")
        check(self.lanes is None or isinstance(self.lanes, int), "lanes", "an integer")
        if self.lanes is None:
            object.__setattr__(self, "lanes", self.cells - 1)
        check(1 <= self.steps <= 32 // self.n1, "steps", f"1 to {32 // self.n1} (n1*steps is at most 32)")
        check(16 <= self.width <= 48, "width", "16 to 48")
        check(isinstance(self.clip, bool), "clip", "True or False")
        check(self.degree in (0, 2, 4), "degree", "4 (quartics too), 2 (quadrics) or 0 (no algebraic surfaces)")
        if self.halve_stages is None:
            object.__setattr__(self, "halve_stages", (self.degree + 1) // 2)
        check(isinstance(self.halve_stages, int) and 0 <= self.halve_stages <= 4, "halve_stages", "0 to 4")
        check(self.vecsum in VECSUMS, "vecsum", "none, helix or general")
        check(self.degree or self.vecsum != "none", "degree", "2 or 4 unless vecsum is helix or general")
        check(1 <= self.lanes < self.cells, "lanes", f"1 to {self.cells - 1} (J - 1)")
        for name in ("units", "vector_units"):
            check(1 <= getattr(self, name) <= self.steps, name, f"1 to {self.steps} (the number of steps)")
        for name, units in (("rings", self.units), ("vector_rings", self.vector_units)):
            check(1 <= getattr(self, name) <= 32 // units, name, f"1 to {32 // units} (32 step units in all)")
        check(self.vector_drop in (0, 4, 8, 12), "vector_drop", "0, 4, 8 or 12")
        check(1 <= self.surfaces <= 64, "surfaces", "1 to 64")
        check(1 <= self.layers <= 8, "layers", "1 to 8")
        check(self.beat in (1, 2, 4), "beat", "1, 2 or 4")
        check(self.beat <= self.max_width <= 4096, "max_width", f"{self.beat} to 4096")
        check(self.max_width % self.beat == 0, "max_width", f"a multiple of {self.beat} (the pixels of a beat)")
        if self.k_stop is None:
            object.__setattr__(self, "k_stop", self.steps)
        check(isinstance(self.k_stop, int) and 1 <= self.k_stop <= self.steps, "k_stop", f"1 to {self.steps} (K)")
        check(self.rules in (*RULES, "both"), "rules", "certified, paper or both")
        check(self.rule in RULES, "rule", "certified or paper")
        check(self.rules in ("both", self.rule), "rule", f"{self.rules} (the rules built in)")

    @property
    def digits(self) -> int:
        """The binary digits of t: n, or fewer where `k_stop` is below K."""
        return self.n1 * self.k_stop

    @property
    def cells(self) -> int:
        """J, the cells of a step."""
        return 1 << self.n1

    def with_(self, **changes) -> "Config":
        """A copy with other values; with another `n1` all lanes, with other `steps` all of them, with another
        `degree` its clocks of a halving, unless given."""
        if "n1" in changes:
            changes = {"lanes": None, **changes}
        if "degree" in changes:
            changes = {"halve_stages": None, **changes}
        if "steps" in changes:
            changes = {"k_stop": None, **changes}
        return replace(self, **changes)
