# SPDX-License-Identifier: Apache-2.0
"""The descriptor memory: both ports against a model, while the banks are exchanged; the reader sees its bank only."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench

WORDS = 128


class Bank:
    """Bytes that were written; what was not is unknown."""

    def __init__(self):
        self.bytes = {}

    def write(self, place, half, value, strobe):
        """Write the bytes of a half that ``strobe`` names."""
        for k in range(4):
            if strobe >> k & 1:
                self.bytes[place, 4 * half + k] = value >> (8 * k) & 0xFF

    def read(self, place, first=0, count=8):
        """(value, mask of the known bits) of ``count`` bytes."""
        known = {k: self.bytes[place, first + k] for k in range(count) if (place, first + k) in self.bytes}
        return sum(v << (8 * k) for k, v in known.items()), sum(0xFF << (8 * k) for k in known)


def bits(value, mask):
    """The bits of a port that ``mask`` names, as an integer; None where one of them is unknown."""
    text = str(value)
    unknown = int("".join("0" if c in "01" else "1" for c in text), 2)
    return None if unknown & mask else int("".join(c if c in "01" else "0" for c in text), 2) & mask


def fresh(dut):
    """All inputs at rest."""
    for name in ("swap_i", "read_i", "slot_i", "word_i", "host_req_i", "host_we_i"):
        getattr(dut, name).value = 0
    for name in ("host_addr_i", "host_data_i", "host_strobe_i"):
        getattr(dut, name).value = 0


@cocotb.test
@cocotb.parametrize(swap=(0.0, 0.01, 0.3))
async def equals_model(dut, swap):
    """Random reads, host accesses and exchanges in every clock; places are few, so that each is met often."""
    rng = bench.rng(swap)
    slots = bench.parameter(dut, "Slots")
    corners = {(s, w) for s in (0, slots - 1) for w in (0, WORDS - 1)}
    places = sorted(corners | {(rng.randrange(slots), rng.randrange(WORDS)) for _ in range(12)})
    aliases = [(s, w) for s in {min(slots, 63), 63} - set(range(slots)) for w in (0, WORDS - 1)]
    fresh(dut)
    await bench.start(dut)
    banks, used = (Bank(), Bank()), 0
    wanted, answer = None, None  # of the reader: (value, mask); of the host: whether there is one, (value, mask)
    stays = True  # no exchange since the reader's last word
    compared = 0
    for number in range(6000):
        slot, word = rng.choice(places)
        host_slot, host_word = rng.choice(places + aliases)
        given = {
            "swap_i": int(rng.random() < swap), "read_i": int(rng.random() < 0.7), "slot_i": slot, "word_i": word,
            "host_req_i": int(rng.random() < 0.7), "host_we_i": rng.getrandbits(1),
            "host_addr_i": host_slot << 8 | host_word << 1 | rng.getrandbits(1),
            "host_data_i": rng.getrandbits(32), "host_strobe_i": rng.choice([15, 15, rng.getrandbits(4)]),
        }  # fmt: skip
        for name, value in given.items():
            getattr(dut, name).value = value
        await ReadOnly()
        lines = []
        ack = int(dut.host_ack_o.value)
        if ack != (answer is not None):
            lines.append(f"host_ack_o: expected {int(answer is not None)}, got {ack}")
        for name, expected in (("data_o", wanted), ("host_data_o", answer)):
            if expected and expected[1]:
                got = bits(getattr(dut, name).value, expected[1])
                compared += 1
                if got != expected[0]:
                    lines.append(f"{name}: expected {expected[0]:#x} where {expected[1]:#x}, got {got}")
        if lines:
            raise bench.mismatch(number, {**given, "bank in use": used}, lines)
        if given["read_i"]:
            wanted, stays = banks[used].read((slot, word)), True
        elif not stays:
            wanted = None
        stays = stays and not given["swap_i"]
        answer = None
        if given["host_req_i"]:
            other, half, place = banks[1 - used], given["host_addr_i"] & 1, (host_slot, host_word)
            answer = 0, 0
            if host_slot >= slots:
                answer = (0, 0) if given["host_we_i"] else (0, 0xFFFFFFFF)
            elif given["host_we_i"]:
                other.write(place, half, given["host_data_i"], given["host_strobe_i"])
            else:
                answer = other.read(place, 4 * half, 4)
        used ^= given["swap_i"]
        await FallingEdge(dut.clk_i)
    assert compared > (6000 if swap else 1500), compared


@cocotb.test
async def every_word(dut):
    """A whole bank is written, exchanged and read: no two places are one. The other bank gets the complement."""
    slots = bench.parameter(dut, "Slots")
    fresh(dut)
    await bench.start(dut)
    dut.host_we_i.value = 1
    dut.host_strobe_i.value = 15
    for flip in (0, 0xFFFFFFFF):
        for address in range(slots * 2 * WORDS):
            dut.host_req_i.value = 1
            dut.host_addr_i.value = address
            dut.host_data_i.value = address * 0x10001 ^ flip
            await FallingEdge(dut.clk_i)
        dut.host_req_i.value = 0
        dut.swap_i.value = 1
        await FallingEdge(dut.clk_i)
        dut.swap_i.value = 0
        dut.read_i.value = 1
        for place in range(slots * WORDS):
            dut.slot_i.value, dut.word_i.value = divmod(place, WORDS)
            await FallingEdge(dut.clk_i)
            low, high = ((2 * place + half) * 0x10001 ^ flip for half in range(2))
            assert int(dut.data_o.value) == high << 32 | low, f"place {place}"
        dut.read_i.value = 0


@cocotb.test
async def reset_orders_the_banks(dut):
    """After a reset the host has the same bank as after the first one; an answer under way is gone."""
    fresh(dut)
    await bench.start(dut)

    async def access(we, value=0):
        dut.host_req_i.value, dut.host_we_i.value = 1, we
        dut.host_strobe_i.value, dut.host_data_i.value = 15, value
        await FallingEdge(dut.clk_i)
        dut.host_req_i.value = 0
        assert dut.host_ack_o.value == 1
        return bits(dut.host_data_o.value, 0xFFFFFFFF)

    await access(1, 0x1234)
    dut.swap_i.value = 1
    await FallingEdge(dut.clk_i)
    dut.swap_i.value = 0
    await access(1, 0x5678)
    assert await access(0) == 0x5678
    dut.rst_ni.value, dut.host_req_i.value, dut.host_we_i.value = 0, 1, 0
    await FallingEdge(dut.clk_i)
    assert dut.host_ack_o.value == 0
    dut.rst_ni.value, dut.host_req_i.value = 1, 0
    await FallingEdge(dut.clk_i)
    assert dut.host_ack_o.value == 0
    assert await access(0) == 0x1234


@pytest.mark.parametrize("slots", [1, 3, 8, 64])
def test_table(slots):
    """The least, a number that is no power of two, one that is, and the largest."""
    bench.run(__name__, "rdx_table", dict(Slots=slots))
