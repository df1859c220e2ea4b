# SPDX-License-Identifier: Apache-2.0
"""Bars on stderr for what takes longer than a moment: how much is done, how fast it goes, what is left."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
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


class CountColumn(MofNCompleteColumn):
    """How many of how many, where that is known."""

    def render(self, task: Task) -> Text:
        """Nothing where it is not."""
        return Text("") if task.total is None else super().render(task)


class TimeColumn(TimeRemainingColumn):
    """The time that is left; where nobody knows, the time since the start."""

    def render(self, task: Task) -> Text:
        """In hours, minutes and seconds."""
        if task.total is not None:
            return super().render(task)
        minutes, seconds = divmod(int(task.elapsed or 0), 60)
        return Text(f"{minutes // 60}:{minutes % 60:02}:{seconds:02}", style="progress.elapsed")


_drawn: list[Progress] = []  # the bars that are on the terminal now, the last in the last place


class Bars(Progress):
    """Known to :func:`working`, which adds a row to them: two displays at a time would overwrite each other."""

    def start(self) -> None:
        """Draw them."""
        _drawn.append(self)
        super().start()

    def stop(self) -> None:
        """Remove them."""
        if self in _drawn:
            _drawn.remove(self)
        super().stop()


def bars(console: Console | None = None) -> Progress:
    """Bars that vanish when they are done, and are not drawn where the console, stderr, is no terminal."""
    console = console or Console(stderr=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        CountColumn(),
        RateColumn(),
        TimeColumn(),
    )
    return Bars(*columns, console=console, transient=True, disable=not console.is_terminal)


def track(items: Iterable[T], label: str, total: int | None = None) -> Iterator[T]:
    """``items``, with a bar that goes on with each; ``total``: how many, where they do not say it."""
    with bars() as shown:
        yield from shown.track(items, total=total, description=label)


@contextmanager
def working(label: str, program: str | None = None) -> Iterator[None]:
    """A row with the time since its start, for what nobody knows the length of; beside bars that are drawn, below them.

    program  says the label in a line where stderr is no terminal; None: nothing is said there
    """
    if program and not Console(stderr=True).is_terminal:
        print(f"{program}: {label} …", file=sys.stderr, flush=True)
    if not _drawn:
        with bars() as shown:
            shown.add_task(f"{label} …", total=None)
            yield
        return
    shown = _drawn[-1]
    task = shown.add_task(f"{label} …", total=None)
    try:
        yield
    finally:
        shown.remove_task(task)


def tell_compilation() -> None:
    """From now on a row says that numba compiles, where nothing is in its cache: a minute for some kernels."""
    from numba.core import event

    class Told(event.Listener):
        """Of compilations within another the outermost is told."""

        def __init__(self) -> None:
            self.depth = 0
            self.row = working("")

        def on_start(self, found: event.Event) -> None:
            """A compilation begins."""
            if self.depth == 0:
                self.row = working(f"numba compiles {found.data['dispatcher'].py_func.__name__}, once")
                self.row.__enter__()
            self.depth += 1

        def on_end(self, found: event.Event) -> None:
            """It ends."""
            self.depth -= 1
            if self.depth == 0:
                self.row.__exit__(None, None, None)

    event.register("numba:compile", Told())
