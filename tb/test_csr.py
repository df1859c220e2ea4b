# SPDX-License-Identifier: Apache-2.0
"""The host's side over a stalling AXI4-Lite: registers as they are described, starts, errors, interrupt, windows."""

import logging

import cocotb
import pytest
from cocotb.triggers import FallingEdge, with_timeout
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp

import bench
from raydix import csr
from test_check import FRAME, code, frame, requests

MAP = csr.address_map()
WRITABLE = ("SIZE", "COUNT", "K_STOP", "SKIP", "AMBIENT", "BACKGROUND_R", "BACKGROUND_G", "BACKGROUND_B")
COUNTERS = bench.Struct(
    ("cycles", 64), ("steps", 64),
    *((name, 32) for name in (
        "rays", "hits", "skipped_rectangle", "skipped_rootless", "skipped_depth", "skipped_boxes", "skipped_cells",
        "skipped_early", "visible", "layers_lost", "given_up", "stalled",
    )),
)  # fmt: skip
STALLS = (0.0, 0.3, 0.8)
OK, SLVERR = AxiResp.OKAY, AxiResp.SLVERR
LIMIT = 4_000_000  # ns: what hangs is ended


class Pins:
    """The AXI4-Lite ports under the names that cocotbext-axi expects."""

    def __init__(self, dut):
        self._name, self._log = dut._name, dut._log
        for channel in ("aw", "w", "b", "ar", "r"):
            for signal in ("valid", "ready", "addr", "data", "strb", "resp"):
                for way in "io":
                    handle = getattr(dut, f"axil_{channel}{signal}_{way}", None)
                    if handle is not None:
                        setattr(self, f"s_axil_{channel}{signal}", handle)


class Host:
    """Reads and writes words; each as (value, response) or response."""

    def __init__(self, dut, stall, rng):
        self.dut, self.rng = dut, rng
        logging.getLogger("cocotb").setLevel(logging.WARNING)
        self.axi = AxiLiteMaster(AxiLiteBus.from_prefix(Pins(dut), "s_axil"), dut.clk_i, dut.rst_ni, False)
        ends = self.axi.write_if, self.axi.read_if
        channels = [ends[0].aw_channel, ends[0].w_channel, ends[0].b_channel, ends[1].ar_channel, ends[1].r_channel]
        if stall:
            for channel in channels:
                channel.set_pause_generator(iter(lambda: rng.random() < stall, None))

    async def write(self, address, value, strobe=15):
        """Write the bytes that ``strobe``, a run of ones, names."""
        first, count = (strobe & -strobe).bit_length() - 1, strobe.bit_count()
        data = (value >> (8 * first) & ((1 << (8 * count)) - 1)).to_bytes(count, "little")
        return (await with_timeout(cocotb.start_soon(self.axi.write(address + first, data)), LIMIT, "ns")).resp

    async def read(self, address):
        """Value and response."""
        answer = await with_timeout(cocotb.start_soon(self.axi.read(address, 4)), LIMIT, "ns")
        return int.from_bytes(answer.data, "little"), answer.resp

    async def put(self, name, **fields):
        """Write fields of a register, the others 0."""
        places = MAP.REGISTERS[name]["fields"]
        value = sum(v << places[f]["low"] for f, v in fields.items())
        assert await self.write(MAP.REGISTERS[name]["address"], value) == OK, name

    async def get(self, name):
        """Fields of a register."""
        value, response = await self.read(MAP.REGISTERS[name]["address"])
        assert response == OK, name
        return {f: value >> p["low"] & ((1 << p["width"]) - 1) for f, p in MAP.REGISTERS[name]["fields"].items()}

    async def request(self, request):
        """Write the registers of a frame."""
        await self.put("SIZE", width=request["width"], height=request["height"])
        await self.put("COUNT", count=request["count"])
        await self.put("K_STOP", k_stop=request["k_stop"])
        skip = {name: request["skip"] >> i & 1 for i, name in enumerate(MAP.REGISTERS["SKIP"]["fields"])}
        await self.put("SKIP", **skip)
        await self.put("AMBIENT", ambient=request["ambient"])
        for i, name in enumerate(("red", "green", "blue")):
            await self.put(f"BACKGROUND_{name[0].upper()}", **{name: request["background"][i]})


