# SPDX-License-Identifier: Apache-2.0
"""The table of proofs that scripts/formal.py makes."""

from dataclasses import dataclass, field

from raydix.formats import LIMIT_WIDTH, STEPS_WIDTH


@dataclass(frozen=True)
class Proof:
    """One proof. A change is (file without ending, text that is there exactly once, text in its place)."""

    top: str  # harness of tb/formal, or a module of rtl whose stream rules are proved
    of: str  # what is proved, in the table
    says: str  # what holds, in the table
    parameters: dict[str, int] = field(default_factory=dict)
    method: str = "pdr"  # pdr; induction <k>; bmc <clocks>; paths
    broken: tuple[tuple[str, str, str], ...] = ()  # changes, each of which has to be refuted
    stand_ins: tuple[str, ...] = ()  # modules of rtl that are replaced by those of tb/formal of the same name
    replace: tuple[tuple[str, str, str], ...] = ()  # changes that make the design smaller
    stages: int = 1  # of lemmas: the parameter Stage of the harness counts them
    depth: int = 20  # clocks in which covers are reached
    limit: int = 600  # seconds that one run of ABC may take


def halve(w, d):
    """rdx_halve of some width and degree."""
    broken = (
        ("rdx_halve", "+ (W + 1)'(1)) >>> 1", "+ (W + 1)'(2)) >>> 1"),
        ("rdx_halve", "right_o = gen_row[D].work_q", "right_o = gen_row[D].left_q"),
        (
            "rdx_halve",
            "work_d[i] = average(b_i[i], b_i[i+1])",
            "work_d[i] = i == 1 ? b_i[1] : average(b_i[i], b_i[i+1])",
        ),
    )
    says = "every value is de Casteljau's, averages half up; outer ends exact, inner end shared, all within the hull"
    return Proof("formal_halve", "rdx_halve", says, {"W": w, "D": d, "Stages": 0}, broken=broken, stages=d)


def select(w, d, n1, rules, below=0):
    """rdx_select against its specification."""
    clocks = 3 if rules == 1 else 3 + (n1 + 2) // 2
    broken = [("rdx_select", "& ~(&positive[j*D+:D+1])", "& ~(&positive[j*D+:D])")] if rules != 2 and d > 1 else []
    if rules != 1:
        broken += [("rdx_guess", ".size[2*i+1] < gen_level", ".size[2*i+1] <= gen_level")]
        broken += [("rdx_guess", "right_second <= left_second", "right_second < left_second")]
    else:
        broken += [("rdx_select", "(last ? changes", "(!last ? changes")]
    if below:
        broken += [("rdx_select", "Below ? !cells_i[i][W-1]", "Below ? cells_i[i] > 0")]
    says = "first and second candidate are those of the rule in force, for all inputs"
    values = {"W": w, "D": d, "N1": n1, "Rules": rules, "Below": below}
    return Proof("formal_select", "rdx_select", says, values, f"induction {clocks + 2}", tuple(broken))


def normalize(w_in, w_out, count, limit, stages=2):
    """rdx_normalize of some widths and stages."""
    broken = (
        ("rdx_normalize", "shift_d = Fine'(Places - 1 - s);", "shift_d = Fine'(Places - s);"),
        ("rdx_normalize", "shift_d = Fine'(Places);", "shift_d = Fine'(Places - 1);"),
    )
    if stages == 4:
        broken += (("rdx_normalize", "eights_d = (Bits - 3)'(Groups - 1 - g);", "eights_d = (Bits - 3)'(Groups - g);"),)
    says = "one shift for all, the largest that fits; signs stay; floor to the output"
    values = {"WIn": w_in, "WOut": w_out, "Count": count, "Limit": limit, "Stages": stages}
    return Proof("formal_normalize", "rdx_normalize", says, values, f"induction {stages + 2}", broken)


def scale(w, count, bits):
    """rdx_scale of some width: the normaliser of a step."""
    broken = (
        ("rdx_scale", "Places = 1 << (Bits - s)", "Places = s == 1 ? 1 : 1 << (Bits - s)"),
        ("rdx_scale", "[W-2-:Places] != {Places{gen_bit", "[W-2-:Places] != {Places{!gen_bit"),
    )
    says = "one shift for all, the largest that fits; nothing is lost, signs stay"
    values = {"W": w, "Count": count, "Bits": bits}
    return Proof("formal_scale", "rdx_scale", says, values, "induction 5", broken)


