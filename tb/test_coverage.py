# SPDX-License-Identifier: Apache-2.0
"""Coverage: a small module's counts are made, read and merged as they are meant; a gap is reported unless waived."""

import os
import re
import sys

import cocotb
import pytest
from cocotb.triggers import FallingEdge

import bench
from raydix import coverpoints
from raydix.coverpoints import Point, Row
from raydix.files import ROOT, sources, written
from scripting import scripts

MODULE = """module rdx_small (
    input wire logic clk_i, input wire logic rst_ni, input wire logic [3:0] count_i, output logic [3:0] sum_o
);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      sum_o <= 4'd0;
    end else if (count_i == 4'd9) begin
      sum_o <= 4'd1;
    end else begin
      sum_o <= count_i;
    end
  end
endmodule
"""
COVER = """`include "rdx_cover.svh"
module rdx_small_cover (input wire logic clk_i, input wire logic rst_ni, input wire logic [3:0] count_i);
  for (genvar i = 0; i < 3; i++) begin : gen_count
    `RDX_COVER(seen, count_i == 4'(i))
  end
  `RDX_COVER_NOW(eight, count_i == 4'd8)
  `RDX_COVER_RUN(one_out_of_reset, count_i == 4'd1)
  `RDX_COVER(in_reset, !rst_ni)
  `RDX_COVER_RUN(in_reset_out_of_reset, !rst_ni)
endmodule
bind rdx_small rdx_small_cover u_cover (.*);
"""
WANTED = """{file}:7: block end else if (count_i == 4'd9) begin if
{file}:2: toggle rst_ni 1->0
{file}:2: toggle count_i 2:0->1 2:1->0
{file}:2: toggle sum_o 2:0->1 2:1->0
{cover}:4: bin gen_count[2].seen
{cover}:9: bin in_reset_out_of_reset"""


async def drive(dut, counts):
    """Each of ``counts`` for a clock."""
    dut.count_i.value = 0
    await bench.start(dut)
    for count in counts:
        dut.count_i.value = count
        await FallingEdge(dut.clk_i)


@cocotb.test
async def low(dut):
    """Bit 0 rises and falls."""
    await drive(dut, (0, 1, 0, 1, 0))


@cocotb.test
async def high(dut):
    """Bits 1 and 3 rise and fall; nothing ends with a 9."""
    await drive(dut, (0, 8, 0, 3, 0))


def script():
    """The command's module."""
    with scripts("cover"):
        return sys.modules["cover"]


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """(folder, results): a module with a test that leaves gaps, built and run as the others are."""
    results = tmp_path_factory.mktemp("results")
    folder = bench.BUILD / "rdx_small_sources"  # always the same: a kept build names its files
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("rdx_small", MODULE), ("rdx_small_cover", COVER)):
        (folder / f"{name}.sv").write_text(text)
    (folder / "rdx_cover.svh").write_text((coverpoints.COVER / "rdx_cover.svh").read_text())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bench, "reached", lambda top: [folder / "rdx_small.sv"])
        patch.setattr(coverpoints, "COVER", folder)
        patch.setattr(coverpoints, "RESULTS", results)
        patch.setenv(coverpoints.MANIFEST, str(results / "manifest"))
        patch.setenv("SEED", "1")
        for check in ("low", "high", "low"):  # the last one is not run again
            bench.run(__name__, "rdx_small", {}, [check])
    names = (results / "manifest").read_text().split()
    assert names[0] == names[2] != names[1]
    return folder, [results / name for name in names[:2]]


def test_gaps_of_a_module(small):
    """What neither run covered is reported, with its line, and nothing else."""
    folder, results = small
    points = {p: n for p, n in coverpoints.merge(results).items() if p.module == "small"}
    place = folder.relative_to(ROOT)
    wanted = WANTED.format(file=place / "rdx_small.sv", cover=place / "rdx_small_cover.sv")
    assert sorted(coverpoints.gaps(points, {})) == sorted(wanted.splitlines())
    counts = coverpoints.rows(points, {})["small"]
    assert counts["block"] == Row(3, 4, 0, 0)
    assert counts["toggle"] == Row(15, 20, 0, 0)
    assert counts["bin"] == Row(5, 7, 0, 0)


