// SPDX-License-Identifier: Apache-2.0
// U step units in a ring. Items circulate until they have a hit or no cell is left; no unit ever stalls.
//
// The ring turns one place a clock and holds Slots items. An item keeps its slot, so a counter that turns with the
// ring is the slot's number at the wrap, and addresses the memory of first segments without any free list. At the
// wrap an item that is done hands over its record and leaves, an item to be restarted gets its first segment back, and
// an empty slot takes a new ray. A record that cannot be handed over goes round once more. So U = K is
// the full pipeline, a ray a clock, and U = 1 one step unit shared by all rays in flight.
//
// Formats    ray_i: rdx_pkg::ray_t; segment_i: first ends and control points; hit_o: rdx_pkg::hit_t. A ray leaves one
//            record for each root, in order of t, and one without a hit where it ends without a further root; the last
//            record is marked. Rays may overtake each other.
// Timing     a new ray is taken where an empty slot comes by, in the best case every clock; a ray that needs s steps in
//            one descent is back after ceil(s/U) turns of Slots = U*latency of rdx_step + 2 clocks.
// Reset      status of the slots only; takes Slots clocks after the release, in which no ray is taken.
// Model      model/raydix/ring.py
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_ring #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned HalveStages = (D + 1) / 2,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire logic          ray_valid_i,
    output logic               ray_ready_o,
    input  wire rdx_pkg::ray_t ray_i,
    input  wire segment_t      segment_i,
    output logic               hit_valid_o,
    input  wire logic          hit_ready_i,
    output rdx_pkg::hit_t      hit_o
);
  import rdx_pkg::*;

  localparam type control_t = `RDX_CONTROL_T(N1 * K);
  localparam int unsigned Slots = U * step_latency(N1, HalveStages, Rules) + 2;
  localparam type slot_t = logic [$clog2(Slots)-1:0];

  if (U < 1 || U > K) begin : gen_illegal_u
    $fatal(1, "rdx_ring: U = %0d; allowed: 1 to K = %0d", U, K);
  end

  // ---- step units ----
  control_t enter_q, control[U+1];  // enter: the item at the first unit
  segment_t enter_segment_q, segment[U+1];
  assign control[0] = enter_q;
  assign segment[0] = enter_segment_q;
  for (genvar u = 0; u < U; u++) begin : gen_unit
    rdx_step #(
        .N1(N1),
        .K(K),
        .W(W),
        .D(D),
        .Rules(Rules),
        .HalveStages(HalveStages)
    ) u_step (
        .clk_i,
        .control_i(control[u]),
        .segment_i(segment[u]),
        .control_o(control[u+1]),
        .segment_o(segment[u+1])
    );
  end

  // ---- slot numbers: of the item that leaves the last unit, of the one behind it, and of the one before it ----
  slot_t leave_slot_q, behind_slot, enter_slot_q;
  logic filled_q;  // the ring has turned once since the reset: what leaves the last unit has entered it
  assign behind_slot = leave_slot_q == slot_t'(Slots - 1) ? '0 : leave_slot_q + 1'b1;
  always_ff @(posedge clk_i) begin
    enter_slot_q <= leave_slot_q;
    if (!rst_ni) begin
      leave_slot_q <= '0;
      filled_q <= 1'b0;
    end else begin
      leave_slot_q <= behind_slot;
      if (leave_slot_q == slot_t'(Slots - 1)) filled_q <= 1'b1;
    end
  end

  // ---- memory of first segments ----
  typedef struct packed {
    surface_t surface;
    pixel_t   x;
    pixel_t   y;
    segment_t segment;
  } first_t;
  logic [$bits(first_t)-1:0] first_mem[Slots];
  first_t first_q;     // of the item that leaves the last unit
  segment_t again_q;   // of the item behind the wrap
  wire take = ray_valid_i && ray_ready_o;
  always_ff @(posedge clk_i) begin
    first_q <= first_mem[behind_slot];
    again_q <= first_q.segment;
    if (take) first_mem[enter_slot_q] <= {ray_i.surface, ray_i.x, ray_i.y, segment_i};
  end

  // ---- leaving: hand over the record ----
  control_t back, leave_d, leave_q;
  segment_t back_segment, leave_segment_q;
  hit_t record;
  logic give, given, more_roots;
  assign back = control[U];
  assign back_segment = segment[U];
  assign more_roots = back.roots > 1 && back.pending && !(&back.steps);
  assign give = filled_q && (back.status == Hit || back.status == Done);
  assign record = '{
          surface: first_q.surface,
          x: first_q.x,
          y: first_q.y,
          hit: back.status == Hit,
          last: back.status == Done || !more_roots,
          t: 32'(back.t),
          depth: back_segment.ends.depth_start,
          point: back_segment.ends.start,
          steps: back.steps
      };
  rdx_register #(
      .W($bits(hit_t))
  ) u_out (
      .clk_i,
      .rst_ni,
      .valid_i(give),
      .ready_o(given),
      .data_i (record),
      .valid_o(hit_valid_o),
      .ready_i(hit_ready_i),
      .data_o (hit_o)
  );

  always_comb begin
    leave_d = back;
    if (!filled_q) begin
      leave_d.status = Idle;
    end else if (give && given) begin
      leave_d.status = record.last ? Idle : Again;
      leave_d.roots  = back.roots - 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    leave_q <= leave_d;
    leave_segment_q <= back_segment;
  end

  // ---- entering: a new ray in an empty slot, a restart from the first segment ----
  control_t enter_d;
  segment_t enter_segment_d;
  assign ray_ready_o = filled_q && leave_q.status == Idle;
  always_comb begin
    enter_d = leave_q;
    enter_segment_d = leave_segment_q;
    if (take) begin
      enter_d = '0;
      enter_d.status = Run;
      enter_d.paper = ray_i.paper;
      enter_d.roots = ray_i.roots;
      enter_d.box = ray_i.box;
      enter_segment_d = segment_i;
    end else if (leave_q.status == Again) begin
      enter_d.status = Run;
      enter_d.level = '0;
      enter_d.t = '0;
      enter_d.t_min = leave_q.t_next;
      enter_d.follow = 1'b1;
      enter_d.pending = 1'b0;
      enter_segment_d = again_q;
    end
  end
  always_ff @(posedge clk_i) begin
    enter_q <= enter_d;
    enter_segment_q <= enter_segment_d;
  end

  `RDX_STREAM(a_hit, hit_valid_o, hit_ready_i, hit_o)
  `RDX_ASSERT(a_wanted, !take || (ray_i.roots >= 1 && ray_i.roots <= 4))

endmodule

`default_nettype wire
