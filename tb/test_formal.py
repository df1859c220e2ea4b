# SPDX-License-Identifier: Apache-2.0
"""The fastest proofs of scripts/formal.py: what holds is proved, what is broken refuted; all of them: make formal."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from raydix.blocks import read_table

ROOT = Path(__file__).resolve().parents[1]
FAST = ["merge", "stream-register", "select-n1", "paths-merge"]


def formal(*arguments):
    """scripts/formal.py with ``arguments``."""
    command = [sys.executable, "scripts/formal.py", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def test_fast_proofs():
    """Each is proved, and each broken variant of its module refuted."""
    run = formal(*FAST)
    assert run.returncode == 0, run.stdout + run.stderr
    assert len(re.findall(r"│ proved +│", run.stdout)) == len(FAST)
    assert len(re.findall(r": refuted: ", run.stdout)) >= len(FAST)


def test_every_change_fits():
    """What a proof replaces, and each broken variant, is in the sources as they are now."""
    program = f"""
import sys
sys.path.insert(0, {str(ROOT / "scripts")!r})
import formal
for name, proof in formal.PROOFS.items():
    for change in (None, *proof.broken):
        assert formal.files(proof, change), name
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_page_has_every_proof():
    """The table of docs/formal.md has a row of each proof and no other, proved, all broken variants refuted."""
    sys.path.append(str(ROOT / "scripts"))
    from formal_proofs import PROOFS

    rows = read_table(ROOT / "docs" / "formal.md", "proofs")
    assert set(rows) == set(PROOFS)
    assert {row[-1] for row in rows.values()} == {"proved"}
    for name, row in rows.items():
        assert row[5] == f"{len(PROOFS[name].broken)} of {len(PROOFS[name].broken)} refuted" or "–" in row[5], row


def test_broken_module_is_refuted(tmp_path):
    """A proof of a design that is broken fails, and the script says so: nothing of the verdict comes from the table."""
    program = f"""
import dataclasses, pathlib, sys
sys.path.insert(0, {str(ROOT / "scripts")!r})
import formal
proof = formal.PROOFS["merge"]
formal.BUILD = pathlib.Path({str(tmp_path)!r})
formal.PROOFS["merge"] = dataclasses.replace(proof, replace=proof.broken[:1], broken=())
sys.exit(formal.main(["merge"]))
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 1, run.stdout + run.stderr
    assert "formal: merge: refuted: " in run.stderr and "p_fair" in run.stderr


@pytest.mark.parametrize(
    ("start", "given", "verdict"),
    [
        ("2'b00", "1'b1", "proved"),
        ("2'b01", "1'b1", "refuted"),
        ("2'b10", "1'b1", "refuted"),
        ("free", "!free", "proved"),
    ],
)
def test_induction_begins(tmp_path, start, given, verdict):
    """A statement that is wrong in the first or the second clock alone follows from itself, and is not proved.

    What is given counts in these clocks, too: the last start is anything, and the statement only about what is left.
    """
    value = "2'b00" if start == "free" else start
    text = f"""
module late (input logic clk_i, input logic free);
  logic [1:0] wrong = {value};
  always_ff @(posedge clk_i) wrong <= {{wrong[0], {"free" if start == "free" else "1'b0"}}};
  always_comb assume ({given});
  always_comb never: assert (!wrong[1]);
endmodule
"""
    program = f"""
import dataclasses, pathlib, sys
sys.path.insert(0, {str(ROOT / "scripts")!r})
import formal
folder = pathlib.Path({str(tmp_path)!r})
proof = dataclasses.replace(formal.PROOFS["select-n1"], top="late", method="induction 3")
formal.graph(proof, {{"late.sv": {text!r}}}, folder, "proof", ["RDX_FORMAL"], {{}}, formal.ASSERTIONS)
print(formal.prove(proof, folder, "proof", False).verdict)
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert run.stdout.strip() == verdict, run.stdout + run.stderr


def test_bad_input():
    """A clear error and exit status 2."""
    run = formal("nothing")
    assert run.returncode == 2
    assert run.stderr.startswith("formal: ") and "Traceback" not in run.stderr
