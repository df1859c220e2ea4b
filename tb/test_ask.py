# SPDX-License-Identifier: Apache-2.0
"""The words of a row in order: places in the descriptor, kind, lane and index, and the marks of the last ones."""

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import feeding
import looks
from raydix.formats import COORD_LANES, FORM_WORDS, HEADER_WORDS, QUADRIC_WORDS, QUARTIC_WORDS, VECTOR_WORDS
from raydix.raster import LANES

KINDS = {QUADRIC_WORDS: COORD_LANES + 3, QUARTIC_WORDS: LANES, VECTOR_WORDS: COORD_LANES}  # lanes by words
RATES = (0.0, 0.3)


def order(kind, form):
    """(place, kind, lane, index) of a row's words; ``form``: its constants, too."""
    words = [(feeding.HEADER, 0, i) for i in range(HEADER_WORDS)]
    for lane in range(KINDS[kind]):
        words += [(feeding.LANE, lane, i) for i in range(6 if lane >= COORD_LANES else 3)]
    count = len(words)
    if form:
        words += [(feeding.FORM, None, i) for i in range(FORM_WORDS)]
    assert len(words) == kind or not form
    return [(place, *word) for place, word in enumerate(words)], count


async def ask(dut, random, kind, form, idle, end=None):
    """A row from its start; the first words only where ``end`` is their number."""
    load = bench.Port(dut, "ask_o", feeding.WORD)
    dut.vector_i.value, dut.quartic_i.value = int(kind == VECTOR_WORDS), int(kind == QUARTIC_WORDS)
    if kind == VECTOR_WORDS:
        dut.quartic_i.value = random.getrandbits(1)
    dut.loaded_i.value = int(not form)
    for _ in range(random.randint(1, 3)):
        dut.start_i.value, dut.lanes_i.value, dut.form_i.value = 1, 0, 0
        await FallingEdge(dut.clk_i)
    dut.start_i.value = 0
    words, lanes = order(kind, form)
    for place, of, lane, index in words[:end]:
        while True:
            given = random.random() >= idle
            dut.lanes_i.value, dut.form_i.value = int(given and place < lanes), int(given and place >= lanes)
            await ReadOnly()
            looks.differs(place, {}, place_o=(place, int(dut.place_o.value)))
            looks.differs(place, {}, ask_valid_o=(given, bool(dut.ask_valid_o.value)))
            if given:
                got = load.struct.unpack(load.read()[0])
                last = place == len(words) - 1
                wanted = {"kind": of, "last": int(last), "lane": got["lane"] if lane is None else lane, "index": index}
                looks.differs(place, {"words": kind}, ask_o=(wanted | {"word": 0}, got))
                if place < lanes:
                    looks.differs(place, {}, lanes_end_o=(place == lanes - 1, bool(dut.lanes_end_o.value)))
                else:
                    looks.differs(place, {}, form_end_o=(last, bool(dut.form_end_o.value)))
            await FallingEdge(dut.clk_i)
            if given:
                break
    dut.lanes_i.value = dut.form_i.value = 0


@cocotb.test
@cocotb.parametrize(idle=RATES)
async def equals_model(dut, idle):
    """Rows of every kind, behind each other, some given up in the middle."""
    random = bench.rng(idle)
    dut.lanes_i.value = dut.form_i.value = dut.start_i.value = 0
    await bench.start(dut)
    for number in range(40):
        kind = random.choice(list(KINDS)) if number > 3 else (*KINDS, VECTOR_WORDS)[number]
        form = kind == VECTOR_WORDS and (number < 3 or random.getrandbits(1))
        await ask(dut, random, kind, bool(form), idle, random.randrange(1, 60) if number % 5 == 4 else None)


def test_ask():
    """The counter."""
    bench.run(__name__, "rdx_ask")
