# SPDX-License-Identifier: Apache-2.0
"""The processor as a host and a display see it: AXI4-Lite, AXI4-Stream, stalls, resets, illegal programs."""

import dataclasses
import functools
import logging

import cocotb
import numpy as np
from cocotb.triggers import ClockCycles, FallingEdge, with_timeout
from cocotbext.axi import AxiStreamBus, AxiStreamSink

import bench
from materials import ONE
from raydix import processor
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.files import ROOT
from raydix.golden import trace_golden
from raydix.raster import QUARTIC_AT, ROOTS_AT, VECTOR_AT
from raydix.rtl import top_parameters
from raydix.scene import load_scene
from raydix.shade import compose
from test_csr import MAP, OK, Host

CONFIG = Config(2, 6, 32, 2, 1, "certified", surfaces=3, layers=2, max_width=24, beat=2)
SIZE = 20, 9  # an odd number of lines
LINE = 200_000  # ns, more than a whole frame takes: what hangs is ended


class Pins:
    """The AXI4-Stream ports under the names that cocotbext-axi expects."""

    def __init__(self, dut):
        self._name, self._log = dut._name, dut._log
        for signal in ("tvalid_o", "tready_i", "tdata_o", "tkeep_o", "tuser_o", "tlast_o"):
            setattr(self, f"m_axis_{signal[:-2]}", getattr(dut, f"m_axis_{signal}"))


class Display:
    """Takes lines of pixels; ``stall``: probability of a clock without ready."""

    def __init__(self, dut, stall, rng):
        logging.getLogger("cocotb").setLevel(logging.WARNING)
        self.sink = AxiStreamSink(AxiStreamBus.from_prefix(Pins(dut), "m_axis"), dut.clk_i, dut.rst_ni, False)
        if stall:
            self.sink.set_pause_generator(iter(lambda: rng.random() < stall, None))

    async def picture(self, width, height):
        """The next picture, (height, width, 3) codes; its marks are checked."""
        rows = []
        for row in range(height):
            line = await with_timeout(cocotb.start_soon(self.sink.recv()), LINE, "ns")
            assert len(line.tdata) == 3 * width, f"line {row}: {len(line.tdata)} bytes"
            marks = [line.tuser] * 3 * width if isinstance(line.tuser, int) else line.tuser  # of each byte
            beat = min(3 * CONFIG.beat, 3 * width)
            assert list(marks) == [int(row == 0)] * beat + [0] * (3 * width - beat), f"line {row}: {marks}"
            rows.append(np.array(line.tdata, np.uint8).reshape(width, 3)[:, ::-1])  # blue comes first
        return np.stack(rows)


@functools.cache
def golden(name, size=SIZE, level=None):
    """Scene, words and picture of a scene by the golden model; ``level``: of ambient light and background, u1p16."""
    scene = load_scene(ROOT / "scenes" / f"{name}.toml", *size)
    if level is not None:
        light = scene.light.model_copy(update={"ambient": level / ONE})
        background = scene.background.model_copy(update={"color": (level / ONE,) * 3})
        scene = dataclasses.replace(scene, light=light, background=background)
    compiled = compile_scene(scene, CONFIG)
    return scene, compiled, compose(scene, trace_golden(compiled, CONFIG), CONFIG, CONFIG.layers).rgb


async def program(host, name, change=None, size=SIZE, constants=True, level=None):
    """Do to the registers what the driver does for a frame; ``change`` may alter an operation (address, value).

    constants   False: descriptors and materials are not written
    """
    windows = [range(w["address"], w["address"] + w["size"]) for w in MAP.WINDOWS.values()]
    scene, compiled, _ = golden(name, size, level)
    driver = processor.Host()
    driver.frame(scene, compiled, CONFIG)
    for kind, address, value, _ in driver.operations:
        assert kind == processor.WRITE
        if not constants and any(address in window for window in windows):
            continue
        address, value = (change or (lambda *same: same))(address, value)
        assert await host.write(address, value) == OK


async def told(host, register, right):
    """Read a register until it is ``right``; an error where it never is."""
    for _ in range(1000):
        if right(await host.get(register)):
            return
    raise AssertionError(f"{register} stays at {await host.get(register)}")