def outside(faces, change):
    """rdx_outside with exponents or with faces."""
    says = "outside where both ends are beyond one face, the faces as numbers"
    also = ("rdx_outside", "&& sign[axis][j] == sign[axis][j+1]", "")
    broken = (("rdx_outside", *change), also)
    return Proof("formal_outside", "rdx_outside", says, {"J": 8, "Faces": faces}, broken=broken)


def fdiff(w, quadratic, places, sums=0):
    """rdx_fdiff of some width over 2^places columns and rows, against the polynomial or the sums of its differences."""
    broken = (
        ("rdx_fdiff", "row_rise_q + dyy", "row_rise_q - dyy" if quadratic else "row_rise_q + 1"),
        ("rdx_fdiff", "{slope_q, row_slope_q} <= {next_row_slope, next_row_slope};", "slope_q <= next_row_slope + 1;"),
    )
    says = "the value is the polynomial of column and row" + (", as the sum of its differences" if sums else "")
    values = {"W": w, "Quadratic": quadratic, "Places": places, "Sums": sums}
    return Proof("formal_fdiff", "rdx_fdiff", says, values, "induction 2", broken, stages=4)


def slots(slots, phases):
    """rdx_slots of some number of slots."""
    broken = (
        ("rdx_slots", "origins[enter_q]  <= origin_i", "origins[behind] <= origin_i"),
        ("rdx_slots", "segments[enter_q] <= segment_i", "segments[behind] <= segment_i"),
        ("rdx_slots", "leave_q == slot_t'(Slots - 1)", "leave_q == slot_t'(Slots - 2)"),
    )
    says = "what an item began with comes back each turn, until its slot is given anew"
    return Proof(
        "formal_slots",
        "rdx_slots",
        says,
        {"Slots": slots, "Phases": phases, "W": 1},
        "pdr",
        broken,
        depth=40 * min(phases, 2),
    )


def ring(parameters, always, **rest):
    """rdx_ring with units that do what they like within their contract."""
    says = "one last record for each ray taken, none without a ray; first segments and places are the ray's own"
    broken = (
        ("rdx_slots", "segments[enter_q] <= segment_i", "segments[next_q] <= segment_i"),
        (
            "rdx_ring",
            "leave_q.status == Idle && next;",
            "(leave_q.status == Idle || leave_q.status == Again) && next;",
        ),
        ("rdx_leave", "record.last ? Idle : Again", "record.last ? Idle : status"),
        ("rdx_leave", "control_i.roots > 1 &&", "control_i.roots > 0 &&"),
    )
    if always:
        says = "the last record of a ray comes in time where every record is taken at once"
        broken = (
            (
                "rdx_ring",
                "if (take || wrap_q.status == Again) {enter_q.status, enter_q.level} <=",
                "if (take) {enter_q.status, enter_q.level} <=",
            ),
        )
    values = parameters | {"Always": always}
    short = ("rdx_pkg", f"int unsigned StepsWidth = {STEPS_WIDTH};", "int unsigned StepsWidth = 2;")
    narrow = ("rdx_pkg", f"int unsigned LimitWidth = {LIMIT_WIDTH};", "int unsigned LimitWidth = 2;")
    return Proof(
        "formal_ring", "rdx_ring", says, values, "pdr", broken, ("rdx_step",), (short, narrow),
        stages=3, depth=60 if always else 70, **rest,
    )  # fmt: skip


QUEUE = ("rdx_fifo", "wire advance = !valid_o || ready_i;", "wire advance = 1'b1;")


# Depth of a queue in a block RAM, in its proof: PDR does not end for 32 places, and the logic is the same.
BLOCK_FROM = 4


def fifo(depth, block=False):
    """rdx_fifo of some depth, in distributed memory or in a block RAM."""
    texts = (("rdx_fifo", "if (Depth > 16)"), ("formal_fifo", "(Depth > 16"))
    replace = tuple((file, old, old.replace("> 16", f">= {BLOCK_FROM}")) for file, old in texts) if block else ()
    broken = (
        ("rdx_fifo", "if (advance && next_valid) data_o <= next;", "if (advance) data_o <= data_i;"),
        ("rdx_fifo", "if (store) write_place_q <=", "if (valid_i) write_place_q <="),
        QUEUE,
    )
    says = (
        "what comes out is what came in, in its order, nothing lost or doubled; a word is offered within three clocks"
    )
    says += ", in a block RAM" if block else ""
    return Proof("formal_fifo", "rdx_fifo", says, {"W": 1, "Depth": depth}, "pdr", broken, replace=replace, depth=80)


