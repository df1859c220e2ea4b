# SPDX-License-Identifier: Apache-2.0
"""Generated blocks in files that are otherwise written by hand."""

import re
import sys
from collections.abc import Container, Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from .replacing import replacing


def replace_block(path: Path, begin: str, end: str, body: str, write: bool) -> bool:
    """Bring the text between the lines ``begin`` and ``end`` of ``path`` up to date, if ``write``: all or none.

    Returns whether it differed from ``body``. Raises ValueError where the markers are not there once each.
    """
    text = path.read_text()
    if text.count(begin) != 1 or text.count(end) != 1:
        raise ValueError(f"{path}: the lines {begin!r} and {end!r} are not there once each")
    head, rest = text.split(begin)
    wanted = head + begin + body + end + rest.split(end)[1]
    if write and wanted != text:
        with replacing(path) as part:
            part.write_text(wanted)
    return wanted != text


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table; columns whose cells start with a digit are right-aligned."""
    right = [bool(rows) and all(row[i][:1].isdigit() or not row[i] for row in rows) for i in range(len(header))]
    lines = [header, ["---:" if r else "---" for r in right], *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def block_of(path: Path, name: str) -> str:
    """Text of the block ``name`` of a Markdown file. Raises ValueError where there is none."""
    _, begin, rest = path.read_text().partition(f"<!-- BEGIN generated: {name} -->\n")
    if not begin:
        raise ValueError(f"{path}: found no generated block {name!r}")
    return rest.split("<!-- END")[0]


def read_table(path: Path, name: str) -> dict[str, list[str]]:
    """Rows of the table in the block ``name`` of a Markdown file, by their first cells."""
    lines = [line for line in block_of(path, name).splitlines() if line.startswith("|")][2:]
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return {row[0]: row for row in rows}


def write_table(path: Path, name: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Replace the block ``name`` of a Markdown file by a table."""
    begin, end = f"<!-- BEGIN generated: {name} -->\n", f"<!-- END generated: {name} -->\n"
    replace_block(path, begin, end, "\n" + markdown_table(header, rows) + "\n", True)


def show_table(
    title: str, header: Sequence[str], rows: Sequence[Sequence[str]], left: Container[str], width: int
) -> None:
    """Print a table; the columns named in ``left`` are left-aligned. ``width``: where the output is no terminal."""
    table = Table(title=title)
    for column in header:
        table.add_column(column, justify="left" if column in left else "right")
    for row in rows:
        table.add_row(*row)
    Console(width=None if sys.stdout.isatty() else width).print(table)