async def begin(dut, stall, salt=""):
    """Everything at rest, and a reset; the host and random numbers."""
    rng = bench.rng(f"{stall} {salt}")
    for name in ("start_ready_i", "busy_i", "done_i", "counters_i", "error_valid_i", "error_code_i", "error_slot_i",
                 "table_ack_i", "table_data_i"):  # fmt: skip
        getattr(dut, name).value = 0
    host = Host(dut, stall, rng)
    await bench.start(dut)
    return host, rng


async def pulse(dut, name):
    """An input at 1 for one clock."""
    await FallingEdge(dut.clk_i)
    getattr(dut, name).value = 1
    await FallingEdge(dut.clk_i)
    getattr(dut, name).value = 0


def legal(rng, dut):
    """A request that is accepted."""
    built = {name: bench.parameter(dut, name) for name in ("K", "Surfaces", "MaxWidth")}
    return next(r for r in requests(rng, built) if not code(r, False, built))


def parameters_of(dut):
    """Fields of the PARAMETERS registers."""
    names = {
        "n1": "N1", "k": "K", "step_units": "U", "width": "W", "degree": "D", "vecsum": "Vecsum", "rules": "Rules",
        "clip": "Clip", "lanes": "Lanes", "vector_units": "VectorUnits", "rings": "Rings", "surfaces": "Surfaces",
        "vector_rings": "VectorRings", "vector_drop": "VectorDrop", "layers": "Layers",
        "max_width": "MaxWidth", "pixels": "Pixels",
    }  # fmt: skip
    return {field: bench.parameter(dut, name) for field, name in names.items()}


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def reset_values(dut, stall):
    """After a reset each register reads as described; what is only written answers with an error."""
    host, _ = await begin(dut, stall)
    built = parameters_of(dut)
    for name, register in MAP.REGISTERS.items():
        fields = register["fields"]
        if all(f["access"] == "w" for f in fields.values()):
            assert await host.read(register["address"]) == (0, SLVERR), name
            continue
        got = await host.get(name)
        for field, value in got.items():
            reset = fields[field]["reset"] or 0
            assert value == (built[field] if name.startswith("PARAMETERS") else reset), (name, field, value)
    assert (await host.read(0))[0] >> 8 == int.from_bytes(b"RDX", "big")


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def accesses(dut, stall):
    """Random values with random byte strobes: what can be written keeps it, what cannot answers with an error."""
    host, rng = await begin(dut, stall)
    kept = {name: (await host.read(r["address"]))[0] for name, r in MAP.REGISTERS.items()}
    for _ in range(4):
        for name, register in rng.sample(list(MAP.REGISTERS.items()), len(MAP.REGISTERS)):
            fields = register["fields"].values()
            value, strobe = rng.getrandbits(32), rng.choice([15, 1, 2, 4, 8, 3, 6, 12, 7, 14])
            mask = sum(0xFF << (8 * k) for k in range(4) if strobe >> k & 1)
            if name == "CONTROL":
                continue
            answer = await host.write(register["address"], value, strobe)
            if all(f["access"] == "r" for f in fields):
                assert answer == SLVERR, name
            else:
                assert answer == OK, name
                for f in fields:
                    bits = (((1 << f["width"]) - 1) << f["low"]) & mask
                    if f["access"] == "rw":
                        kept[name] = kept[name] & ~bits | value & bits
            for other in {name, rng.choice(list(MAP.REGISTERS))} - {"CONTROL"}:
                got = await host.read(MAP.REGISTERS[other]["address"])
                assert got == (kept[other], OK), f"{other} after {value:#x}/{strobe:04b} to {name}: {got[0]:#x}"


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def unmapped(dut, stall):
    """Any other address answers with an error, to reads and writes; nothing hangs, nothing leaves."""
    host, rng = await begin(dut, stall)
    mapped = {r["address"] for r in MAP.REGISTERS.values()}
    inside = [range(w["address"], w["address"] + w["size"]) for w in MAP.WINDOWS.values()]
    free = [a for a in range(0, 1 << 18, 4) if a not in mapped and not any(a in r for r in inside)]
    assert {0x28, 0x1000, 0x24000, 0x3FFFC} <= set(free)
    kept = await host.read(MAP.REGISTERS["SKIP"]["address"])
    for address in [0x28, 0x3C, 0xC4, 0x1000, 0xFFFC, 0x24000, 0x3FFFC, *rng.sample(free, 20)]:
        assert await host.read(address) == (0, SLVERR), hex(address)
        assert await host.write(address, rng.getrandbits(32)) == SLVERR, hex(address)
    assert await host.read(MAP.WINDOWS["MATERIALS"]["address"]) == (0, SLVERR)
    assert await host.read(MAP.REGISTERS["SKIP"]["address"]) == kept
    assert dut.start_valid_o.value == 0


