# SPDX-License-Identifier: Apache-2.0
"""The zone of a set of points: RTL equals the model; the model equals the definition."""

import cocotb

import bench
from raydix.bound import zone_of
from raydix.formats import COORD_FRAC, COORD_WIDTH, ZONES

LEAST, MOST = bench.low(COORD_WIDTH), bench.high(COORD_WIDTH)
EDGES = sorted({v for bit in range(COORD_WIDTH) for s in (-1, 1) for d in (-1, 0, 1)
                if LEAST <= (v := s * (1 << bit) + d) <= MOST})  # fmt: skip


def model(xs, ys):
    """The least zone of the points, by the golden model; near as in ``step.boundaries``."""
    return min(zone_of((x ^ (x >> 63)) | (y ^ (y >> 63))) for x, y in zip(xs, ys, strict=True))


def stimuli(dut):
    """All points at -1; every edge of a zone and its neighbours, in x, in y, and in both; then random points."""
    random = bench.rng()
    count = len(bench.Port(dut, "x_i").handles)

    def with_others(x, y):
        """The point among such as are in the last zone."""
        points = [(random.choice((LEAST, MOST)), random.randint(LEAST, MOST)) for _ in range(count)]
        points[random.randrange(count)] = x, y
        return [list(values) for values in zip(*points, strict=True)]

    yield [[-1] * count] * 2
    for edge in EDGES:
        for x, y in ((edge, 0), (0, edge), (-1, edge), (edge, random.choice(EDGES)), (random.choice(EDGES), edge)):
            yield with_others(x, y)
    for _ in range(600):
        most = random.randint(1, COORD_WIDTH)
        yield [[bench.signed(random.getrandbits(32), random.randint(most, COORD_WIDTH)) for _ in range(count)]
               for _ in range(2)]  # fmt: skip


@cocotb.test
async def equals_model(dut):
    """The zone is the model's."""
    items = ({"x_i": xs, "y_i": ys} for xs, ys in stimuli(dut))
    await bench.pipeline(dut, items, lambda item: {"zone_o": model(item["x_i"], item["y_i"])}, 0)


@cocotb.test
async def equals_definition(dut):
    """Zone i is [2^(i-15), 2^(i-14)), the first reaches to the axis, the last to the end of the range."""
    for number, (xs, ys) in enumerate(stimuli(dut)):
        near = min(max(v if v >= 0 else -v - 1 for v in point) for point in zip(xs, ys, strict=True)) / 2**COORD_FRAC
        zone = model(xs, ys)
        if not (
            (zone == 0 or near >= 2.0 ** (zone + 1 - ZONES)) and (zone == ZONES - 1 or near < 2.0 ** (zone + 2 - ZONES))
        ):
            raise bench.mismatch(number, {"x_i": xs, "y_i": ys}, [f"nearest {near}, the model's zone {zone}"])


def test_zone():
    """The boundaries of a step."""
    bench.run(__name__, "rdx_zone")
