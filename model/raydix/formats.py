# SPDX-License-Identifier: Apache-2.0
"""Number formats and field widths: the one table.

The blocks between markers in ``rtl/rdx_pkg.sv``, ``rdx_form.svh``, ``rdx_form.sv``, ``rdx_cordic.sv`` (its angles),
``rdx_rsqrt.sv``, ``rdx_srgb.sv``, ``rdx_swirl_chord.sv`` (their tables), ``rdx_material.svh``, ``rdx_swirl.svh`` and
``docs/number-formats.md`` are generated from here:
``python -m raydix.formats --write``; without ``--write`` the exit status tells whether they agree.

A format token is ``s<I>p<F>`` (signed, ``I`` integer bits with the sign, ``F`` fractional) or ``u<I>p<F>``.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from .blocks import markdown_table, replace_block

ROOT = Path(__file__).resolve().parents[2]


class Constant(NamedTuple):
    """A width or limit shared by the golden model and the RTL."""

    name: str  # CamelCase, as in rdx_pkg
    value: int
    token: str  # number format, or "" for a plain count
    meaning: str
    rtl: bool = True  # used by the RTL, too


COORD_FRAC = 30
COORD_WIDTH = 2 + COORD_FRAC
COORD_ACC_WIDTH = 48
DEPTH_WIDTH = 32
LIMIT_WIDTH = 18
QUAD_ACC_WIDTH = 64
OPERAND_WIDTH = 36
OPERAND_SHIFT = 27
PRODUCT_DROP = 12
PIXEL_WIDTH = 12
SURFACE_WIDTH = 6
ROOTS_WIDTH = 3
BOX_WIDTH = 5
STEPS_WIDTH = 20
COORD_LANES = 6
HEADER_WORDS = 3
QUADRIC_WORDS = HEADER_WORDS + 3 * COORD_LANES + 18
QUARTIC_WORDS = QUADRIC_WORDS + 36
VECTOR_FRAC = 33
VECTOR_WIDTH = 5 + VECTOR_FRAC
ANGLE_WIDTH = 32
TURN_FRAC = 28
TURN_WIDTH = 8 + TURN_FRAC
ANGLE_ITERATIONS = 28
LENGTH_ITERATIONS = 16
ZONES = 16
UNIT_FRAC = 16
NORMAL_WIDTH = 18
LARGEST_ITERATIONS = 32  # of a CORDIC


class Field(NamedTuple):
    """One constant of a vector-sum surface, or an array of them, a word each."""

    name: str  # as in form_t of rdx_pkg
    token: str
    meaning: str
    count: int = 1  # type: ignore[assignment]  # hides the tuple's method

    @property
    def width(self) -> int:
        """Bits that count."""
        return sum(int(n) for n in self.token[1:].split("p"))


# K is the gain of the angle's CORDIC: lengths across the axis carry K, the indicator K^2.
FORM = (
    Field("lipschitz", "u23p33", "bound of the indicator's change over the whole segment, in each zone", ZONES),
    Field("curvature", "u23p33", "bound of half its second derivative over a cell of from_level, in each zone", ZONES),
    Field("from_level", "u6p0", "first level at which the curvature bound holds, in each zone", ZONES),
    Field("guard", "s5p33", "1.5 K c, where c is the distance between axis and solid"),
    Field("low", "s2p30", "box: lowest coordinates inside", 3),
    Field("high", "s2p30", "box: highest coordinates inside", 3),
    Field("turns", "s8p28", "T, length of the spiral"),
    Field("turn_z", "s10p26", "turns per height"),
    Field("turn_offset", "s14p28", "turn at the coordinate origin"),
    Field("radius", "s5p33", "K times the centre curve's radius at its start"),
    Field("pitch", "s6p30", "K times the rise of a turn"),
    Field("height", "s5p33", "K times the centre curve's height at its start"),
    Field("tube", "s5p33", "K^2 times the tube's radius at its start"),
    Field("split", "s2p30", "height from which on the second end is the nearer"),
    Field("start", "s2p30", "centre of the ball at the start", 3),
    Field("stop", "s2p30", "centre of the ball at the end", 3),
    Field("tube_stop", "s5p33", "K^2 times the tube's radius at its end"),
    Field("turn_rho", "s10p26", "turns per radius"),
    Field("skew_z", "s10p26", "shift of the nearest turn by the tube's growth: per height"),
    Field("skew_rho", "s10p26", "per radius"),
    Field("skew_offset", "s14p28", "at the coordinate origin"),
    Field("skew_back", "u1p0", "1: the tube shrinks, the shift is downwards"),
    Field("radius_growth", "s6p30", "K times the growth of the centre curve's radius in a turn"),
    Field("tube_growth", "s6p30", "K^2 times the growth of the tube's radius in a turn"),
)
# What shading knows of a surface; gradients are in scaled coordinates. A vector sum has the constants of its
# gradient (swirl.py) where an algebraic surface has those of its quadrics.
MATERIAL = (
    Field(
        "light",
        "s1p17",
        "matrix T by rows: gradient in scaled coordinates to a basis whose third axis is the light's",
        9,
    ),
    Field("color", "u1p16", "red, green, blue, linear", 3),
    Field("opacity", "u1p16", "1 is opaque"),
    Field("vector", "u1p0", "1: a vector sum"),
    Field("q3_matrix", "s1p17", "of Q3: 2 xx, 2 yy, 2 zz, xy, yz, zx", 6),
    Field("q3_linear", "s1p17", "of Q3: x, y, z", 3),
    Field("q1_matrix", "s1p17", "of Q1", 6),
    Field("q1_linear", "s1p17", "of Q1", 3),
    Field("q1_constant", "s1p17", "of Q1"),
    Field("q2_matrix", "s1p17", "of Q2", 6),
    Field("q2_linear", "s1p17", "of Q2", 3),
    Field("q2_constant", "s1p17", "of Q2"),
)
MATERIAL_WORDS = 64  # places for the constants of a material
# Of a vector sum, where the quadrics of an algebraic surface would stand. Lengths carry K, as in FORM; G is for the
# evaluator of every spiral only, H for that of helices only.
SWIRL = (
    Field("turn_z", "s13p19", "turns per height"),
    Field("turn_rho", "s13p19", "G: turns per radius"),
    Field("turn_offset", "s16p16", "turn at the coordinate origin"),
    Field("turns", "s8p22", "T, length of the spiral"),
    Field("radius", "s4p22", "centre curve's radius at its start"),
    Field("height", "s4p22", "centre curve's height at its start"),
    Field("tube", "s4p22", "G: tube's radius at its start"),
    Field("pitch", "s6p26", "rise of a turn"),
    Field("radius_growth", "s6p26", "G: growth of the centre curve's radius in a turn"),
    Field("tube_growth", "s6p26", "G: growth of the tube's radius in a turn"),
    Field("scale", "u3p0", "E + 1: the tube's largest radius is 0.49 to 0.98 times 2^-E, or less"),
    Field("pitch_radian", "s3p15", "rise of a radian"),
    Field("radius_radian", "s3p15", "G: growth of the centre curve's radius in a radian"),
    Field("tube_radian", "s3p15", "G: growth of the tube's radius in a radian"),
    Field("near", "s1p17", "c: the largest power of two with which these four fit"),
    Field("bend", "s1p17", "c 2^E (R_growth^2 + pitch^2 - r_growth^2) / 4 pi"),
    Field("start_reach", "s1p17", "c 2^E / pi times the centre curve's radius at its start"),
    Field("stop_reach", "s1p17", "G: the same at its end"),
    Field("start", "s2p22", "centre of the ball at the start; x and y without K", 3),
    Field("stop", "s2p22", "centre of the ball at the end", 3),
    Field("split", "s2p22", "H: height from which on the upper end is the nearer"),
    Field("down", "u1p0", "H: 1: the start is the upper end"),
    Field("plane", "s1p17", "G: beyond this plane the ball at the end is the nearer: per x, y, z", 3),
    Field("plane_offset", "s4p28", "G: less this"),
)
SWIRL_FIRST = 16  # constant of a material that is the first of these
SWIRL_FRAC = 22
SWIRL_WIDTH = 4 + SWIRL_FRAC
SWIRL_ITERATIONS = 16
SWIRL_STILL = 14
SWIRL_CHORDS = 64  # intervals of the table of sin^2
FORM_INDEX = {field.name: sum(f.count for f in FORM[:i]) for i, field in enumerate(FORM)}
MATERIAL_INDEX = {field.name: sum(f.count for f in MATERIAL[:i]) for i, field in enumerate(MATERIAL)}
SWIRL_INDEX = {field.name: sum(f.count for f in SWIRL[:i]) for i, field in enumerate(SWIRL)}
SWIRL_WORDS = sum(field.count for field in SWIRL)
FORM_WORDS = sum(field.count for field in FORM)
VECTOR_WORDS = HEADER_WORDS + 3 * COORD_LANES + FORM_WORDS

TABLE = (
    Constant("CoordFrac", COORD_FRAC, "", "fractional bits of a local coordinate"),
    Constant("CoordWidth", COORD_WIDTH, "s2p30", "local coordinate, in units of the surface's axis scale"),
    Constant("CoordAccWidth", COORD_ACC_WIDTH, "s2p46", "forward-difference accumulator of a coordinate"),
    Constant("DepthWidth", DEPTH_WIDTH, "s1p31", "camera depth in units of the frame's scale; never negative"),
    Constant("LimitWidth", LIMIT_WIDTH, "u0p18", "depth of the nearest opaque hit, floor; all ones: there is none"),
    Constant("QuadAccWidth", QUAD_ACC_WIDTH, "s64p0", "accumulator of a quadric's control point, magnitude below 2^62"),
    Constant("OperandWidth", OPERAND_WIDTH, "s36p0", "operand of a product; quartic: accumulator / 2^27, half up"),
    Constant("OperandShift", OPERAND_SHIFT, "", "bits dropped from an accumulator to make an operand"),
    Constant("ProductDrop", PRODUCT_DROP, "", "bits dropped (floor) from the product of two operands"),
    Constant("PixelWidth", PIXEL_WIDTH, "u12p0", "pixel column or row"),
    Constant("SurfaceWidth", SURFACE_WIDTH, "u6p0", "surface number"),
    Constant("RootsWidth", ROOTS_WIDTH, "u3p0", "roots still wanted, 1 to 4"),
    Constant("BoxWidth", BOX_WIDTH, "u5p0", "box exponent m: the box is [-2^(1-m), 2^(1-m)); 0: no face cuts"),
    Constant("StepsWidth", STEPS_WIDTH, "u20p0", "steps taken; at the largest value the item is given up"),
    Constant("CoordLanes", COORD_LANES, "", "x, y, z at the near end h and the far end e"),
    Constant("VectorWidth", VECTOR_WIDTH, "s5p33", "lengths in the vector-sum evaluator; the indicator"),
    Constant("VectorFrac", VECTOR_FRAC, "", "fractional bits of such a length"),
    Constant("AngleWidth", ANGLE_WIDTH, "u0p32", "azimuth in turns"),
    Constant("TurnWidth", TURN_WIDTH, "s8p28", "place on a spiral, in turns from its start"),
    Constant("TurnFrac", TURN_FRAC, "", "fractional bits of such a place"),
    Constant("AngleIterations", ANGLE_ITERATIONS, "", "of the CORDIC that finds radius and azimuth"),
    Constant("LengthIterations", LENGTH_ITERATIONS, "", "of the CORDICs that find a length only"),
    Constant("HeaderWords", HEADER_WORDS, "", "64-bit words before the lanes in a surface descriptor", False),
    Constant("Zones", ZONES, "", "of the distance from the axis, each with bounds of its own"),
    Constant("UnitWidth", 1 + UNIT_FRAC, "u1p16", "linear colour, opacity, light: 0 to 1 inclusive"),
    Constant("UnitFrac", UNIT_FRAC, "", "fractional bits of such a number"),
    Constant("NormalWidth", NORMAL_WIDTH, "s1p17", "component of a normal or of a constant of a material"),
    Constant("MaterialWords", MATERIAL_WORDS, "", "places for the constants of a material, 32 bits each"),
    Constant("FormWords", FORM_WORDS, "", "constants of a vector-sum surface"),
    Constant("VectorWords", VECTOR_WORDS, "", "words of a descriptor of a vector-sum surface", False),
    Constant("QuadricWords", QUADRIC_WORDS, "", "words of a descriptor of degree 1 or 2", False),
    Constant("QuarticWords", QUARTIC_WORDS, "", "words of a descriptor of degree 3 or 4", False),
)

STEPS_MAX = (1 << STEPS_WIDTH) - 1
MAX_IMAGE = 1 << PIXEL_WIDTH
MAX_SURFACES = 1 << SURFACE_WIDTH

BEGIN, END = "BEGIN generated by raydix.formats", "END generated"


def systemverilog() -> str:
    """The constants as SystemVerilog localparams."""
    lines = []
    for c in TABLE:
        if not c.rtl:
            continue
        token = f"{c.token}: " if c.token else ""
        lines += [f"  // {token}{c.meaning}", f"  localparam int unsigned {c.name} = {c.value};"]
    return "\n".join(lines) + "\n"


def form_struct() -> str:
    """The constants of a vector-sum surface as a SystemVerilog struct."""
    lines = ["typedef struct packed {"]
    for field in FORM:
        kind = f"logic {'signed ' if field.token[0] == 's' else ''}[{field.width - 1}:0]"
        if field.count > 1:
            array = f"[{field.count - 1}:0]"  # a part of it has the sign of a named type only
            kind = f"coord_t {array}" if field.token == "s2p30" else f"logic {array}{kind[6:]}"
        lines.append(f"  {kind} {field.name};  // {field.token}: {field.meaning}")
    return "\n".join([*lines, "} form_t;"]) + "\n"


def form_loader() -> str:
    """One assignment for each word of the form, for ``rtl/rdx_form.sv``."""
    lines = []
    for field in FORM:
        for i in range(field.count):
            place = f"{field.name}[{i}]" if field.count > 1 else field.name
            word = FORM_INDEX[field.name] + i
            lines.append(f"      if (index_i == 7'd{word}) form_o.{place} <= word_i[{field.width - 1}:0];")
    return "\n".join(lines) + "\n"


def angle_table() -> str:
    """The angles of the CORDIC as a SystemVerilog constant."""
    from .cordic import ANGLES  # which takes the width of an angle from here

    text = ",\n".join(f"      {ANGLE_WIDTH}'h{angle:08x}" for angle in ANGLES)
    return f"  localparam logic [AngleWidth-1:0] Angles[{LARGEST_ITERATIONS}] = '{{\n{text}\n  }};\n"


def rom(name: str, width: int, entries: Sequence[int], of_a_line: int) -> str:
    """A table as one SystemVerilog constant, its last entry first; ``of_a_line`` entries make a literal."""
    bits = of_a_line * width
    lines = []
    for at in range(len(entries) - of_a_line, -1, -of_a_line):
        value = sum(int(entry) << (width * i) for i, entry in enumerate(entries[at : at + of_a_line]))
        lines.append(f"    {bits}'h{value:0{bits // 4}x}")
    text = ",\n".join(lines)
    return f"  localparam logic [{len(entries) - 1}:0][{width - 1}:0] {name} = {{\n{text}\n  }};\n"


def root_table() -> str:
    """The table of ``rtl/rdx_rsqrt.sv``: start, then fall."""
    from .rsqrt import BASE_BITS, ENTRIES, FALL_BITS

    return rom("Table", BASE_BITS + FALL_BITS, [base << FALL_BITS | fall for base, fall in ENTRIES], 8)


def code_table() -> str:
    """The table of ``rtl/rdx_srgb.sv``."""
    from .srgb import CODES

    return rom("Codes", 8, CODES, 32)


def material_places() -> str:
    """Where a material's constants begin, as SystemVerilog localparams."""
    lines = []
    for field in MATERIAL:
        name = "".join(part.capitalize() for part in field.name.split("_"))
        lines += [
            f"// {field.token}: {field.meaning}",
            f"localparam int unsigned At{name} = {MATERIAL_INDEX[field.name]};",
        ]
    return "\n".join(lines) + "\n"