async def table(dut, rng, memory, slow):
    """Answers the port of the descriptors, some time later, from ``memory``."""
    while True:
        await FallingEdge(dut.clk_i)
        dut.table_ack_i.value = 0
        if not dut.table_req_o.value:
            continue
        address, value, we = int(dut.table_addr_o.value), int(dut.table_data_o.value), int(dut.table_we_o.value)
        mask = sum(0xFF << (8 * k) for k in range(4) if int(dut.table_strobe_o.value) >> k & 1)
        await FallingEdge(dut.clk_i)
        while rng.random() < slow:
            dut.table_data_i.value = rng.getrandbits(32)
            assert not dut.table_req_o.value, "a second access while one waits"
            await FallingEdge(dut.clk_i)
        if we:
            memory[address] = memory.get(address, 0) & ~mask | value & mask
        dut.table_data_i.value = rng.getrandbits(32) if we else memory.get(address, 0)
        dut.table_ack_i.value = 1


async def materials(dut, written):
    """Notes what is written to the materials."""
    while True:
        await FallingEdge(dut.clk_i)
        if dut.material_we_o.value:
            place = int(dut.material_surface_o.value), int(dut.material_constant_o.value)
            written.append((*place, int(dut.material_data_o.value)))


@cocotb.test
@cocotb.parametrize(stall=STALLS, slow=(0.0, 0.7))
async def windows(dut, stall, slow):
    """Descriptors are written by bytes and read back, materials are written by words; both between other accesses."""
    host, rng = await begin(dut, stall, slow)
    memory, kept, written, sent = {}, {}, [], []
    cocotb.start_soon(table(dut, rng, memory, slow))
    cocotb.start_soon(materials(dut, written))
    places = [0, 0x3FFF, *(rng.randrange(1 << 14) for _ in range(6))]

    async def descriptors():
        for _ in range(40):
            place, value, strobe = rng.choice(places), rng.getrandbits(32), rng.choice([15, 15, 1, 2, 8, 6, 14])
            mask = sum(0xFF << (8 * k) for k in range(4) if strobe >> k & 1)
            assert await host.write(0x10000 + 4 * place, value, strobe) == OK
            kept[place] = kept.get(place, 0) & ~mask | value & mask
            place = rng.choice(places)
            assert await host.read(0x10000 + 4 * place) == (kept.get(place, 0), OK)

    async def reads():
        for _ in range(40):
            first = rng.randrange(4)
            data = (await host.axi.read(first, 4 - first)).data
            assert data == bytes([1, *b"XDR"])[first:]

    async def others():
        for _ in range(40):
            surface, constant, value = rng.getrandbits(6), rng.getrandbits(6), rng.getrandbits(32)
            strobe = rng.choice([15, 15, 15, 7])
            assert await host.write(0x20000 + 256 * surface + 4 * constant, value, strobe) == OK
            if strobe == 15:
                sent.append((surface, constant, value))
            assert (await host.read(0))[1] == OK

    tasks = [cocotb.start_soon(f()) for f in (descriptors, others, reads, reads, reads)]
    for task in tasks:
        await with_timeout(task, LIMIT, "ns")
    assert written == sent
    slot, word, half = places[-1] >> 8, places[-1] >> 1 & 127, places[-1] & 1
    await host.write(MAP.WINDOWS["DESCRIPTORS"]["address"] + 1024 * slot + 8 * word + 4 * half, 0x5EED)
    assert memory[places[-1]] == 0x5EED


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def starts(dut, stall):
    """A start copies the registers and waits; a second one is an error; the registers can be written meanwhile."""
    host, rng = await begin(dut, stall)
    port = bench.Port(dut, "frame_o", FRAME)
    for _ in range(4):
        first, other = legal(rng, dut), legal(rng, dut)
        await host.request(first)
        assert dut.start_valid_o.value == 0
        await host.put("CONTROL", start=1)
        await host.request(other)
        dut.busy_i.value = rng.getrandbits(1)
        assert await host.get("STATUS") == {"busy": int(dut.busy_i.value), "queued": 1, "done": 0, "error": 0}
        await host.put("CONTROL", start=1)
        assert await host.get("ERROR") == {"code": MAP.ERRORS["QUEUED"][0], "slot": 0}
        assert dut.start_valid_o.value == 1
        assert not port.differences(port.words(frame(first)), port.read())
        await host.put("IRQ_STATUS", error=1)
        assert await host.get("ERROR") == {"code": 0, "slot": 0}
        await pulse(dut, "start_ready_i")
        assert dut.start_valid_o.value == 0
        await host.put("CONTROL", start=1)
        assert (await host.get("STATUS"))["queued"] == 1
        assert not port.differences(port.words(frame(other)), port.read())
        await pulse(dut, "start_ready_i")
        await pulse(dut, "done_i")
        assert await host.get("STATUS") == {"busy": int(dut.busy_i.value), "queued": 0, "done": 1, "error": 0}
        assert await host.get("ERROR") == {"code": 0, "slot": 0}


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def illegal_starts(dut, stall):
    """Sizes, numbers of descriptors and steps that cannot be: no start, code and interrupt; then a legal start."""
    host, rng = await begin(dut, stall)
    good = legal(rng, dut)
    k, surfaces, width = (bench.parameter(dut, name) for name in ("K", "Surfaces", "MaxWidth"))
    cases = [("SIZE", dict(width=0)), ("SIZE", dict(height=0)), ("SIZE", dict(width=width + 1)),
             ("SIZE", dict(height=4097)), ("COUNT", dict(count=surfaces + 1)), ("K_STOP", dict(k_stop=0)),
             ("K_STOP", dict(k_stop=k + 1))]  # fmt: skip
    await host.put("IRQ_ENABLE", error=1)
    for name, change in rng.sample(cases, len(cases)):
        await host.request({**good, **change})
        await host.put("CONTROL", start=1)
        assert await host.get("ERROR") == {"code": MAP.ERRORS[name][0], "slot": 0}, change
        assert dut.irq_o.value == 1 and dut.start_valid_o.value == 0, change
        assert await host.get("STATUS") == {"busy": 0, "queued": 0, "done": 0, "error": 1}
        await host.put("IRQ_STATUS", error=1)
        assert dut.irq_o.value == 0
    await host.request(good)
    await host.put("CONTROL", start=1)
    assert await host.get("STATUS") == {"busy": 0, "queued": 1, "done": 0, "error": 0}


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def errors_of_the_processor(dut, stall):
    """Code and slot of the first error stay until it is cleared."""
    host, rng = await begin(dut, stall)
    for _ in range(4):
        faults = [(rng.choice([4, 5, 6, 7, 9]), rng.getrandbits(6)) for _ in range(2)]
        for fault in faults:
            dut.error_code_i.value, dut.error_slot_i.value = fault
            await pulse(dut, "error_valid_i")
        assert await host.get("ERROR") == dict(zip(("code", "slot"), faults[0], strict=True))
        await host.put("IRQ_STATUS", done=1)
        assert (await host.get("STATUS"))["error"] == 1
        await host.put("IRQ_STATUS", error=1)
        assert await host.get("ERROR") == {"code": 0, "slot": 0}


