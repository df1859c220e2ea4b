# SPDX-License-Identifier: Apache-2.0
"""scripts/synth.py: cell counts of small modules, results that are kept, the wrapper, and what is refused."""

import importlib.util
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def load():
    """The script as a module."""
    spec = importlib.util.spec_from_file_location("synth_script", ROOT / "scripts" / "synth.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def synth(tmp_path, monkeypatch):
    """The script with a folder of its own for results and two small design points."""
    module = load()
    monkeypatch.setattr(module, "BUILD", tmp_path / "kept results")
    small = {"W": 8, "D": 1}
    points = {"tiny": module.Point("rdx_halve", small), "wrong": module.Point("rdx_halve", small | {"D": 7})}
    monkeypatch.setattr(module, "POINTS", points)
    return module


def test_counts_are_plausible_and_kept(synth, tmp_path, capsys):
    """One average, and two ends and the average through two registers; the second run says the same, without a tool."""
    out = tmp_path / "counts.json"
    rows = []
    for _ in range(2):
        assert synth.main(["tiny", "--no-pnr", "--json", str(out)]) == 0
        rows += json.loads(out.read_text())
        said = capsys.readouterr()
    assert rows[0] == rows[1]
    assert "(kept)" in said.out and not said.err
    assert rows[0]["parameters"] == {"W": 8, "D": 1}
    counts = rows[0]["counts"]
    assert 8 <= counts["lut4"] <= 16
    assert counts["ff"] == 2 * 3 * 8
    assert (counts["dsp"], counts["bram"]) == (0, 0)


def test_carry_and_memory_count_as_the_luts_they_occupy(synth):
    """A carry cell is two LUT4s, a distributed RAM six, multiplexers none; a cell that is not known is refused."""
    cells = {"LUT4": 3, "CCU2C": 5, "TRELLIS_DPR16X4": 2, "PFUMX": 7, "TRELLIS_FF": 11, "MULT18X18D": 1, "DP16KD": 2}
    assert synth.count(cells) == {"lut4": 25, "ff": 11, "dsp": 1, "bram": 2}
    with pytest.raises(synth.SynthError, match="ALU54B"):
        synth.count(cells | {"ALU54B": 1})


def test_wrapper_registers_every_port_bit(synth):
    """Three pins; a register before each input bit, a register and a place in the chain after each output bit."""
    ports = {
        "clk_i": {"direction": "input", "bits": [2]},
        "a_i": {"direction": "input", "bits": [3, 4]},
        "b_o": {"direction": "output", "bits": [5, 5, "1"]},  # the same net twice, and a constant
    }
    lut = {"type": "LUT4", "connections": {"A": [3], "B": [4], "C": ["0"], "D": ["0"], "Z": [5]}}
    netlist = {"modules": {"m": {"ports": ports, "cells": {"lut": lut}, "netnames": {}}, "LUT4": {}}}
    assert synth.wrap(netlist, "m") == {"lut4": 3, "ff": 2 + 2 * 3}
    module = netlist["modules"].pop("m")
    assert not netlist["modules"]
    assert {name: port["direction"] for name, port in module["ports"].items()} == {
        "clk_i": "input",
        "pin_i": "input",
        "pin_o": "output",
    }
    drivers = {}
    for name, cell in module["cells"].items():
        output = cell["connections"]["Q" if cell["type"] == "TRELLIS_FF" else "Z"][0]
        assert output not in drivers, name
        drivers[output] = name
    assert (drivers[3], drivers[4], drivers[5]) == ("wrapper.in.a_i[0]", "wrapper.in.a_i[1]", "lut")
    cells = module["cells"]
    assert [cells[f"wrapper.out.b_o[{i}]"]["connections"]["DI"] for i in range(3)] == [[5], [5], ["1"]]
    # from the pin at the end of the chain back over every output bit
    net, passed = module["ports"]["pin_o"]["bits"][0], []
    while net != "0":
        mixed = cells[drivers[cells[drivers[net]]["connections"]["DI"][0]]]["connections"]
        passed.append(drivers[mixed["B"][0]])
        net = mixed["A"][0]
    assert passed == [f"wrapper.out.b_o[{i}]" for i in (2, 1, 0)]


def test_sources_are_those_the_module_needs(synth):
    """A result depends on the files of its own module only."""
    modules, included = synth.parts("rdx_halve")
    assert [path.name for path in modules] == ["rdx_delay.sv", "rdx_halve.sv"]
    assert not included
    modules, included = synth.parts("rdx_core")
    assert {"rdx_pkg.sv", "rdx_ring.sv", "rdx_step.sv", "rdx_delay.sv"} < {path.name for path in modules}
    assert "rdx_types.svh" in [path.name for path in included]


def refused(synth, capsys, *arguments):
    """The one line that refuses the arguments."""
    assert synth.main(list(arguments)) == 2
    lines = [line for line in capsys.readouterr().err.splitlines() if not line.endswith("…")]
    assert len(lines) == 1, lines
    return lines[0]


def test_unknown_name(synth, capsys):
    """The line names what was found and what is allowed."""
    assert refused(synth, capsys, "tiny", "nonsense") == "synth: found nonsense; allowed: tiny, wrong"


def test_failing_tool(synth, capsys):
    """The module's own complaint and the log."""
    line = refused(synth, capsys, "wrong", "--no-pnr")
    assert "rdx_halve: D = 7; allowed: 1 to 4" in line
    assert "ERROR" in Path(line.split("log: ")[1]).read_text()


def test_unknown_module_or_parameter(synth, capsys):
    """What read_slang would ignore is refused, too."""
    synth.POINTS.update(module=synth.Point("rdx_nothing"), parameter=synth.Point("rdx_halve", {"Wide": 8}))
    assert "rdx_nothing" in refused(synth, capsys, "module", "--no-pnr")
    assert "no parameter Wide" in refused(synth, capsys, "parameter", "--no-pnr")


def test_table_is_written_with_clocks_only(synth, capsys):
    """--write without a clock, or with that of another seed, is refused."""
    for arguments in (["--no-pnr"], ["--seed", "2"]):
        assert "--write" in refused(synth, capsys, "--write", *arguments)


def test_what_a_point_aims_at_reaches_nextpnr(synth, tmp_path):
    """Clock and density of a point are nextpnr's options, once each; what others placed is not taken for it."""
    end = {"cell": "wrapper.in.a", "port": "Q"}
    path = {"from": "posedge c", "to": "posedge c", "path": [{"type": "logic", "delay": 1.0, "from": end, "to": end}]}
    used = {"TRELLIS_COMB": {"used": 9}, "TRELLIS_FF": {"used": 9}}
    report = {"fmax": {"c": {"achieved": 50.0}}, "critical_paths": [path], "utilization": used}

    class Recorder:
        """In place of the tools: remembers the commands, and has a report for each."""

        ended, commands = False, []

        def run(self, tool, command, log, cwd):
            """See :class:`synth.Tools`."""
            self.commands.append(command)
            (cwd / "report.json").write_text(json.dumps(report))
            return 1.0

    ports = {"clk_i": {"direction": "input", "bits": [2]}, "a_o": {"direction": "output", "bits": [3]}}
    netlist = {"modules": {"rdx_halve": {"ports": ports, "cells": {}, "netnames": {}}}}
    (tmp_path / "netlist.json").write_text(json.dumps(netlist))
    recorder, small = Recorder(), {"W": 8, "D": 1}
    plain, dense = synth.Point("rdx_halve", small), synth.Point("rdx_halve", small, target=75, density=0.5)
    for point in (plain, dense, plain, dense):
        figures, _, _ = synth.place(point, tmp_path, 1, recorder, lambda text: None)
        assert figures["fmax_mhz"] == 50.0
    assert len(recorder.commands) == 2
    first, second = ([command[command.index("--freq") + 1], command.count("--freq")] for command in recorder.commands)
    assert first == ["400", 1] and second == ["75", 1]
    assert "--placer-heap-beta" not in recorder.commands[0]
    assert recorder.commands[1][recorder.commands[1].index("--placer-heap-beta") + 1] == "0.5"


def test_rows_of_the_page_are_read_back():
    """The table in the page has rows of the script's design points, each with all columns but the time."""
    synth = load()
    rows = synth.read_table(synth.PAGE, "synthesis")
    assert rows and set(rows) <= set(synth.POINTS)
    assert {len(row) for row in rows.values()} == {len(synth.COLUMNS) - 1}


@pytest.mark.parametrize("name", load().POINTS)
def test_points_fit_their_modules(name):
    """The module of each design point of the script is there and has those parameters."""
    load().check(name)
