#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One HTML page of what was rendered, tested and measured last; it needs no network and no other file.

    scripts/report.py                     build/report.html
    scripts/report.py --out page.html     elsewhere

Pictures and figures of scenes: build/render, as `make render` and `make gallery` leave them. Test results:
build/results, as `make test` and `make regress` leave them. Tables: the generated ones of docs/. Plots: of build/,
else of docs/.

Exit status 0: written; 2: a file cannot be read or written.
"""

import argparse
import subprocess
import sys
from datetime import datetime
from pathlib import Path

import jinja2

from raydix.command import status_of
from raydix.image import ImageError, text_writer, write_files
from raydix.progress import track
from reporting.documents import CHAPTERS, section
from reporting.gallery import cards
from reporting.results import ResultsError, read_runs

ROOT = Path(__file__).resolve().parents[1]
PARTS = Path(__file__).resolve().parent / "reporting"
OUT = ROOT / "build" / "report.html"


def commit() -> str:
    """The commit that is checked out, marked where files differ from it."""
    command = ["git", "-C", str(ROOT), "describe", "--always", "--dirty=, with changes", "--abbrev=10"]
    try:
        found = subprocess.run(command, capture_output=True, text=True).stdout.strip()
    except OSError:
        found = ""
    return f"commit {found}" if found else "no git repository"


def verdict(scenes, runs) -> tuple[bool, str]:
    """Whether nothing is known to be wrong, and a line that says so."""
    differing = [card.name for card in scenes if not card.equal]
    failed = int(sum(run.total("failed") for run in runs))
    passed = int(sum(run.total("passed") for run in runs))
    said = [
        f"{len(scenes) - len(differing)} of {len(scenes)} scenes equal in every bit" if scenes else "no scene rendered",
        f"{passed:,} tests passed, {failed:,} failed" if runs else "no test run",
    ]
    return not differing and not failed, "; ".join(said)


def page(render: Path, results: Path) -> str:
    """The page as text. Raises ImageError, ResultsError."""
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    template = environment.from_string((PARTS / "page.html").read_text())
    scenes, runs = cards(render), read_runs(results)
    good, line = verdict(scenes, runs)
    style, script = (jinja2.utils.markupsafe.Markup((PARTS / name).read_text()) for name in ("page.css", "page.js"))
    return template.render(
        style=style,
        script=script,
        when=datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z"),
        commit=commit(),
        good=good,
        verdict=line,
        cards=scenes,
        runs=runs,
        sections=[section(chapter) for chapter in track(CHAPTERS, "chapters")],
    )


def folder(text: str) -> Path:
    """A folder as an argument. Raises ArgumentTypeError."""
    path = Path(text)
    if not path.is_dir():
        raise argparse.ArgumentTypeError(
            f"found {'the file ' * path.exists()}'{text}'; allowed: a folder that is there"
        )
    return path


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    folders = (("render", "of scenes"), ("results", "of test results"))
    for name, what in folders:
        default = ROOT / "build" / name
        parser.add_argument(f"--{name}", type=folder, default=default, help=f"folder {what} (default: build/{name})")
    parser.add_argument("--out", type=Path, default=OUT, metavar="FILE", help="default: build/report.html")
    args = parser.parse_args()
    try:
        text = page(args.render, args.results)
        write_files({args.out: text_writer(text)})
    except (ImageError, ResultsError, ValueError, OSError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    print(f"{args.out} ({len(text) / 1e6:.1f} MB): open it in a browser")
    return 0


if __name__ == "__main__":
    sys.exit(status_of(main))
