# SPDX-License-Identifier: Apache-2.0
"""What Verilator's designs share is compiled once: by the first build, for all that come after it."""

import time

from raydix import runtime

MADE = "verilated.o", "verilated_threads.o", f"{runtime.FAST}.gch", f"{runtime.SLOW}.gch"


def test_first_build_is_kept(tmp_path):
    """Objects and headers of the first build go to the next one, newer than its makefile; the design's do not."""
    cache, works, states = tmp_path / "cache", [tmp_path / str(i) for i in range(3)], []
    for number, work in enumerate(works):
        work.mkdir()
        runtime.place(work, cache)
        there = {file.name for file in work.iterdir()}
        assert there == {runtime.HEADER, runtime.FAST, runtime.SLOW} | (set(MADE) if number else set())
        for name in MADE:
            if number:
                assert (work / name).read_text() == "0"
                assert (work / name).stat().st_mtime > time.time() + 60
            (work / name).unlink(missing_ok=True)
            (work / name).write_text(f"{number}")
        (work / "Vtop.o").write_text("")
        runtime.keep(work, cache)
        states.append([(file.stat().st_mtime, file.stat().st_nlink) for file in sorted(cache.iterdir())])
        assert states[-1] == states[0]  # a build changes nothing of what is kept
        assert sorted(file.name for file in cache.iterdir()) == sorted(MADE)
        assert len(list(tmp_path.iterdir())) == len({cache, *works[: number + 1]})  # no folder is left over