def material_table() -> str:
    """The constants of a material as a Markdown table."""
    rows = [[str(MATERIAL_INDEX[f.name]), f"`{f.name}`", str(f.count), f"`{f.token}`", f.meaning] for f in MATERIAL]
    return markdown_table(["first", "constant", "count", "format", "meaning"], rows)


def _camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def swirl_types() -> str:
    """Numbers and types of the constants of a vector sum's gradient."""
    from .swirl import FLAT  # which takes the numbers from here

    counts = (
        ("Frac", SWIRL_FRAC, "fractional bits of lengths, and of turns"),
        ("Width", SWIRL_WIDTH, f"s{SWIRL_WIDTH - SWIRL_FRAC}p{SWIRL_FRAC}: length"),
        ("Iterations", SWIRL_ITERATIONS, "of the CORDIC"),
        ("Still", SWIRL_STILL, "iteration of it from which on the radius stays as it is"),
        ("Chords", SWIRL_CHORDS, "intervals of the table of sin^2"),
        ("Flat", FLAT, "u0p17: 1/K^2"),
    )
    lines = []
    for name, value, meaning in counts:
        lines += [f"// {meaning}", f"localparam int unsigned Swirl{name} = {value};"]
    for field in SWIRL:
        number = SWIRL_FIRST + SWIRL_INDEX[field.name]
        sign = "signed " if field.token[0] == "s" else ""
        lines += [
            f"// {field.token}: {field.meaning}",
            f"localparam int unsigned Swirl{_camel(field.name)} = {number};",
        ]
        lines += [f"typedef logic {sign}[{field.width - 1}:0] swirl_{field.name}_t;"]
    return "\n".join(lines) + "\n"


