# SPDX-License-Identifier: Apache-2.0
"""Coverage of each module of the RTL by its own test: blocks and branches, toggled bits, functional bins."""

import argparse
import math
import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

from rich.console import Console
from rich.table import Table

from pytests import run_pytest
from raydix import coverpoints
from raydix.blocks import read_table, write_table
from raydix.command import COUNT, status_of
from raydix.files import sources, top_modules
from raydix.progress import track

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "coverage.md"
SEED = "1"  # the same stimuli each time, so that results can be kept
KINDS = ("block", "toggle", "bin")
HEADER = ("module", "runs", "blocks", "waived", "toggles", "constant", "left", "toggled", "bins", "waived")


def modules(wanted):
    """Names of the modules that have a test, or of those wanted. Raises ValueError where one is none."""
    names = [path.stem.removeprefix("rdx_") for path in sources() if not path.stem.endswith("pkg")]
    names += [name.removeprefix("rdx_") for name in top_modules()]
    wanted = [name.removeprefix("rdx_") for name in wanted]
    if unknown := [name for name in wanted if name not in names]:
        raise ValueError(f"found {', '.join(unknown)}; allowed: {', '.join(sorted(names))}")
    return wanted or names


def run_tests(names, jobs):
    """Run the tests of modules that have no results yet; names of the results' files. None where a test fails."""
    with tempfile.TemporaryDirectory() as folder:
        manifest = Path(folder, "results")
        manifest.touch()
        files = sorted({f"tb/test_{coverpoints.owner(name)}.py" for name in names})
        environment = {**os.environ, coverpoints.MANIFEST: str(manifest), "SEED": SEED, "WAVES": ""}
        options = ["-n", str(jobs), "--dist", "worksteal"]
        if run_pytest([*options, *files], "tests", environment, ["nice", "-n", "10"]):
            return None
        return sorted(set(manifest.read_text().split()))


def collect(names, files):
    """Points of each module by its own results: (points, number of results)."""
    points, runs = {}, {}
    for name in track(names, "results of modules"):
        mine = [coverpoints.RESULTS / file for file in files if file.startswith(f"rdx_{coverpoints.owner(name)}-")]
        runs[name] = len(mine)
        points.update({p: n for p, n in coverpoints.merge(mine).items() if p.module == name})
    return points, runs


def texts(name, runs, row):
    """Cells of a module's row."""
    block, toggle, bins = row["block"], row["toggle"], row["bin"]
    can = toggle.total - toggle.constant
    share = math.floor(10_000 * toggle.hit / can) / 100 if can else 100.0
    counts = [f"{block.hit}/{block.total}", str(block.constant + block.left)]
    counts += [f"{toggle.hit:,}/{toggle.total:,}", f"{toggle.constant:,}", f"{toggle.left:,}", f"{share:.2f} %"]
    return [name, str(runs), *counts, f"{bins.hit}/{bins.total}", str(bins.constant + bins.left)]


def contradicted(points, rules):
    """Waivers of constants, of one module, that match a bit which rose and fell, each as a sentence."""
    seen = Counter((p.module, coverpoints.label(p, {})) for p, count in points.items() if p.kind == "toggle" and count)
    moved = [bit for bit, directions in seen.items() if directions == 2]
    found = []
    for rule in rules:
        if rule.constant and rule.kind == "toggle":
            for pattern in rule.points:
                bits = sorted(name for module, name in moved if module == rule.module and pattern.fullmatch(name))
                if bits:
                    found.append(
                        f"{rule.module}: not constant: {', '.join(bits[:6])}, of the waiver {pattern.pattern!r}"
                    )
    return found


def numbers(cell):
    """The counts in a cell, as in 1,024/2,048."""
    return [int(part.replace(",", "")) for part in cell.split("/")]


def total(lines):
    """The row of all modules: the sums of theirs."""

    def row(line):
        """The counts of a line."""
        block, waived, toggle, constant, left, _, bins, idle = line[2:]
        kinds = (block, waived, "0"), (toggle, constant, left), (bins, idle, "0")
        return [coverpoints.Row(*(n for cell in cells for n in numbers(cell))) for cells in kinds]

    sums = [coverpoints.Row(*map(sum, zip(*those, strict=True))) for those in zip(*map(row, lines), strict=True)]
    return texts("all", sum(int(line[1]) for line in lines), dict(zip(KINDS, sums, strict=True)))


def main():
    """Command line: 0 where every gap is closed or waived, 1 where not, 2 for a mistake of the user's."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("module", nargs="*", help="only these")
    parser.add_argument("--jobs", type=COUNT, default=1, help="builds and simulations at a time (default: 1)")
    parser.add_argument("--write", action="store_true", help="renew the rows of these modules in docs/coverage.md")
    args = parser.parse_args()
    try:
        names = modules(args.module)
        rules = coverpoints.waivers(coverpoints.WAIVERS)
    except (ValueError, OSError) as error:
        print(f"coverage: {error}", file=sys.stderr)
        return 2
    files = run_tests(names, args.jobs)
    if files is None:
        print("coverage: a test failed, so there is no table", file=sys.stderr)
        return 1
    points, runs = collect(names, files)
    waived, idle = coverpoints.apply(points, rules)
    table = coverpoints.rows(points, waived)
    lines = [texts(name, runs[name], row) for name, row in table.items()]
    if len(lines) > 1:
        lines.append(total(lines))
    shown = Table()
    for title in HEADER:
        shown.add_column(title, justify="left" if title == "module" else "right")
    for line in lines:
        shown.add_row(*line)
    Console(width=120).print(shown)
    if args.write:
        kept = {name: line for name, line in read_table(PAGE, "coverage").items() if name in modules([])}
        kept = sorted((kept | {line[0]: line for line in lines if line[0] != "all"}).values())
        write_table(PAGE, "coverage", HEADER, [*kept, total(kept)])
    left = coverpoints.gaps(points, waived) + idle + contradicted(points, rules)
    for line in left:
        print(line)
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(status_of(main))