def test_runs_are_merged(small):
    """Each run alone leaves more; the counts are sums."""
    _, results = small
    each = [coverpoints.merge([result]) for result in results]
    both = coverpoints.merge(results)
    gaps = [len(coverpoints.gaps(points, {})) for points in (*each, both)]
    assert gaps[2] < min(gaps[:2])
    assert both == {p: each[0].get(p, 0) + each[1].get(p, 0) for p in each[0] | each[1]}


def waiver(folder, text):
    """The waivers of a file."""
    (folder / "waivers.toml").write_text(text)
    return coverpoints.waivers(folder / "waivers.toml")


WAIVERS = """
[[waiver]]
module = "small"
kind = "toggle"
constant = false
points = ['count_i\\[2\\]', 'sum_o']
reason = "no stimulus has it"
[[waiver]]
module = "small"
kind = "block"
constant = true
points = ["end else if .count_i == 4'd9. begin"]
reason = "9 does not come"
[[waiver]]
module = "*"
kind = "toggle"
constant = true
points = ["rst_ni", "nowhere"]
reason = "reset only at the start"
[[waiver]]
module = "another"
kind = "block"
constant = true
points = ["x"]
reason = "of another run"
"""


def test_waivers(small, tmp_path):
    """A waived point is no gap and no hit, constant or left; a pattern that waives nothing is told, if of this run."""
    _, results = small
    points = {p: n for p, n in coverpoints.merge(results).items() if p.module == "small"}
    waived, idle = coverpoints.apply(points, waiver(tmp_path, WAIVERS))
    assert [line.split()[1] for line in coverpoints.gaps(points, waived)] == ["bin", "bin", "toggle"]
    assert idle == ["small: the waiver of toggle 'sum_o' waives nothing"]
    assert coverpoints.rows(points, waived)["small"]["toggle"] == Row(15, 20, 1, 2)


def test_constant_that_moves(small, tmp_path):
    """A bit that rose and fell is no constant; one that did neither may be, and what is left to others may do both."""
    _, results = small
    points = {p: n for p, n in coverpoints.merge(results).items() if p.module == "small"}
    rules = waiver(tmp_path, WAIVERS.replace("count_i\\[2\\]", "count_i\\[[02]\\]"))
    assert not script().contradicted(points, rules)
    (found,) = script().contradicted(points, [rule._replace(constant=True) for rule in rules])
    assert found.startswith("small: not constant: count_i[0], of the waiver")


@pytest.mark.parametrize(
    ("found", "complaint"),
    [
        ("kind = 'toggle'", "waiver 2: found module, kind; needed: module, kind .*, constant .*, points, reason"),
        ("kind = 'bits'\nconstant = true\npoints = []\nreason = 'x'", "needed: .*block, toggle or bin"),
        ("kind = 'bin'\nconstant = 1\npoints = []\nreason = 'x'", "needed: .*true or false"),
        ("kind = 'bin'\nconstant = true\npoints = []\nreason = ' '", "waiver 2: a reason is needed"),
        ("kind = 'bin'\nconstant = false\npoints = ['(']\nreason = 'x'", "waiver 2: the pattern '\\('"),
        ("kind = ", "Invalid value"),
    ],
)
def test_waiver_that_is_none(tmp_path, found, complaint):
    """A mistake in the file is named."""
    good = "[[waiver]]\nmodule = 'a'\nkind = 'bin'\nconstant = true\npoints = ['x']\nreason = 'y'\n"
    with pytest.raises(ValueError, match=complaint):
        waiver(tmp_path, f"{good}[[waiver]]\nmodule = 'a'\n{found}\n")


def test_another_file_is_refused():
    """What is no coverage file, or has points of an unknown kind, is an error."""
    with pytest.raises(ValueError, match="not a coverage file"):
        coverpoints.read(["hello"])
    with pytest.raises(ValueError, match="unknown kind"):
        coverpoints.read(["# SystemC::Coverage-3\n", "C '\x01f\x02a.sv\x01t\x02strange' 1\n"])