def chord_tables() -> str:
    """The table of sin^2 as SystemVerilog constants."""
    from .swirl import CHORD_GAINS, CHORDS

    tables = []
    for name, values in (("Chords", CHORDS), ("Gains", CHORD_GAINS)):
        text = ",\n".join(f"      18'h{v & 0x3FFFF:05x}" for v in values)
        tables.append(f"  localparam logic signed [17:0] {name}[SwirlChords] = '{{\n{text}\n  }};\n")
    return "".join(tables)


def swirl_table() -> str:
    """The constants of a vector sum's gradient as a Markdown table."""
    rows = [
        [str(SWIRL_FIRST + SWIRL_INDEX[f.name]), f"`{f.name}`", str(f.count), f"`{f.token}`", f.meaning] for f in SWIRL
    ]
    return markdown_table(["first number", "constant", "words", "format", "meaning"], rows)


def form_table() -> str:
    """The constants of a vector-sum surface as a Markdown table."""
    rows = [[str(FORM_INDEX[f.name]), f"`{f.name}`", str(f.count), f"`{f.token}`", f.meaning] for f in FORM]
    return markdown_table(["first word", "constant", "words", "format", "meaning"], rows)


def markdown() -> str:
    """The constants as a Markdown table."""
    rows = [[f"`{c.name}`", str(c.value), f"`{c.token}`" if c.token else "", c.meaning] for c in TABLE]
    return markdown_table(["constant", "value", "format", "meaning"], rows)


