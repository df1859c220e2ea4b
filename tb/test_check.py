# SPDX-License-Identifier: Apache-2.0
"""The check of a start: only a legal one becomes a frame, which stays until it is taken; the first error is kept."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
from raydix import csr, formats
from raydix.files import RTL

UNIT, PIXEL, SURFACE = 17, formats.PIXEL_WIDTH, formats.SURFACE_WIDTH
_LIGHT = ("skip", 5), ("ambient", UNIT), ("background", UNIT, 3)
REQUEST = bench.Struct(("width", 13), ("height", 13), ("count", 7), ("k_stop", 6), *_LIGHT)
FRAME = bench.Struct(
    ("last_x", PIXEL), ("last_y", PIXEL), ("last_slot", SURFACE), ("empty", 1), ("k_stop", 6), *_LIGHT
)  # fmt: skip
ONE = 1 << 16
BUILT = dict(K=8, Surfaces=64, MaxWidth=1920)


def code(request, queued, built):
    """Number of the error that a start gives, 0 for none."""
    if queued:
        return 8
    if not 1 <= request["width"] <= built["MaxWidth"] or not 1 <= request["height"] <= 1 << PIXEL:
        return 1
    if request["count"] > built["Surfaces"]:
        return 2
    return 0 if 1 <= request["k_stop"] <= built["K"] else 3


def frame(request):
    """What a legal request becomes."""
    return {
        "last_x": request["width"] - 1,
        "last_y": request["height"] - 1,
        "last_slot": (request["count"] - 1) % (1 << SURFACE),
        "empty": int(request["count"] == 0),
        "k_stop": request["k_stop"],
        "skip": request["skip"],
        "ambient": min(request["ambient"], ONE),
        "background": [min(value, ONE) for value in request["background"]],
    }


def requests(rng, built):
    """Requests without end: each value near the ends of its range, or anywhere in it, or of any bits."""

    def pick(least, most, width):
        value = rng.choice([least - 1, least, most, most + 1, *[rng.randint(least, most)] * 12, rng.getrandbits(width)])
        return max(0, min(value, (1 << width) - 1))

    while True:
        yield {
            "width": pick(1, built["MaxWidth"], 13),
            "height": pick(1, 1 << PIXEL, 13),
            "count": pick(0, built["Surfaces"], 7),
            "k_stop": pick(1, built["K"], 6),
            "skip": rng.getrandbits(5),
            "ambient": pick(0, ONE, UNIT),
            "background": [pick(0, ONE, UNIT) for _ in range(3)],
        }


def fresh(dut):
    """All inputs at rest."""
    for name in ("start_i", "request_i", "start_ready_i", "done_i", "error_valid_i", "error_slot_i", "known_i"):
        getattr(dut, name).value = 0
    dut.error_code_i.value = 0


@cocotb.test
@cocotb.parametrize(ready=(0.1, 0.5, 1.0))
async def equals_model(dut, ready):
    """Random starts, answers, errors and ends of frames: every output in every clock."""
    rng = bench.rng(ready)
    built = {name: bench.parameter(dut, name) for name in BUILT}
    fresh(dut)
    request_port, frame_port = bench.Port(dut, "request_i", REQUEST), bench.Port(dut, "frame_o", FRAME)
    await bench.start(dut)
    waiting, done, first = None, 0, None
    seen = set()
    source = requests(rng, built)
    for number in range(4000):
        request = next(source)
        given = {
            "start_i": int(rng.random() < 0.5), "start_ready_i": int(rng.random() < ready),
            "done_i": int(rng.random() < 0.2), "error_valid_i": int(rng.random() < 0.1),
            "error_code_i": rng.randint(1, 9), "error_slot_i": rng.getrandbits(6), "known_i": int(rng.random() < 0.5),
        }  # fmt: skip
        request_port.write(request)
        for name, value in given.items():
            getattr(dut, name).value = value
        await ReadOnly()
        fault = code(request, waiting is not None and not given["start_ready_i"], built)
        legal, wrong = given["start_i"] and not fault, given["error_valid_i"] or (given["start_i"] and fault)
        lines = []
        expected = {"start_valid_o": waiting is not None, "done_o": done, "error_o": bool(wrong)}
        if first:
            expected |= {"code_o": first[0], "slot_o": first[1]}
        for name, value in expected.items():
            got = int(getattr(dut, name).value)
            lines += [f"{name}: expected {int(value)}, got {got}"] if got != value else []
        if waiting:
            lines += frame_port.differences(frame_port.words(waiting), frame_port.read())
        if lines:
            raise bench.mismatch(number, {**given, "request": request}, lines)
        if given["start_i"]:
            seen.add(fault)
        if legal:
            waiting = frame(request)
        elif given["start_ready_i"]:
            waiting = None
        done = 1 if given["done_i"] else 0 if legal else done
        if wrong and not given["known_i"]:
            first = (given["error_code_i"], given["error_slot_i"]) if given["error_valid_i"] else (fault, 0)
        await FallingEdge(dut.clk_i)
    assert seen >= {0, 1, 2, 3} and (ready == 1.0 or 8 in seen), seen


@cocotb.test
async def reset_forgets(dut):
    """A start that waits is gone after a clock of reset, and so is the note that a frame was finished."""
    fresh(dut)
    await bench.start(dut)
    bench.Port(dut, "request_i", REQUEST).write(
        {"width": 1, "height": 1, "count": 0, "k_stop": 1, "skip": 0, "ambient": 0, "background": [0, 0, 0]}
    )
    dut.start_i.value = 1
    dut.done_i.value = 1
    await FallingEdge(dut.clk_i)
    dut.start_i.value = 0
    dut.done_i.value = 0
    assert dut.start_valid_o.value == 1 and dut.done_o.value == 1
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    assert dut.start_valid_o.value == 0 and dut.done_o.value == 0


@pytest.mark.parametrize(
    "parameters",
    [BUILT, dict(K=1, Surfaces=1, MaxWidth=1), dict(K=32, Surfaces=33, MaxWidth=4096)],
    ids=bench.label,
)
def test_check(parameters):
    """The default, the least, and the largest frame."""
    bench.run(__name__, "rdx_check", parameters)


def test_codes_are_those_of_the_registers():
    """error_e has the numbers of rdx_csr.rdl, and their names but for the style."""
    text = (RTL / "rdx_frame.svh").read_text()
    for name, (number, _) in csr.address_map().ERRORS.items():
        style = "".join(part.capitalize() for part in name.split("_"))
        assert f"Error{style} " in text and f"= 4'd{number}" in text.split(f"Error{style} ")[1].split("\n")[0], name
    assert text.count("= 4'd") == len(csr.address_map().ERRORS)
