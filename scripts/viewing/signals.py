# SPDX-License-Identifier: Apache-2.0
"""Signals of a waveform (VCD) in groups: a module's clock, inputs, outputs, stages, then what stands in it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vcd.reader import TokenKind, VarDecl, VCDParseError, tokenize

from raydix.waves import variables

from .formats import Number, number_of

INSTANCE = re.compile(r"u_\w+|gen_\w+(\[\d+\])?|rdx_\w+|\$rootio|TOP")  # scopes that are none of a struct or an array


@dataclass(frozen=True)
class Signal:
    """A variable of the waveform.

    scopes    all scopes around it, as in the file
    name      with indices
    ranged    declared with a range, as [0:0]
    inside    how many of ``scopes`` are instances of modules or generate blocks; the others are those of its struct
    code      by which its changes are marked
    """

    scopes: tuple[str, ...]
    name: str
    width: int
    code: str
    ranged: bool
    inside: int

    @property
    def path(self) -> str:
        """Full name as the viewers write it."""
        return ".".join([*self.scopes, self.name])

    @property
    def short(self) -> str:
        """Name within its module: members of structs with a point, no array twice."""
        parts = [*self.scopes[self.inside :], self.name]
        return ".".join(p for i, p in enumerate(parts) if i == len(parts) - 1 or not parts[i + 1].startswith(f"{p}["))

    @property
    def root(self) -> str:
        """Name in the source, without members and indices."""
        return re.split(r"[.\[]", self.short)[0]

    @property
    def number(self) -> Number | None:
        """How it is read if it is a fixed-point number."""
        return number_of(self.short, self.width)


@dataclass
class Group:
    """Signals that belong together; ``inner``: groups of the modules within."""

    name: str
    signals: list[Signal] = field(default_factory=list)
    inner: list["Group"] = field(default_factory=list)

    def flat(self) -> Iterator[Signal]:
        """All signals, those of the inner groups too."""
        yield from self.signals
        for group in self.inner:
            yield from group.flat()


def read_signals(wave: Path) -> list[Signal]:
    """All variables of a VCD file. Raises OSError, and ValueError where there is none."""
    try:
        found = [_signal(*variable) for variable in variables(wave)]
    except (VCDParseError, IndexError) as error:
        raise ValueError(f"found no waveform; allowed: a VCD file ({error})") from None
    if not found:
        raise ValueError("found no signals; allowed: a waveform (VCD)")
    return found


def _signal(scopes: tuple[str, ...], declared: VarDecl) -> Signal:
    inside = 0
    while inside < len(scopes) and INSTANCE.fullmatch(scopes[inside]):
        inside += 1
    index = declared.bit_index  # of an array of bits; a vector has two
    name = declared.reference + (f"[{index}]" if isinstance(index, int) else "")
    return Signal(scopes, name, declared.size, declared.id_code, isinstance(index, tuple), inside)


def stage_of(root: str) -> str:
    """The group of a signal by the suffix of its name: docs/architecture.md, "Names"."""
    if root in ("clk_i", "rst_ni"):
        return "clock"
    suffix = re.search(r"_(i|o|q+)$", root)
    if not suffix:
        return "between registers"
    return {"i": "inputs", "o": "outputs"}.get(suffix[1], f"stage {len(suffix[1])}")


def groups_of(signals: list[Signal], depth: int = 2) -> list[Group]:
    """A group for each stage of the module that is simulated, then one for each module in it, down to ``depth``.

    A module within shows its inputs and outputs; what is deeper is left to the viewer. None without a clock.
    """
    clocked = [s for s in signals if s.root == "clk_i" and s.scopes != ("$rootio",)]
    if not clocked:
        return []
    top = clocked[0].scopes
    within = [s for s in signals if s.scopes[: len(top)] == top and s.root[:1].islower()]  # parameters begin large
    order = ["clock", "inputs", "outputs", "stage 1", "stage 2", "stage 3", "stage 4", "between registers"]
    own: dict[str, Group] = {name: Group(name) for name in order}
    modules: dict[tuple[str, ...], Group] = {}
    for signal in within:
        place = signal.scopes[len(top) : signal.inside]
        if not place:
            own.setdefault(stage_of(signal.root), Group(stage_of(signal.root))).signals.append(signal)
        elif len(place) <= depth and stage_of(signal.root) in ("inputs", "outputs"):
            modules.setdefault(place, Group(".".join(place))).signals.append(signal)
    for group in own.values():
        group.signals.sort(key=lambda s: s.root)  # members and elements stay as they are
    return [group for group in [*own.values(), *modules.values()] if group.signals]


def changes(wave: Path, codes: set[str], until: int) -> Iterator[tuple[int, str, str]]:
    """(time, code, bits) of the signals ``codes``, in order, up to a time in the file's unit; x and z count as 0."""
    time = 0
    with wave.open("rb") as file:
        for token in tokenize(file):
            if token.kind is TokenKind.CHANGE_TIME:
                time = token.time_change
                if time > until:
                    return
            elif token.kind in (TokenKind.CHANGE_SCALAR, TokenKind.CHANGE_VECTOR) and token.data.id_code in codes:
                value = token.data.value
                yield time, token.data.id_code, value if isinstance(value, int) else int(str(value) == "1")
