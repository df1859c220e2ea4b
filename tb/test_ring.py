# SPDX-License-Identifier: Apache-2.0
"""The ring of step units: every ray's records are the model's, none lost, none twice, whatever the ports do."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, SimTimeoutError, with_timeout

import bench
import streams
from raydix.item import BOX, DEPTH, HIT, PAPER, ROOTS, SIZE, STATUS, STEPS, B, C
from raydix.kernel import words, zeros
from raydix.ring import trace

CERTIFIED, PAPER_RULE, BOTH = 1, 2, 3


class Shape:
    """Parameters of the ring at hand."""

    def __init__(self, dut):
        names = ("N1", "K", "W", "D", "U", "Rules")
        self.n1, self.steps, self.width, self.degree, self.units, self.rules = (bench.parameter(dut, n) for n in names)
        self.slots = bench.parameter(dut, "Slots")


def bernstein(roots, degree, width, sign):
    """Control points of sign * prod(t - root), scaled to W bits; a missing root is a factor that keeps its sign."""
    b = [1.0]
    for root in [*roots, *[-1.0] * (degree - len(roots))]:
        size = len(b)
        # times (t - root): Bernstein coefficients -root and 1 - root
        b = [
            ((size - i) * (b[i] if i < size else 0) * -root + i * (b[i - 1] if i else 0) * (1 - root)) / size
            for i in range(size + 1)
        ]
    scale = sign * bench.high(width) / max(map(abs, b))
    return [max(bench.low(width), min(bench.high(width), round(v * scale))) for v in b]


def random_ray(random, shape, number):
    """A ray and its first segment: 0 to D roots, some close to each other, or any control points; with boxes."""
    kind = random.random()
    if kind < 0.6:
        at = random.random()
        spread = random.choice((1.0, 0.1, 0.001))
        roots = [
            min(max(at + spread * (random.random() - 0.5), 0.0), 1.0) for _ in range(random.randint(0, shape.degree))
        ]
        b = bernstein(roots, shape.degree, shape.width, random.choice((-1, 1)))
    elif kind < 0.9:
        b = [random.randint(bench.low(shape.width), bench.high(shape.width)) for _ in range(shape.degree + 1)]
    else:
        b = [
            random.choice((bench.low(shape.width), bench.high(shape.width), 0, 1, -1)) for _ in range(shape.degree + 1)
        ]
    by_paper = {CERTIFIED: 0, PAPER_RULE: 1, BOTH: random.getrandbits(1)}[shape.rules]
    ray = {
        "surface": random.getrandbits(6),
        "x": number & 0xFFF,
        "y": number >> 12,
        "paper": by_paper,
        "roots": random.randint(1, 4),
        "box": [random.choice((0, 0, 0, 0, 1, 2, 7, 20)) for _ in range(3)],
    }
    coordinate = (bench.low(32), bench.high(32), *(random.randint(bench.low(32), bench.high(32)) for _ in range(6)))
    segment = {
        "start": [random.choice(coordinate) for _ in range(3)],
        "stop": [random.choice(coordinate) for _ in range(3)],
        "depth_start": random.randrange(1 << 31),
        "depth_stop": random.randrange(1 << 31),
        "b": b,
    }
    return ray, segment


def plain_ray(random, shape, number):
    """A ray with one root and nothing pending: linear, no box. It takes K steps and never restarts."""
    ray, segment = random_ray(random, shape, number)
    first, last = -random.randint(1 << 8, bench.high(shape.width)), random.randint(1 << 8, bench.high(shape.width))
    segment["b"] = [first + (last - first) * i // shape.degree for i in range(shape.degree + 1)]
    return {**ray, "paper": shape.rules == PAPER_RULE, "roots": 1, "box": [0, 0, 0]}, segment


def known_ray(random, shape, number, count):
    """A ray with ``count`` roots far from each other, all of them wanted, without a box."""
    ray, segment = random_ray(random, shape, number)
    segment["b"] = bernstein([0.2, 0.4, 0.6, 0.8][:count], shape.degree, shape.width, random.choice((-1, 1)))
    return {**ray, "roots": 4, "box": [0, 0, 0]}, segment


def model(shape, ray, segment):
    """The records that the ray leaves, in order."""
    records = []
    first = zeros(SIZE)
    first[C : C + 6] = words([*segment["start"], *segment["stop"]])
    first[DEPTH : DEPTH + 2] = words([segment["depth_start"], segment["depth_stop"]])
    first[B : B + shape.degree + 1] = words(segment["b"])
    cells, nodes = zeros((shape.degree << shape.n1) + 1), zeros((shape.n1 + 1) * (shape.degree + 1))

    def follow(roots):
        item, t, depth, point = zeros(SIZE), zeros(4), zeros(4), zeros(12).reshape(4, 3)
        item[PAPER], item[ROOTS] = ray["paper"], roots
        item[BOX : BOX + 3] = words(ray["box"])
        hits = trace(item, first, cells, nodes, shape.n1, shape.steps, shape.width, shape.degree, t, depth, point, 0)
        return item, hits, t, depth, point

    place = {name: ray[name] for name in ("surface", "x", "y")}
    item, hits, t, depth, point = follow(ray["roots"])
    for i in range(hits):
        last = i == hits - 1 and item[STATUS] == HIT
        # the steps up to a hit are those of a ray that wants no more
        steps = item[STEPS] if last else follow(i + 1)[0][STEPS]
        records.append({**place, "hit": 1, "last": int(last), "t": t[i], "depth": depth[i], "point": list(point[i])})
        records[-1]["steps"] = steps
    if item[STATUS] != HIT:
        records.append({**place, "hit": 0, "last": 1, "t": None, "depth": None, "point": None, "steps": item[STEPS]})
    return records


RATES = (0.0, 0.3, 0.8)
PORTS = dict(prefix="ray_", data=("ray_i", "segment_i"))


async def start(dut):
    """Clock and reset, with both ports at rest; the shape."""
    dut.ray_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    return Shape(dut)


def feed(dut, shape, rays, random, idle=0.0):
    """Start a source of ``rays``; the task."""
    structs = (bench.RAY, bench.segment(shape.width, shape.degree))
    return cocotb.start_soon(streams.source(dut, rays, random, idle, struct=structs, **PORTS))


def hit_sink(dut, random, stall=0.0):
    """A sink of the hit stream."""
    return streams.Sink(dut, random, stall, "hit_", "hit_o", bench.HIT)


def compare(shape, rays, received):
    """Ray by ray the records are the model's, in its order (that of t); every record belongs to a ray."""
    by_ray = {}
    for record in received:
        by_ray.setdefault((record["surface"], record["x"], record["y"]), []).append(record)
    for number, (ray, segment) in enumerate(rays):
        expected = model(shape, ray, segment)
        got = by_ray.pop((ray["surface"], ray["x"], ray["y"]), [])
        lines = []
        if len(got) != len(expected):
            lines.append(f"{len(expected)} records expected, {len(got)} received")
        for i, (e, g) in enumerate(zip(expected, got, strict=False)):
            lines += [f"record {i}, {n}: expected {e[n]}, got {g[n]}" for n in e if e[n] is not None and e[n] != g[n]]
        if lines:
            raise bench.mismatch(number, {"ray": ray, "segment": segment}, [*lines, f"{expected}", f"{got}"])
        t = [g["t"] for g in got if g["hit"]]
        assert t == sorted(set(t)) and [g["last"] for g in got] == [0] * (len(got) - 1) + [1]
    assert not by_ray, f"records of rays that were not sent: {by_ray}"


