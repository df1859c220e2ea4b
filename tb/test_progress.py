# SPDX-License-Identifier: Apache-2.0
"""Bars: rate and remaining time where stderr is a terminal, not a sign of them where it is none."""

import os
import pty
import re
import subprocess
import sys
from types import SimpleNamespace

import pytest

from raydix.progress import RateColumn, track

SLOW = """import time
from raydix.progress import track
print(sum(time.sleep(0.2) or i for i in track(range(12), "items")))"""


@pytest.mark.parametrize(("speed", "text"), [(None, ""), (0.25, "4 s each"), (2.34, "2.3/s"), (12345.6, "12,346/s")])
def test_rate(speed, text):
    """Steps a second, or seconds a step."""
    assert str(RateColumn().render(SimpleNamespace(speed=speed, finished_speed=None))) == text


def test_nothing_is_lost():
    """The items in their order, of a generator too."""
    assert list(track((i * i for i in range(5)), "squares", 5)) == [0, 1, 4, 9, 16]


def test_on_a_terminal():
    """A pseudo-terminal gets the label, how much of how many, a rate and the time that is left; stdout is untouched."""
    leader, follower = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    process = subprocess.Popen(
        [sys.executable, "-c", SLOW], stderr=follower, stdout=subprocess.PIPE, text=True, env=environment
    )
    os.close(follower)
    shown = b""
    while True:
        try:
            part = os.read(leader, 4096)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        shown += part
    assert process.communicate()[0] == "66\n" and process.returncode == 0
    text = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", shown.decode())
    assert re.search(r"items .*\d+/12 +[45]\.\d/s +0:00:0\d", text), text


def test_without_a_terminal():
    """Nothing on stderr where nobody looks."""
    done = subprocess.run([sys.executable, "-c", SLOW], capture_output=True, text=True)
    assert done.stdout == "66\n" and done.stderr == ""
