# SPDX-License-Identifier: Apache-2.0
"""The design points of the sweep: an engine with its parameters, and the scene that it is measured with."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path

from raydix.config import Config
from raydix.fit import families
from raydix.rtl import parameters
from raydix.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
SCENE_OF = {"quadric": "hyperboloid", "quartic": "torus", "spiral": "spiral"}
SIZE = 320, 240
# parameters of rdx_algebraic, and of rdx_vector by those of rdx_core
ALGEBRAIC = ("N1", "K", "W", "D", "U", "Rings", "Rules", "Clip")
VECTOR = {"N1": "N1", "K": "K", "U": "VectorUnits", "Rings": "VectorRings", "Rules": "Rules", "Lanes": "Lanes"}


@dataclass(frozen=True)
class Design:
    """An intersection engine: rays with their control points or ends go in, hits come out.

    family  "quadric", "quartic" or "spiral": what it is built for, and which scene it is measured with
    n1, steps, width, units, rings, lanes, rules   as in :class:`~raydix.config.Config`
    """

    family: str
    n1: int = 3
    steps: int = 8
    width: int = 36
    units: int = 1
    rings: int = 1
    lanes: int = 0  # of spirals
    rules: str = "certified"

    def __str__(self):
        lanes = f" L {self.lanes}" if self.lanes else f" W {self.width}"
        return f"n1 {self.n1} K {self.steps}{lanes} U {self.units} R {self.rings} {self.rules}"

    @cached_property
    def scene(self) -> Scene:
        """What it is measured with."""
        return load_scene(SCENES / f"{SCENE_OF[self.family]}.toml", *SIZE)

    @cached_property
    def config(self) -> Config:
        """Its parameters for the scene that it is measured with."""
        return self.config_for(self.scene)

    def config_for(self, scene: Scene) -> Config:
        """Its parameters as the golden model and the simulation take them, built for a scene of the family."""
        common = dict(n1=self.n1, steps=self.steps, rules=self.rules, surfaces=1, layers=1) | families(scene)
        common["rule"] = "paper" if self.rules == "paper" else "certified"
        if self.family == "spiral":
            return Config(lanes=self.lanes, units=1, vector_units=self.units, vector_rings=self.rings, **common)
        return Config(width=self.width, units=self.units, rings=self.rings, **common)

    @property
    def module(self) -> tuple[str, dict[str, int]]:
        """Name and parameters of the RTL module that is placed."""
        values = parameters(self.config)
        if self.family == "spiral":
            return "rdx_vector", {own: values[name] for own, name in VECTOR.items()} | {"General": 0}
        return "rdx_algebraic", {name: values[name] for name in ALGEBRAIC}

    def as_dict(self) -> dict:
        """The fields."""
        return asdict(self)


@dataclass(frozen=True)
class Sweep:
    """Values of a family that are combined with each other, ``n1`` with the K that gives the digits."""

    family: str
    n1: tuple[int, ...]
    digits: tuple[int, ...] = (24,)
    others: dict[str, tuple] = field(default_factory=dict)

    def designs(self) -> Iterator[Design]:
        """Every combination."""
        chosen = [{}]
        for name, values in self.others.items():
            chosen = [known | {name: value} for known in chosen for value in values]
        for n1 in self.n1:
            for digits in self.digits:
                for values in chosen:
                    yield Design(self.family, n1, digits // n1, **values)


# What is measured first stands first. A design that several name is measured once.
SWEEPS = (
    Sweep("quadric", (3, 1, 2, 4)),
    Sweep("quartic", (3, 1, 2, 4)),
    Sweep("quadric", (1,), others={"rings": (2, 4)}),
    Sweep("quadric", (1,), others={"units": (2, 4)}),
    Sweep("quadric", (2, 3), others={"rings": (2,)}),
    Sweep("quadric", (1, 2, 3, 4), others={"rules": ("paper", "both")}),
    Sweep("quadric", (1, 2, 3, 4), others={"width": (24, 30)}),
    Sweep("quadric", (1, 2, 4), digits=(12, 16)),
    Sweep("quartic", (1,), others={"rings": (2, 4)}),
    Sweep("quartic", (1, 3), others={"width": (28,)}),
    Sweep("quartic", (1, 3), others={"rules": ("paper",)}),
    Sweep("quadric", (2,), others={"rings": (4,)}),
    Sweep("quadric", (2,), others={"units": (2,)}),
    Sweep("quadric", (3,), others={"rings": (3,)}),
    Sweep("quartic", (3,), others={"rings": (2,)}),
    Sweep("spiral", (2,), others={"lanes": (1, 2)}),
    Sweep("spiral", (1, 3), others={"lanes": (1,)}),
)


def all_designs() -> list[Design]:
    """The whole sweep, each design once."""
    return list(dict.fromkeys(design for sweep in SWEEPS for design in sweep.designs()))
