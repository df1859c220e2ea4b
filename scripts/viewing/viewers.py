# SPDX-License-Identifier: Apache-2.0
"""Files that open a waveform with its signals in groups: GTKWave, Surfer, and a VCD of reals."""

import re
import shutil
from datetime import datetime
from math import log2
from pathlib import Path
from typing import TextIO

from vcd import VCDWriter
from vcd.gtkw import GTKWFlag, GTKWSave

from .formats import number_of
from .signals import Group, Signal, changes

CLOCK_PIXELS = 40  # width of a clock where GTKWave opens
FRAME = 200  # pixels that its zoom gives the time of, as a power of two


def gtkwave_name(signal: Signal) -> str:
    """A vector has its range behind its name."""
    return signal.path if signal.width == 1 else f"{signal.path}[{signal.width - 1}:0]"


def write_gtkwave(file: TextIO, wave: Path, groups: list[Group], start: int, period: int) -> None:
    """A save file: fixed-point numbers as such, by GTKWave's own shift of the point; modules within are closed.

    start, period   what is seen first, and a clock, in the waveform's unit of time
    """
    save = GTKWSave(file)
    save.dumpfile(str(wave))
    save.timestart(start)
    save.zoom_markers(-log2(period * FRAME / CLOCK_PIXELS))
    save.signals_width(300)
    for group in groups:
        with save.group(group.name, closed=group.name.startswith(("u_", "gen_"))):
            for signal in group.signals:
                number, alias = signal.number, signal.short.replace(".", "/")  # it would show what is behind a point
                if number is None:
                    save.trace(gtkwave_name(signal), alias=alias, datafmt="hex" if signal.width > 1 else "bin")
                    continue
                file.write(f"[fpshift_count] {number.fraction}\n")  # holds for the trace that follows
                form = "signed" if number.signed else "dec"
                save.trace(gtkwave_name(signal), alias=alias, datafmt=form, extraflags=GTKWFlag.fpdecshift)


RANGED = re.compile(r"(\$var\s+\S+\s+(\d+)\s+\S+\s+(\S+)\s+)\[(\d+):0\](?=\s+\$end)")


def surfer_name(signal: Signal) -> str:
    """Surfer's reader has elements of an array in a scope of its name; the last index of a single bit is none's."""
    last = signal.name.rfind("[") if signal.width == 1 and not signal.ranged else len(signal.name)
    elements = re.sub(r"(?<!^)\[", ".[", signal.name[:last]) + signal.name[last:]
    return ".".join([*signal.scopes, elements])


def surfer_index(place: int) -> str:
    """How Surfer names the item of a line: hexadecimal digits from a on."""
    return f"{place:x}".translate(str.maketrans("0123456789abcdef", "abcdefghijklmnop"))


def write_surfer(file: TextIO, groups: list[Group]) -> None:
    """Commands for a waveform of :func:`write_fixed`: a divider before each group, formats of fixed-point numbers.

    A divider's name is one word, or Surfer refuses it. Formats are last: what follows a focused line is added there.
    """
    formats, place = [], 0
    for group in groups:
        file.write(f"divider_add {re.sub(r'[^A-Za-z0-9_]', '_', group.name)}\n")
        place += 1
        for signal in group.signals:
            file.write(f"variable_add {surfer_name(signal)}\n")
            if signal.number:
                form = "Signed" if signal.number.signed else "Unsigned"
                formats += [f"item_focus {surfer_index(place)}_{signal.name}", f"item_set_format {form} fixed point"]
            place += 1
    file.write("\n".join([*formats, "item_unfocus", "zoom_fit", ""]))


def write_fixed(file: TextIO, wave: Path) -> None:
    """The waveform with the point in the ranges of fixed-point numbers, where Surfer looks for it: [1:-30], not [31:0].

    Changes are copied as they are.
    """

    def shifted(found: re.Match) -> str:
        number = number_of(found[3], int(found[2]))
        below = number.fraction if number else 0
        return f"{found[1]}[{int(found[4]) - below}:{-below}]"

    with wave.open() as source:
        for line in source:
            file.write(RANGED.sub(shifted, line))
            if "$enddefinitions" in line:
                break
        shutil.copyfileobj(source, file)


def write_reals(file: TextIO, wave: Path, groups: list[Group], until: int) -> int:
    """A VCD that any viewer shows as it is: a scope for each group, fixed-point signals as real numbers.

    Up to a time of ``wave``; the number of changes that it has.
    """
    count = 0
    with VCDWriter(file, timescale="1 ps", date=datetime.now().isoformat(" ", "seconds")) as writer:
        of_code: dict[str, list] = {}
        for group in groups:
            scope = group.name.replace(" ", "_")
            for signal in group.signals:
                kind = "real" if signal.number else "wire"
                variable = writer.register_var(scope, signal.short, kind, signal.width if kind == "wire" else None)
                of_code.setdefault(signal.code, []).append((signal, variable))
        for time, code, bits in changes(wave, set(of_code), until):
            for signal, variable in of_code[code]:
                writer.change(variable, time, signal.number.value(bits, signal.width) if signal.number else bits)
                count += 1
    return count
