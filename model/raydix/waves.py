# SPDX-License-Identifier: Apache-2.0
"""Reads waveforms of the RTL: what is in one, and what a step unit gave back."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vcd.reader import TokenKind, VarDecl, tokenize

from .item import RUN
from .trace_ray import NAMES

STEP = re.compile(r"(.*u_ring\.gen_unit\[\d+\]\.u_step)\.((?:control|segment)_[io]\..*)")  # step unit, signal


@dataclass
class Output:
    """What left the step unit after a step; fields as those of :class:`~raydix.trace_ray.Step`.

    control   control points that entered it, empty where they were not seen
    """

    number: int
    control: list[int]
    t: int
    next_t: int
    status: str
    after: list[int]
    depth: int


def signed(value: int, width: int) -> int:
    """Two's complement."""
    return value - (1 << width) if value >> (width - 1) else value


def variables(wave: Path) -> Iterator[tuple[tuple[str, ...], VarDecl]]:
    """Scopes and declaration of every variable of a waveform (VCD). Raises OSError, VCDParseError, IndexError."""
    scopes: list[str] = []
    with wave.open("rb") as file:
        for token in tokenize(file):
            if token.kind is TokenKind.SCOPE:
                scopes.append(token.scope.ident)
            elif token.kind is TokenKind.UPSCOPE:
                scopes.pop()
            elif token.kind is TokenKind.VAR:
                yield tuple(scopes), token.var
            elif token.kind is TokenKind.ENDDEFINITIONS:
                return


def step_outputs(wave: Path) -> list[Output]:
    """Every step of the only ray of a simulation, from a waveform (VCD), whichever step unit has taken it.

    In the order of their numbers, which may have gaps where the design is wrong.

    Raises ValueError where the waveform has no step unit.
    """
    names: dict[str, list[tuple[str, str, int]]] = {}  # code: step units' signals, with widths
    for scopes, declared in variables(wave):
        if match := STEP.fullmatch(".".join([*scopes, declared.reference])):
            names.setdefault(declared.id_code, []).append((match[1], match[2], declared.size))
    if not names:
        raise ValueError(f"{wave}: found no step unit; allowed: a waveform of rdx_core or rdx_top")
    units: dict[str, dict[str, int]] = {unit: {} for ports in names.values() for unit, _, _ in ports}
    found: list[Output] = []
    entered: list[int] = []  # control points of the step that is being taken
    with wave.open("rb") as file:
        for token in tokenize(file):
            if token.kind is TokenKind.CHANGE_TIME:
                _look(units, found, entered)
            elif token.kind in (TokenKind.CHANGE_SCALAR, TokenKind.CHANGE_VECTOR):
                scalar = token.kind is TokenKind.CHANGE_SCALAR
                change = token.scalar_change if scalar else token.vector_change
                for unit, signal, width in names.get(change.id_code, ()):
                    value = int(change.value) if str(change.value) in "01" or isinstance(change.value, int) else 0
                    units[unit][signal] = signed(value, width) if signal.startswith("segment_") else value
    _look(units, found, entered)
    return found


def _look(units: dict[str, dict[str, int]], found: list[Output], entered: list[int]) -> None:
    """Note the item at the output of a unit where it has taken more steps than the last that was noted.

    ``entered`` takes the control points of the item that has taken no more and enters a unit.
    """
    taken = found[-1].number if found else 0
    for values in units.values():
        status, number = values.get("control_o.status", 0), values.get("control_o.steps", 0)
        if status in NAMES and number > taken:
            taken = number
            found.append(
                Output(
                    number,
                    [*entered],
                    values["control_o.t"],
                    values["control_o.t_next"] if values["control_o.pending"] else -1,
                    NAMES[status],
                    _points(values, "segment_o.b["),
                    values["segment_o.ends.depth_start"],
                )
            )
            entered.clear()
    for values in units.values():
        if values.get("control_i.status") == RUN and values.get("control_i.steps") == taken:
            entered[:] = _points(values, "segment_i.b[")


def _points(values: dict[str, int], name: str) -> list[int]:
    """Elements of an array of up to ten, in order."""
    return [value for signal, value in sorted(values.items()) if signal.startswith(name)]
