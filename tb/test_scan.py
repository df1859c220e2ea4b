# SPDX-License-Identifier: Apache-2.0
"""Rows one by one: every ray that is not hidden, in order, with the model's ends and accumulators."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, with_timeout

import bench
import feeding
import looks
import streams
import streams_extra
from raydix.core import FORM_AT
from raydix.formats import DEPTH_WIDTH
from test_raster import CASES, STRUCTS, VECTOR, descriptor, kinds, rays

RATES = (0.0, 0.5)


def make_rows(dut, random, limits, widths):
    """(descriptor of one row, whether its constants are loaded); often two rows of a vector sum behind each other."""
    rows, before = [], None
    for number, width in enumerate(widths):
        kind = random.choice(kinds(dut)) if number > 2 else kinds(dut)[number % len(kinds(dut))]
        d = descriptor(random, width, 1, kind)
        near = random.choice(limits.depths)
        d[2] = near | random.getrandbits(DEPTH_WIDTH - 1) << 32
        same = kind == VECTOR and before is not None and random.random() < 0.5
        if same:
            d[FORM_AT:] = before[FORM_AT:]
        rows.append((d, kind == VECTOR and not same))
        before = d if kind == VECTOR else before
    return rows


async def feed(dut, random, rows, idle):
    """Give the rows' words: in any order but for the last one; constants where nothing is under way."""
    port = bench.Port(dut, "load_i", feeding.WORD)
    for d, form in rows:
        loads = feeding.row(d, d[1] >> 16 & 0xFFF, form)
        lanes = [load for load in loads[:-1] if load["kind"] != feeding.FORM]
        random.shuffle(lanes)
        for load in lanes + [load for load in loads if load["kind"] == feeding.FORM or load["last"]]:
            while True:
                # full_o and idle_o come from registers, so that they tell here already
                waits = dut.full_o.value == 1 or (load["kind"] == feeding.FORM and dut.idle_o.value == 0)
                given = not waits and random.random() >= idle
                dut.load_valid_i.value = int(given)
                noise = (
                    load
                    if given
                    else {"kind": random.randrange(3), "lane": random.randrange(16), "index": 0, "last": 1}
                )
                port.write(noise | {"word": random.getrandbits(64) if noise.get("word") is None else noise["word"]})
                await FallingEdge(dut.clk_i)
                if given:
                    break
        dut.load_valid_i.value = 0


async def watch(dut, limits, hidden):
    """Answer the questions; record what is hidden: lowest bits of the rows."""
    while True:
        await ReadOnly()
        asked = limits.asked()
        if dut.hidden_o.value == 1:
            hidden.append(int(dut.hidden_row_o.value))
        await FallingEdge(dut.clk_i)
        limits.answer(asked)


async def scan(dut, random, rows, limits, idle, stall):
    """All rows through the design, compared with the model; the sink."""
    every = list(rays(dut, [d for d, _ in rows]))

    def bit(ray):
        return ray["ray_o"]["y"] & 3

    hides = [limits.hides(bit(ray), ray["ray_o"]["x"], ray["ends_o"]["depth_start"]) for ray in every]
    expected = [ray for ray, h in zip(every, hides, strict=True) if not h]
    for ray in expected:
        ray["ray_o"]["limit"] = limits.carried(bit(ray), ray["ray_o"]["x"])
    hidden = []
    sink = streams_extra.sink(dut, random, stall, "ray_", STRUCTS)
    watching = cocotb.start_soon(watch(dut, limits, hidden))
    feeding_task = cocotb.start_soon(feed(dut, random, rows, idle))
    limit = 10 * (1000 + 20 * len(every) + 400 * len(rows))
    await with_timeout(cocotb.start_soon(sink.take(len(expected))), limit, "ns")
    await with_timeout(feeding_task, limit, "ns")
    for _ in range(10000):
        if dut.idle_o.value == 1:
            break
        await FallingEdge(dut.clk_i)
    assert dut.idle_o.value == 1 and dut.full_o.value == 0
    watching.cancel()
    streams_extra.compare(sink.port, expected, sink.received)
    streams.compare([bit(ray) for ray, h in zip(every, hides, strict=True) if h], hidden)
    return sink


async def start(dut, random, share):
    """Clock and reset, with the ports at rest; the limits."""
    dut.load_valid_i.value = 0
    dut.ray_ready_i.value = 0
    limits = looks.Limits(dut, random, share)
    await bench.start(dut)
    return limits


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES, share=(0.0, 0.5))
async def equals_model(dut, idle, stall, share):
    """Rows of every kind and of 1 to 12 pixels, hidden ones among them, with idle clocks and stalls."""
    random = bench.rng(f"{idle} {stall} {share}")
    limits = await start(dut, random, share)
    await scan(dut, random, make_rows(dut, random, limits, looks.widths(random, 24)), limits, idle, stall)


@cocotb.test
async def no_gap(dut):
    """Rows at least as long as their words take follow without a gap: a ray in every clock."""
    random = bench.rng()
    limits = await start(dut, random, 0.0)
    rows = []
    for kind in kinds(dut)[-1:] * 5:
        d = descriptor(random, 60, 1, kind)
        if rows:
            d[FORM_AT:] = rows[0][0][FORM_AT:] if kind == VECTOR else d[FORM_AT:]
        rows.append((d, kind == VECTOR and not rows))
    sink = await scan(dut, random, rows, limits, 0.0, 0.0)
    at = sink.transfers
    assert at == list(range(at[0], at[0] + 300)), at


@cocotb.test
async def all_hidden(dut):
    """Rows of which no pixel has a ray: nothing waits for ready."""
    random = bench.rng()
    limits = await start(dut, random, 1.0)
    limits.depths = (0,)
    rows = [(descriptor(random, 20, 1, kinds(dut)[-1]), False) for _ in range(4)]
    for d, _ in rows:
        d[2] |= 1
    if kinds(dut)[-1] == VECTOR:
        rows = [(rows[0][0], True), *((d[:FORM_AT] + rows[0][0][FORM_AT:], False) for d, _ in rows[1:])]
    sink = await scan(dut, random, rows, limits, 0.0, 1.0)
    assert not sink.received


@cocotb.test
async def reset_ends_row(dut):
    """A reset in the middle of a row, with another that waits: both are gone."""
    random = bench.rng()
    limits = await start(dut, random, 0.0)
    for clocks in (100, 130, 160):
        rows = make_rows(dut, random, limits, [30, 30, 30])
        task = cocotb.start_soon(feed(dut, random, rows, 0.0))
        for _ in range(clocks):
            await FallingEdge(dut.clk_i)
        task.cancel()
        dut.load_valid_i.value = 0
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        assert dut.ray_valid_o.value == 0 and dut.full_o.value == 0 and dut.idle_o.value == 1
        dut.rst_ni.value = 1
        limits = looks.Limits(dut, random, 0.3)
        await scan(dut, random, make_rows(dut, random, limits, [3, 1, 9]), limits, 0.2, 0.2)


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_scan(parameters):
    """Quadrics alone, and quartics too; vector sums alone, and beside them."""
    bench.run(__name__, "rdx_scan", parameters)
