# SPDX-License-Identifier: Apache-2.0
"""Files that open a waveform with its signals in groups: a save file of GTKWave, commands of Surfer, a VCD of reals."""

from datetime import datetime
from math import log2
from pathlib import Path
from typing import TextIO

from vcd import VCDWriter
from vcd.gtkw import GTKWFlag, GTKWSave

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


def write_surfer(file: TextIO, wave: Path, groups: list[Group]) -> None:
    """Commands (surfer -c FILE): a divider before each group. Real numbers are in the file of :func:`write_reals`."""
    file.write(f"load_file {wave}\n")
    for group in groups:
        file.write(f"divider_add {group.name}\n")
        for signal in group.signals:
            file.write(f"variable_add {signal.path}\n")
    file.write("zoom_fit\n")


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
