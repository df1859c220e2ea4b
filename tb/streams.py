# SPDX-License-Identifier: Apache-2.0
"""Streams with valid, ready and data: a source, a sink that checks the two rules of a stream, and their comparison.

All signals are driven at the falling edge and looked at when they have settled; so ready may depend on ready.
"""

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly, with_timeout

import bench


async def source(dut, items, rng, idle=0.0, prefix="", data="data_i", struct=None):
    """Send ``items`` by ``<prefix>valid_i``, ``<prefix>ready_o`` and ``data``, a name or names of ports.

    idle    probability of a clock without valid after a transfer
    data    with more than one name, an item is a tuple of that many values; struct is then a tuple, too
    """
    names, many = (data, True) if isinstance(data, tuple) else ((data,), False)
    structs = struct if many and struct else (struct,) * len(names)
    ports = [bench.Port(dut, name, s) for name, s in zip(names, structs, strict=True)]
    valid, ready = getattr(dut, f"{prefix}valid_i"), getattr(dut, f"{prefix}ready_o")
    for item in items:
        while rng.random() < idle:
            valid.value = 0
            await FallingEdge(dut.clk_i)
        valid.value = 1
        for port, value in zip(ports, item if many else (item,), strict=True):
            port.write(value)
        taken = False
        while not taken:
            await ReadOnly()
            taken = bool(ready.value)
            await FallingEdge(dut.clk_i)
    valid.value = 0


class Sink:
    """Takes what comes by ``<prefix>valid_o``, ``<prefix>ready_i`` and ``data``, and checks the stream's two rules.

    stall     probability of a clock without ready
    received  unsigned words, one for each element of the port; or fields where ``struct`` is given
    """

    def __init__(self, dut, rng, stall=0.0, prefix="", data="data_o", struct=None):
        self.dut, self.rng, self.stall = dut, rng, stall
        self.valid, self.ready = getattr(dut, f"{prefix}valid_o"), getattr(dut, f"{prefix}ready_i")
        self.port = bench.Port(dut, data, struct)
        self.received = []
        self.clocks = 0
        self.transfers = []  # clock of each transfer

    async def take(self, count=None, quiet=20):
        """Take ``count`` items, or for ever; then see for ``quiet`` clocks that no more come."""
        waiting = None
        extra = 0
        while count is None or len(self.received) < count or extra < quiet:
            ready = self.rng.random() >= self.stall
            self.ready.value = int(ready)
            await ReadOnly()
            valid = bool(self.valid.value)
            words = self.port.read() if valid else None  # without valid they are anything
            if waiting is not None:
                assert valid, f"{self.port.name}: valid fell before ready, after {len(self.received)} items"
                assert words == waiting, f"{self.port.name}: {waiting} became {words} before ready"
            waiting = words if valid and not ready else None
            if valid and ready:
                self.received.append(self._item(words))
                self.transfers.append(self.clocks)
            if count is not None and len(self.received) >= count:
                extra += 1
            self.clocks += 1
            await FallingEdge(self.dut.clk_i)

    def _item(self, words):
        if self.port.struct:
            return self.port.struct.unpack(words[0])
        return words[0] if len(words) == 1 else words


def compare(expected, received):
    """Nothing lost, doubled, changed or out of order."""
    for number, (e, r) in enumerate(zip(expected, received, strict=False)):
        if e != r:
            later = [i for i, x in enumerate(expected) if x == r]
            found = f"which was sent as item {later}" if later else "which was never sent"
            raise bench.mismatch(number, {"expected": e, "got": r}, [found])
    assert len(expected) == len(received), f"{len(expected)} items expected, {len(received)} received"


async def through(dut, items, expected, idle, stall, rng, clocks_per_item=100):
    """Send ``items`` into data_i and compare what leaves data_o; the sink, for its record of clocks."""
    sink = Sink(dut, rng, stall)
    cocotb.start_soon(source(dut, items, rng, idle))
    limit = 10 * (1000 + clocks_per_item * len(items))
    await with_timeout(cocotb.start_soon(sink.take(len(expected))), limit, "ns")
    compare(expected, sink.received)
    return sink
