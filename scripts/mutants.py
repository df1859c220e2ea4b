# SPDX-License-Identifier: Apache-2.0
"""Mutation testing: small changes of each RTL module, one at a time, that the module's own tests must find."""

import argparse
import os
import signal
import sys
import tomllib
from collections import Counter
from pathlib import Path

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tb"))

from mutation import campaign as work  # noqa: E402  (needs tb/ on the path)
from mutation import schema, sites  # noqa: E402
from raydix.blocks import read_table, write_table  # noqa: E402
from raydix.command import COUNT, status_of  # noqa: E402
from raydix.config import ConfigError  # noqa: E402
from raydix.progress import bars  # noqa: E402

EQUIVALENT = ROOT / "tb" / "mutants.toml"
PAGE = ROOT / "docs" / "mutants.md"
SLOW = ["ring", "step", "algebraic", "ends", "sample", "lanes", "vecsum", "vector", "core"]  # these come last
WHOLE = ("select", "guess", "halve", "ring", "slots", "leave")  # all mutants of these, always: the heart of the descent

KINDS = ("check", "assertion", "timeout")
HEADER = [
    "module",
    "possible",
    "mutants",
    "by a check",
    "by an assertion",
    "by a timeout",
    "equivalent",
    "survivors",
    "score",
]


def equivalents():
    """{(module, code, change, nth): reason} of ``tb/mutants.toml``; raises ValueError where one has no reason."""
    found = {}
    for entry in tomllib.loads(EQUIVALENT.read_text()).get("equivalent", []):
        if not str(entry.get("reason", "")).strip():
            raise ValueError(f"{EQUIVALENT}: {entry}: no reason")
        for nth in entry.get("nth", [1]):
            found[entry["module"], entry["code"], entry["change"], nth] = entry["reason"]
    return found


def change(mutant):
    """What a mutant replaces by what."""
    return f"{mutant.old} -> {mutant.new}"


def key(name, mutant):
    """The key of a mutant in :func:`equivalents`."""
    return name, mutant.code, change(mutant), mutant.nth


def row(name, everything, outcomes, equal):
    """The cells of a module's row; ``equal``: numbers of the survivors that are equivalent."""
    counts = Counter(outcome for outcome, _, _ in outcomes.values())
    killed = sum(counts[k] for k in KINDS)
    survivors = counts["survived"] - len(equal)
    score = f"{killed / (killed + survivors):.1%}" if killed + survivors else "–"
    texts = [name, len(everything), len(outcomes), *(counts[k] for k in KINDS), len(equal), survivors, score]
    return [str(t) for t in texts]


def named(name, everything, numbers):
    """The mutants of a module with these numbers. Raises ConfigError where one is none."""
    if missing := sorted(set(numbers) - {m.number for m in everything}):
        found = ", ".join(map(str, missing))
        raise ConfigError(f"--mutant: found {found}; allowed of rdx_{name}: 1 to {len(everything)}")
    return [m for m in everything if m.number in numbers]


def module(name, args, progress, known):
    """Mutate one module. Returns its row, the survivors, and listed mutants that a test has killed."""
    tests, everything, runs = work.prepare(name, args.kept)
    wanted = everything if args.all or name in WHOLE else schema.choose(everything, args.count, name)
    if args.mutant:
        wanted = named(name, everything, args.mutant)
    task = progress.add_task(name, total=len(wanted))
    results = work.Results(name, everything)

    def show(where, fields):
        counts = results.read()
        dead = sum(work.verdict(counts.get(m.number))[0] != "survived" for m in wanted)
        progress.update(task, completed=dead, description=f"{name} {where}")

    listed = {m.number for m in wanted if key(name, m) in known}
    outcomes = work.campaign(name, wanted, tests, runs, results, listed, args.jobs, show, args.kept)
    progress.update(task, description=name)
    left = [m for m in wanted if outcomes[m.number][0] == "survived"]
    equal = listed & {m.number for m in left}
    wrong = [m for m in wanted if m.number in listed - equal]
    return row(name, everything, outcomes, equal), [m for m in left if m.number not in equal], wrong, wanted, outcomes


def total(rows):
    """The last row, of all modules."""
    sums = [sum(int(cells[i]) for cells in rows if cells[i] != "–") for i in range(1, 8)]
    killed = sum(sums[2:5])
    return ["all", *map(str, sums), f"{killed / max(1, killed + sums[6]):.1%}"]


