# SPDX-License-Identifier: Apache-2.0
"""A picture of the important signals: the streams at a module's ports and its numbers, over a window of clocks."""

from pathlib import Path
from textwrap import wrap

from matplotlib.figure import Figure

from .signals import Group, Signal, changes

ROWS = 28  # most signals of a picture
TITLE = 150  # characters of a line of the title
CHARACTER = 0.0047  # width of one, as part of the time axis
SHADE, INK = "#dbe6f6", "#24406e"


def ports_of(groups: list[Group]) -> list[Signal]:
    """The module's ports: single bits first, then what has a number, then the rest."""
    ports = [s for g in groups if g.name in ("clock", "inputs", "outputs") for s in g.signals]
    control = [s for s in ports if s.width == 1]
    numbers = [s for s in ports if s.number]
    rest = [s for s in ports if s.width > 1 and not s.number]
    return [*control, *numbers, *rest]


def important(
    ports: list[Signal], outputs: set[str], known: dict[str, list[tuple[int, int]]], start: int
) -> list[Signal]:
    """Of the ports, in their order, those that a picture from ``start`` on has room for.

    Outputs that change come before inputs that do, both before what stays as it is.

    outputs  codes of the module's outputs
    """

    def rank(signal: Signal) -> int:
        still = not any(time > start for time, _ in known[signal.code])
        return 2 if still else 0 if signal.code in outputs else 1

    chosen = sorted(ports, key=rank)[:ROWS]
    return [signal for signal in ports if signal in chosen]


def history(wave: Path, signals: list[Signal], until: int) -> dict[str, list[tuple[int, int]]]:
    """(time, bits) of each signal's code, one for each change."""
    found: dict[str, list[tuple[int, int]]] = {signal.code: [(0, 0)] for signal in signals}
    for time, code, bits in changes(wave, set(found), until):
        if found[code][-1][0] == time:
            found[code].pop()
        found[code].append((time, bits))
    return found


def period_of(wave: Path, clock: Signal) -> int:
    """Clock period in the file's unit, by its first two rising edges. Raises ValueError where it has none."""
    rising = []
    for time, _, bits in changes(wave, {clock.code}, 1 << 62):
        if bits:
            rising.append(time)
        if len(rising) == 2:
            return rising[1] - rising[0]
    raise ValueError("found a clock that does not run; allowed: two clocks at least")


def first_valid(wave: Path, groups: list[Group], until: int) -> int:
    """When the first input that says valid does; 0 if none does."""
    ports = [s for g in groups if g.name == "inputs" for s in g.signals if s.width == 1 and "valid" in s.root]
    for time, _, bits in changes(wave, {s.code for s in ports}, until):
        if bits and time:
            return time
    return 0


def text_of(signal: Signal, bits: int) -> str:
    """A value as it is written into its box."""
    return f"{signal.number.value(bits, signal.width):.3g}" if signal.number else f"{bits:x}"


def draw(wave: Path, groups: list[Group], start: int, until: int, period: int, title: str, out: Path) -> None:
    """Write a PNG: a row for each signal, levels of single bits, boxes with values of the others."""
    ports = ports_of(groups)
    known = history(wave, ports, until)
    outputs = {s.code for g in groups if g.name == "outputs" for s in g.signals}
    signals = important(ports, outputs, known, start)
    if len(signals) < len(ports):
        title += f"; {len(signals)} of {len(ports)} signals, first what changes"
    figure = Figure(figsize=(16, 0.36 * len(signals) + 1.2), layout="constrained")
    axes = figure.subplots()
    for row, signal in enumerate(signals):
        base = len(signals) - 1 - row
        events = [e for e in known[signal.code] if e[0] <= until]
        ends = [t for t, _ in events[1:]] + [until]
        for (time, bits), end in zip(events, ends, strict=True):
            left, right = max(time, start) / period, end / period
            if right <= start / period or right == left:
                continue
            if signal.width == 1:
                axes.fill_between([left, right], base, base + 0.7 * bits, color=SHADE, linewidth=0)
                axes.plot([left, right], [base + 0.7 * bits] * 2, color=INK, linewidth=1)
                axes.plot([left, left], [base, base + 0.7], color=INK, linewidth=0.5 if time >= start else 0)
                continue
            axes.fill_between([left, right], base, base + 0.7, facecolor=SHADE, edgecolor=INK, linewidth=0.6)
            text = text_of(signal, bits)
            if right - left > CHARACTER * len(text) * (until - start) / period:
                axes.text((left + right) / 2, base + 0.33, text, ha="center", va="center", fontsize=6.5, color=INK)
    axes.set_yticks([len(signals) - 1 - i + 0.35 for i in range(len(signals))], [s.short for s in signals], fontsize=8)
    axes.set_xlim(start / period, until / period)
    axes.set_xlabel("clocks")
    axes.set_title("\n".join(wrap(title, TITLE, break_on_hyphens=True)), fontsize=10)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(axis="y", length=0)
    figure.savefig(out, dpi=110)
