# SPDX-License-Identifier: Apache-2.0
"""Streams into one: nothing lost or doubled, each in its order, an offer stays, and each has its turn."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench


async def clock_of(dut, offers, ready):
    """Drive one clock; (valid_o, ready_o of both, data_o) when they have settled."""
    dut.valid_i.value = sum((offer is not None) << i for i, offer in enumerate(offers))
    for i, offer in enumerate(offers):
        dut.data_i[i].value = offer or 0
    dut.ready_i.value = int(ready)
    await ReadOnly()
    taken = int(dut.ready_o.value)
    return bool(int(dut.valid_o.value)), [bool(taken >> i & 1) for i in range(len(offers))], int(dut.data_o.value)


async def merge(dut, random, data, idle, stall, count=400):
    """``count`` items of each stream with ``data(stream)``: the streams of the transfers, in order."""
    streams = bench.parameter(dut, "Count")
    dut.valid_i.value = 0
    dut.ready_i.value = 0
    await bench.start(dut)
    offers, left, order, held = [None] * streams, [count] * streams, [], None
    others = [0] * streams  # transfers of other streams since the offer
    turn = 0  # the stream that goes first if it offers: the next one after a transfer, also where a pause follows
    while any(left) or any(offer is not None for offer in offers):
        for i in range(streams):
            if offers[i] is None and left[i] and random.random() >= idle[i % 2]:
                offers[i], others[i] = data(i), 0
                left[i] -= 1
        ready = random.random() >= stall
        valid, taken, value = await clock_of(dut, offers, ready)
        assert valid == any(offer is not None for offer in offers), "valid_o is that there is an offer"
        moved = [i for i in range(streams) if taken[i] and offers[i] is not None]
        assert len(moved) == (valid and ready), f"ready_i = {ready}, transfers of {moved}"
        if held is not None:
            assert value == held, f"{held} became {value} before ready"
        held = value if valid and not ready else None
        if held is not None:
            turn = next(j for j in sorted(range(streams), key=lambda j: (j - turn) % streams) if offers[j] is not None)
        for i in moved:
            assert value == offers[i], f"stream {i}: {offers[i]} became {value}"
            assert others[i] < streams, f"stream {i} waited for {others[i]} others"
            assert i == min((j for j in range(streams) if offers[j] is not None), key=lambda j: (j - turn) % streams)
            turn = (i + 1) % streams
            others = [n + (j != i) for j, n in enumerate(others)]
            order.append(i)
            offers[i] = None
        await FallingEdge(dut.clk_i)
    assert sorted(order) == [i for i in range(streams) for _ in range(count)]
    return order


RATES = ((0.0, 0.0), (0.5, 0.5), (0.9, 0.2), (0.0, 0.7))


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=(0.0, 0.3, 0.8))
async def keeps_both_streams(dut, idle, stall):
    """What is taken from a stream leaves in the same clock. Without idle clocks the streams take turns."""
    random = bench.rng(f"{idle} {stall}")
    order = await merge(dut, random, lambda i: random.getrandbits(1), idle, stall)
    if not any(idle):
        streams = bench.parameter(dut, "Count")
        assert order == list(range(streams)) * (len(order) // streams)


@cocotb.test
@cocotb.parametrize(idle=RATES)
async def offer_stays(dut, idle):
    """The same where the value names the stream: an offer that waits is not exchanged for the other stream's."""
    random = bench.rng(f"{idle}")
    await merge(dut, random, lambda i: i & 1, idle, 0.7)


@cocotb.test
@cocotb.parametrize(stream=(0, 1))
async def reset_gives_turn_to_the_first(dut, stream):
    """After a reset in the middle of an offer the first stream is taken if both offer; if only the second, that one."""
    dut.valid_i.value = 0
    dut.ready_i.value = 0
    await bench.start(dut)
    rest = [None] * (bench.parameter(dut, "Count") - 2)
    for offers in ([None, 1], [0, 1]):
        offers = [*offers, *rest]
        _, _, value = await clock_of(dut, offers, False)
        assert value == 1
        await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    _, taken, value = await clock_of(dut, [None if stream else 0, 1, *rest], True)
    assert value == stream and taken[:2] == [stream == 0, stream == 1]
    await FallingEdge(dut.clk_i)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_merge(count):
    """Items of one bit, two streams and more; records of the rings pass it in the core's tests."""
    bench.run(__name__, "rdx_merge", dict(Count=count))
