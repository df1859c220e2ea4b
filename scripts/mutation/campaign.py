# SPDX-License-Identifier: Apache-2.0
"""Mutants of one module against its own tests: which are found, by what; results are kept in ``build/mutants``."""

import contextlib
import hashlib
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

import bench
from raydix import coverpoints
from raydix.files import GENERATED_CONTROL, ROOT, RTL, environment, reached, top_modules, written

from . import schema, sites

PLACE = ROOT / "build" / "mutants"
SEED = "1"
LIMIT = 3  # times the computing time of the module as it is, and 2 s

# module     of the tests: test_<name>
# toplevel, parameters, checks    as in bench.run
Call = namedtuple("Call", "module toplevel parameters checks")


class Unknown(RuntimeError):
    """Results are missing and nothing may be run."""


class Broken(RuntimeError):
    """The tests fail, or nothing can be built, without any mutant."""


def names():
    """Modules that have a test, their own or that of the module they are a part of."""
    return [p.stem[4:] for p in written() if not p.stem.endswith("pkg")]


def source(name):
    """File of a module."""
    return RTL / f"rdx_{name}.sv"


def digest(name, *more):
    """What the outcome of a mutant depends on, and ``more``."""
    owner = coverpoints.owner(name)
    files = [*reached(f"rdx_{owner}"), *sorted(RTL.glob("*.svh"))]
    facts = [*(p.read_bytes() for p in files), coverpoints.texts(f"test_{owner}"), *more]
    return hashlib.sha256(b"".join(facts)).hexdigest()[:20]


def size(parameters):
    """Guess of what a run with these parameters costs. Vector sums have large evaluators."""
    vector = parameters.get("D") == 1 and "Lanes" in parameters
    return math.prod(max(1, abs(v)) for v in parameters.values()) * (1000 if vector else 1)


def calls(name):
    """The simulations of a module's test, the cheapest first."""
    owner = coverpoints.owner(name)
    with tempfile.TemporaryDirectory() as folder:
        noted = Path(folder, "calls")
        noted.touch()
        paths = os.pathsep.join([str(ROOT / "tb"), str(ROOT / "scripts"), os.environ.get("PYTHONPATH", "")])
        command = [sys.executable, "-m", "pytest", "-q", "-p", "mutation.record", "-p", "no:cacheprovider", "-n", "0"]
        run = subprocess.run(
            [*command, str(ROOT / "tb" / f"test_{owner}.py")],
            cwd=ROOT, env={**os.environ, "RDX_CALLS": str(noted), "PYTHONPATH": paths}, capture_output=True, text=True,
        )  # fmt: skip
        if run.returncode:
            raise Broken(f"tb/test_{owner}.py fails as it is:\n" + "\n".join(run.stdout.splitlines()[-15:]))
        found = [Call(*json.loads(line)) for line in noted.read_text().splitlines()]
    return sorted((c for c in found if c.toplevel == f"rdx_{owner}"), key=lambda c: size(c.parameters))


def label(call):
    """Parameters and checks of a call, as text."""
    return f"{bench.label(call.parameters)} {' '.join(call.checks or ['all'])}"


def refused(top, parameters, path, text, mutants):
    """Numbers of the mutants in whose lines Verilator finds errors."""
    with tempfile.TemporaryDirectory() as folder:
        changed = Path(folder, path.name)
        changed.write_text(text)
        files = [str(changed if p == path else p) for p in reached(top)]
        command = ["verilator", "--lint-only", "--assert", f"-I{RTL}", "--top-module", top]
        command += [*(f"-G{n}={v}" for n, v in parameters.items())]
        command += [*([str(GENERATED_CONTROL)] if top in top_modules() else []), *files]
        run = subprocess.run(command, env=environment(), capture_output=True, text=True)
    if run.returncode == 0:
        return set()
    lines = {int(n) for n in re.findall(rf"{re.escape(str(changed))}:(\d+):", run.stdout + run.stderr)}
    found = {m.number for m in mutants if m.line in lines}
    if not found:
        raise Broken(f"{top} {parameters}: Verilator refuses the mutants\n{run.stderr[-2000:]}")
    return found


def mutants(name, tests):
    """All mutants of a module, and for each set of parameters the numbers of those that it can run."""
    path = source(name)
    text = path.read_text()
    own = set(re.findall(r"^ +parameter .*?(\w+) =", text, re.M))
    found = {}
    for call in tests:
        key = json.dumps(call.parameters, sort_keys=True)
        if key not in found:
            parameters = {name: value for name, value in call.parameters.items() if name in own}
            found[key] = sites.find(path.stem, parameters, path, reached(path.stem), RTL)
    union = {site for sites_ in found.values() for site in sites_}
    numbered = schema.number(
        text, sorted(union, key=lambda s: (s.start, -s.end, sites.OPERATORS.index(s.operator), s.new))
    )
    runs = {}
    for key, mine in found.items():
        inside = [m for m in numbered if m.site in set(mine)]
        top, parameters = tests[0].toplevel, json.loads(key)
        while bad := refused(top, parameters, path, schema.rewrite(text, inside), inside):
            inside = [m for m in inside if m.number not in bad]
        runs[key] = {m.number for m in inside}
    able = set().union(*runs.values()) if runs else set()
    return [m for m in numbered if m.number in able], runs


def cached(file, compute):
    """The content of a JSON file, made by ``compute`` if there is none."""
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        content = json.dumps(compute())
        file.with_suffix(".part").write_text(content)
        file.with_suffix(".part").replace(file)
    return json.loads(file.read_text())