def drift(write: bool = False) -> list[Path]:
    """Files whose generated block differs from the table; with ``write`` they are brought up to date."""

    def sv(file, name, body):
        return ROOT / "rtl" / file, f"  // {BEGIN}{name}\n", f"  // {END}{name}\n", body

    def md(name, body):
        return ROOT / "docs" / "number-formats.md", f"<!-- {BEGIN}{name} -->\n", f"<!-- {END}{name} -->\n", body

    targets = (
        sv("rdx_pkg.sv", "", systemverilog()),
        (ROOT / "rtl" / "rdx_form.svh", f"// {BEGIN}: form\n", f"// {END}: form\n", form_struct()),
        sv("rdx_cordic.sv", ": angles", angle_table()),
        sv("rdx_swirl_chord.sv", ": chords", chord_tables()),
        (ROOT / "rtl" / "rdx_swirl.svh", f"// {BEGIN}: swirl\n", f"// {END}: swirl\n", swirl_types()),
        (ROOT / "rtl" / "rdx_form.sv", f"      // {BEGIN}: form\n", f"      // {END}: form\n", form_loader()),
        (ROOT / "rtl" / "rdx_material.svh", f"// {BEGIN}: material\n", f"// {END}: material\n", material_places()),
        sv("rdx_rsqrt.sv", ": roots", root_table()),
        sv("rdx_srgb.sv", ": codes", code_table()),
        md("", markdown()),
        md(": material", material_table()),
        md(": form", form_table()),
        md(": swirl", swirl_table()),
    )
    return sorted({path for path, begin, end, body in targets if replace_block(path, begin, end, body, write)})


def main() -> int:
    """Command line of the generator."""
    parser = argparse.ArgumentParser(description="generated number formats: check, or write")
    parser.add_argument("--write", action="store_true", help="bring the files up to date")
    args = parser.parse_args()
    stale = drift(args.write)
    for path in stale:
        print(f"{'written' if args.write else 'differs from the table'}: {path.relative_to(ROOT)}")
    return int(bool(stale) and not args.write)


if __name__ == "__main__":
    sys.exit(main())
