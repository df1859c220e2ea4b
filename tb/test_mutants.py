# SPDX-License-Identifier: Apache-2.0
"""The mutation tester: what it makes of a small module; a weak test lets through what a strong one finds."""

import sys
import tomllib

import pytest

from raydix.blocks import read_table
from raydix.files import ROOT, RTL

sys.path.append(str(ROOT / "scripts"))  # behind tb/, which has modules of the same names
from mutants import main as mutants_main  # noqa: E402  (scripts/ is not installed)
from mutation import campaign, schema, sites  # noqa: E402

TINY = """\
// A module for test_mutants.py.
module tiny #(
    parameter int unsigned W = 3 + 1
) (
    input  wire logic         clk_i,
    input  wire logic [W-1:0] a_i,
    input  wire logic [W-1:0] b_i,
    output logic      [W-1:0] sum_o,
    output logic              less_o,
    output logic      [W-1:0] pick_o,
    output logic              low_o
);
  localparam int unsigned Twice = W + W;
  if (W < 2) begin : gen_illegal_w
    $fatal(1, "tiny: W = %0d; allowed: 2 or more", W);
  end
  if (W > 9) begin : gen_wide
    wire [W-1:0] unlikely = a_i - b_i;
  end
  wire less = a_i < b_i;
  wire unused = &{1'b0, less, Twice > 3};
  function automatic logic [W-1:0] both(logic [W-1:0] x, logic [W-1:0] y);
    return x & y;
  endfunction
  wire [W-1:0] sum = a_i + b_i;
  always_ff @(posedge clk_i) begin
    less_o <= less;
    sum_o <= sum;
    low_o <= sum[0];
    if (less) pick_o <= both(a_i, b_i);
    else pick_o <= ~a_i;
  end
  a_sum : assert property (@(posedge clk_i) sum == a_i + b_i || 1'b1);
endmodule
"""
# operator, line of the text, text, replaced by
MADE = {
    ("add", "wire [W-1:0] sum = a_i + b_i;", "a_i + b_i", "a_i - b_i"),
    ("stuck", "wire [W-1:0] sum = a_i + b_i;", "a_i + b_i", "zero"),
    ("stuck", "wire [W-1:0] sum = a_i + b_i;", "a_i + b_i", "all ones"),
    ("order", "wire less = a_i < b_i;", "a_i < b_i", "a_i <= b_i"),
    ("stuck", "wire less = a_i < b_i;", "a_i < b_i", "zero"),
    ("stuck", "wire less = a_i < b_i;", "a_i < b_i", "all ones"),
    ("bits", "return x & y;", "x & y", "x | y"),
    ("stuck", "return x & y;", "x & y", "zero"),
    ("stuck", "return x & y;", "x & y", "all ones"),
    ("hold", "less_o <= less;", "less_o <= less;", "(left out)"),
    ("stuck", "less_o <= less;", "less", "zero"),
    ("stuck", "less_o <= less;", "less", "all ones"),
    ("hold", "sum_o <= sum;", "sum_o <= sum;", "(left out)"),
    ("stuck", "sum_o <= sum;", "sum", "zero"),
    ("stuck", "sum_o <= sum;", "sum", "all ones"),
    ("hold", "low_o <= sum[0];", "low_o <= sum[0];", "(left out)"),
    ("stuck", "low_o <= sum[0];", "sum[0]", "zero"),
    ("stuck", "low_o <= sum[0];", "sum[0]", "all ones"),
    ("index", "low_o <= sum[0];", "0", "1"),
    ("if", "if (less) pick_o <= both(a_i, b_i);", "less", "!(less)"),
    ("if", "if (less) pick_o <= both(a_i, b_i);", "less", "1'b1"),
    ("if", "if (less) pick_o <= both(a_i, b_i);", "less", "1'b0"),
    ("hold", "if (less) pick_o <= both(a_i, b_i);", "pick_o <= both(a_i, b_i);", "(left out)"),
    ("stuck", "if (less) pick_o <= both(a_i, b_i);", "both(a_i, b_i)", "zero"),
    ("stuck", "if (less) pick_o <= both(a_i, b_i);", "both(a_i, b_i)", "all ones"),
    ("hold", "else pick_o <= ~a_i;", "pick_o <= ~a_i;", "(left out)"),
    ("not", "else pick_o <= ~a_i;", "~a_i", "(a_i)"),
    ("stuck", "else pick_o <= ~a_i;", "~a_i", "zero"),
    ("stuck", "else pick_o <= ~a_i;", "~a_i", "all ones"),
}
# of one expression each: the changes that the operators make of it, stuck values left out
EXPRESSIONS = {
    "a_i - b_i": {"a_i + b_i"},
    "a_i | b_i": {"a_i & b_i"},
    "a_i ^ b_i": {"a_i ~^ b_i"},
    "4'(a_i == b_i)": {"a_i != b_i"},
    "4'(a_i != b_i)": {"a_i == b_i"},
    "4'(a_i >= b_i)": {"a_i > b_i"},
    "4'(less && low_o)": {"less || low_o"},
    "4'(less || !low_o)": {"less && !low_o", "!(!(low_o))"},
    "a_i << b_i[1:0]": {"a_i >> b_i[1:0]"},
    "4'($signed(a_i) >>> b_i[1:0])": {"$signed(a_i) >> b_i[1:0]"},
    "4'($signed(a_i + b_i) >>> b_i[1:0])": {"$signed(a_i + b_i) >> b_i[1:0]", "a_i - b_i"},
    "4'($bits(a_i + b_i))": set(),
    "less ? a_i : b_i": {"!(less)"},
    "a_i | 4'd15": {"a_i & 4'd15", "4'd0"},
    "{a_i[3:1], 1'b0}": {"1'd1"},
    "4'(a_i[b_i[1:0]])": {"b_i[1:0] + 1, where that exists"},
    "(less) ? '0 : -a_i": {"!(less)", "'1", "(a_i)"},
    "4'(|a_i)": {"&(a_i)"},
    "{2{a_i[2], less}}": {"3"},
    "4'(W) + a_i[1+:4-1]": {"4'(W) - a_i[1+:4-1]", "2"},
}


