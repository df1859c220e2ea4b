# SPDX-License-Identifier: Apache-2.0
"""Runs pytest with a bar: tests done, their rate, the time that is left."""

import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from raydix.progress import bars

ROOT = Path(__file__).resolve().parents[1]
COUNT = re.compile(r"\[ *(\d+)/(\d+)\]")  # of pytest's console_output_style
HEADING = re.compile(r"=+ (FAILURES|ERRORS|short test summary info) =+")


def run_pytest(arguments: Sequence[str], label: str, settings: dict[str, str], before: Sequence[str] = ()) -> int:
    """Run pytest from the root of the repository; its exit status.

    What it prints goes to stderr as it comes. On a terminal there is a bar instead, and the report of tests that fail.
    before  words before the command, such as nice
    """
    command = [*before, sys.executable, "-u", "-m", "pytest"]
    if not Console(stderr=True).is_terminal:
        return subprocess.run([*command, "-q", *arguments], cwd=ROOT, env=settings, stdout=sys.stderr).returncode
    command += ["-v", "-o", "console_output_style=count", *arguments]
    lines = []
    with bars() as shown, subprocess.Popen(command, cwd=ROOT, env=settings, stdout=subprocess.PIPE, text=True) as run:
        task = shown.add_task(label, total=None)
        assert run.stdout  # it is a pipe
        for line in run.stdout:
            lines.append(line)
            if count := COUNT.search(line):
                shown.update(task, completed=int(count[1]), total=int(count[2]))
    if run.returncode:
        begin = next((i for i, line in enumerate(lines) if HEADING.match(line)), 0)
        sys.stderr.writelines(lines[begin:])
    return run.returncode
