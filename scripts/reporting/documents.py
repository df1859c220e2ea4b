# SPDX-License-Identifier: Apache-2.0
"""Tables that commands write into the docs, and the newest plots, as parts of a page."""

import base64
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from markdown_it import MarkdownIt

from raydix.blocks import block_of

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
RENDERER = MarkdownIt("commonmark", {"html": False}).enable("table")


@dataclass(frozen=True)
class Chapter:
    """A section of the page.

    title    its heading
    command  what renews it
    page     of docs/, whose generated ``blocks`` it shows
    plots    files below the root, of which those that exist are shown; of alternatives separated by "|" the first
    """

    title: str
    command: str
    page: str
    blocks: tuple[str, ...] = ()
    plots: tuple[str, ...] = ()


CHAPTERS = (
    Chapter("Run time against error", "make bench ARGS=--write", "benchmarks.md", ("beaten", "clocks"),
            tuple(f"build/bench/{n}.png|docs/images/benchmark-{n}.png" for n in ("torus", "hyperboloid", "spiral"))),
    Chapter("Which structure for which goal", "make explore ARGS=--write", "exploration.md", ("goals",),
            ("build/explore/explore.png|docs/images/exploration.png",)),
    Chapter("Size and clock", "make synth ARGS=--write", "synthesis.md", ("synthesis",)),
    Chapter("Frames a second, what skipping saves", "make realtime ARGS=--write", "realtime.md", ("speed", "skips")),
    Chapter("Stress: difficult rays", "make stress ARGS=--write", "stress.md", ("stress",),
            ("docs/images/stress-algebraic.png", "docs/images/stress-spirals.png")),
    Chapter("Coverage", "make coverage ARGS=--write", "coverage.md", ("coverage",)),
    Chapter("Mutants", "make mutants ARGS=--write", "mutants.md", ("mutants",)),
    Chapter("Proofs", "make formal ARGS=--write", "formal.md", ("proofs",)),
)  # fmt: skip


@dataclass
class Section:
    """A chapter with its contents as HTML and data: addresses.

    when     its page was last written, as git knows it
    missing  names of plots that are nowhere
    """

    chapter: Chapter
    when: str
    tables: list[str] = field(default_factory=list)
    plots: list[tuple[str, str]] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)

    @property
    def anchor(self) -> str:
        """Of its heading."""
        return Path(self.chapter.page).stem


def table_html(text: str) -> str:
    """A generated block as an HTML table that scrolls by itself."""
    return f'<div class="scroll">{RENDERER.render(text)}</div>'


def written(page: str) -> str:
    """Date of a page's last commit; empty outside of a git repository."""
    command = ["git", "-C", str(ROOT), "log", "-1", "--format=%cs", "--", f"docs/{page}"]
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout.strip()
    except OSError:
        return ""


def section(chapter: Chapter) -> Section:
    """Raises ValueError where the page lacks a block."""
    found = Section(chapter, written(chapter.page))
    found.tables = [table_html(block_of(DOCS / chapter.page, name)) for name in chapter.blocks]
    for choices in chapter.plots:
        paths = [ROOT / choice for choice in choices.split("|")]
        path = next((path for path in paths if path.exists()), None)
        name = paths[-1].stem.removeprefix("benchmark-")
        if path:
            address = "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()
            found.plots.append((name, address))
        else:
            found.missing.append(name)
    return found
