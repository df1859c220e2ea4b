# SPDX-License-Identifier: Apache-2.0
"""Reads waveforms of the RTL: what is in one, and what a step unit gave back."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vcd.reader import TokenKind, VarDecl, tokenize

from .trace_ray import NAMES

STEP = re.compile(r"(.*u_ring\.gen_unit\[\d+\]\.u_step)\.((?:control|segment)_o\..*)")  # step unit, signal


@dataclass
class Output:
    """What left the step unit after a step; fields as those of :class:`~raydix.trace_ray.Step`."""

    number: int
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

    Raises ValueError where the waveform has no step unit.
    """
    names: dict[str, tuple[str, str, int]] = {}  # code: step unit, its signal, width
    for scopes, declared in variables(wave):
        if match := STEP.fullmatch(".".join([*scopes, declared.reference])):
            names[declared.id_code] = match[1], match[2], declared.size
    if not names:
        raise ValueError(f"{wave}: found no step unit; allowed: a waveform of rdx_core or rdx_top")
    units: dict[str, dict[str, int]] = {unit: {} for unit, _, _ in names.values()}
    found: list[Output] = []
    with wave.open("rb") as file:
        for token in tokenize(file):
            if token.kind is TokenKind.CHANGE_TIME:
                _look(units, found)
            elif token.kind in (TokenKind.CHANGE_SCALAR, TokenKind.CHANGE_VECTOR):
                scalar = token.kind is TokenKind.CHANGE_SCALAR
                change = token.scalar_change if scalar else token.vector_change
                if change.id_code in names:
                    unit, signal, width = names[change.id_code]
                    value = int(change.value) if str(change.value) in "01" or isinstance(change.value, int) else 0
                    units[unit][signal] = signed(value, width) if signal.startswith("segment_o.") else value
    _look(units, found)
    return found


def _look(units: dict[str, dict[str, int]], found: list[Output]) -> None:
    """Note the item at the output of a unit where it has taken one step more than the last that was noted."""
    for values in units.values():
        status, number = values.get("control_o.status", 0), values.get("control_o.steps", 0)
        if status in NAMES and number == len(found) + 1:
            b = sorted((signal, value) for signal, value in values.items() if signal.startswith("segment_o.b["))
            found.append(
                Output(
                    number,
                    values["control_o.t"],
                    values["control_o.t_next"] if values["control_o.pending"] else -1,
                    NAMES[status],
                    [value for _, value in b],
                    values["segment_o.ends.depth_start"],
                )
            )