def test_exit_status(small, tmp_path, monkeypatch, capsys):
    """1 and a list where gaps are left, 0 where they are waived, 2 for a wrong name, 1 where a test fails."""
    folder, results = small
    command = script()
    every = tmp_path / "waivers.toml"
    kinds = "".join(
        f"[[waiver]]\nmodule = 'small'\nkind = '{kind}'\nconstant = false\npoints = ['.*']\nreason = 'x'\n"
        for kind in ("block", "toggle", "bin")
    )
    monkeypatch.setattr(coverpoints, "RESULTS", results[0].parent)
    monkeypatch.setattr(coverpoints, "WAIVERS", every)
    monkeypatch.setattr(command, "sources", lambda: [folder / "rdx_small.sv"])
    monkeypatch.setattr(command, "top_modules", list)
    monkeypatch.setattr(command, "run_tests", lambda *_: [result.name for result in results])
    monkeypatch.setattr("sys.argv", ["cover.py", "small"])
    every.write_text("waiver = []\n")
    assert command.main() == 1
    assert "rdx_small.sv:7: block" in capsys.readouterr().out
    every.write_text(kinds)
    assert command.main() == 0
    assert ":7:" not in capsys.readouterr().out
    monkeypatch.setattr("sys.argv", ["cover.py", "large"])
    assert command.main() == 2
    assert "found large; allowed: small" in capsys.readouterr().err
    monkeypatch.setattr("sys.argv", ["cover.py"])
    monkeypatch.setattr(command, "run_tests", lambda *_: None)
    assert command.main() == 1


# Modules without bins: they only hold, pass on or join; or they are arithmetic without a choice that a bin could name,
# whose tests compare every word with the golden model; or parts of rdx_swirl, whose test does not count bins of parts.
HOLD_OR_JOIN = ("pkg", "swirl_pkg", "delay", "cells", "constant", "finish", "render", "top", "swirl")
ARITHMETIC = ("matrix", "gradient")
PARTS_OF_SWIRL = ("polar", "side", "legs", "chord", "gradient")


def test_every_module_has_bins():
    """Each module has its file of bins, bound to it, but for those named above."""
    names = {path.stem.removesuffix("_cover") for path in coverpoints.COVER.glob("*.sv")}
    without = {*HOLD_OR_JOIN, *ARITHMETIC, *(f"swirl_{part}" for part in PARTS_OF_SWIRL)}
    assert {path.stem.removeprefix("rdx_") for path in written()} - {n.removeprefix("rdx_") for n in names} == without
    for name in names:
        text = (coverpoints.COVER / f"{name}_cover.sv").read_text()
        assert re.search(rf"^bind {name} {name}_cover ", text, re.M), name
        assert "`RDX_COVER" in text, name


def test_waivers_are_of_modules():
    """Each waiver of the project names a module."""
    found = coverpoints.waivers(coverpoints.WAIVERS)
    assert {rule.module for rule in found} <= {"*", *(path.stem.removeprefix("rdx_") for path in written())}


def test_only_the_module_is_counted():
    """The other modules are left out, and the package, whose functions are everybody's, is not."""
    text = coverpoints.configuration("rdx_ring", sources())
    left_out = re.findall(r'^coverage_off -file ".*/(\w+)\.sv"$', text, re.M)
    assert sorted(left_out) == sorted({path.stem for path in sources()} - {"rdx_ring", "rdx_pkg"})


def test_a_result_depends_on_what_the_test_imports():
    """The stimuli of another test that a test uses are part of the key of its results, and the bench is."""
    text = coverpoints.texts("test_lanes").decode()
    for name, used in (("test_lanes", 1), ("test_vecsum", 1), ("test_cordic", 1), ("bench", 1), ("test_ring", 0)):
        assert ((ROOT / "tb" / f"{name}.py").read_text() in text) == bool(used), name


def test_nothing_is_counted_otherwise():
    """Without the environment variable a build is what it was: the other tests do not pay."""
    assert coverpoints.MANIFEST not in os.environ
    assert not any("coverage" in str(a) for a in bench._trace_arguments("rdx_halve", "vcd"))


def test_points_differ_by_place():
    """Points of one line are told apart by column and name."""
    head = "# SystemC::Coverage-3\n"
    line = "C '\x01f\x02/a/rdx_x.sv\x01l\x027\x01n\x02{}\x01t\x02branch\x01page\x02v_branch/x\x01o\x02{}\x01h\x02x' 3\n"
    points = coverpoints.read([head, *(line.format(c, o) for c, o in ((3, "if"), (4, "else"), (3, "if")))])
    assert points == {
        Point("block", "x", "/a/rdx_x.sv", 7, 3, "if"): 6,
        Point("block", "x", "/a/rdx_x.sv", 7, 4, "else"): 3,
    }