async def all_taken(shape, rays, sink, task):
    """Wait for the sink's task, not for ever, and compare what it has received."""
    complete = True
    try:
        await with_timeout(task, 10 * (2000 + 8 * len(rays) * shape.slots), "ns")
    except SimTimeoutError:
        complete = False
    compare(shape, rays, sink.received)
    assert complete, "too slow"


async def trace_all(dut, shape, rays, random, idle, stall):
    """All rays through the ring, compared with the model; the sink."""
    count = sum(len(model(shape, *ray)) for ray in rays)
    sink = hit_sink(dut, random, stall)
    feed(dut, shape, rays, random, idle)
    await all_taken(shape, rays, sink, cocotb.start_soon(sink.take(count, quiet=2 * shape.slots)))
    return sink


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def equals_model(dut, idle, stall):
    """The records of each ray are the model's, in order of t, `last` once: none lost, none twice."""
    shape = await start(dut)
    random = bench.rng(f"{idle} {stall}")
    rays = [known_ray(random, shape, count, count) for count in range(shape.degree + 1)]
    for count, ray in enumerate(rays):
        assert sum(r["hit"] for r in model(shape, *ray)) == count
    rays += [random_ray(random, shape, number) for number in range(len(rays), 70)]
    random.shuffle(rays)
    await trace_all(dut, shape, rays, random, idle, stall)


