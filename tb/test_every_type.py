# SPDX-License-Identifier: Apache-2.0
"""Both rules and every width on chords through each type: the figures of the page hold on other chords; bad input."""

from pathlib import Path

import pytest

from raydix.blocks import read_table
from scripting import scripts

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def script():
    """scripts/every_type.py as a module."""
    with scripts("every_type") as modules:
        yield modules


@pytest.mark.parametrize("name", ["sphere", "hyperboloid", "torus", "quartic"])
def test_certified_is_right_at_every_width(script, name):
    """No missed, false or wrong root on other chords than the page's; wider control points are not worse."""
    chords = script.Chords(name, 4000, 7)
    rows = [dict(zip(script.WIDE, row, strict=True)) for row in script.width_rows(chords)]
    assert [row["W"] for row in rows] == ["24", "28", "32", "36"]
    assert all(row["missed"] == row["false"] == "0" for row in rows), rows
    largest = [float(row["max"]) for row in rows]
    assert largest == sorted(largest, reverse=True) and largest[-1] < 4 and largest[0] > 2
    assert float(rows[-1]["error rms, ulp"]) == pytest.approx(12**-0.5, abs=0.02)


def test_paper_rule_misses_and_certified_does_not(script):
    """On a quartic, one digit a step: the paper's rule misses roots and takes wrong ones."""
    row, *_ = script.rule_rows(script.Chords("quartic", 20_000, 7))
    texts = dict(zip(script.RULES[:7], row[:7], strict=True))
    assert float(texts["paper: missed"].rstrip("%")) > 1 and float(texts["wrong root"].rstrip("%")) > 1
    assert row[7:10] == ["0.0000%", "0.0000%", "0"]


def test_page_has_every_type(script):
    """The tables name every type that is not a spiral."""
    types = {script.Chords(name, 10, 1).surface.type for name in script.SCENES}
    assert len(types) == 13
    for table in ("types", "widths"):
        assert set(read_table(script.PAGE, table)) == types


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["spiral"], "found 'spiral'; allowed: plane, sphere"),
        (["--chords", "0"], "found '0'; allowed: whole numbers, 1 or more"),
        (["torus", "--write"], "allowed: with all of them"),
    ],
)
def test_refuses(script, capsys, arguments, words):
    """Bad arguments: status 2, what was found and what is allowed."""
    with pytest.raises(SystemExit) as ended:
        script.main(arguments)
    assert ended.value.code == 2 and words in capsys.readouterr().err
