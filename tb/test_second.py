# SPDX-License-Identifier: Apache-2.0
"""Where the simulators start: X under Icarus Verilog, random values under Verilator; a missing reset is found."""

import os
import re
import subprocess
import sys
from unittest.mock import patch

import cocotb
import pytest
from cocotb.triggers import Timer

import bench
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