def stream(top, parameters, *broken, method="induction 2", **rest):
    """The rules of streams, which a module states itself."""
    says = "at each stream port valid stays until ready, and so does the data"
    return Proof(top, top, says, parameters, method, broken, **rest)


def paths(top, parameters, *broken, **rest):
    """No way from ready to valid."""
    says = "no path without a register from a ready input to a valid output"
    return Proof(top, top, says, parameters, "paths", broken, **rest)


SMALL = {"N1": 1, "K": 2, "W": 16, "D": 2, "U": 1, "Rules": 1, "HalveStages": 0}
OUTPUT = ("rdx_register", "else if (ready_o) valid_o <= valid_i;", "else valid_o <= valid_i;")
THROUGH = (
    "rdx_register",
    "  always_ff @(posedge clk_i) begin\n"
    "    if (!rst_ni) valid_o <= 1'b0;\n    else if (ready_o) valid_o <= valid_i;\n",
    "  logic held_q;\n  assign valid_o = held_q && ready_i;\n"
    "  always_ff @(posedge clk_i) begin\n    if (!rst_ni) held_q <= 1'b0;\n    else if (ready_o) held_q <= valid_i;\n",
)
THROUGH_QUEUE = ("rdx_product", "rays_valid && points_valid;", "rays_valid && points_valid && ray_ready_i;")
LAST = (
    "  rdx_fifo #(\n      .W($bits(hit_t)),\n      .Depth(2)\n  ) u_out (\n      .clk_i,\n      .rst_ni,\n"
    "      .valid_i(merged_valid),\n      .ready_o(merged_ready),\n      .data_i (merged),\n      .valid_o({}),\n"
)
THROUGH_RINGS = (
    "rdx_rings",
    LAST.format("hit_valid_o"),
    "  logic held;\n  assign hit_valid_o = held && hit_ready_i;\n" + LAST.format("held"),
)
QUEUED = (
    "  rdx_fifo #(\n      .W($bits(ray_t) + $bits(segment_t)),\n      .Depth(Queue)\n  ) u_queue (\n      .clk_i,\n"
    "      .rst_ni,\n      .valid_i(here && !drop),\n      .ready_o(queue_ready),\n      .data_i ({{ray, segment}}),\n"
    "      .valid_o({}),\n"
)
THROUGH_SIFT = (
    "rdx_sift",
    QUEUED.format("ray_valid_o"),
    "  logic held;\n  assign ray_valid_o = held && ray_ready_i;\n" + QUEUED.format("held"),
)
THROUGH_MERGE = ("rdx_merge", "valid_o = |valid_i;", "valid_o = |(valid_i & ready_o);")
CORE = SMALL | {"Vecsum": 2, "Lanes": 1}
VECTOR = {"N1": 1, "K": 2, "Rules": 1, "Lanes": 1}
STAND_INS = ("rdx_step", "rdx_vecsum", "rdx_quartic")
# an evaluator of few clocks, so that the ring of vector sums is short
SHORT = (
    "rdx_pkg",
    "return angle_iterations(vector_drop) + 1 + TurnLatency + tube_latency(vector_drop) + 6;",
    "return 2;",
)


def held(module):
    """All stages of a module advance, whether the last was taken or not."""
    return (module, "wire en = !valid_q[Latency-1] || ray_ready_i;", "wire en = 1'b1;")


def through(module):
    """A module offers what it has only where it is asked."""
    return (module, "ray_valid_o = valid_q[Latency-1];", "ray_valid_o = valid_q[Latency-1] && ray_ready_i;")


WALK = ("rdx_raster", "wire step = ray_valid_o && ray_ready_i;", "wire step = ray_valid_o;")

# the frame's last column is an input that does not change within a frame: a register that keeps any value
HELD_COLUMN = (
    ("rdx_pixels", "wire pixel_t last_beat = last_x_i >> Shift;",
     "pixel_t held_q;\n  always_ff @(posedge clk_i) held_q <= held_q;\n  wire pixel_t last_beat = held_q >> Shift;"),
    ("rdx_pixels", "+ pixel_t'(p) <= last_x_i}};", "+ pixel_t'(p) <= held_q}};"),
)  # fmt: skip
AT_ONCE = ("rdx_pixels", "assign m_axis_tvalid_o = beat_valid;", "assign m_axis_tvalid_o = beat_valid && beat_ready;")
MOVES = ("rdx_walk", "wire en = !valid_q || hidden_q || ray_ready_i;", "wire en = !valid_q || hidden_q || next_i;")
WAITS = ("rdx_walk", "assign ray_valid_o = valid_q && !hidden_q;", "assign ray_valid_o = valid_q && ray_ready_i;")