@cocotb.test
async def full_and_stalled(dut):
    """The sink stalls for hundreds of clocks, the ring fills up and takes no ray; then everything comes out."""
    shape = await start(dut)
    random = bench.rng()
    rays = [random_ray(random, shape, number) for number in range(shape.slots + 40)]
    sink = hit_sink(dut, random, 1.0)
    feed(dut, shape, rays, random)
    task = cocotb.start_soon(sink.take(sum(len(model(shape, *ray)) for ray in rays), quiet=2 * shape.slots))
    idle_since = clock = 0
    # in three turns and the steps of the longest search every place is taken by a ray that waits for the sink
    while clock - idle_since < 300 + 3 * shape.slots:
        await ReadOnly()
        if dut.ray_ready_o.value == 1:
            idle_since = clock
        clock += 1
        await FallingEdge(dut.clk_i)
        assert clock < 200 * shape.slots, "the ring does not fill up"
    assert not sink.received and dut.hit_valid_o.value == 1 and dut.ray_valid_i.value == 1
    for stall, clocks in ((0.0, 3), (1.0, 300), (0.0, 30), (0.9, 400), (0.0, 0)):
        sink.stall = stall
        for _ in range(clocks):
            await FallingEdge(dut.clk_i)
    await all_taken(shape, rays, sink, task)


@cocotb.test
async def reset_empties(dut):
    """A reset in the middle of work: the ring is empty, takes a new ray after one turn, and works."""
    shape = await start(dut)
    random = bench.rng()
    dut.hit_ready_i.value = 0
    old = [random_ray(random, shape, 3000 + number) for number in range(2 * shape.slots)]
    task = feed(dut, shape, old, random)
    for _ in range(random.randint(3, 6) * shape.slots):
        await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 1  # there is work in it
    task.cancel()
    dut.ray_valid_i.value = 0
    dut.rst_ni.value = 0
    await FallingEdge(dut.clk_i)
    assert dut.hit_valid_o.value == 0
    dut.rst_ni.value = 1
    dut.hit_ready_i.value = 1
    clocks = 0
    while dut.ray_ready_o.value == 0:
        await FallingEdge(dut.clk_i)
        clocks += 1
    assert clocks == shape.slots, f"the first ray is taken after {clocks} clocks, documented: {shape.slots}"
    for _ in range(5 * shape.slots):  # nothing of before comes out, every place is empty
        assert dut.hit_valid_o.value == 0 and dut.ray_ready_o.value == 1
        await FallingEdge(dut.clk_i)
    rays = [random_ray(random, shape, number) for number in range(40)]
    await trace_all(dut, shape, rays, random, 0.0, 0.2)


@cocotb.test
async def throughput(dut):
    """Rays of K steps without a restart take ceil(K/U) turns of the ring; with U = K one is taken every clock."""
    shape = await start(dut)
    random = bench.rng()
    rays = [plain_ray(random, shape, number) for number in range(3 * shape.slots)]
    for ray in rays:
        assert [(r["hit"], r["steps"]) for r in model(shape, *ray)] == [(1, shape.steps)]
    dut.hit_ready_i.value = 1
    while dut.ray_ready_o.value == 0:
        await FallingEdge(dut.clk_i)
    sink = await trace_all(dut, shape, rays, random, 0.0, 0.0)
    turns = -(-shape.steps // shape.units)
    first = sink.transfers[0]
    assert first == turns * shape.slots  # from the clock that takes the first ray on
    # as many rays as there are places come out one after the other, and their places are taken in the same moment
    expected = [first + (i // shape.slots) * turns * shape.slots + i % shape.slots for i in range(len(rays))]
    assert sink.transfers == expected, f"{turns} turns of {shape.slots} clocks; hits at {sink.transfers}"
    if shape.units == shape.steps:
        assert expected == list(range(first, first + len(rays)))  # a ray a clock
    assert [r["x"] for r in sink.received] == [ray["x"] for ray, _ in rays]  # nobody overtakes here


CASES = [
    dict(N1=3, K=8, W=36, D=4, U=1, Rules=BOTH),
    dict(N1=1, K=6, W=36, D=2, U=6, Rules=CERTIFIED),
    dict(N1=2, K=5, W=24, D=4, U=3, Rules=PAPER_RULE),
    dict(N1=4, K=3, W=48, D=4, U=2, Rules=BOTH),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_ring(parameters):
    """One shared unit, the full pipeline, and in between; each rule alone and both."""
    bench.run(__name__, "rdx_ring", parameters)
