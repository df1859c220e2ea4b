#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Proofs of the RTL: yosys makes an and-inverter graph of a harness, ABC proves its assertions.

    scripts/formal.py                every proof of the table PROOFS
    scripts/formal.py ring merge     these only; make formal POINT=ring
    scripts/formal.py --write        renew the rows in docs/formal.md, too

Each proof is made three times: of the design; of what must be reachable under its assumptions; and of the design broken
on purpose, which has to be refuted. Results are kept in build/formal by what they depend on. docs/formal.md says what
is proved and how.

Exit status 0: everything as it should be; 1: something was not proved, reached or refuted; 2: bad input or a failed
tool.
"""

import argparse
import inspect
import json
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import pyosys
from rich.console import Console
from rich.table import Table

from formal_proofs import PROOFS
from raydix.blocks import read_table, write_table
from raydix.command import status_of
from raydix.files import RTL, named, sources, top_modules, top_sources
from raydix.progress import track
from synth import ROOT, YOSYS, SynthError, digest, keep, package

HARNESSES = ROOT / "tb" / "formal"
BUILD = ROOT / "build" / "formal"
PAGE = ROOT / "docs" / "formal.md"
ABC = Path(pyosys.__file__).parent / "yosys-abc"

PREPARE = ["hierarchy -check -top {top}", "flatten", "async2sync", "chformal -lower"]
PREPARE += [
    "setundef -undriven -anyseq",
    "setundef -anyseq",
    "opt_expr",
    "opt_clean",
    "memory_map -formal",
    "opt_clean",
]
PREPARE += ["formalff -clk2ff -ff2anyinit", "simplemap", "dffunmap", "techmap", "opt_clean", "aigmap", "opt_clean"]
ASSERTIONS = [
    "delete -output",
    "opt_clean",
    "write_aiger -I -B -L -zinit -no-startoffset -ywmap {stem}.json {stem}.aig",
]
NETLIST = ["write_aiger -ascii -symbols {stem}.aag"]


@dataclass
class Outcome:
    """What came out of one run: verdict is proved, bounded, refuted or open; text names what failed."""

    verdict: str
    text: str
    seconds: float


# ---- from sources to a graph ----


def files(proof, change=None):
    """Texts of the sources of a proof by file name, in the order in which they are read; ``change`` breaks one of them.

    Raises :class:`SynthError` where a replacement does not fit the source exactly once.
    """
    harnesses = {path.stem: path for path in sorted(HARNESSES.glob("*.sv"))}
    paths = {path.stem: path for path in (top_sources() if proof.of in top_modules() else sources())}
    unused = {stem for stem in harnesses if stem in paths and stem not in proof.stand_ins}
    paths |= {stem: path for stem, path in harnesses.items() if stem not in unused}
    texts = {stem: path.read_text() for stem, path in paths.items()}
    for name, old, new in [*proof.replace, *([change] if change else [])]:
        if name not in texts or texts[name].count(old) != 1:
            raise SynthError(f"{name}: to be replaced, but not there exactly once: {old!r}")
        texts[name] = texts[name].replace(old, new)
    found = named([proof.top], included() | texts)
    return {f"{stem}.sv": text for stem, text in texts.items() if stem in found}


def included():
    """Texts of the included files by name."""
    return {path.name: path.read_text() for folder in (RTL, HARNESSES) for path in sorted(folder.glob("*.svh"))}


def graph(proof, texts, folder, stem, defines, parameters, write):
    """Run yosys: ``stem`` with the endings that ``write`` names in ``folder``."""
    for name, text in (included() | texts).items():
        (folder / name).write_text(text)
    values = " ".join(f"-G {name}={value}" for name, value in parameters.items())
    macros = " ".join(f"-D {name}" for name in defines)
    commands = [f"read_slang --top {proof.top} -I . {macros} {values} {' '.join(texts)}", *PREPARE, *write]
    commands = [command.format(top=proof.top, stem=stem) for command in commands]
    program = [sys.executable, "-c", YOSYS, json.dumps(commands)]
    run = subprocess.run(program, cwd=folder, capture_output=True, text=True)
    if run.returncode:
        lines = [*run.stdout.splitlines(), *run.stderr.splitlines()]
        reasons = [line for line in lines if "error" in line.lower()] or lines[-1:]
        raise SynthError(f"yosys failed: {reasons[0].strip()}")


# ---- ABC ----


def abc(folder, *commands):
    """Output of ABC."""
    run = subprocess.run([ABC, "-q", "; ".join(commands)], cwd=folder, capture_output=True, text=True)
    if "Error:" in run.stdout or run.returncode:
        lines = [line for line in (run.stdout + run.stderr).splitlines() if line.strip()]
        raise SynthError(f"ABC failed: {next((line for line in lines if 'Error' in line), lines[-1:])}")
    return run.stdout


def names(folder, stem):
    """Names of the assertions in the order of the graph's outputs."""
    entries = json.loads((folder / f"{stem}.json").read_text())["asserts"]
    return [".".join(part.removeprefix("\\") for part in path) for path in entries]


