# SPDX-License-Identifier: Apache-2.0
"""Words of rows: each equals the model's forward differences, rows below each other, surfaces in turns."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import looks
from raydix.fdiff import DXX, ROW_SLOPE, ROW_VALUE, ROWS, load, next_row
from raydix.formats import COORD_LANES, FORM_WORDS, HEADER_WORDS
from raydix.kernel import zeros

HEADER, LANE, FORM = range(3)  # kinds of words
WORD = bench.Struct(("kind", 2), ("last", 1), ("lane", 4), ("index", 7), ("word", 64))
MASK = (1 << 64) - 1
GAP = 4  # clocks after which a surface may be asked for again


def lane_words(lane):
    """Words of a lane in a descriptor."""
    return 6 if lane >= COORD_LANES else 3


def order(lanes, form, last=True):
    """What is asked for, for a row: (kind, lane, index, whether it is the last word)."""
    asks = [(HEADER, 0, i) for i in range(HEADER_WORDS)]
    asks += [(LANE, lane, i) for lane in range(lanes) for i in range(lane_words(lane))]
    asks += [(FORM, 0, i) for i in range(FORM_WORDS if form else 0)]
    return [(*ask, int(last and number == len(asks) - 1)) for number, ask in enumerate(asks)]


class Surface:
    """Words of a descriptor of any bits, and the model's lanes at its current row."""

    def __init__(self, random, lanes, form=False):
        self.lanes, self.form = lanes, form
        self.header = [random.getrandbits(64) for _ in range(HEADER_WORDS)]
        self.words = [[bench.signed(random.getrandbits(64), 64) for _ in range(lane_words(i))] for i in range(lanes)]
        self.constants = [random.getrandbits(64) for _ in range(FORM_WORDS)]
        self.first()

    def first(self):
        """To the first row."""
        self.state = zeros(ROWS * self.lanes).reshape(ROWS, self.lanes)
        for lane, words in enumerate(self.words):
            load(self.state, lane, [*words, 0, 0, 0], 0, lane >= COORD_LANES)

    def next(self):
        """To the next row."""
        next_row(self.state)

    def table(self, kind, lane, index):
        """The word of the descriptor."""
        return (self.header, self.words[lane] if kind == LANE else None, self.constants)[kind][index] & MASK

    def load(self, ask, y):
        """What leaves for a word that is asked for, as fields of :data:`WORD`; None for nothing."""
        kind, lane, index, last = ask
        if kind != LANE:
            word = self.table(kind, lane, index)
            if (kind, index) == (HEADER, 1):
                word = word & ~(0xFFF << 16) | y << 16
        elif index in (0, 1, 3):
            word = self.state[{0: ROW_VALUE, 1: ROW_SLOPE, 3: DXX}[index], lane]
            index = 2 if index == 3 else index
        elif last:
            index, word = 3, None  # only the mark counts
        else:
            return None
        return {"kind": kind, "last": last, "lane": lane, "index": index, "word": None if word is None else word & MASK}


