#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run one test with a waveform, and write what shows it: for GTKWave, for Surfer, for any viewer, and as a picture.

    scripts/waves.py settle                       the first test of tb/test_settle.py
    scripts/waves.py "ring[N1=1-K=6"              the first whose name has this
    scripts/waves.py ring --check reset           that test's first check whose name has this, not its first; or all
    scripts/waves.py --file build/waves/ring.vcd  a waveform that is there

Beside the waveform (build/waves/<test>.vcd): <test>.gtkw, a save file of GTKWave; <test>.sucl, commands of Surfer, for
<test>-fixed.vcd, the waveform with the point of fixed-point values in their ranges;
<test>-reals.vcd, the same signals in groups with fixed-point values as real numbers; <test>.png, the module's ports.

Exit status 0; 1: the test failed, its waveform is shown all the same; 2: bad input, or there is no waveform.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from pytests import run_pytest
from raydix.command import COUNT, SEED, status_of, whole
from raydix.image import ImageError, write_files
from raydix.progress import working
from viewing.picture import draw, first_valid, period_of
from viewing.signals import groups_of, read_signals
from viewing.viewers import write_fixed, write_gtkwave, write_reals, write_surfer

ROOT = Path(__file__).resolve().parents[1]
WAVES = ROOT / "build" / "waves"
WRITTEN = ("-reals", "-fixed")  # waveforms made of another one


class WavesError(RuntimeError):
    """There is nothing to show; the text is one line."""


def test_named(text: str) -> str:
    """The pytest name of the first test that is meant: a module, or that and a part of a test's name in brackets."""
    module, _, part = text.removeprefix("rdx_").removeprefix("test_").partition("[")
    path = ROOT / "tb" / f"test_{module}.py"
    if "/" in module or not path.is_file():
        known = ", ".join(sorted(p.stem.removeprefix("test_") for p in (ROOT / "tb").glob("test_*.py")))
        raise WavesError(f"T: found '{text}'; allowed: {known}, or one of them and a part of a test's name: ring[N1=1")
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", str(path)]
    with working(f"looking for the tests of {module}"):
        lines = subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout.splitlines()
    names = [line for line in lines if "::" in line and "[" in line] or [line for line in lines if "::" in line]
    found = [name for name in names if part.rstrip("]") in name]
    if not found:
        raise WavesError(f"T: found '{text}'; allowed of this module: {', '.join(n.split('::')[1] for n in names)}")
    return found[0]


def run(name: str, seed: int | None, check: str) -> tuple[int, Path]:
    """Run a check of a test, or all, with a waveform: (exit status of pytest, waveform). Raises :class:`WavesError`."""
    WAVES.mkdir(parents=True, exist_ok=True)
    before = {path: path.stat().st_mtime_ns for path in WAVES.glob("*.vcd")}
    settings = {**os.environ, "WAVES": "vcd", "CHECK": check, **({} if seed is None else {"SEED": str(seed)})}
    print(f"waves: {name} with a waveform …", file=sys.stderr, flush=True)
    status = run_pytest([name], "test", settings)
    new = [p for p in WAVES.glob("*.vcd") if before.get(p) != p.stat().st_mtime_ns and not p.stem.endswith(WRITTEN)]
    if not new:
        why = (
            "ended before there was a waveform"
            if status
            else "found no waveform; allowed: a test that simulates a module"
        )
        raise WavesError(f"{name}: {why}")
    newest = max(new, key=lambda path: path.stat().st_mtime_ns)
    return status, newest.relative_to(Path.cwd()) if newest.is_relative_to(Path.cwd()) else newest


def show(wave: Path, start: int | None, clocks: int) -> dict[Path, str]:
    """Write the files beside a waveform; each with how to open it. Raises WavesError, ImageError."""
    try:
        signals = read_signals(wave)
        groups = groups_of(signals)
        if not groups:
            raise WavesError(f"{wave}: found no clk_i; allowed: a waveform of a module with a clock")
        period = period_of(wave, next(s for s in signals if s.root == "clk_i"))
    except (OSError, ValueError) as error:
        raise WavesError(f"{wave}: {getattr(error, 'strerror', None) or error}") from None
    begin = first_valid(wave, groups, 1 << 62) - 2 * period if start is None else start * period
    begin = max(0, begin)
    until = begin + clocks * period
    written = (".gtkw", ".sucl", "-fixed.vcd", "-reals.vcd", ".png")
    paths = {suffix: wave.with_name(f"{wave.stem}{suffix}") for suffix in written}

    def text(write, *arguments):
        def into(work):
            with work.open("w") as file:
                write(file, *arguments)

        return into

    title = f"{wave.stem}, clocks {begin // period} to {until // period}"
    write_files(
        {
            paths[".gtkw"]: text(write_gtkwave, wave, groups, begin, period),
            paths[".sucl"]: text(write_surfer, groups),
            paths["-fixed.vcd"]: text(write_fixed, wave),
            paths["-reals.vcd"]: text(write_reals, wave, groups, until),
            paths[".png"]: lambda work: draw(wave, groups, begin, until, period, title, work),
        }
    )
    return {
        paths[".gtkw"]: f"gtkwave {paths['.gtkw']}",
        paths[".sucl"]: f"surfer -c {paths['.sucl']} {paths['-fixed.vcd']}",
        paths["-fixed.vcd"]: "for Surfer: the waveform with the point of fixed-point values in their ranges",
        paths["-reals.vcd"]: "any viewer: the same signals in groups, fixed-point values as real numbers",
        paths[".png"]: "a picture of the module's ports",
    }


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("test", nargs="?", help="a module, or module[part of a test's name")
    parser.add_argument("--file", type=Path, help="a waveform (VCD) that is there, in place of a test")
    parser.add_argument("--check", default="first", help="which cocotb test: a part of its name, first, or all (first)")
    parser.add_argument("--seed", type=SEED, help="of the random stimuli")
    parser.add_argument(
        "--start", type=whole(0), help="first clock of the picture (default: two before the first valid)"
    )
    parser.add_argument("--clocks", type=COUNT, default=30, help="clocks in the picture (default: 30)")
    args = parser.parse_args()
    if (args.test is None) == (args.file is None):
        parser.error("found both or none of TEST and --file; allowed: one")
    try:
        status, wave = (0, args.file) if args.file else run(test_named(args.test), args.seed, args.check)
        with working(f"reading and drawing {wave.name}"):
            shown = show(wave, args.start, args.clocks)
    except (WavesError, ImageError) as error:
        print(f"waves: {error}", file=sys.stderr)
        return 2
    print(wave)
    for path, how in shown.items():
        print(f"{path.name}: {how}")
    return int(bool(status))


if __name__ == "__main__":
    sys.exit(status_of(main))
