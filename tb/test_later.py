# SPDX-License-Identifier: Apache-2.0
"""What `make test` leaves to `make regress` within a simulation: named by patterns, run there, and never lost."""

import re

import pytest

import bench
import second

CHECKS = ["once", "rates/idle=0.0/stall=0.3", "rates/idle=0.3/stall=0.3"]


def test_what_is_kept():
    """Whole names are meant, of the checks that are given or of all that the file has."""
    assert bench.kept(CHECKS, ()) == (CHECKS, None) and bench.kept(None, ()) == (None, None)
    assert bench.kept(CHECKS, ["rates/idle=0.3.*", "onc"]) == (CHECKS[:2], None)
    checks, pattern = bench.kept(None, ["rates/idle=0.3.*", "onc"])
    assert checks is None
    assert [name for name in CHECKS if re.search(pattern, f"test_this.{name}")] == CHECKS[:2]
    assert bench.label_of(CHECKS[1:]) == "rates-idle=0.0-stall=0.3-and-1-more" and bench.label_of(["a"]) == "a"


@pytest.mark.parametrize("short", ["1", ""])
def test_short_and_long(monkeypatch, capsys, short):
    """The long run has all checks of the short one and those that are left to it; each tells how to repeat it."""
    passed = []
    monkeypatch.setattr(second, "record", lambda **facts: passed.append(facts["passed"]))
    monkeypatch.setenv("RAYDIX_SHORT", short)
    for later in ((), [".*stall=0.8"]):
        bench.run("test_register", "rdx_register", dict(W=32), later=later)
    assert 0 < passed[1] < passed[0] if short else passed[0] == passed[1]
    assert capsys.readouterr().out.count(" ALL=1\n") == (0 if short else 2)


def test_lost_pattern(monkeypatch):
    """A pattern that fits no check, as after a change of its name, is told by the long run."""
    monkeypatch.delenv("RAYDIX_SHORT", raising=False)
    with pytest.raises(AssertionError, match="left to the long run, but no check: nothing"):
        bench.run("test_register", "rdx_register", dict(W=32), later=["nothing"])
