# SPDX-License-Identifier: Apache-2.0
"""The ring of step units: every ray's records are the model's, none lost, none twice, whatever the ports do."""

import cocotb
import pytest
from cocotb.triggers import FallingEdge, ReadOnly, SimTimeoutError, with_timeout

import bench
import latency
import spirals
import streams
from raydix.ends import ends
from raydix.formats import COORD_FRAC, VECTOR_WIDTH
from raydix.item import AGAIN, BOX, DEPTH, DONE, ENTERS, HIT, PAPER, ROOTS, RUN, SIZE, STATUS, STEPS, B, C, T
from raydix.kernel import words, zeros
from raydix.ring import NO_LIMIT, behind, enter, limit_of, more, restart, trace
from raydix.step import new_work, step
from raydix.vecsum import new_lanes

CERTIFIED, PAPER_RULE, BOTH = 1, 2, 3
ALL_MODES = 3  # rdx_pkg::ModesDefault


class Shape:
    """Parameters of the ring at hand; for vector sums (D = 1) a surface, whose constants go to the port."""

    def __init__(self, dut, random, **given):
        def value(name):
            return given[name] if name in given else bench.parameter(dut, name)

        names = ("N1", "K", "W", "D", "U", "Rules")
        self.n1, self.steps, self.width, self.degree, self.units, self.rules = map(value, names)
        self.limited = value("Limit")
        self.clip = self.degree == 1 or value("Clip")
        self.general = value("General") if self.degree == 1 else 0
        self.phases = latency.phases((1 << self.n1) - 1, value("Lanes")) if self.degree == 1 else 1
        self.slots = value("Slots")
        self.turn = self.slots * self.phases  # clocks
        self.drop = bench.parameter(dut, "VectorDrop") if self.degree == 1 else 0
        self.work = new_work(self.n1, self.degree, self.drop)
        self.form, self.surface = None, None
        self.records = {}  # of rays seen
        if self.degree == 1:
            self.use(dut, random)

    def use(self, dut, random):
        """Take a surface, another one than before."""
        choice = [s for s in (spirals.GENERAL if self.general else spirals.HELIX) if s != self.surface]
        self.surface = random.choice(choice)
        found = spirals.surface(*self.surface, self.n1)
        self.form = spirals.form(found)
        self.firsts = [first for _, _, _, first in spirals.rays(found)]
        self.plain = []
        self.records = {}
        bench.Port(dut, "form_i", bench.FORM).write(bench.form_fields(self.form))


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


def random_request(random, shape, number):
    """A ray with a number of its own, all over the pixels, that asks for anything."""
    number = number * 0x9E3779 & 0xFFFFFF  # odd, so no two are the same
    return {
        "surface": random.getrandbits(6),
        "x": number & 0xFFF,
        "y": number >> 12,
        "paper": {CERTIFIED: 0, PAPER_RULE: 1, BOTH: random.getrandbits(1)}[shape.rules],
        "roots": random.randint(1, 4),
        "box": [random.choice((0, 0, 0, 0, 1, 2, 7, 10, 20)) for _ in range(3)],
        "limit": NO_LIMIT,
    }


def with_limit(random, ray, ends):
    """The ray with a limit: none, any, or a depth along the segment; near and far plane may be either way around."""
    near, far = ends["depth_start"], ends["depth_stop"]
    between = limit_of(near + int((far - near) * random.random()))
    limit = random.choice((NO_LIMIT, NO_LIMIT - 1, 0, random.randrange(NO_LIMIT), limit_of(near), *[between] * 8))
    return ray | {"limit": limit}


def segment_of(first, degree):
    """Fields of a first segment of the model."""
    fields = {"start": first[C : C + 3].tolist(), "stop": first[C + 3 : C + 6].tolist()}
    fields |= {"depth_start": first[DEPTH], "depth_stop": first[DEPTH + 1], "b": first[B : B + degree + 1].tolist()}
    return fields