PROOFS = {
    "halve-d4": halve(48, 4),
    "halve-d2": halve(48, 2),
    "select-n1": select(4, 4, 1, 3),
    "select-n2": select(4, 4, 2, 3),
    "select-n3": select(4, 4, 3, 3),
    "select-n4": select(4, 4, 4, 3),
    "select-d2": select(4, 2, 3, 3),
    "select-d1": select(4, 1, 3, 3),
    "select-certified": select(4, 4, 3, 1),
    "select-below": select(5, 4, 3, 1, 1),
    "select-paper": select(4, 4, 3, 2),
    "normalize": normalize(48, 18, 3, 7),
    "normalize-product": normalize(64, 36, 5, 63, 4),
    "normalize-product-d2": normalize(64, 36, 3, 63, 4),
    "scale": scale(36, 5, 3),
    "scale-n4": scale(48, 5, 4),
    "pick": Proof(
        "formal_pick",
        "rdx_pick",
        "the digits of the level are those chosen, the rest stays; t_next likewise; others than Run pass",
        {"N1": 3, "K": 8},
        broken=(
            ("rdx_pick", "control_i.follow && pick_i == first_i", "control_i.follow"),
            ("rdx_pick", "control_o.t_next  = control_i.t;", "control_o.t_next  = control_i.t_next;"),
        ),
    ),
    "settle": Proof(
        "formal_settle",
        "rdx_settle",
        "an item hits, goes a level on, to its pending cell, or ends; it ends after as many steps as can be counted",
        {"N1": 1, "K": 2, "W": 4, "D": 2},
        "induction 5",
        broken=(
            ("rdx_settle", "else if (spent_q) control_d.status = Done;", ""),
            ("rdx_settle", "control_qq.pending ? Again : Done", "Again"),
            ("rdx_settle", "last_q && changes_q && !point_outside", "changes_q && !point_outside"),
            ("rdx_settle", "changes_q && !point_outside", "changes_q && point_outside"),
            ("rdx_settle", "positive_q <= b[0] > 0;", "positive_q <= b[0] <= 0;"),
        ),
    ),
    "outside": outside(0, ("left = left << (1 << (i - 1));", "left = left << (1 << i);")),
    "outside-faces": outside(1, ("boundaries_i[axis][j] > high_i[axis]", "boundaries_i[axis][j] >= high_i[axis]")),
    "fdiff": fdiff(64, 1, 2, 1),
    "fdiff-closed": fdiff(8, 1, 2),
    "fdiff-linear": fdiff(48, 0, 2),
    "bound": Proof(
        "formal_bound",
        "rdx_bound",
        "a cell of one sign is excluded exactly where a bound excludes it",
        {"N1": 1},
        "induction 5",
        (
            ("rdx_bound", "(BoundWidth + 1)'(bound) + 1'b1;", "(BoundWidth + 1)'(bound);"),
            ("rdx_bound", "(6'(level_i) + 6'd1) * 6'(N1)", "6'(level_i) * 6'(N1)"),
            ("rdx_bound", "(bend_q >> 2)", "(bend_q >> 3)"),
        ),
        stages=2,
        depth=6,
    ),
    "slots": slots(6, 1),
    "slots-phases": slots(5, 3),
    "paths-core": paths("rdx_core", CORE, THROUGH_MERGE, stand_ins=STAND_INS, replace=(SHORT,)),
    "paths-algebraic": paths("rdx_algebraic", SMALL, THROUGH_RINGS, stand_ins=("rdx_step",)),
    "paths-vector": paths("rdx_vector", VECTOR, THROUGH_RINGS, stand_ins=("rdx_step", "rdx_vecsum"), replace=(SHORT,)),
    "paths-ring": paths("rdx_ring", SMALL, THROUGH, stand_ins=("rdx_step",)),
    "paths-product": paths("rdx_product", {"D": 2}, THROUGH_QUEUE),
    "paths-raster": paths(
        "rdx_raster", {"D": 2, "Vector": 1}, ("rdx_raster", "state_q == Walk;", "state_q == Walk && ray_ready_i;")
    ),
    "paths-ends": paths("rdx_ends", {"Lanes": 1}, through("rdx_ends"), stand_ins=("rdx_vecsum",), replace=(SHORT,)),
    "paths-merge": paths("rdx_merge", {}, THROUGH_MERGE),
    "paths-register": paths("rdx_register", {}, THROUGH),
    "stream-register": stream(
        "rdx_register", {"W": 32}, ("rdx_register", "if (ready_o && valid_i) data_o", "if (valid_i) data_o")
    ),
    "fifo": fifo(4),
    "fifo-two": fifo(2),
    "fifo-block": fifo(BLOCK_FROM, block=True),
    "stream-fifo": stream("rdx_fifo", {"W": 213, "Depth": 16}, QUEUE),
    "stream-fifo-block": stream("rdx_fifo", {"W": 60, "Depth": 32}, QUEUE),
    "stream-sift": stream("rdx_sift", {"W": 16, "D": 2, "Levels": 1, "Queue": 16}, QUEUE),
    "paths-sift": paths("rdx_sift", {"W": 16, "D": 2, "Levels": 1, "Queue": 16}, THROUGH_SIFT),
    "stream-rings": stream("rdx_rings", SMALL | {"Rings": 2}, QUEUE, stand_ins=("rdx_step",), depth=60),
    "paths-rings": paths("rdx_rings", SMALL | {"Rings": 2}, THROUGH_RINGS, stand_ins=("rdx_step",)),
    "stream-product": stream("rdx_product", {"D": 2}, QUEUE),
    "stream-product-d4": stream("rdx_product", {"D": 4}, QUEUE, stand_ins=("rdx_quartic",)),
    "stream-raster": stream("rdx_raster", {"D": 2, "Vector": 1}, WALK, depth=50),
    "stream-raster-d4": stream("rdx_raster", {"D": 4, "Vector": 1}, WALK, depth=50),
    "stream-ends": stream("rdx_ends", {"Lanes": 1}, held("rdx_ends"), stand_ins=("rdx_vecsum",), replace=(SHORT,)),
    "stream-ring": stream("rdx_ring", SMALL, OUTPUT, stand_ins=("rdx_step",), depth=40),
    "stream-algebraic": stream("rdx_algebraic", SMALL, QUEUE, stand_ins=("rdx_step",), depth=80),
    "stream-vector": stream(
        "rdx_vector", VECTOR, QUEUE, stand_ins=("rdx_step", "rdx_vecsum"), replace=(SHORT,), depth=90
    ),
    "stream-scan": stream("rdx_scan", {"D": 2, "Vector": 1}, MOVES),
    "paths-scan": paths("rdx_scan", {"D": 2, "Vector": 1}, WAITS),
    "stream-pixels": stream("rdx_pixels", {"Pixels": 2, "Depth": 16}, QUEUE, replace=HELD_COLUMN),
    "paths-pixels": paths("rdx_pixels", {"Pixels": 2, "Depth": 16}, AT_ONCE),
    "stream-check": stream(
        "rdx_check", {}, ("rdx_check", "else if (start_ready_i) start_valid_o", "else start_valid_o")
    ),
    "csr": Proof(
        "formal_csr",
        "rdx_csr",
        "a request of the table waits for its answer; answers to the host and starts of frames keep the stream rules",
        method="pdr",
        broken=(
            ("rdx_csr", "rd_ack: table_ack_i && !table_we_q", "rd_ack: table_req_o"),
            ("rdx_csr", "wr_ack: table_ack_i && table_we_q", "wr_ack: 1'b1"),
            ("rdx_check", "else if (start_ready_i) start_valid_o", "else start_valid_o"),
        ),
    ),
    # without vector sums, whose ports are those of stream-vector: their first hit would come after a hundred clocks
    "stream-core": stream("rdx_core", CORE | {"Vecsum": 0}, QUEUE, stand_ins=STAND_INS, replace=(SHORT,), depth=110),
    "ring": ring({"U": 1}, 0),
    "ring-time": ring({"U": 1}, 1),
    "merge": Proof(
        "formal_merge",
        "rdx_merge",
        "nothing lost, doubled or changed; nobody passed by twice; stream rules, if both inputs keep them",
        {"W": 8},
        broken=(
            ("rdx_merge", "turn_q <= !ready_i ? chosen :", "turn_q <= 1'b1 ? chosen :"),
            ("rdx_merge", "i >= int'(turn_q)) chosen", "i >= 1) chosen"),
            ("rdx_merge", "ready_o[chosen] = ready_i;", "ready_o = {Count{ready_i}};"),
        ),
    ),
}
