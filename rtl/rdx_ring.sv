// SPDX-License-Identifier: Apache-2.0
// U step units in a ring. Items circulate until they have a hit or no cell is left; no unit ever stalls.
//
// The ring turns one place a clock and holds Slots items. An item keeps its slot, whose number is that of a counter at the
// wrap: it addresses the memory of first segments. At the wrap an item that is done hands over its record and leaves, one to
// be restarted gets its first segment back, and an empty slot takes a new ray. A record that cannot be handed over goes round
// once more. So U = K is the full pipeline, a ray a clock, and U = 1 one step unit shared by all rays in flight.
//
// Formats    ray_i: rdx_pkg::ray_t; segment_i: first ends and control points; hit_o: rdx_pkg::hit_t. A ray leaves one
//            record for each root, in order of t, and one without a hit where it ends without a further root; the last
//            record is marked. Rays may overtake each other.
// Timing     a new ray is taken where an empty slot comes by, in the best case every clock; a ray that needs s steps in
//            one descent is back after ceil(s/U) turns of U*latency of rdx_step + 3 clocks. Vector sums (D = 1): a slot
//            every Phases clocks, and a turn is made a multiple of that. ray_ready_o is a register.
// Reset      status of the slots only; takes a turn after the release, in which no ray is taken.
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
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    parameter bit Limit = 1'b0,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire rdx_pkg::form_t        form_i,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire logic                  ray_valid_i,
    output logic                       ray_ready_o,
    input  wire rdx_pkg::ray_t         ray_i,
    input  wire segment_t              segment_i,
    output logic                       hit_valid_o,
    input  wire logic                  hit_ready_i,
    output rdx_pkg::hit_t              hit_o,
    output logic                 [5:0] steps_o,      // items that take a step, a clock ago
    output logic                       ended_o       // an item has ended behind its limit, a clock ago
);
  import rdx_pkg::*;

  localparam type control_t = `RDX_CONTROL_T(N1 * K);
  // Vector sums whose lanes evaluate an item in several clocks: an item every Phases clocks, others are bubbles.
  localparam int unsigned Phases = D == 1 ? phases((1 << N1) - 1, Lanes) : 1;
  localparam int unsigned Latency = step_latency(N1, D, HalveStages, Lanes, VectorDrop, Rules);
  localparam int unsigned Slots = (U * Latency + 3 + Phases - 1) / Phases;  // that can hold an item
  localparam int unsigned Pad = Slots * Phases - 3 - U * Latency;  // so that the ring holds a whole number of them
  if (U < 1 || U > K) begin : gen_illegal_u
    $fatal(1, "rdx_ring: U = %0d; allowed: 1 to K = %0d", U, K);
  end

  // ---- step units ----
  control_t enter_q, control[U+1];  // enter: the item at the first unit
  segment_t enter_segment_q, segment[U+1];
  assign {control[0], segment[0]} = {enter_q, enter_segment_q};
  logic [  3:0] phase;  // of the place at the first unit
  logic [U-1:0] runs;
  always_ff @(posedge clk_i) steps_o <= 6'($countones(runs));
  for (genvar u = 0; u < U; u++) begin : gen_unit
    assign runs[u] = control[u].status == Run;
    rdx_step #(
        .N1(N1),
        .K(K),
        .W(W),
        .D(D),
        .Rules(Rules),
        .Clip(Clip),
        .HalveStages(HalveStages),
        .Lanes(Lanes),
        .General(General),
        .VectorDrop(VectorDrop)
    ) u_step (
        .clk_i,
        .rst_ni,
        .phase_i  (phase_before(phase, u * Latency, Phases)),
        .form_i,
        .modes_i,
        .control_i(control[u]),
        .segment_i(segment[u]),
        .control_o(control[u+1]),
        .segment_o(segment[u+1])
    );
  end

  // ---- what the items began with ----
  origin_t  first_origin;  // of the item that leaves the last unit
  segment_t first_segment;  // of the item behind it
  logic next, filled;  // the place that enters next may hold an item; what leaves the last unit has entered the ring
  wire take = ray_valid_i && ray_ready_o;
  rdx_slots #(
      .Slots(Slots),
      .Phases(Phases),
      .O(origin_t),
      .S(segment_t)
  ) u_slots (
      .clk_i,
      .rst_ni,
      .take_i(take),
      .origin_i('{surface: ray_i.surface, x: ray_i.x, y: ray_i.y, limit: Limit ? ray_i.limit : NoLimit}),
      .segment_i,
      .origin_o(first_origin),
      .segment_o(first_segment),
      .next_o(next),
      .phase_o(phase),
      .filled_o(filled)
  );

  // ---- leaving: hand over the record ----
  control_t back, leave_d, leave_q, wrap_q;
  segment_t back_segment, leave_segment_q, wrap_segment_q;
  localparam type item_t = logic [$bits(control_t)+$bits(segment_t)-1:0];
  item_t last[1], padded[1];
  logic behind;
  assign last[0] = {control[U], segment[U]};
  rdx_delay #(
      .T(item_t),
      .Depth(Pad)
  ) u_pad (
      .clk_i,
      .data_i(last),
      .data_o(padded)
  );
  assign {back, back_segment} = padded[0];
  rdx_leave #(
      .N1(N1),
      .K(K),
      .U(U),
      .Limit(Limit)
  ) u_leave (
      .clk_i,
      .rst_ni,
      .early_i  (modes_i.early),
      .filled_i (filled),
      .control_i(back),
      .ends_i   (back_segment.ends),
      .origin_i (first_origin),
      .control_o(leave_d),
      .ended_o  (behind),
      .hit_valid_o,
      .hit_ready_i,
      .hit_o
  );
  always_ff @(posedge clk_i) begin
    leave_q <= leave_d;
    leave_segment_q <= back_segment;
    ended_o <= behind;
  end

  // ---- entering: a new ray in an empty slot, a restart from the first segment; that there is room is known a clock before ----
  always_ff @(posedge clk_i) ray_ready_o <= rst_ni && filled && leave_q.status == Idle && next;
  always_ff @(posedge clk_i) begin
    wrap_q <= leave_q;
    wrap_segment_q <= leave_q.status == Again ? first_segment : leave_segment_q;
    enter_q <= wrap_q;
    enter_segment_q <= wrap_segment_q;
    if (take) begin
      enter_q <= '0;
      {enter_q.paper, enter_q.roots, enter_q.box} <= {ray_i.paper, ray_i.roots, ray_i.box};
      enter_segment_q <= segment_i;
    end else if (wrap_q.status == Again) begin
      enter_q.t <= '0;
      enter_q.t_min <= wrap_q.t_next;
      enter_q.follow <= 1'b1;
      enter_q.pending <= 1'b0;
    end
    if (take || wrap_q.status == Again) {enter_q.status, enter_q.level} <= {Run, modes_i.first_level};
  end

  `RDX_STREAM(a_hit, hit_valid_o, hit_ready_i, hit_o)
  `RDX_ASSERT(a_wanted, !take || (ray_i.roots >= 1 && ray_i.roots <= 4))

endmodule

`default_nettype wire