def random_chord(random, shape):
    """First segment of a ray of the frame, from either end, or ending on its way; or between any two points."""
    first = random.choice(shape.firsts).copy()
    reach, part = 7 << COORD_FRAC - 2, random.random()
    kind = random.random()
    if kind < 0.2:
        first[C : C + 6] = words(random.randint(-reach, reach) for _ in range(6))
        first[DEPTH : DEPTH + 2] = words(random.getrandbits(31) for _ in range(2))
    elif kind < 0.4:
        first[C : C + 3], first[C + 3 : C + 6] = first[C + 3 : C + 6].copy(), first[C : C + 3].copy()
    elif kind < 0.5:
        first[C + 3 : C + 6] = words(int(first[C + i] + part * (first[C + 3 + i] - first[C + i])) for i in range(3))
    ends(first, new_lanes(2, shape.drop), shape.form, shape.general)
    return segment_of(first, 1)


def random_ray(random, shape, number):
    """A ray and its first segment: 0 to D roots, some close to each other, or any control points; with boxes."""
    if shape.degree == 1:
        segment = random_chord(random, shape)
        return with_limit(random, random_request(random, shape, number), segment), segment
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
    ray = random_request(random, shape, number)
    coordinate = (bench.low(32), bench.high(32), *(random.randint(bench.low(32), bench.high(32)) for _ in range(6)))
    segment = {
        "start": [random.choice(coordinate) for _ in range(3)],
        "stop": [random.choice(coordinate) for _ in range(3)],
        "depth_start": random.randrange(1 << 31),
        "depth_stop": random.randrange(1 << 31),
        "b": b,
    }
    if random.random() < 0.5:  # as the planes of a surface are
        segment["depth_start"], segment["depth_stop"] = sorted((segment["depth_start"], segment["depth_stop"]))
    return with_limit(random, ray, segment), segment


