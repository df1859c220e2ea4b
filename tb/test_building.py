# SPDX-License-Identifier: Apache-2.0
"""A folder to build in: gone with its process, or by the next build where that was killed."""

import signal
import subprocess
import sys

import pytest

from raydix.building import building

BUILDS = """import sys, time; from pathlib import Path; from raydix.building import building
with building(Path(sys.argv[1])) as folder: (folder / "half").touch(); print(folder.name, flush=True); time.sleep(60)"""


@pytest.fixture
def build(tmp_path):
    """Starts a process that builds in ``tmp_path``: it and its folder's name."""
    started = []

    def start():
        started.append(subprocess.Popen([sys.executable, "-c", BUILDS, tmp_path], stdout=subprocess.PIPE, text=True))
        return started[-1], started[-1].stdout.readline().strip()

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGKILL])
def test_killed_build_is_swept(tmp_path, build, end):
    """What a killed build has left goes with the next one; the folder of one that still runs stays."""
    runs, (killed, left) = build()[1], build()
    (tmp_path / "building-old").mkdir()  # of a version without locks
    killed.send_signal(end)
    killed.wait()
    assert (tmp_path / left / "half").exists()
    with building(tmp_path) as folder:
        assert {path.name for path in tmp_path.glob("building-*")} == {folder.name, runs}
    assert [path.name for path in tmp_path.glob("building-*")] == [runs] and (tmp_path / runs / "half").exists()


def test_folder_is_gone_after_an_error(tmp_path):
    """A build that fails leaves no folder."""
    with pytest.raises(RuntimeError, match="fails"), building(tmp_path / "new"):
        raise RuntimeError("fails")
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["building.lock"]
