# SPDX-License-Identifier: Apache-2.0
"""Illegal parameters fail at elaboration, and the reason says what was found and what is allowed."""

import re
import subprocess

import pytest

import bench
from raydix.files import RTL, environment, sources, written

# module, its parameters, text of the reason
CASES = [
    ("rdx_halve", dict(W=1), "W = 1; allowed: 2 or more"),
    ("rdx_halve", dict(D=0), "D = 0; allowed: 1 to 4"),
    ("rdx_halve", dict(D=5), "D = 5; allowed: 1 to 4"),
    ("rdx_cells", dict(N1=0), "N1 = 0; allowed: 1 to 4"),
    ("rdx_cells", dict(N1=5), "N1 = 5; allowed: 1 to 4"),
    ("rdx_normalize", dict(WOut=37), "WOut = 37; allowed: at most WIn = 36"),
    ("rdx_normalize", dict(Limit=0), "Limit = 0; allowed: 1 to 35"),
    ("rdx_normalize", dict(Limit=63), "Limit = 63; allowed: 1 to 35"),
    ("rdx_normalize", dict(Limit=6), "Limit = 6; allowed: a power of two less one"),
    ("rdx_normalize", dict(Stages=1), "Stages = 1; allowed: 2, 3 and, with Limit = 15 or more, 4"),
    ("rdx_normalize", dict(Stages=4), "Stages = 4; allowed: 2, 3 and, with Limit = 15 or more, 4"),
    ("rdx_select", dict(Rules=0), "Rules = 0; allowed: 1 certified, 2 paper, 3 both"),
    ("rdx_select", dict(Rules=4), "Rules = 4; allowed: 1 certified, 2 paper, 3 both"),
    ("rdx_select", dict(Rules=3, Below=1), "Below = 1 with Rules = 3; allowed: 1 certified"),
    ("rdx_scale", dict(Bits=6), "Bits = 6; allowed: 1 and up, 2^Bits at most W = 36"),
    ("rdx_scale", dict(Bits=0), "Bits = 0; allowed: 1 and up, 2^Bits at most W = 36"),
    ("rdx_clip", dict(N1=3, Latency=2), "Latency = 2; allowed: 0, or N1 = 3 and up"),
    ("rdx_step", dict(K=11), "K = 11; allowed: 1 to 10 (N1*K is at most 32)"),
    ("rdx_step", dict(K=0), "K = 0; allowed: 1 to 10 (N1*K is at most 32)"),
    ("rdx_step", dict(W=15), "W = 15; allowed: 16 to 48"),
    ("rdx_step", dict(W=49), "W = 49; allowed: 16 to 48"),
    ("rdx_step", dict(D=1), "D = 1 with W = 36, HalveStages = 1; allowed: 38, 1"),
    ("rdx_step", dict(D=1, W=38, HalveStages=2), "D = 1 with W = 38, HalveStages = 2; allowed: 38, 1"),
    ("rdx_ring", dict(U=0), "U = 0; allowed: 1 to K = 8"),
    ("rdx_ring", dict(U=9), "U = 9; allowed: 1 to K = 8"),
    ("rdx_rings", dict(Rings=0), "Rings = 0, U = 8; allowed: 1 or more, 32 step units in all"),
    ("rdx_rings", dict(Rings=5), "Rings = 5, U = 8; allowed: 1 or more, 32 step units in all"),
    ("rdx_sift", dict(Queue=8), "Queue = 8; allowed: 16 or more"),
    ("rdx_sift", dict(D=4, Levels=4, Queue=13), "Queue = 13; allowed: 16 or more"),
    ("rdx_merge", dict(Count=0), "Count = 0; allowed: 1 or more"),
    ("rdx_tally", dict(Lines=3), "Lines = 3; allowed: 2, 4"),
    ("rdx_raster", dict(D=3), "D = 3; allowed: 4 (quartics too), 2 (quadrics) or 0 (none)"),
    ("rdx_product", dict(D=3), "D = 3; allowed: 2 (quadrics) or 4 (quartics too)"),
    ("rdx_core", dict(Vecsum=3), "Vecsum = 3; allowed: 0 none (where D > 0), 1 helix, 2 general"),
    ("rdx_core", dict(D=0), "Vecsum = 0; allowed: 0 none (where D > 0), 1 helix, 2 general"),
    ("rdx_vecsum", dict(VectorDrop=6), "VectorDrop = 6; allowed: 0, 4, 8, 12"),
    ("rdx_lanes", dict(Lanes=0), "Lanes = 0; allowed: 1 to Points = 7, which is at most 15"),
    ("rdx_lanes", dict(Lanes=8), "Lanes = 8; allowed: 1 to Points = 7, which is at most 15"),
    ("rdx_lanes", dict(Points=16), "Lanes = 7; allowed: 1 to Points = 16, which is at most 15"),
    ("rdx_line", dict(Depth=1), "Depth = 1; allowed: 2 or more"),
    ("rdx_multiply", dict(W=48), "W = 48; allowed: at most 47 with Drop = 25"),
    ("rdx_cordic", dict(Iterations=0), "Iterations = 0; allowed: 1 to 32, and at most W - 3 = 35"),
    ("rdx_cordic", dict(Iterations=33), "Iterations = 33; allowed: 1 to 32, and at most W - 3 = 35"),
    ("rdx_cordic", dict(Still=19), "Still = 19; allowed: above 19, or Iterations"),
    ("rdx_constant", dict(Surfaces=0), "Surfaces = 0; allowed: 1 to 64"),
    ("rdx_constant", dict(Surfaces=65), "Surfaces = 65; allowed: 1 to 64"),
    ("rdx_constant", dict(Index=64), "Index = 64; allowed: below 64"),
    ("rdx_cordic", dict(W=27), "Iterations = 28; allowed: 1 to 32, and at most W - 3 = 24"),
    ("rdx_check", dict(K=0), "K = 0; allowed: 1 to 32"),
    ("rdx_check", dict(K=33), "K = 33; allowed: 1 to 32"),
    ("rdx_check", dict(Surfaces=0), "Surfaces = 0; allowed: 1 to 64"),
    ("rdx_check", dict(Surfaces=65), "Surfaces = 65; allowed: 1 to 64"),
    ("rdx_check", dict(MaxWidth=0), "MaxWidth = 0; allowed: 1 to 4096"),
    ("rdx_check", dict(MaxWidth=4097), "MaxWidth = 4097; allowed: 1 to 4096"),
    ("rdx_table", dict(Slots=0), "Slots = 0; allowed: 1 to 64"),
    ("rdx_table", dict(Slots=65), "Slots = 65; allowed: 1 to 64"),
    ("rdx_blend", dict(Layers=0), "Layers = 0; allowed: 1 or more"),
    ("rdx_gradient", dict(D=0), "D = 0; allowed: 2, 4"),
    ("rdx_gradient", dict(D=3), "D = 3; allowed: 2, 4"),
    ("rdx_fill", dict(WOut=1), "WOut = 1; allowed: 2 to 32"),
    ("rdx_fill", dict(WOut=33), "WOut = 33; allowed: 2 to 32"),
    ("rdx_fifo", dict(Depth=1), "Depth = 1; allowed: a power of two, 2 or more"),
    ("rdx_fifo", dict(Depth=12), "Depth = 12; allowed: a power of two, 2 or more"),
    (
        "rdx_layers",
        dict(Pixels=3, MaxWidth=48),
        "Pixels = 3, MaxWidth = 48; allowed: a power of two, a multiple of it",
    ),
    (
        "rdx_layers",
        dict(Pixels=4, MaxWidth=50),
        "Pixels = 4, MaxWidth = 50; allowed: a power of two, a multiple of it",
    ),
]
UNREACHABLE = set()