async def interrupt(dut, most):
    """Clocks until there is an interrupt, or ``most``."""
    for number in range(most):
        if dut.irq_o.value:
            return number
        await FallingEdge(dut.clk_i)
    return most


async def begin(dut, stall):
    """Host, display and a reset."""
    rng = bench.rng(stall)
    host, display = Host(dut, stall, rng), Display(dut, stall, rng)
    await bench.start(dut)
    return host, display


@cocotb.test
@cocotb.parametrize(stall=(0.0, 0.4))
async def frames_equal_golden(dut, stall):
    """Frames of three scenes and sizes, each written while the one before is made: their pixels are the golden ones."""
    host, display = await begin(dut, stall)
    frames = ("sphere", SIZE), ("cone", (7, 4)), ("ellipsoid", (24, 6)), ("sphere", SIZE)

    async def write_all():
        for name, size in frames:
            await told(host, "STATUS", lambda status: not status["queued"])
            await program(host, name, size=size)

    writing = cocotb.start_soon(write_all())
    for name, size in frames:
        assert (await display.picture(*size) == golden(name, size)[2]).all(), name
    await writing
    await told(host, "FRAMES", lambda frames_made: frames_made["count"] >= len(frames))
    counted = {name.lower(): (await host.get(name))["count"] for name in ("RAYS", "HITS", "VISIBLE", "LAYERS_LOST")}
    frame = golden(*frames[-1])
    assert counted["layers_lost"] == 0 and 0 < counted["visible"] <= counted["hits"]
    rows = frame[1].surfaces[0].rect
    assert counted["rays"] <= (rows[2] - rows[0] + 1) * (rows[3] - rows[1] + 1)


@cocotb.test
@cocotb.parametrize(after=(1, 200, 900, 2500))
async def reset_in_a_frame(dut, after):
    """A reset a number of clocks after a start: the next frame is as if nothing had been."""
    host, display = await begin(dut, 0.0)
    await program(host, "sphere")
    await ClockCycles(dut.clk_i, after)
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 0
    await ClockCycles(dut.clk_i, 3)
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    display.sink.clear()
    await program(host, "cone")
    assert (await display.picture(*SIZE) == golden("cone")[2]).all()


@cocotb.test
async def reset_leaves_the_constants(dut):
    """The first frame since a reset, broken off by another one, is made again by its registers alone."""
    host, display = await begin(dut, 0.0)
    await program(host, "sphere")
    await ClockCycles(dut.clk_i, 200)
    await FallingEdge(dut.clk_i)
    await reset(dut, display)
    await program(host, "sphere", constants=False)
    assert (await display.picture(*SIZE) == golden("sphere")[2]).all()


async def reset(dut, display):
    """A reset of one clock."""
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    display.sink.clear()


NOTHING = {"busy": 0, "queued": 0, "done": 0, "error": 0}  # STATUS


@cocotb.test
async def busy_while_a_frame_is_made(dut):
    """The registers tell of a frame from its start to its end, and of nothing before."""
    host, display = await begin(dut, 0.0)
    assert await host.get("STATUS") == NOTHING
    await program(host, "cone", size=(7, 4))
    assert await host.get("STATUS") == NOTHING | {"busy": 1}
    assert (await display.picture(7, 4) == golden("cone", (7, 4))[2]).all()
    await ClockCycles(dut.clk_i, 10)
    assert await host.get("STATUS") == NOTHING | {"done": 1}
    assert (await host.get("FRAMES"))["count"] == 1


@cocotb.test
async def reset_at_the_end_of_a_frame(dut):
    """A reset of one clock in each of the last clocks before the end is told: then it is never told."""
    host, display = await begin(dut, 0.0)

    async def clocks(most):
        """Clocks from the start of a frame to its interrupt."""
        await host.put("IRQ_ENABLE", done=1)
        await program(host, "cone", size=(7, 4))
        return await interrupt(dut, most)

    whole = await clocks(20_000)
    assert 100 < whole < 20_000
    for before in range(1, 7):
        await reset(dut, display)
        assert await clocks(whole - before) == whole - before
        await reset(dut, display)
        await ClockCycles(dut.clk_i, 8)
        assert not dut.irq_o.value
        assert await host.get("STATUS") == NOTHING, before
        assert (await host.get("FRAMES"))["count"] == 0, before