def describe(name, mutant):
    """Where a mutant is, what it changes, and how to run it alone."""
    return (
        f"rtl/rdx_{name}.sv:{mutant.line}: {mutant.site.operator}: {change(mutant)}\n"
        f'  in: {mutant.code}  (nth = [{mutant.nth}])\n  make mutants T={name} ARGS="--mutant {mutant.number}"'
    )


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("modules", nargs="*", help="names without rdx_ (default: all)")
    count_help = f"mutants of each module, at most (default: 45; of {', '.join(WHOLE)} all)"
    parser.add_argument("--count", type=COUNT, default=45, help=count_help)
    parser.add_argument("--all", action="store_true", help="all mutants that the operators make")
    parser.add_argument("--mutant", type=COUNT, action="append", help="only this one, of one module")
    parser.add_argument("--list", action="store_true", help="print the mutants, run nothing")
    parser.add_argument("--kept", action="store_true", help="run nothing, show what earlier runs have found")
    parser.add_argument("--jobs", type=COUNT, default=os.cpu_count(), help="simulations at a time (default: the cores)")
    parser.add_argument("--write", action="store_true", help="renew the rows of these modules in docs/mutants.md")
    args = parser.parse_args()
    names = work.names()
    names = sorted(names, key=lambda n: (SLOW.index(n) if n in SLOW else -1, work.source(n).stat().st_size))
    if bad := set(args.modules) - set(names):
        parser.error(f"found {', '.join(sorted(bad))}; allowed: {' '.join(sorted(names))}")
    if args.mutant and len(args.modules) != 1:
        parser.error("--mutant needs exactly one module")
    if args.count < 1 or args.jobs < 1:
        parser.error("--count and --jobs: allowed: 1 and up")
    if args.write and (args.mutant or args.all):
        parser.error("--write is not for single mutants or all of them")
    known_names, names = names, args.modules or names
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))  # ends the simulators, too
    console = Console(width=140, emoji=False)
    rows, bad, broken = [], 0, []
    try:
        known = equivalents()
        with bars(console) as progress:
            for name in names:
                if args.list:
                    everything = work.prepare(name)[1]
                    for mutant in named(name, everything, args.mutant) if args.mutant else everything:
                        console.print(describe(name, mutant), markup=False, highlight=False, soft_wrap=True)
                    continue
                try:
                    cells, survivors, wrong, wanted, outcomes = module(name, args, progress, known)
                except work.Unknown:
                    rows.append([name, *["–"] * (len(HEADER) - 2), "not run"])
                    continue
                except (work.Broken, sites.Unreadable) as error:
                    print(f"mutants: {error}", file=sys.stderr)
                    broken.append(name)
                    continue
                rows.append(cells)
                console.print("  ".join(f"{t} {h}" if h != "module" else t for h, t in zip(HEADER, cells, strict=True)))
                for mutant in survivors:
                    console.print(describe(name, mutant), markup=False, highlight=False, soft_wrap=True)
                for mutant in wrong:
                    text = f"tb/mutants.toml lists as equivalent what {outcomes[mutant.number][1:]} finds:\n"
                    console.print(text + describe(name, mutant), markup=False, highlight=False, soft_wrap=True)
                if args.mutant:
                    for number, (outcome, detail, where) in outcomes.items():
                        console.print(f"mutant {number}: {outcome} {detail} {where}", markup=False)
                bad += len(survivors) + len(wrong)
    except (work.Broken, sites.Unreadable, ValueError, KeyError, OSError) as error:
        print(f"mutants: {error}", file=sys.stderr)
        return 2
    if args.list:
        return 0
    table = Table(title="mutants")
    for name in HEADER:
        table.add_column(name, justify="left" if name == "module" else "right")
    for cells in sorted(rows) + [total(rows)]:
        table.add_row(*cells)
    console.print(table)
    if broken:
        print(f"mutants: not run: {' '.join(broken)}", file=sys.stderr)
        return 2
    if args.write:
        kept = {name: cells for name, cells in read_table(PAGE, "mutants").items() if name in known_names}
        rows = sorted((kept | {cells[0]: cells for cells in rows}).values())
        write_table(PAGE, "mutants", HEADER, rows + [total(rows)])
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(status_of(main))
