// SPDX-License-Identifier: Apache-2.0
// rdx_ring, its step units replaced by ones that may do anything their contract allows: each ray taken is answered by exactly
// one last record, in time where the records are taken, and by no other's; a slot's memory is not overwritten.
//
// One ray of all that come, any, is marked, in its place on the screen (the slot's memory keeps it), in its box (the item
// carries it) and in its first segment. The design treats all rays alike, so what holds for the marked one holds for each.
`default_nettype none
`include "formal.svh"
`include "rdx_types.svh"

module formal_ring #(
    parameter int unsigned N1 = 1,
    parameter int unsigned K = 2,
    parameter int unsigned W = 16,
    parameter int unsigned D = 2,
    parameter int unsigned U = 1,
    parameter int unsigned Lanes = 1,
    parameter bit Always = 1'b0,  // the output is always ready
    parameter int unsigned Stage = 2,
    localparam type control_t = `RDX_CONTROL_T(N1 * K),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input wire logic          clk_i,
    input wire logic          rst_ni,
    input wire logic          ray_valid_i,
    input wire rdx_pkg::ray_t ray_i,
    input wire segment_t      segment_i,
    input wire logic          hit_ready_i
);
  import rdx_pkg::*;

  localparam int unsigned HalveStages = D == 1 ? 1 : 0;
  localparam int unsigned Rules = RuleCertified;
  localparam int unsigned Phases = D == 1 ? phases((1 << N1) - 1, Lanes) : 1;
  localparam int unsigned Latency = step_latency(N1, D, HalveStages, Lanes, 0, Rules);
  localparam int unsigned Slots = (U * Latency + 3 + Phases - 1) / Phases;
  localparam int unsigned MostSteps = (1 << StepsWidth) - 1;

  logic ray_ready, hit_valid;
  hit_t hit;
  rdx_ring #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .HalveStages(HalveStages),
      .Lanes(Lanes),
      .Limit(1'b1)
  ) u_ring (
      .clk_i,
      .rst_ni,
      .form_i('0),
      .modes_i(ModesDefault),
      .ray_valid_i,
      .ray_ready_o(ray_ready),
      .ray_i,
      .segment_i,
      .hit_valid_o(hit_valid),
      .hit_ready_i,
      .hit_o(hit)
  );

  // ---- reset in the first clock and never again; rays ask for 1 to 4 roots; the mark ----
  `RESET_FIRST
  `GIVEN(g_no_reset, !began_q || rst_ni)
  `GIVEN(g_roots, ray_i.roots >= 1 && ray_i.roots <= 4)
  wire mark = ray_i.x[0];
  `GIVEN(g_mark, ray_i.box[0][0] == mark && segment_i.ends.start[0][0] == mark && ray_i.limit[0] == mark)
  `GIVEN(g_ready, !Always || hit_ready_i)
  wire take = rst_ni && ray_valid_i && ray_ready;
  wire give = rst_ni && hit_valid && hit_ready_i;

  logic taken_q = 1'b0, answered_q = 1'b0;
  logic [6:0] age_q = '0;
  `GIVEN(g_one, !(mark && taken_q && take))
  always_ff @(posedge clk_i) begin
    if (take && mark) taken_q <= 1'b1;
    if (give && hit.x[0] && hit.last) answered_q <= 1'b1;
    if (taken_q && age_q != '1) age_q <= age_q + 1'b1;
  end
  wire flying = taken_q && !answered_q;

  // ---- the marked item: in one place of the ring, or its last record is in the output's register ----
  logic [U*Latency+2:0] here;
  assign here[0] = u_ring.enter_q.status != Idle && u_ring.enter_q.box[0][0];
  assign here[1] = u_ring.leave_q.status != Idle && u_ring.leave_q.box[0][0];
  assign here[2] = u_ring.wrap_q.status != Idle && u_ring.wrap_q.box[0][0];
  for (genvar u = 0; u < U; u++) begin : gen_unit
    for (genvar i = 0; i < Latency; i++) begin : gen_stage
      wire control_t item = u_ring.gen_unit[u].u_step.control_q[i];
      assign here[3+u*Latency+i] = item.status != Idle && item.box[0][0];
    end
  end
  wire handed = hit_valid && hit.x[0] && hit.last;
  wire running = rst_ni && u_ring.filled;
  `LEMMA(1, p_kept, !running || flying == (here != '0 || handed))
  `LEMMA(1, p_once, !running || (here & (here - 1'b1)) == '0)
  `LEMMA(1, p_left, !running || !handed || here == '0)

  // ---- records of one ray: a step at least for each, and not more than roots were wanted ----
  steps_t steps_q = '0;
  roots_t roots_q;  // still wanted
  always_ff @(posedge clk_i) begin
    if (take && mark) roots_q <= ray_i.roots;
    else if (give && hit.x[0]) roots_q <= roots_q - 1'b1;
    if (give && hit.x[0]) steps_q <= hit.steps;
  end
  if (!Always) begin : gen_records
    `LEMMA(2, p_steps, !(give && hit.x[0]) || hit.steps > steps_q)
    `LEMMA(2, p_roots, !(give && hit.x[0]) || roots_q != '0)
  end

  // ---- what the mark shows ----
  `LEMMA(1, p_ours, !(give && hit.x[0]) || flying)  // no record without a ray, and none behind the last
  if (Always) begin : gen_time
    // a step a turn and no turn without one: steps and place say how long ago the marked item was taken
    localparam int unsigned Turn = Slots * Phases;
    `LEMMA(1, p_enter, !(running && here[0]) || age_q == 7'(Turn * 32'(u_ring.enter_q.steps)))
    for (genvar i = 0; i < Latency; i++) begin : gen_stage
      wire control_t item = u_ring.gen_unit[0].u_step.control_q[i];
      `LEMMA(1, p_stage, !(running && here[3+i]) || age_q == 7'(Turn * (32'(item.steps) - 1) + 1 + i))
    end
    `LEMMA(1, p_leave, !(running && here[1]) || age_q == 7'(Turn * 32'(u_ring.leave_q.steps) - 2))
    `LEMMA(1, p_wrap, !(running && here[2]) || age_q == 7'(Turn * 32'(u_ring.wrap_q.steps) - 1))
    // each step a turn of the ring; the record stands at the output two clocks before the last turn is over, and not sooner
    `LEMMA(2, p_time, !flying || age_q <= 7'(MostSteps * Turn - 2))
    `REACH(r_time, flying && age_q == 7'(MostSteps * Turn - 2))
  end else begin : gen_held
    `REACH(r_held, flying && age_q == 7'((MostSteps + 2) * Slots * Phases))
  end

  // the record is of the item that leaves, and its memory is the ray's
  `LEMMA(0, p_memory, !(u_ring.u_leave.offer && rst_ni) || u_ring.first_origin.x[0] == u_ring.back.box[0][0])
  // so is the limit that any item is compared with
  `LEMMA(
      0, p_limit,
      !(rst_ni && u_ring.filled && u_ring.back.status != Idle) || u_ring.first_origin.limit[0] == u_ring.back.box[0][0])
  // what begins a descent has its ray's own segment
  wire begins = u_ring.enter_q.status == Run && u_ring.enter_q.level == '0;
  `LEMMA(0, p_segment,
         !(rst_ni && u_ring.filled && begins) || u_ring.enter_segment_q.ends.start[0][0] == u_ring.enter_q.box[0][0])
  `REACH(r_restart, rst_ni && u_ring.filled && begins && u_ring.enter_q.steps != '0 && u_ring.enter_q.box[0][0])
  `REACH(r_ended, rst_ni && u_ring.u_leave.ended_o && u_ring.back.box[0][0])
  `REACH(r_ended_later, rst_ni && u_ring.u_leave.ended_o && u_ring.back.box[0][0] && u_ring.back.steps > 2'd1)
  `REACH(r_last, give && hit.x[0] && hit.last && hit.hit)
  `REACH(r_more, give && hit.x[0] && !hit.last)

endmodule

`default_nettype wire