def commands(proof, broken):
    """ABC commands of the proof's method; what is broken only has to be refuted, by the search for a counterexample."""
    kind, *depth = proof.method.split()
    if broken or kind == "bmc":
        return [f"bmc3 -F {proof.depth if broken else depth[0]} -T {proof.limit}"]
    if kind == "induction":
        return ["orpos", f"ind -F {depth[0]} -T {proof.limit}"]
    return [f"pdr -T {proof.limit}"]


def begins(proof, folder, stem):
    """Whether the assertions hold in the first clocks of an induction, unrolled; ABC's ``ind`` does not look there."""
    unroll = [f"frames -F {proof.method.split()[1]} -i", "strash", "orpos", "&get", "&fraig -y -C 10000", "&put"]
    text = abc(folder, f"read_aiger {stem}.aig", "fold -s", "strash", *unroll, "strash", "iprove", "print_status")
    return re.findall(r"Status = (-?\d+)", text)[-1] == "1"


def prove(proof, folder, stem, broken):
    """Ask ABC for all assertions of a graph.

    What is broken gets random inputs for some seconds first: the search for a counterexample goes from assertion to
    assertion, and one that holds can take it long.
    """
    start = time.monotonic()
    if not (listed := names(folder, stem)):
        raise SynthError(f"{proof.top} asserts nothing")
    for method in [*([[f"sim3 -F {proof.depth} -T 5"]] if broken else []), commands(proof, broken)]:
        text = abc(folder, f"read_aiger {stem}.aig", "fold -s", "strash", *method, "print_status")
        seconds = time.monotonic() - start
        if failed := re.search(r'Output (\d+) of miter "\S*" was asserted in frame (\d+)', text):
            return Outcome("refuted", f"{listed[int(failed[1])]}, clock {failed[2]}", seconds)
    status = re.findall(r"Status = (-?\d+)\s+Frames = (-?\d+)", text)[-1]
    kind, *depth = proof.method.split()
    if kind == "induction" and not broken and not begins(proof, folder, stem):
        text = abc(folder, f"read_aiger {stem}.aig", "fold -s", "strash", f"bmc3 -F {depth[0]} -T {proof.limit}")
        failed = re.search(r'Output (\d+) of miter "\S*" was asserted in frame (\d+)', text)
        seconds = time.monotonic() - start
        if failed:
            return Outcome("refuted", f"{listed[int(failed[1])]}, clock {failed[2]}", seconds)
        return Outcome("open", f"the first {depth[0]} clocks are not decided", seconds)
    if status[0] == "1":
        return Outcome("proved", f"{len(listed)} assertions", seconds)
    if status[0] == "0":
        return Outcome("refuted", f"clock {status[1]}", seconds)
    if kind == "bmc" and re.search(rf"No output failed in {depth[0]} frames", text):
        return Outcome("bounded", f"{len(listed)} assertions", seconds)
    return Outcome("open", "the method does not decide it", seconds)


def reach(proof, folder, stem):
    """See that each cover can be reached: (reached, missed), names with their clocks."""
    reached, missed = [], []
    for i, name in enumerate(names(folder, stem)):
        steps = ("&get", f"&cone -O {i}", "&put", f"bmc3 -F {proof.depth} -T {proof.limit}")
        text = abc(folder, f"read_aiger {stem}.aig", "fold -s", "strash", *steps)
        found = re.search(r"was asserted in frame (\d+)", text)
        (reached if found else missed).append(f"{name} {found[1]}" if found else name)
    return reached, missed


# ---- paths ----