def prepare(name, kept=False):
    """Simulations, mutants, and the numbers of mutants that each set of parameters can run, from the cache if there.

    kept   compute nothing: raise :class:`Unknown`
    """

    def compute():
        tests = calls(name)
        if not tests:
            raise Broken(f"tb/test_{coverpoints.owner(name)}.py does not simulate rdx_{coverpoints.owner(name)}")
        everything, runs = mutants(name, tests)
        return [tests, everything, {key: sorted(numbers) for key, numbers in runs.items()}]

    tools = [Path(module.__file__).read_bytes() for module in (sites, schema)]
    file = PLACE / name / f"{digest(name, *tools)}.json"
    if kept and not file.exists():
        raise Unknown(name)
    tests, everything, runs = cached(file, compute)
    everything = [schema.Mutant(m[0], sites.Site(*m[1]), *m[2:]) for m in everything]
    return [Call(*c) for c in tests], everything, {key: set(numbers) for key, numbers in runs.items()}


def simulate(call, file, text, numbers, jobs, log, each):
    """Run the mutants ``numbers`` in one build with ``text`` in place of the RTL file ``file`` (a path).

    log    file for what the tools print
    each   called with each result (see ``serve``), the one of 0, no mutant, excepted
    Raises :class:`Broken` where the tests fail without a mutant or the run ends early.
    """
    with tempfile.TemporaryDirectory() as folder:
        changed, lines, spec = (Path(folder, n) for n in (file.name, "lines", "spec.json"))
        changed.write_text(text)
        lines.touch()
        order = dict(mutants=[0, *numbers], module=call.module, jobs=jobs, factor=LIMIT)
        order |= dict(results=str(lines), space=folder)
        spec.write_text(json.dumps([order, call, str(changed)]))
        paths = os.pathsep.join([str(ROOT / "tb"), str(ROOT / "scripts"), os.environ.get("PYTHONPATH", "")])
        settings = {**os.environ, "SEED": SEED, "WAVES": "", "PYTHONPATH": paths}
        command = [sys.executable, "-m", "mutation.simulate", str(spec)]
        with log.open("w") as out:
            process = subprocess.Popen(command, env=settings, stdout=out, stderr=out, start_new_session=True)
        done = 0
        try:
            while True:
                ended = process.poll() is not None
                for fields in map(json.loads, lines.read_text().splitlines()[done:]):
                    done += 1
                    if fields["mutant"]:
                        each(fields)
                    elif fields["outcome"] != "survived":
                        why = f"{fields['outcome']} {fields['detail']}\n{fields['log']}"
                        raise Broken(f"{call.toplevel} {label(call)} fails without a mutant: {why}")
                if ended:
                    break
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(0.2)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGTERM)
                process.wait()
        if done != len(numbers) + 1:
            raise Broken(
                f"{call.toplevel} {label(call)}: {done} results of {len(numbers) + 1}\n{log.read_text()[-3000:]}"
            )


class Results:
    """What is known of a module's mutants: a file of JSON lines, so that an interrupted run goes on where it was."""

    def __init__(self, name, everything):
        self.file = PLACE / name / f"{digest(name, repr([m.site for m in everything]).encode())}.jsonl"
        self.file.parent.mkdir(parents=True, exist_ok=True)
        self.file.touch()

    def read(self):
        """{mutant: {label of the call: line}}."""
        known = {}
        for line in self.file.read_text().splitlines():
            fields = json.loads(line)
            known.setdefault(fields["mutant"], {})[fields["call"]] = fields
        return known


def verdict(lines):
    """(outcome, detail, label) of a mutant from its lines: what has killed it, else survived."""
    for where, line in (lines or {}).items():
        if line["outcome"] != "survived":
            return line["outcome"], line["detail"], where
    return "survived", "", ""


def campaign(name, wanted, tests, runs, results, equal, jobs, progress, kept=False):
    """Run the ``wanted`` mutants, a set of parameters after the other, until each is killed or has survived all.

    First comes the smallest of those sets that can run nearly as much of what is left as any. Nothing is built only
    for mutants of ``equal`` (numbers), which are listed as equivalent; they run where others do.
    progress   called with the set's name and with the line of the result, None before it is built
    kept       run nothing: raise :class:`Unknown` where a result is missing
    Returns {mutant: (outcome, detail, label)}. Raises :class:`Broken`.
    """
    text = source(name).read_text()
    numbers = {m.number for m in wanted}
    tests = list(tests)
    while tests:
        known = results.read()
        able = {i: runs[json.dumps(c.parameters, sort_keys=True)] & numbers for i, c in enumerate(tests)}
        left = {i: {n for n in able[i] if verdict(known.get(n))[0] == "survived"} for i in able}
        most = max(len(numbers) for numbers in left.values())
        first = min((i for i in able if len(left[i]) >= 0.8 * most), key=lambda i: size(tests[i].parameters))
        call, mine = tests.pop(first), sorted(left[first])
        mine = [n for n in mine if label(call) not in known.get(n, {})]
        if set(mine) - equal:
            if kept:
                raise Unknown(name)
            progress(f"{bench.label(call.parameters)}: build", None)
            changed = schema.rewrite(text, [m for m in wanted if m.number in able[first]])

            def each(fields, call=call):
                with results.file.open("a") as file:
                    print(json.dumps({**fields, "call": label(call)}), file=file)
                progress(bench.label(call.parameters), fields)

            simulate(call, source(name), changed, mine, jobs, PLACE / name / "log", each)
    known = results.read()
    return {n: verdict(known.get(n)) for n in sorted(numbers)}
