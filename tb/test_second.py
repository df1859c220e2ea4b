# SPDX-License-Identifier: Apache-2.0
"""Where the simulators start: X under Icarus Verilog, random values under Verilator; a missing reset is found."""

import os
import re
import subprocess
import sys
from unittest.mock import patch

import cocotb
import pytest
from cocotb.triggers import FallingEdge, Timer
from cocotb.types import LogicArray

import bench
import netlist
import second
from raydix.blocks import read_table
from raydix.files import ROOT, RTL

WIDTH = 173


@cocotb.test
async def starts_unknown(dut):
    """Nothing is known before the first clock, inputs included."""
    await Timer(1, unit="ns")
    for name in ("valid_o", "ready_o", "data_o", "data_i", "rst_ni"):
        assert set(str(getattr(dut, name).value)) == {"X"}, name


@cocotb.test
async def starts_random(dut):
    """The register without a reset holds neither zeros nor ones, and the seed is that of the run."""
    await Timer(1, unit="ns")
    ones = f"{int(dut.data_o.value):b}".count("1")
    assert 40 < ones < WIDTH - 40, f"{ones} of {WIDTH} bits"


@pytest.fixture
def icarus():
    """The second simulator in place of Verilator."""
    if not second.found():
        pytest.skip(second.MISSING)
    with patch.dict(os.environ, SIMULATOR="icarus"):
        yield


def test_unknown_at_the_start(icarus):
    """Four states, and no initial values."""
    bench.run(__name__, "rdx_register", dict(W=WIDTH), ["starts_unknown"])


@pytest.mark.parametrize("seed", [1, 0x7FFFFFFF])
def test_random_at_the_start(seed):
    """Verilator: random values of the run's seed."""
    with patch.dict(os.environ, SIMULATOR="verilator", SEED=str(seed)):
        bench.run(__name__, "rdx_register", dict(W=WIDTH), ["starts_random"])


CASES = [
    ("register", dict(W=32)),
    ("halve", dict(W=16, D=3, Stages=2)),
    ("slots", dict(Slots=5, Phases=3)),
    ("multiply", {}),
]


@pytest.mark.parametrize(("module", "parameters"), CASES, ids=[module for module, _ in CASES])
def test_module(icarus, module, parameters):
    """The tests of modules with a stream, with unpacked arrays, with a memory, with parts of a signed vector."""
    bench.run(f"test_{module}", f"rdx_{module}", parameters, {"halve": ["equals_model"]}.get(module))


BREAKS = [
    ("rdx_register", "if (!rst_ni) valid_o <= 1'b0;\n    else if", "if"),
    ("rdx_slots", "filled_o <= 1'b0;", ""),
    ("rdx_merge", "if (!rst_ni) turn_q <= '0;\n    else if", "if"),
]


@pytest.mark.parametrize(("module", "old", "new"), BREAKS, ids=[module for module, *_ in BREAKS])
def test_missing_reset_is_found(icarus, monkeypatch, tmp_path, capfd, module, old, new):
    """Without the reset of a register of control an output of control is unknown."""
    text = (RTL / f"{module}.sv").read_text()
    assert text.count(old) == 1
    broken = tmp_path / f"{module}.sv"
    broken.write_text(text.replace(old, new))
    files = [broken if p.name == broken.name else p for p in second.reached(module)]
    monkeypatch.setattr(second, "reached", lambda top: files)
    with pytest.raises(AssertionError):
        bench.run(f"test_{module.removeprefix('rdx_')}", module)
    assert re.search("unknown output of control|non-0/1 values|Logic\\('X'\\)", capfd.readouterr().out)


MEMORY = """\
module rdx_memory (
    input  wire logic       clk_i,
    input  wire logic       we_i,
    input  wire logic [1:0] at_i,
    input  wire logic [3:0] data_i,
    output logic      [3:0] words_o[4]
);
  logic [3:0] words[4];
  always_ff @(posedge clk_i) if (we_i) words[at_i] <= data_i;
  always_comb for (int i = 0; i < 4; i++) words_o[i] = words[i];
endmodule
"""


@cocotb.test
async def unknown_write(dut):
    """A write that may happen leaves its word unknown, one to anywhere all words; so does the next test's start."""
    dut.we_i.value = dut.at_i.value = 0
    await bench.start(dut)

    async def write(enable, place, value):
        dut.we_i.value, dut.at_i.value, dut.data_i.value = LogicArray(enable), LogicArray(place), value
        await FallingEdge(dut.clk_i)
        return bench.Port(dut, "words_o").read()

    assert bench.Port(dut, "words_o").read() == [None] * 4
    for place in range(4):
        words = await write("1", f"{place:02b}", place + 5)
    assert words == [5, 6, 7, 8]
    assert await write("0", "XX", 9) == [5, 6, 7, 8]
    assert await write("1", "10", 9) == [5, 6, 9, 8]
    assert await write("X", "01", 9) == [5, None, 9, 8]
    assert await write("1", "1X", 9) == [None] * 4
    await write("1", "00", 5)


@cocotb.test
async def unknown_write_again(dut):
    """The same after it: what the first test left is forgotten."""
    await unknown_write.func(dut)


def test_unknown_write(icarus, monkeypatch, tmp_path):
    """Memories know no more than what was surely written, and nothing at the start of a test."""
    source = tmp_path / "rdx_memory.sv"
    source.write_text(MEMORY)
    monkeypatch.setattr(second, "reached", lambda top: [source])
    bench.run(__name__, "rdx_memory", {}, ["unknown_write", "unknown_write_again"])


def test_every_register_is_forgotten():
    """Parts of registers, too; a declaration of a form that is not known is an error."""
    text = "module m;\n  reg [67:65] \\a.b[67:65] ;\n  reg c;\n  reg [3:0] d [7:2];\n"
    lines = list(netlist.forgotten(text))
    assert lines[:2] == ["netlist.\\a.b[67:65] = 'bx;", "netlist.c = 'bx;"]
    assert lines[2] == "for (place = 2; place <= 7; place = place + 1) netlist.d [place] = 'bx;"
    with pytest.raises(RuntimeError, match="of another form"):
        list(netlist.forgotten(text + "  reg [3:0] e = 1;\n"))
    with pytest.raises(RuntimeError, match="of another form: else d"):
        netlist.unknown_writes(text + "    else d [0] <= c;\n")


@pytest.mark.parametrize(
    ("arguments", "path", "line"),
    [
        (["nonsense", "ring"], os.environ["PATH"], "second: found nonsense; allowed: advance, algebraic, "),
        (["register"], "/nonexistent", f"second: {second.MISSING}\n"),
    ],
    ids=["unknown module", "no Icarus"],
)
def test_one_line_refuses(arguments, path, line):
    """A clear line and exit status 2."""
    command = [sys.executable, str(ROOT / "scripts" / "second.py"), *arguments]
    run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": path})
    assert run.returncode == 2 and run.stderr.startswith(line) and run.stderr.count("\n") == 1, run.stderr


def test_every_module_has_a_row():
    """The table of the second simulator has a row for each module with a test, and no other; all tests passed."""
    rows = read_table(ROOT / "docs" / "verification.md", "second")
    assert sorted(rows) == [f"rdx_{name}" for name in second.tested()]
    for name, (_, sets, tests, passed, _) in rows.items():
        assert int(sets) > 0 and int(tests) > 0 and tests == passed, name