@cocotb.test
async def abort_ends_with_background(dut):
    """After an abort the frame has all its pixels, the last ones background; the next frame is whole."""
    host, display = await begin(dut, 0.0)
    await program(host, "sphere")
    await host.put("CONTROL", abort=1)
    picture = await display.picture(*SIZE)
    whole = golden("sphere")[2]
    assert (picture[-1] == picture[-1, 0]).all() and (picture != whole).any()
    same = (picture == whole).all(axis=(1, 2))
    background = (picture == picture[-1, 0]).all(axis=(1, 2))
    assert (same | background).all(), "a line that is neither the picture's nor background"
    await program(host, "cone")
    assert (await display.picture(*SIZE) == golden("cone")[2]).all()


def head_with(low, width, value):
    """Changes a field of word 0 of slot 0."""
    base = MAP.WINDOWS["DESCRIPTORS"]["address"]

    def change(address, word):
        if address == base:
            word = word & ~(((1 << width) - 1) << low) | value << low
        return address, word

    return change


def rectangle_with(shift, value):
    """Changes a field of word 1 of slot 0."""
    base = MAP.WINDOWS["DESCRIPTORS"]["address"] + 8

    def change(address, word):
        if address == base + shift // 32 * 4:
            word = word & ~(0xFFF << shift % 32) | value << shift % 32
        return address, word

    return change


ILLEGAL = {
    "KIND": head_with(QUARTIC_AT, 1, 1),
    "KIND of a spiral": head_with(VECTOR_AT, 1, 1),
    "ROOTS": head_with(ROOTS_AT, 3, 5),
    "ROOTS of 0": head_with(ROOTS_AT, 3, 0),
    "RULE": head_with(ROOTS_AT + 3, 1, 1),
    "SURFACE": head_with(0, 6, CONFIG.surfaces),
    "RECTANGLE": rectangle_with(32, SIZE[0]),
    "RECTANGLE reversed": rectangle_with(16, 4000),
}


@cocotb.test
@cocotb.parametrize(what=tuple(ILLEGAL))
async def illegal_program_is_told(dut, what):
    """Error flag, code, slot and interrupt, no pixel and no hang; the next frame is whole."""
    host, display = await begin(dut, 0.0)
    await host.put("IRQ_ENABLE", error=1)
    await program(host, "sphere", ILLEGAL[what])
    assert await interrupt(dut, 5000) < 5000
    assert (await host.get("STATUS")) == {"busy": 0, "queued": 0, "done": 0, "error": 1}
    assert (await host.get("ERROR")) == {"code": MAP.ERRORS[what.split()[0]][0], "slot": 0}
    await ClockCycles(dut.clk_i, 500)
    assert display.sink.empty() and not dut.m_axis_tvalid_o.value
    await host.put("IRQ_STATUS", error=1)
    await program(host, "cone")
    assert (await display.picture(*SIZE) == golden("cone")[2]).all()


@cocotb.test
async def empty_frame_is_background(dut):
    """A frame without a descriptor is background all over."""
    host, display = await begin(dut, 0.3)
    count = MAP.REGISTERS["COUNT"]["address"]
    await program(host, "sphere", lambda address, value: (address, 0 if address == count else value))
    picture = await display.picture(*SIZE)
    assert (picture == golden("sphere")[2][0, 0]).all()


@cocotb.test
async def registers_from_end_to_end(dut):
    """Light and background from 0 to 1, each kind of skip alone: golden pictures, one of 4,096 lines."""
    host, display = await begin(dut, 0.0)
    skip = MAP.REGISTERS["SKIP"]["address"]
    frames = (ONE, (1, 1)), (ONE - 1, (1, 4096)), (0, (2, 1)), (1, (3, 2)), (ONE, (1, 1))
    for number, (level, size) in enumerate(frames):
        await program(host, "sphere", lambda a, v, bit=1 << number: (a, bit if a == skip else v), size, level=level)
        assert (await display.picture(*size) == golden("sphere", size, level)[2]).all(), (level, size)


def test_top():
    """A small processor: quadrics, three surfaces, two pixels a beat."""
    bench.run(__name__, "rdx_top", top_parameters(CONFIG), later=["reset_in_a_frame/after=(200|2500)"])