@cocotb.test
async def an_error_is_not_lost(dut):
    """An error in any clock around the write that clears the one before is kept, with its code."""
    host, _ = await begin(dut, 0.0)
    later = set()
    for wait in range(12):
        dut.error_code_i.value, dut.error_slot_i.value = 4, 1
        await pulse(dut, "error_valid_i")
        task = cocotb.start_soon(host.put("IRQ_STATUS", error=1))
        for _ in range(wait):
            await FallingEdge(dut.clk_i)
        dut.error_code_i.value, dut.error_slot_i.value = 6, 2
        await pulse(dut, "error_valid_i")
        await task
        status = await host.get("IRQ_STATUS")
        if status["error"]:
            assert await host.get("ERROR") == {"code": 6, "slot": 2}, wait
        later.add(status["error"])
        await host.put("IRQ_STATUS", error=1)
    assert later == {0, 1}


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def interrupt(dut, stall):
    """irq_o is the level of what is enabled and not yet cleared; an event in the clock of the clearing is not lost."""
    host, rng = await begin(dut, stall)
    dut.error_code_i.value = 5
    state, enable = {"done": 0, "error": 0}, {"done": 0, "error": 0}
    for _ in range(30):
        match rng.choice(("event", "event", "clear", "enable")):
            case "event":
                name = rng.choice(("done", "error"))
                await pulse(dut, {"done": "done_i", "error": "error_valid_i"}[name])
                state[name] = 1
            case "clear":
                bits = {name: rng.getrandbits(1) for name in state}
                await host.put("IRQ_STATUS", **bits)
                state = {name: value & ~bits[name] for name, value in state.items()}
            case "enable":
                enable = {name: rng.getrandbits(1) for name in enable}
                await host.put("IRQ_ENABLE", **enable)
        assert await host.get("IRQ_STATUS") == state
        assert int(dut.irq_o.value) == any(state[name] & enable[name] for name in state), (state, enable)
    await host.put("IRQ_STATUS", done=1)
    dut.done_i.value = 1
    await host.put("IRQ_STATUS", done=1)
    dut.done_i.value = 0
    assert (await host.get("IRQ_STATUS"))["done"] == 1


