# SPDX-License-Identifier: Apache-2.0
"""A sink for a stream whose data are several ports, beside ``streams.py``."""

import bench
import streams


class Bundle:
    """Several ports as one: their words behind each other."""

    struct = None

    def __init__(self, dut, structs):
        self.ports = [bench.Port(dut, name, struct) for name, struct in structs.items()]
        self.name = " ".join(structs)

    def read(self):
        """All words."""
        return [word for port in self.ports for word in port.read()]

    def differences(self, expected, words):
        """Lines that tell where ``words`` differ from ``expected``, a dictionary of ports to values."""
        lines, at = [], 0
        for port in self.ports:
            mine = words[at : at + len(port.handles)]
            at += len(mine)
            lines += port.differences(port.words(expected[port.name]), mine)
        return lines


def sink(dut, rng, stall, prefix, structs):
    """A :class:`streams.Sink` of the ports that ``structs`` names (None: no struct); it receives their words."""
    first, struct = next(iter(structs.items()))
    taker = streams.Sink(dut, rng, stall, prefix, first, struct)
    taker.port = Bundle(dut, structs)
    return taker


def compare(bundle, expected, received):
    """Nothing lost, doubled, changed or out of order: ``expected`` are dictionaries of ports to values."""
    for number, (e, r) in enumerate(zip(expected, received, strict=False)):
        lines = bundle.differences(e, r)
        if lines:
            raise bench.mismatch(number, {"expected": e}, lines)
    assert len(expected) == len(received), f"{len(expected)} items expected, {len(received)} received"
