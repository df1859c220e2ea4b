#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The module tests under Icarus Verilog, whose signals have four states; a table of what passed.

    scripts/second.py               all modules
    scripts/second.py ring step     two of them
    scripts/second.py --write       all, and their rows in the table of docs/verification.md

Exit status 0: all passed; 1: a test failed; 2: bad input, or Icarus Verilog is missing.
"""

import argparse
import contextlib
import inspect
import io
import json
import os
import re
import sys
import tempfile
from collections import Counter
from pathlib import Path

import pytest
from rich.console import Console
from rich.table import Table

from pytests import run_pytest
from raydix.blocks import read_table, write_table
from raydix.command import COUNT, SEED, status_of
from raydix.progress import working

ROOT = Path(__file__).resolve().parents[1]
TB = ROOT / "tb"
PAGE = ROOT / "docs" / "verification.md"
HEADER = ("module", "parameter sets", "tests", "passed", "left out")

# Parameter sets that take Icarus many minutes each: many lanes or cells, or all cells within one clock.
SLOW = re.compile(
    r"test_cast\.py::test_cast(_without_spirals)?$|test_ring\.py.*(N1=4|Lanes=)"
    r"|test_rings\.py.*(N1=2|Lanes=)|test_vector\.py.*N1=2|test_lanes\.py.*(7 on [1347]|15 on|general)"
    r"|test_sample\.py.*Lanes=7|test_step\.py.*(N1=4|Lanes=[37]|HalveStages=0)|test_split\.py.*N1=4"
)
sys.path.insert(0, str(TB))

import second  # noqa: E402


class Collector:
    """The pytest tests that start a simulation by :func:`bench.run`."""

    def __init__(self):
        self.found = []

    def pytest_collection_modifyitems(self, items):
        """Called by pytest."""
        self.found = [i.nodeid for i in items if "bench.run(" in inspect.getsource(i.function)]


def collect(modules):
    """Names of the pytest tests of these modules that start a simulation."""
    collector = Collector()
    files = [str(TB / f"test_{module}.py") for module in modules]
    with contextlib.redirect_stdout(io.StringIO()):
        pytest.main(["--collect-only", "-q", "-q", "--no-summary", f"--rootdir={ROOT}", *files], [collector])
    return collector.found


def shorter(names):
    """Those that are not slow, and how many of each module are."""
    slow = [name for name in names if SLOW.search(name)]
    return [name for name in names if name not in slow], Counter(re.search(r"test_(\w+)\.py", n)[1] for n in slow)


def simulate(names, jobs, seed):
    """Run the pytest tests under Icarus; the runs as :func:`bench.run` records them, and whether pytest is content."""
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder, "runs")
        settings = {
            "SIMULATOR": "icarus",
            "RAYDIX_RECORD": str(record),
            "SEED": "" if seed is None else str(seed),
            "WAVES": "",
        }
        options = ["-n", str(jobs), "--dist", "worksteal"]
        status = run_pytest([*options, *names], "tests", {**os.environ, **settings})
        lines = record.read_text().splitlines() if record.exists() else []
    return [json.loads(line) for line in lines], status == 0


def table(runs, left):
    """Rows: module, parameter sets, tests, tests passed, tests left out."""
    rows = []
    for module in sorted({run["module"] for run in runs}):
        mine = [run for run in runs if run["module"] == module]
        sets = {json.dumps(run["parameters"], sort_keys=True) for run in mine}
        passed, failed = sum(run["passed"] for run in mine), sum(len(run["failed"]) for run in mine)
        slow = left[module.removeprefix("rdx_")]
        out = [second.left_out(module)] + ([f"slow: {slow} parameter set{'s' * (slow > 1)}"] if slow else [])
        rows.append([module, str(len(sets)), str(passed + failed), str(passed), "; ".join(filter(None, out)) or "none"])
    return rows


def main(arguments=None):
    """The command line."""
    known = second.tested()
    parser = argparse.ArgumentParser(description="Module tests under Icarus Verilog, with four-state values.")
    parser.add_argument("module", nargs="*", help="all if none is named")
    parser.add_argument("--jobs", type=COUNT, default=2)
    parser.add_argument(
        "--seed", type=SEED, default=os.environ.get("SEED") or None, help="of all runs; one for each by default"
    )
    parser.add_argument("--all", action="store_true", help="the slow parameter sets, too: hours")
    parser.add_argument("--write", action="store_true", help="renew the rows of docs/verification.md")
    options = parser.parse_args(arguments)
    modules = [name.removeprefix("rdx_") for name in options.module]
    if unknown := sorted(set(modules) - set(known)):
        print(f"second: found {', '.join(unknown)}; allowed: {', '.join(known)}", file=sys.stderr)
        return 2
    if not second.found():
        print(f"second: {second.MISSING}", file=sys.stderr)
        return 2
    with working("looking for the tests"):
        names, left = collect(modules or known), Counter()
    if not options.all:
        names, left = shorter(names)
    if not names:  # pytest would run everything
        print("second: all parameter sets of these modules are slow; allowed: --all", file=sys.stderr)
        return 2
    runs, content = simulate(names, options.jobs, options.seed)
    if not runs:
        print("second: no test came to a simulation; what pytest printed above says why", file=sys.stderr)
        return 2
    rows, bad = table(runs, left), [run for run in runs if run["failed"]]
    shown = Table(*HEADER)
    for row in rows:
        shown.add_row(*row)
    Console().print(shown)
    for run in bad:
        print(f"{run['module']} {run['parameters']}, SEED={run['seed']}: {', '.join(run['failed'])}")
    if options.write and content:
        kept = {name: row for name, row in read_table(PAGE, "second").items() if name.removeprefix("rdx_") in known}
        write_table(PAGE, "second", HEADER, [row for _, row in sorted((kept | {row[0]: row for row in rows}).items())])
    return 0 if content else 1


if __name__ == "__main__":
    sys.exit(status_of(main))