def plain_ray(random, shape, number):
    """A ray with one root and nothing pending: linear, no box. It takes K steps and never restarts."""
    ray, segment = random_ray(random, shape, number)
    ray |= {"paper": shape.rules == PAPER_RULE, "roots": 1, "box": [0, 0, 0], "limit": NO_LIMIT}
    if shape.degree == 1:  # a few that do it, over and over
        while len(shape.plain) < 12:
            if [(r["hit"], r["steps"]) for r in model(shape, ray, segment)] == [(1, shape.steps)]:
                shape.plain.append(segment)
            segment = random_chord(random, shape)
        return ray, random.choice(shape.plain)
    first, last = -random.randint(1 << 8, bench.high(shape.width)), random.randint(1 << 8, bench.high(shape.width))
    segment["b"] = [first + (last - first) * i // shape.degree for i in range(shape.degree + 1)]
    return ray, segment


def known_ray(random, shape, number, count):
    """A ray with ``count`` roots far from each other, all of them wanted, without a box."""
    ray, segment = random_ray(random, shape, number)
    segment["b"] = bernstein([0.2, 0.4, 0.6, 0.8][:count], shape.degree, shape.width, random.choice((-1, 1)))
    return {**ray, "roots": 4, "box": [0, 0, 0], "limit": NO_LIMIT}, segment


def close_ray(random, shape, number):
    """A ray with roots in neighbouring cells of the last step, both wanted: the second may be left for a restart."""
    ray, segment = random_ray(random, shape, number)
    cells = 1 << shape.n1 * shape.steps
    roots = [(2 * random.randrange(cells // 2) + 0.5) / cells]
    segment["b"] = bernstein([*roots, roots[0] + 1 / cells], shape.degree, shape.width, random.choice((-1, 1)))
    return {**ray, "roots": 4, "box": [0, 0, 0], "limit": NO_LIMIT}, segment


def model(shape, ray, segment):
    """The records that the ray leaves, in order."""
    key = repr((ray, segment))
    ray = ray if shape.clip else ray | {"box": [0, 0, 0]}  # boxes that are not built do not count
    if key not in shape.records:
        records = trace_by_model(shape, ray, segment)
        if shape.limited and ray["limit"] != NO_LIMIT:
            records = limit_by_model(shape, ray, segment, records)
        shape.records[key] = records
    return shape.records[key]


def first_of(shape, segment):
    """The first segment as the model has it."""
    first = zeros(SIZE)
    first[C : C + 6] = words([*segment["start"], *segment["stop"]])
    first[DEPTH : DEPTH + 2] = words([segment["depth_start"], segment["depth_stop"]])
    first[B : B + shape.degree + 1] = words(segment["b"])
    return first


def trace_by_model(shape, ray, segment):
    """The same without a limit, not looked up."""
    records, first = [], first_of(shape, segment)
    fixed = shape.work, shape.n1, shape.steps, shape.width, shape.degree, shape.general

    def follow(roots):
        item, t, depth, enters, point = zeros(SIZE), zeros(4), zeros(4), zeros(4), zeros(12).reshape(4, 3)
        item[PAPER], item[ROOTS] = ray["paper"], roots
        item[BOX : BOX + 3] = words(ray["box"])
        hits = trace(item, first, shape.form, *fixed, t, depth, point, enters, 0)
        return item, hits, t, depth, point, enters

    place = {name: ray[name] for name in ("surface", "x", "y")}
    item, hits, t, depth, point, enters = follow(ray["roots"])
    for i in range(hits):
        last = i == hits - 1 and item[STATUS] == HIT
        # the steps up to a hit are those of a ray that wants no more
        steps = item[STEPS] if last else follow(i + 1)[0][STEPS]
        records.append({**place, "hit": 1, "last": int(last), "t": t[i], "depth": depth[i], "point": list(point[i])})
        records[-1] |= {"enters": enters[i], "steps": steps}
    if item[STATUS] != HIT:
        nothing = dict.fromkeys(("t", "depth", "point", "enters"))
        records.append({**place, "hit": 0, "last": 1, **nothing, "steps": item[STEPS]})
    return records


def limit_by_model(shape, ray, segment, without):
    """The records of a ray whose items end behind its limit, turn by turn; ``without``: those of the ray without it."""
    item, first = zeros(SIZE), first_of(shape, segment)
    item[PAPER], item[ROOTS] = ray["paper"], ray["roots"]
    item[BOX : BOX + 3] = words(ray["box"])
    fixed = shape.form, shape.work, shape.n1, shape.steps, shape.width, shape.degree, shape.general
    records = []

    def record(hit, last, **rest):
        place = {name: ray[name] for name in ("surface", "x", "y")}
        nothing = dict.fromkeys(("t", "depth", "point", "enters"))
        records.append({**place, "hit": hit, "last": last, **nothing, **rest, "steps": item[STEPS]})

    enter(item, first, shape.degree)
    while not records or not records[-1]["last"]:
        for _ in range(shape.units):
            if item[STATUS] == RUN:
                step(item, *fixed)
        if item[STATUS] != DONE and behind(item[DEPTH], ray["limit"]):
            record(0, 1, ended=True)
        elif item[STATUS] == HIT:
            last, point = int(not more(item)), item[C : C + 3].tolist()
            record(1, last, t=item[T], depth=item[DEPTH], point=point, enters=item[ENTERS])
            item[ROOTS] -= 1
            item[STATUS] = AGAIN
        elif item[STATUS] == DONE:
            record(0, 1)
        if item[STATUS] == AGAIN:
            restart(item, first, shape.degree)
    if segment["depth_start"] <= segment["depth_stop"]:  # no hit is lost but those that cannot be seen
        hits, all_hits = ([r["t"] for r in some if r["hit"]] for some in (records, without))
        assert hits == [r["t"] for r in without if r["hit"] and not behind(r["depth"], ray["limit"])], (hits, all_hits)
    return records


RATES = (0.0, 0.3, 0.8)
PORTS = dict(prefix="ray_", data=("ray_i", "segment_i"))


async def still(dut, degree):
    """The ports that stand still, noise there before: modes as usual, constants of a surface to come."""
    await bench.noise(dut, "modes_i", *["form_i"] * (degree == 1))
    dut.modes_i.value = ALL_MODES


async def start(dut, random):
    """Clock and reset, with both ports at rest; the shape."""
    dut.ray_valid_i.value = 0
    dut.hit_ready_i.value = 0
    await bench.start(dut)
    await still(dut, bench.parameter(dut, "D"))
    return Shape(dut, random)


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
            lines += [f"record {i}, {n}: expected {e[n]}, got {g[n]}" for n in g if e[n] is not None and e[n] != g[n]]
        if lines:
            raise bench.mismatch(number, {"ray": ray, "segment": segment}, [*lines, f"{expected}", f"{got}"])
        t = [g["t"] for g in got if g["hit"]]
        assert t == sorted(set(t)) and [g["last"] for g in got] == [0] * (len(got) - 1) + [1]
    assert not by_ray, f"records of rays that were not sent: {by_ray}"


async def all_taken(shape, rays, sink, task):
    """Wait for the sink's task, not for ever, and compare what it has received."""
    complete = True
    try:
        await with_timeout(task, 10 * (2000 + 8 * len(rays) * shape.turn), "ns")
    except SimTimeoutError:
        complete = False
    compare(shape, rays, sink.received)
    assert complete, "too slow"


async def trace_all(dut, shape, rays, random, idle, stall, new=False):
    """All rays through the ring, compared with the model; the sink.

    new   begin in the clock after a reset; steps_o tells of items of before for a turn, so it is not looked at
    """
    for _ in range(0 if new else 2 * shape.turn):  # the phase stays
        await FallingEdge(dut.clk_i)
    count = sum(len(model(shape, *ray)) for ray in rays)
    sink = hit_sink(dut, random, stall)
    feed(dut, shape, rays, random, idle)
    totals = {"steps_o": 0, "ended_o": 0}
    watch = cocotb.start_soon(add_up(dut, totals))
    await all_taken(shape, rays, sink, cocotb.start_soon(sink.take(count, quiet=2 * shape.turn)))
    watch.cancel()
    last = [model(shape, *ray)[-1] for ray in rays]
    wanted = {"steps_o": sum(r["steps"] for r in last), "ended_o": sum(r.get("ended", False) for r in last)}
    assert new or totals == wanted, f"steps, and items that end behind their limit: {wanted}, told of: {totals}"
    return sink


async def add_up(dut, totals):
    """For ever: add what the ports named in ``totals`` tell of: of the clock before, so not in the first one."""
    while True:
        await FallingEdge(dut.clk_i)
        await ReadOnly()
        for name in totals:
            totals[name] += int(getattr(dut, name).value)


@cocotb.test
@cocotb.parametrize(idle=RATES, stall=RATES)
async def equals_model(dut, idle, stall):
    """The records of each ray are the model's, in order of t, `last` once: none lost, none twice."""
    random = bench.rng(f"{idle} {stall}")
    shape = await start(dut, random)
    if shape.degree == 1:
        rays, wanted = [], {0, 1, 2}
        while wanted or len(rays) < 40:
            rays.append(random_ray(random, shape, len(rays)))
            wanted.discard(sum(r["hit"] for r in model(shape, *rays[-1])))
    else:
        rays = [known_ray(random, shape, count, count) for count in range(shape.degree + 1)]
        for count, ray in enumerate(rays):
            assert sum(r["hit"] for r in model(shape, *ray)) == count
        rays += [close_ray(random, shape, number) for number in range(len(rays), 15)]
        rays += [random_ray(random, shape, number) for number in range(len(rays), 70)]
    while shape.limited and not any(model(shape, *ray)[-1].get("ended") for ray in rays):
        rays.append(random_ray(random, shape, len(rays)))
    random.shuffle(rays)
    await trace_all(dut, shape, rays, random, idle, stall)


@cocotb.test
async def full_and_stalled(dut):
    """The sink stalls for hundreds of clocks, the ring fills up and takes no ray; then everything comes out."""
    random = bench.rng()
    shape = await start(dut, random)
    rays = [random_ray(random, shape, number) for number in range(shape.slots + 40)]
    sink = hit_sink(dut, random, 1.0)
    feed(dut, shape, rays, random)
    task = cocotb.start_soon(sink.take(sum(len(model(shape, *ray)) for ray in rays), quiet=2 * shape.turn))
    idle_since = clock = 0
    # in three turns and the steps of the longest search every place is taken by a ray that waits for the sink
    search = shape.turn * (-(-shape.steps // shape.units) if shape.degree == 1 else 1)
    while clock - idle_since < 300 + 3 * search:
        await ReadOnly()
        if dut.ray_ready_o.value == 1:
            idle_since = clock
        clock += 1
        await FallingEdge(dut.clk_i)
        assert clock < 200 * shape.turn, "the ring does not fill up"
    assert not sink.received and dut.hit_valid_o.value == 1 and dut.ray_valid_i.value == 1
    for stall, clocks in ((0.0, 3), (1.0, 300), (0.0, 30), (0.9, 400), (0.0, 0)):
        sink.stall = stall
        for _ in range(clocks):
            await FallingEdge(dut.clk_i)
    await all_taken(shape, rays, sink, task)


@cocotb.test
async def reset_empties(dut):
    """A reset in the middle of work: the ring is empty, takes a new ray after one turn, and works."""
    random = bench.rng()
    shape = await start(dut, random)
    dut.hit_ready_i.value = 0
    old = [random_ray(random, shape, 3000 + number) for number in range(2 * shape.slots)]
    task = feed(dut, shape, old, random)
    for _ in range((random.randint(3, 6) + -(-shape.steps // shape.units)) * shape.turn):
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
    turn = shape.turn + 1 + (shape.phases > 1)
    assert clocks == turn, f"the first ray is taken after {clocks} clocks, documented: {turn}"
    for clock in range(5 * shape.turn):  # nothing of before comes out, every place is empty
        assert dut.hit_valid_o.value == 0 and dut.ray_ready_o.value == (clock % shape.phases == 0)
        await FallingEdge(dut.clk_i)
    rays = [random_ray(random, shape, number) for number in range(40)]
    await trace_all(dut, shape, rays, random, 0.0, 0.2, new=True)


@cocotb.test
async def throughput(dut):
    """Rays of K steps without a restart take ceil(K/U) turns of the ring; with U = K one is taken every clock.

    Vector sums on few lanes: a place every Phases clocks.
    """
    random = bench.rng()
    shape = await start(dut, random)
    rays = [plain_ray(random, shape, number) for number in range(3 * shape.slots)]
    for ray in rays:
        assert [(r["hit"], r["steps"]) for r in model(shape, *ray)] == [(1, shape.steps)]
    dut.hit_ready_i.value = 1
    while dut.ray_ready_o.value == 0:
        await FallingEdge(dut.clk_i)
    sink = await trace_all(dut, shape, rays, random, 0.0, 0.0)
    turns, places = -(-shape.steps // shape.units), shape.slots
    first = sink.transfers[0]
    assert first == turns * shape.turn - 1  # from the clock that takes the first ray on
    # as many rays as there are places come out one after the other, and their places are taken in the same moment
    expected = [first + (i // places) * turns * shape.turn + i % places * shape.phases for i in range(len(rays))]
    assert sink.transfers == expected, f"{turns} turns of {shape.turn} clocks; hits at {sink.transfers}"
    if shape.units == shape.steps and shape.phases == 1:
        assert expected == list(range(first, first + len(rays)))  # a ray a clock
    assert [r["x"] for r in sink.received] == [ray["x"] for ray, _ in rays]  # nobody overtakes here


CASES = [
    dict(N1=3, K=8, W=36, D=4, U=1, Rules=BOTH, Limit=1),
    dict(N1=1, K=6, W=36, D=2, U=6, Rules=CERTIFIED, Limit=1),
    dict(N1=2, K=4, W=36, D=4, U=1, Rules=CERTIFIED, Clip=0, HalveStages=1),
    pytest.param(dict(N1=2, K=5, W=24, D=4, U=3, Rules=BOTH), marks=pytest.mark.long),
    dict(N1=4, K=3, W=48, D=4, U=2, Rules=BOTH),
    dict(N1=1, K=4, W=24, D=2, U=2, Rules=PAPER_RULE),
]


@pytest.mark.parametrize("parameters", CASES, ids=bench.label)
def test_ring(parameters):
    """One shared unit, the full pipeline, and in between; each rule alone and both; with limits, boxes, and without."""
    bench.run(__name__, "rdx_ring", parameters)


VECTOR_CASES = [
    pytest.param(dict(N1=3, K=8, U=1, Rules=BOTH, Lanes=7, General=0, Limit=1), marks=pytest.mark.long),
    dict(N1=2, K=5, U=2, Rules=CERTIFIED, Lanes=1, General=1, VectorDrop=8, Limit=1),
    pytest.param(dict(N1=3, K=4, U=2, Rules=PAPER_RULE, Lanes=3, General=0), marks=pytest.mark.long),
]


@pytest.mark.parametrize("parameters", VECTOR_CASES, ids=bench.label)
def test_ring_of_vector_sums(parameters):
    """All lanes and one unit; one lane; some lanes, where the turn needs places that hold no item."""
    bench.run(__name__, "rdx_ring", dict(W=VECTOR_WIDTH, D=1, HalveStages=1) | parameters)
