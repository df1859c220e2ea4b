# SPDX-License-Identifier: Apache-2.0
"""A module for the second simulator, Icarus Verilog, whose signals have four states: everything begins as X.

Icarus does not read the sources. yosys reads them and writes them as plain Verilog, without an optimisation: every
register, memory and operator of the source is there, and an X at a choice becomes an X of what depends on it. The
netlist has flat ports and no parameters; a shell around it has both again, under the names that the tests use.
"""

import contextlib
import hashlib
import inspect
import json
import os
import re
import shutil
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import netlist
from raydix.building import building
from raydix.files import ROOT, RTL, reached

BUILD = ROOT / "build" / "second"
MISSING = "iverilog is missing (Debian: apt-get install iverilog)"

# -noopt and pmuxtree: what an X does is for the simulator to find out; a casez would take X for no match.
# bmuxmap: a table is a tree, whose nets are split; write_verilog would make one net of each level, anew at a change.
PASSES = (
    "proc -noopt",
    "pmuxtree",
    "bwmuxmap",
    "bmuxmap",
    "opt_clean",
    "splitnets -driver",
    "rename {top} {top}_netlist",
    "write_verilog -noattr {out}",
)
YOSYS = """
import json, sys
from pyosys import libyosys
design = libyosys.Design()
for command in json.loads(sys.argv[1]):
    libyosys.run_pass(command, design)
"""

# Icarus does some hundred clocks a second of the largest modules. Of their tests only these are run: name of the test
# file, and names of cocotb tests.
SLOW = {
    "test_algebraic": ("equals_model/idle=0.8/stall=0.3", "reset_empties"),
    "test_core": ("equals_golden/scene=torus/rule=certified",),
    "test_top": (
        "frames_equal_golden/stall=0.4",
        "reset_in_a_frame/after=900",
        "reset_leaves_the_constants",
        "empty_frame_is_background",
    ),
    "test_ring": ("equals_model/idle=0.3/stall=0.3", "reset_empties"),
    "test_rings": ("equals_model/idle=0.6/stall=0.3", "reset_empties"),
    "test_vector": ("reset_makes_idle",),
}


def tested():
    """Names, without ``rdx_``, of the modules that have a test file."""
    names = (path.stem.removeprefix("test_") for path in (ROOT / "tb").glob("test_*.py"))
    return sorted(name for name in names if (RTL / f"rdx_{name}.sv").exists())


def chosen(module, checks):
    """Names of the cocotb tests of the test file ``module`` to be run, None for all."""
    return [name for name in SLOW[module] if not checks or name in checks] if module in SLOW else checks


def left_out(toplevel):
    """For the table: which tests of a module are not run."""
    names = SLOW.get(toplevel.replace("rdx_", "test_"))
    return f"slow: all tests but {', '.join(names)}" if names else ""


def record(**facts):
    """Append what a run gave to the file that RAYDIX_RECORD names, if there is one; ``scripts/second.py`` reads it."""
    if os.environ.get("RAYDIX_RECORD"):
        with open(os.environ["RAYDIX_RECORD"], "a") as out:
            out.write(json.dumps(facts) + "\n")


def found():
    """Whether Icarus Verilog is installed."""
    return shutil.which("iverilog") is not None


def elaborate(toplevel, parameters, files):
    """What slang finds: ports (name, whether an input, bits of an element, elements, whether scalar); parameters.

    The number of elements is None for a port that is not an unpacked array. Raises RuntimeError where slang objects.
    """
    import pyslang

    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    names = " ".join(f'"{p}"' for p in files)
    values = " ".join(f"-G {name}={value}" for name, value in parameters.items())
    read = driver.parseCommandLine(f'slang --top {toplevel} -I "{RTL}" -D SYNTHESIS {values} {names}')
    if not (read and driver.processOptions() and driver.parseAllSources()):
        raise RuntimeError(f"{toplevel} {parameters}: slang cannot read it")
    body = driver.createCompilation().getRoot().topInstances[0].body
    ports = []
    for port in body.portList:
        count, kind = None, port.type
        while kind.isUnpackedArray:
            count, kind = (count or 1) * kind.fixedRange.width, kind.elementType
        ports.append((port.name, port.direction.name == "In", kind.bitWidth, count, kind.isScalar))
    # whole numbers; not a table, which no test reads and Icarus does not
    numbers = [p for p in body.parameters if isinstance(p, pyslang.ast.ParameterSymbol) and p.type.isIntegral]
    numbers = [p for p in numbers if p.type.bitWidth <= 64]
    return ports, [(p.name, str(p.value)) for p in numbers]


def build(toplevel, parameters, files=None):
    """Folder with the compiled ``sim.vvp`` of ``toplevel``; built unless the same sources were built before.

    files   the sources; all that the toplevel needs, if not given
    Raises RuntimeError where a tool fails.
    """
    from cocotb_tools.runner import get_runner

    files = list(files or reached(toplevel))
    icarus = subprocess.run(["iverilog", "-V"], capture_output=True, text=True).stdout.splitlines()[0]
    tools = [
        version("pyosys"),
        version("pyslang"),
        version("cocotb"),
        icarus,
        PASSES,
        inspect.getsource(elaborate),
        Path(netlist.__file__).read_text(),
    ]
    contents = [p.read_text() for p in (*files, *sorted(RTL.glob("*.svh")))]
    facts = json.dumps([toplevel, sorted(parameters.items()), tools, contents]).encode()
    target = BUILD / f"{toplevel}-{hashlib.sha256(facts).hexdigest()[:20]}"
    if (target / "sim.vvp").exists():
        return target
    with building(BUILD) as folder:
        work, log = folder / "work", BUILD / f"{target.name}.log"
        work.mkdir()
        ports, values = elaborate(toplevel, parameters, files)
        outer, inner = work / "shell.v", work / "netlist.v"
        read = f"read_slang --top {toplevel} -I {RTL} -D SYNTHESIS "
        read += " ".join([*(f"-G {name}={value}" for name, value in parameters.items()), *map(str, files)])
        commands = [read, *(p.format(top=toplevel, out=inner) for p in PASSES)]
        with open(log, "w") as out:
            program = [sys.executable, "-c", YOSYS, json.dumps(commands)]
            status = subprocess.run(program, stdout=out, stderr=subprocess.STDOUT, cwd=ROOT).returncode
        if status:
            raise RuntimeError(f"{toplevel} {parameters}: yosys fails; log: {log}")
        text = inner.read_text()
        if re.search(r"\binitial\b|^  reg .*=", text, re.M):
            raise RuntimeError(f"{toplevel} {parameters}: the netlist has initial values")
        inner.write_text(netlist.unknown_writes(text))
        outer.write_text(netlist.shell(toplevel, ports, values, text))
        try:
            get_runner("icarus").build(
                hdl_toplevel=toplevel, sources=[outer, inner], build_dir=work, log_file=log,
            )  # fmt: skip
        except RuntimeError as error:
            tail = "\n".join(log.read_text().splitlines()[-15:])
            raise RuntimeError(f"{toplevel} {parameters}: iverilog fails; log: {log}\n{tail}") from error
        with contextlib.suppress(OSError):  # another worker was first
            os.replace(work, target)
        log.unlink(missing_ok=True)
    return target