def support(text):
    """Inputs on which each output of an ASCII graph depends without a register between: name -> names of inputs."""
    lines = text.splitlines()
    _, _, inputs, latches, outputs, gates = lines[0].split()
    inputs, latches, outputs, gates = int(inputs), int(latches), int(outputs), int(gates)
    at = 1 + inputs + latches
    symbols = dict(line.split(" ", 1) for line in lines[at + outputs + gates :] if re.match(r"[io]\d+ ", line))
    fan_in = {}
    for line in lines[at + outputs : at + outputs + gates]:
        gate, *operands = (int(number) >> 1 for number in line.split())
        fan_in[gate] = operands
    names = {int(lines[1 + i]) >> 1: symbols[f"i{i}"] for i in range(inputs) if f"i{i}" in symbols}
    result = {}
    for o in range(outputs):
        seen, new = set(), {int(lines[at + o]) >> 1}
        while new:
            seen |= new
            new = {operand for gate in new for operand in fan_in.get(gate, ())} - seen
        result[symbols[f"o{o}"]] = {names[gate] for gate in seen & names.keys()}
    return result


def paths(folder, stem):
    """See that no valid output depends on a ready input."""
    start = time.monotonic()
    found = support((folder / f"{stem}.aag").read_text())
    valid = {name: inputs for name, inputs in found.items() if re.match(r"(.*_)?t?valid_o\b", name)}
    ready = {name for inputs in found.values() for name in inputs if re.match(r"(.*_)?t?ready_i\b", name)}
    if not valid:
        raise SynthError("no output is named valid_o")
    bad = [f"{name} depends on {i}" for name, inputs in valid.items() for i in sorted(inputs & ready)]
    text = ", ".join(bad) or f"{len(valid)} valid, {len(ready)} ready"
    return Outcome("refuted" if bad else "proved", text, time.monotonic() - start)


# ---- one proof ----


def decide(proof, change, folder):
    """All stages of a proof; ends at the first that is not proved."""
    texts = files(proof, change)
    if proof.method == "paths":
        graph(proof, texts, folder, "paths", ["SYNTHESIS"], proof.parameters, NETLIST)
        return paths(folder, "paths")
    if change:  # all lemmas at once
        last = proof.parameters | ({"Stage": proof.stages - 1} if proof.stages > 1 else {})
        graph(proof, texts, folder, "proof", ["RDX_FORMAL", "RDX_ALL"], last, ASSERTIONS)
        return prove(proof, folder, "proof", True)
    seconds, count = 0.0, 0
    for stage in range(proof.stages):
        parameters = proof.parameters | ({"Stage": stage} if proof.stages > 1 else {})
        graph(proof, texts, folder, "proof", ["RDX_FORMAL"], parameters, ASSERTIONS)
        outcome = prove(proof, folder, "proof", False)
        seconds += outcome.seconds
        if outcome.verdict not in ("proved", "bounded"):
            return Outcome(outcome.verdict, f"stage {stage}: {outcome.text}", seconds)
        count += int(outcome.text.split()[0])
    return Outcome(outcome.verdict, f"{count} assertions", seconds)


def covers(proof, folder):
    """Covers of a proof: (reached, missed)."""
    if proof.method == "paths":
        return [], []
    parameters = proof.parameters | ({"Stage": proof.stages - 1} if proof.stages > 1 else {})
    graph(proof, files(proof), folder, "reach", ["RDX_FORMAL", "RDX_REACH"], parameters, ASSERTIONS)
    return reach(proof, folder, "reach")


def run(name):
    """One proof with its covers and its broken variants: a dictionary for JSON."""

    def say(part):
        print(f"formal: {name}: {part} …", file=sys.stderr, flush=True)

    proof = PROOFS[name]
    code = [
        inspect.getsource(part)
        for part in (files, graph, commands, begins, prove, reach, support, paths, decide, covers)
    ]
    key = digest(package("pyosys"), YOSYS, PREPARE, ASSERTIONS, NETLIST, code, repr(proof))
    key = digest(key, files(proof), included())
    kept = BUILD / f"{name}-{key}.json"
    if kept.exists():
        return json.loads(kept.read_text()) | {"kept": True}
    BUILD.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix=f"{name}-", dir=BUILD) as work:
        folder = Path(work)
        say("proof")
        outcome = decide(proof, None, folder)
        say("reach")
        reached, missed = covers(proof, folder)
        broken = []
        for i, change in enumerate(proof.broken):
            say(f"broken {i + 1}")
            got = decide(proof, change, folder)
            broken.append({"change": change, "verdict": got.verdict, "text": got.text})
    result = {"name": name, "verdict": outcome.verdict, "text": outcome.text, "seconds": outcome.seconds}
    result |= {"reached": reached, "missed": missed, "broken": broken, "all_seconds": time.monotonic() - start}
    keep(kept, result)
    return result


