# SPDX-License-Identifier: Apache-2.0
"""The check of descriptors: each error is found, the first one stays; rows, kind and opacity of surfaces are kept."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly

import bench
import looks
from raydix.formats import BOX_WIDTH, PIXEL_WIDTH, SURFACE_WIDTH
from raydix.raster import BOX_AT, OPAQUE_AT, PAPER_AT, QUARTIC_AT, ROOTS_AT, VECTOR_AT

INFO = bench.Struct(("vector", 1), ("quartic", 1), ("y0", PIXEL_WIDTH), ("y1", PIXEL_WIDTH), ("width", PIXEL_WIDTH))
NONE, KIND, ROOTS, RECTANGLE, SURFACE, RULE, CLIP = 0, 4, 5, 6, 7, 9, 10
ORDER = (KIND, CLIP, SURFACE, RULE, ROOTS, RECTANGLE)  # of several the first counts
CERTIFIED, PAPER = 1, 2


class Built:
    """What the design at hand has."""

    def __init__(self, dut):
        self.degree, self.rules, self.clip, self.vecsum, self.slots = (
            bench.parameter(dut, name) for name in ("D", "Rules", "Clip", "Vecsum", "Slots")
        )

    def errors(self, d, size):
        """All errors of a descriptor."""
        last_x, last_y = size
        return {
            KIND: not self.vecsum if d["vector"] else self.degree != 4 if d["quartic"] else self.degree == 0,
            CLIP: not self.clip and not d["vector"] and d["box"] != 0,
            SURFACE: d["surface"] >= self.slots,
            RULE: not self.rules & (PAPER if d["paper"] else CERTIFIED),
            ROOTS: not 1 <= d["roots"] <= 4,
            RECTANGLE: d["x0"] > d["x1"] or d["y0"] > d["y1"] or d["x1"] > last_x or d["y1"] > last_y,
        }

    def error(self, d, size):
        """The one that counts."""
        found = self.errors(d, size)
        return next((error for error in ORDER if found[error]), NONE)


def header(random, d):
    """Word 0; what does not count is any bits."""
    word = random.getrandbits(64) & ~((1 << (OPAQUE_AT + 1)) - 1) & ((1 << 64) - 1)
    for name, at in (("surface", 0), ("roots", ROOTS_AT), ("paper", PAPER_AT), ("quartic", QUARTIC_AT),
                     ("vector", VECTOR_AT), ("opaque", OPAQUE_AT), ("box", BOX_AT)):  # fmt: skip
        word |= d[name] << at
    return word


def corners(random, d):
    """Word 1; the bits between the fields are any."""
    word = sum(random.getrandbits(4) << at for at in (12, 28, 44, 60))
    return word | sum(d[name] << 16 * i for i, name in enumerate(("x0", "y0", "x1", "y1")))


def good(random, built, size):
    """A descriptor without an error."""
    while True:
        x, y = (sorted(random.randrange(n + 1) for _ in range(2)) for n in size)
        d = {"surface": random.randrange(built.slots), "roots": random.randint(1, 4)}
        d |= {name: random.getrandbits(1) for name in ("paper", "quartic", "vector", "opaque")}
        d["box"] = random.choice((0, random.getrandbits(3 * BOX_WIDTH)))
        d |= {"x0": x[0], "x1": x[1], "y0": y[0], "y1": y[1]}
        if built.error(d, size) == NONE:
            return d


def bad(random, built, size, error):
    """A descriptor with that error alone; None where this design has none such."""
    for _ in range(300):
        d = good(random, built, size)
        if error == KIND:
            d["vector"], d["quartic"] = random.getrandbits(1), random.getrandbits(1)
        elif error == CLIP:
            d["box"] = random.choice((1 << random.randrange(3 * BOX_WIDTH), random.getrandbits(3 * BOX_WIDTH)))
        elif error == SURFACE:
            d["surface"] = random.getrandbits(SURFACE_WIDTH)
        elif error == RULE:
            d["paper"] ^= 1
        elif error == ROOTS:
            d["roots"] = random.choice((0, 5, 6, 7))
        else:
            axis = random.randrange(2)
            first, last = ("x0", "x1") if axis == 0 else ("y0", "y1")
            if random.getrandbits(1):
                d[last] = min(size[axis] + random.choice((1, 1, 2, 100)), 4095)
            else:
                d[first] = min(d[last] + random.choice((1, 1, 2, 100)), 4095)
        if [e for e, there in built.errors(d, size).items() if there] == [error]:
            return d
    return None


async def audit(dut, random, built, size, descriptors, idle=0.0):
    """Ask for two words of each slot; the error after the last of them, and what is kept, against the model."""
    dut.last_x_i.value, dut.last_y_i.value = size
    dut.asked_i.value = random.getrandbits(1)
    dut.clear_i.value = 1
    await FallingEdge(dut.clk_i)
    dut.clear_i.value = 0
    fault, asked, pending = (NONE, None), False, []
    for slot, d in enumerate(descriptors):
        for second, word in enumerate((header(random, d), corners(random, d))):
            while True:
                asked = random.random() >= idle
                dut.asked_i.value = int(asked)
                dut.second_i.value = second if asked else random.getrandbits(1)
                dut.slot_i.value = slot if asked else random.randrange(built.slots)
                pending.append((slot, d) if asked and second else None)
                await ReadOnly()
                if len(pending) > 2 and (done := pending.pop(0)) and fault[0] == NONE:
                    fault = built.error(done[1], size), done[0]
                looks.differs(slot, d, fault_o=(fault[0], int(dut.fault_o.value)))
                if fault[0] != NONE:
                    looks.differs(slot, d, fault_slot_o=(fault[1], int(dut.fault_slot_o.value)))
                await FallingEdge(dut.clk_i)
                # the table's word comes now; without a question it is anything
                dut.table_i.value = word if asked else random.getrandbits(64)
                if asked:
                    break
    dut.asked_i.value = 0
    for _ in range(2):
        await FallingEdge(dut.clk_i)
        dut.table_i.value = random.getrandbits(64)
    found = ((built.error(d, size), slot) for slot, d in enumerate(descriptors))
    fault = next((f for f in found if f[0] != NONE), (NONE, None))
    looks.differs(0, {"descriptors": descriptors}, fault_o=(fault[0], int(dut.fault_o.value)))
    if fault[0] != NONE:
        looks.differs(0, {"descriptors": descriptors}, fault_slot_o=(fault[1], int(dut.fault_slot_o.value)))
    opaque = {}
    for slot, d in enumerate(descriptors):
        dut.slot_i.value = slot
        await ReadOnly()
        wanted = {name: d[name] for name in ("vector", "quartic", "y0", "y1")}
        wanted["width"] = (d["x1"] - d["x0"]) & 0xFFF
        looks.differs(slot, d, info_o=(wanted, INFO.unpack(int(dut.info_o.value))))
        opaque[d["surface"]] = d["opaque"]
        await FallingEdge(dut.clk_i)
    for surface, bit in opaque.items():
        looks.differs(surface, {}, opaque_o=(bit, int(dut.opaque_o.value[surface])))
    return fault[0]


async def begin(dut):
    """Clock; no error."""
    for name in ("asked_i", "second_i", "slot_i", "table_i", "last_x_i", "last_y_i"):
        getattr(dut, name).value = 0
    dut.clear_i.value = 1
    await bench.start(dut)
    return Built(dut)


def any_size(random):
    """Last column and row of a frame."""
    return tuple(random.choice((0, 4095, random.randrange(4096), random.randrange(100))) for _ in range(2))


@cocotb.test
@cocotb.parametrize(idle=(0.0, 0.4))
async def good_frames(dut, idle):
    """Frames without an error, of one surface and of as many as are built."""
    random = bench.rng(idle)
    built = await begin(dut)
    for count in (1, built.slots, built.slots, built.slots):
        size = any_size(random)
        descriptors = [good(random, built, size) for _ in range(count)]
        assert await audit(dut, random, built, size, descriptors, idle) == NONE


@cocotb.test
async def each_error(dut):
    """Each error that the design can have, alone, in the first and in the last slot; the next audit is without it."""
    random = bench.rng()
    built = await begin(dut)
    seen = set()
    for error in ORDER * 4:
        size = tuple(min(4090, s) for s in any_size(random))
        descriptors = [good(random, built, size) for _ in range(built.slots)]
        if d := bad(random, built, size, error):
            seen.add(error)
            descriptors[random.choice((0, -1))] = d
            assert await audit(dut, random, built, size, descriptors, 0.1) == error
    wanted = {ROOTS, RECTANGLE} | ({SURFACE} if built.slots < 64 else set()) | ({RULE} if built.rules < 3 else set())
    wanted |= {KIND} if built.degree < 4 or not built.vecsum else set()
    wanted |= {CLIP} if built.degree and not built.clip else set()
    assert seen == wanted


@cocotb.test
async def first_slot_wins(dut):
    """Any bits as descriptors: of the errors of a slot the order decides, of those of several slots the first slot."""
    random = bench.rng()
    built = await begin(dut)
    seen = set()
    for number in range(60):
        size = any_size(random)
        descriptors = []
        for _ in range(built.slots):
            d = good(random, built, size)
            if random.random() < (1.0 if number & 1 else 2 / built.slots):
                for name, bits in random.sample(
                    [
                        ("surface", 6),
                        ("roots", 3),
                        ("paper", 1),
                        ("quartic", 1),
                        ("vector", 1),
                        ("x1", 12),
                        ("y0", 12),
                        ("box", 15),
                    ],
                    3,
                ):
                    d[name] = random.getrandbits(bits)
            descriptors.append(d)
        seen.add(await audit(dut, random, built, size, descriptors, random.choice((0.0, 0.3))))
    assert len(seen) > 2, seen


CASES = [
    dict(D=4, Rules=3, Vecsum=0, Slots=64), dict(D=2, Rules=1, Clip=0, Vecsum=2, Slots=5),
    dict(D=0, Rules=2, Vecsum=1, Slots=1), dict(D=4, Rules=3, Clip=0, Vecsum=2, Slots=3),
]  # fmt: skip


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_audit(parameters):
    """Kinds, rules and slots that are built."""
    bench.run(__name__, "rdx_audit", parameters)