def elaborate(module, parameters):
    """Exit status and messages of Verilator."""
    command = ["verilator", "--lint-only", f"-I{RTL}", "--top-module", module]
    command += [f"-G{name}={value}" for name, value in parameters.items()]
    run = subprocess.run([*command, *map(str, sources())], env=environment(), capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


@pytest.mark.parametrize(("module", "parameters", "reason"), CASES, ids=[f"{m}-{bench.label(p)}" for m, p, _ in CASES])
def test_illegal(module, parameters, reason):
    """Elaboration ends with the reason, and names the module."""
    status, messages = elaborate(module, parameters)
    assert status != 0, f"{module} {parameters} elaborates"
    assert f"{module}: {reason}" in messages, messages


@pytest.mark.parametrize("module", sorted({module for module, _, _ in CASES}))
def test_legal(module):
    """The defaults elaborate: what the other test sees is the parameter's doing."""
    status, messages = elaborate(module, {})
    assert status == 0, messages


def test_every_check_is_tried():
    """Each $fatal of the sources has a case above, one for each side of a range."""
    checks = set()
    for file in written():
        checks |= set(re.findall(r'\$fatal\(\s*1,\s*"(rdx_\w+: \w+)', file.read_text()))
    tried = {f"{module}: {reason.split()[0]}" for module, _, reason in CASES}
    assert checks - UNREACHABLE == tried