@cocotb.test
@cocotb.parametrize(stall=STALLS)
async def counters(dut, stall):
    """The counters are those of the last finished frame, whatever stands there later; frames are counted."""
    host, rng = await begin(dut, stall)
    port = bench.Port(dut, "counters_i", COUNTERS)
    dut.busy_i.value = 1  # the next frame is being made
    for frames in range(1, 4):
        values = {name: rng.getrandbits(width) for name, width, _ in COUNTERS.fields}
        port.write(values)
        await pulse(dut, "done_i")
        port.write({name: 0 for name in values})
        expected = {f"{n.upper()}_LOW": values[n] & 0xFFFFFFFF for n in ("cycles", "steps")}
        expected |= {f"{n.upper()}_HIGH": values[n] >> 32 for n in ("cycles", "steps")}
        expected |= {n.upper(): v for n, v in values.items() if n not in ("cycles", "steps")}
        for name, value in {**expected, "FRAMES": frames}.items():
            assert await host.get(name) == {"count": value}, name


@cocotb.test
async def commands_last_a_clock(dut):
    """CONTROL's bits are pulses, only of the byte and the bits that are written; abort leaves a start that waits."""
    host, rng = await begin(dut, 0.0)
    await host.request(legal(rng, dut))
    seen = []

    async def watch():
        while True:
            seen.append((int(dut.abort_o.value), int(dut.start_valid_o.value)))
            await FallingEdge(dut.clk_i)

    cocotb.start_soon(watch())
    await host.write(MAP.REGISTERS["CONTROL"]["address"], 0x3, 2)
    assert all(s == (0, 0) for s in seen)
    await host.put("CONTROL", start=1)
    await host.put("CONTROL", abort=1)
    await host.read(0)
    assert sum(a for a, _ in seen) == 1 and seen[-1][1] == 1


@cocotb.test
async def reset_empties(dut):
    """A reset in the middle: no start, no interrupt, no counters, and the host can go on."""
    host, rng = await begin(dut, 0.0)
    await host.request(legal(rng, dut))
    await host.put("IRQ_ENABLE", done=1, error=1)
    await host.put("CONTROL", start=1)
    dut.counters_i.value = (1 << COUNTERS.width) - 1
    await pulse(dut, "done_i")
    assert dut.irq_o.value == 1 and dut.start_valid_o.value == 1
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    await FallingEdge(dut.clk_i)
    dut.rst_ni.value = 1
    assert dut.irq_o.value == 0 and dut.start_valid_o.value == 0
    assert await host.get("STATUS") == {"busy": 0, "queued": 0, "done": 0, "error": 0}
    for name in ("SIZE", "RAYS", "CYCLES_HIGH", "FRAMES"):
        assert not any((await host.get(name)).values()), name


@pytest.mark.parametrize(
    "parameters",
    [
        {},
        dict(N1=1, K=32, W=16, D=2, U=3, Rules=1, Clip=0, Vecsum=2, Lanes=1, VectorUnits=2, VectorDrop=12, Rings=5,
             VectorRings=3, Surfaces=5, Layers=1, MaxWidth=4096, Pixels=4),
    ],
    ids=("default", "other"),
)  # fmt: skip
def test_csr(parameters):
    """The defaults, and other numbers everywhere."""
    bench.run(__name__, "rdx_csr", parameters)


def test_tables_are_up_to_date():
    """docs/registers.md agrees with rdx_csr.rdl."""
    assert not csr.drift()


def test_generated_once():
    """The header and the map name every register, and a second call writes nothing."""
    made = csr.generate()
    times = [path.stat().st_mtime_ns for path in (*made.rtl, made.header, made.python)]
    csr.generate()
    assert times == [path.stat().st_mtime_ns for path in (*made.rtl, made.header, made.python)]
    header = made.header.read_text()
    assert (made.html / "index.html").is_file()
    for name in MAP.REGISTERS:
        assert f"__{name}__" in header, name
