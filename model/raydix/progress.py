# SPDX-License-Identifier: Apache-2.0
"""Bars on stderr for what takes longer than a moment: how much is done, how fast it goes, what is left."""

from collections.abc import Iterable, Iterator
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.text import Text

T = TypeVar("T")


class RateColumn(ProgressColumn):
    """Steps a second, or seconds a step where they are slow."""

    def render(self, task: Task) -> Text:
        """Nothing until it is known."""
        speed = task.finished_speed or task.speed
        if not speed:
            return Text("")
        return Text(f"{speed:,.0f}/s" if speed >= 10 else f"{speed:.1f}/s" if speed >= 1 else f"{1 / speed:.0f} s each")


def bars(console: Console | None = None) -> Progress:
    """Bars that vanish when they are done, and are not drawn where the console, stderr, is no terminal."""
    console = console or Console(stderr=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        RateColumn(),
        TimeRemainingColumn(),
    )
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


def track(items: Iterable[T], label: str, total: int | None = None) -> Iterator[T]:
    """``items``, with a bar that goes on with each; ``total``: how many, where they do not say it."""
    with bars() as shown:
        yield from shown.track(items, total=total, description=label)