async def run_rows(dut, random, surfaces, rows, idle):
    """``rows``: (number of the surface, whether its first row, y) in order; each word against the model."""
    out = []  # (clock, what leaves)
    busy = {}  # clock -> whether a word is under way
    table, clock, count = random.getrandbits(64), 0, 0
    dut.table_i.value = table

    async def tick(ask=None, surface=None, slot=0, first=0, y=0):
        nonlocal clock, count
        valid = ask is not None
        kind, lane, index, last = (
            ask if valid else (random.getrandbits(1), random.getrandbits(4), random.getrandbits(7), 1)
        )
        dut.ask_valid_i.value = int(valid)
        dut.ask_i.value = WORD.pack(
            {"kind": kind, "last": last, "lane": lane, "index": index, "word": random.getrandbits(64)}
        )
        dut.slot_i.value, dut.first_i.value, dut.y_i.value = slot, first, y
        if valid:
            out.append((clock + 2, surface.load(ask, y), ask))
            writes = kind == LANE and index in (2, 4, 5)
            busy.update({clock + 1: True, clock + 2: True, **({clock + 3: True} if writes else {})})
        await ReadOnly()
        looks.differs(count, {}, busy_o=(busy.pop(clock, False), bool(dut.busy_o.value)))
        wanted = out.pop(0) if out and out[0][0] == clock else None
        loads = wanted is not None and wanted[1] is not None
        looks.differs(count, {"ask": wanted}, load_valid_o=(loads, bool(dut.load_valid_o.value)))
        if loads:
            got = WORD.unpack(int(dut.load_o.value))
            expected = {name: got[name] if value is None else value for name, value in wanted[1].items()}
            looks.differs(count, {"ask": wanted[2]}, load_o=(expected, got))
            count += 1
        await FallingEdge(dut.clk_i)
        # the table's word comes a clock later; where none was asked for it is anything
        dut.table_i.value = surface.table(kind, lane, index) if valid else random.getrandbits(64)
        clock += 1

    for slot, first, y in rows:
        surface = surfaces[slot]
        surface.first() if first else surface.next()
        for ask in order(surface.lanes, surface.form):
            while random.random() < idle:
                await tick(slot=slot, first=first, y=y)
            await tick(ask, surface, slot, first, y)
        for _ in range(GAP):
            await tick(slot=random.randrange(len(surfaces)), first=random.getrandbits(1), y=random.getrandbits(12))
    assert count and not out


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.4))
async def equals_model(dut, idle):
    """Surfaces of every kind in turns, as on lines that they cross; a frame after the other begins from the table."""
    random = bench.rng(idle)
    dut.ask_valid_i.value = 0
    await bench.start(dut)
    slots = bench.parameter(dut, "Slots")
    kinds = [(6, True), (15, False), (9, False)]
    for _ in range(2):
        surfaces = [Surface(random, *kinds[i % 3]) for i in range(slots)]
        used = sorted(random.sample(range(slots), min(slots, 4)) + [slots - 1])
        begun, rows, y = set(), [], random.randrange(4000)
        for line in range(7):
            for slot in sorted(set(used)):
                if slot in begun or line == 6 or random.random() < 0.6:
                    rows.append((slot, int(slot not in begun), y + line))
                    begun.add(slot)
        await run_rows(dut, random, surfaces, rows, idle)


@cocotb.test
async def table_stays(dut):
    """A surface that is begun again has the table's words, whatever was kept of it."""
    random = bench.rng()
    dut.ask_valid_i.value = 0
    await bench.start(dut)
    surface = [Surface(random, 9)]
    await run_rows(dut, random, surface, [(0, int(i % 3 == 0), 4095 * (i & 1)) for i in range(9)], 0.0)


@cocotb.test
async def reset_takes_words_away(dut):
    """A reset while words are under way: none leaves, nothing is kept of them."""
    random = bench.rng()
    dut.ask_valid_i.value = 0
    await bench.start(dut)
    for clocks in (1, 2, 3):
        dut.ask_valid_i.value = 1
        dut.ask_i.value = WORD.pack({"kind": LANE, "last": 1, "lane": 0, "index": 2, "word": 0})
        for _ in range(clocks):
            await FallingEdge(dut.clk_i)
        dut.ask_valid_i.value = 0
        dut.rst_ni.value = 0
        await FallingEdge(dut.clk_i)
        assert dut.busy_o.value == 0 and dut.load_valid_o.value == 0
        dut.rst_ni.value = 1
    await run_rows(dut, random, [Surface(random, 6)], [(0, 1, 1), (0, 0, 2)], 0.0)


@pytest.mark.parametrize("slots", [1, 5, 64])
def test_advance(slots):
    """One surface, a number that is no power of two, and the largest."""
    bench.run(__name__, "rdx_advance", dict(Slots=slots))