def mutants(tmp_path, text):
    """The file and its mutants."""
    file = tmp_path / "tiny.sv"
    file.write_text(text)
    return file, schema.number(text, sites.find("tiny", {}, file, [file], RTL))


def test_makes_these_mutants(tmp_path):
    """Run-time expressions only: no parameter, generate condition, assertion, unused net or width."""
    _, made = mutants(tmp_path, TINY)
    assert {(m.site.operator, m.code, m.old, m.new) for m in made} == MADE
    assert len(made) == len(MADE)


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_operators(tmp_path, expression):
    """Each operator on an expression of its own."""
    _, made = mutants(tmp_path, TINY.replace("x & y", expression))
    line = f"return {expression};"
    assert {m.new for m in made if m.code == line and m.site.operator != "stuck"} == EXPRESSIONS[expression]


def test_choice_is_even(tmp_path):
    """A few mutants come from as many operators and lines; the same every time."""
    _, made = mutants(tmp_path, TINY)
    operators = {m.site.operator for m in made}
    few = schema.choose(made, len(operators), "tiny")
    assert few == schema.choose(made, len(operators), "tiny")
    assert {m.site.operator for m in few} == operators
    stuck = [m for m in made if m.site.operator == "stuck"]
    lines = {m.line for m in stuck}
    assert {m.line for m in schema.choose(stuck, len(lines), "tiny")} == lines
    assert schema.choose(made, 1000, "tiny") == made


def test_schema_keeps_lines(tmp_path):
    """Each mutant stands in its line, once."""
    file, made = mutants(tmp_path, TINY)
    lines = schema.rewrite(TINY, made).splitlines()
    assert len(lines) == len(TINY.splitlines())
    for mutant in made:
        places = [i for i, line in enumerate(lines, 1) if f"rdx_mutant == {mutant.number} " in line
                  or f"rdx_mutant != {mutant.number})" in line]  # fmt: skip
        assert places == [mutant.line]


def test_weak_test_lets_mutants_through(tmp_path, monkeypatch):
    """The strong check finds every mutant; the weak one those of its output, and no other."""
    monkeypatch.setattr(campaign, "LIMIT", 20)
    file, made = mutants(tmp_path, TINY)
    text = schema.rewrite(TINY, made)
    found = {}
    for check in ("strong", "weak"):
        lines = []
        call = campaign.Call("mutants_tiny", "tiny", {}, [check])
        campaign.simulate(call, file, text, [m.number for m in made], 1, tmp_path / "log", lines.append)
        assert [fields["mutant"] for fields in lines] == [m.number for m in made]
        found[check] = {fields["mutant"]: fields["outcome"] for fields in lines}
    assert set(found["strong"].values()) == {"check"}
    mine = {m.number for m in made if "sum" in m.code and "low_o" not in m.code}
    assert {n for n, outcome in found["weak"].items() if outcome == "check"} == mine
    assert set(found["weak"].values()) == {"check", "survived"}


def test_errors(monkeypatch, capsys):
    """A module that is not there, and options that do not go together: a clear text and exit status 2."""
    for arguments, text in (
        (["torus"], "found torus; allowed: advance algebraic"),
        (["--mutant", "1"], "exactly one module"),
        (["select", "--mutant", "-1"], "found '-1'; allowed: whole numbers"),
    ):
        monkeypatch.setattr(sys, "argv", ["mutants.py", *arguments])
        with pytest.raises(SystemExit) as ended:
            mutants_main()
        assert ended.value.code == 2 and text in capsys.readouterr().err


def test_list_of_equivalents():
    """Each entry names a line of its module, says what is changed, and why that changes nothing."""
    entries = tomllib.loads((ROOT / "tb" / "mutants.toml").read_text())["equivalent"]
    for entry in entries:
        lines = {line.strip() for line in (RTL / f"rdx_{entry['module']}.sv").read_text().splitlines()}
        assert entry["code"] in lines, f"rdx_{entry['module']} has no line {entry['code']}"
        assert " -> " in entry["change"] and len(entry["reason"]) > 20
        assert entry.keys() <= {"module", "code", "change", "nth", "reason"}


def test_page_has_every_module():
    """docs/mutants.md has a row of each module that has mutants, and no survivor."""
    rows = read_table(ROOT / "docs" / "mutants.md", "mutants")
    assert set(rows) - {"all"} == set(campaign.names())
    assert {name for name, row in rows.items() if row[7] != "0"} == set()


@pytest.mark.long
def test_rows_are_of_these_sources():
    """As many mutants are possible as the row of each module says: one measured of other sources mostly has another."""
    rows = read_table(ROOT / "docs" / "mutants.md", "mutants")
    possible = {name: str(len(campaign.prepare(name)[1])) for name in campaign.names()}
    assert {name: row[1] for name, row in rows.items() if name != "all"} == possible