def covered(result):
    """Covers of a proof, reached and missed; the offers of inner streams are wanted only of the proofs of streams."""
    harness = PROOFS[result["name"]].top.startswith("formal_")
    wanted = [[n for n in result[k] if not (harness and "_offer" in n)] for k in ("reached", "missed")]
    return wanted[0], wanted[1]


def faults(result):
    """What is not as it should be, in words."""
    wanted = "bounded" if PROOFS[result["name"]].method.startswith("bmc") else "proved"
    if result["verdict"] not in (wanted, "proved"):
        yield f"{result['verdict']}: {result['text']}"
    for name in covered(result)[1]:
        yield f"not reached: {name}"
    for broken in result["broken"]:
        if broken["verdict"] != "refuted":
            yield f"broken on purpose, and {broken['verdict']}: {broken['change'][2]!r} in {broken['change'][0]}"


# ---- output ----

COLUMNS = ("name", "of, parameters", "what holds", "method", "reached", "broken", "time, s", "verdict")


def method(proof):
    """The method in words."""
    kind, *depth = proof.method.split()
    words = {"pdr": "PDR", "induction": "{}-induction", "bmc": "BMC, {} clocks", "paths": "paths"}
    text = words[kind].format(*depth)
    return f"{text}, {proof.stages} stages" if proof.stages > 1 else text


def texts(result):
    """The text of a row's cells."""
    proof = PROOFS[result["name"]]
    of = " ".join([proof.of, *(f"{name}={value}" for name, value in proof.parameters.items())])
    refuted = sum(broken["verdict"] == "refuted" for broken in result["broken"])
    reached, missed = covered(result)
    total = len(reached) + len(missed)
    counts = [f"{len(reached)} of {total}" if total else "–", f"{refuted} of {len(result['broken'])} refuted"]
    return [result["name"], of, proof.says, method(proof), *counts, f"{result['seconds']:.1f}", result["verdict"]]


def main(arguments=None):
    """Prove, print; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", nargs="*", metavar="NAME", help=f"proofs: {', '.join(PROOFS)}")
    parser.add_argument("--write", action="store_true", help="renew the rows of these proofs in docs/formal.md")
    options = parser.parse_args(arguments)
    if unknown := [name for name in options.name if name not in PROOFS]:
        print(f"formal: found {', '.join(unknown)}; allowed: {', '.join(PROOFS)}", file=sys.stderr)
        return 2
    chosen, rows, wrong = options.name or list(PROOFS), [], []
    try:
        for name in track(chosen, "proofs"):
            rows.append(result := run(name))
            wrong += [f"{name}: {fault}" for fault in faults(result)]
    except (SynthError, OSError) as error:
        print(f"formal: {name}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("formal: interrupted; what was finished is kept in build/formal", file=sys.stderr)
        return 130
    table = Table(title="proofs")
    for column in COLUMNS:
        table.add_column(column)
    for row in rows:
        table.add_row(*texts(row))
    Console(width=None if sys.stdout.isatty() else 200).print(table)
    for row in rows:
        for broken in row["broken"]:
            file, old, new = broken["change"]
            print(f"{row['name']}: {file}: {old.strip()!r} → {new.strip()!r}: {broken['verdict']}: {broken['text']}")
    print(f"{len(rows)} proofs, {sum(row['all_seconds'] for row in rows):.0f} s, {len(wrong)} faults")
    for line in wrong:
        print(f"formal: {line}", file=sys.stderr)
    if options.write and not wrong:
        cells = {row["name"]: [cell.replace("|", "\\|") for cell in texts(row)] for row in rows}
        kept = {name: row for name, row in read_table(PAGE, "proofs").items() if name in PROOFS} | cells
        write_table(PAGE, "proofs", COLUMNS, [kept[name] for name in PROOFS if name in kept])
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(status_of(main))
