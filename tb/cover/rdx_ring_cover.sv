// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_ring.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_ring_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic          clk_i,
    input wire logic          rst_ni,
    input wire rdx_pkg::ray_t ray_i,
    input wire logic          ray_valid_i,
    input wire logic          hit_valid_o,
    input wire logic          hit_ready_i,
    input wire control_t      back,
    input wire control_t      leave_q,
    input wire rdx_pkg::hit_t record,
    input wire logic          filled,
    input wire logic          enter,
    input wire logic          take,
    input wire logic          give,
    input wire logic          given
);
  import rdx_pkg::*;

  logic took_q;
  always_ff @(posedge clk_i) took_q <= take;
  wire again = filled && back.status == Again;
  wire limit = &back.steps;

  for (genvar r = 1; r <= 4; r++) begin : gen_roots
    `RDX_COVER_RUN(wanted, take && ray_i.roots == 3'(r))
    `RDX_COVER_RUN(hit, give && given && record.hit && back.roots == 3'(r))
    `RDX_COVER_RUN(last_hit, give && given && record.hit && record.last && back.roots == 3'(r))
    `RDX_COVER_RUN(ends_without, give && given && !record.hit && back.roots == 3'(r))
  end
  for (genvar p = 0; p < 2; p++) begin : gen_rule
    if (Rules[p]) begin : gen_built
      `RDX_COVER_RUN(rule, take && (Rules != 3 || ray_i.paper == p))
    end
  end
  `RDX_COVER_RUN(first_turn, !filled && ray_valid_i)
  `RDX_COVER_RUN(empty_slot_not_taken, filled && enter && leave_q.status == Idle && !ray_valid_i)
  `RDX_COVER_RUN(full, filled && enter && leave_q.status != Idle && ray_valid_i)
  `RDX_COVER_RUN(ray_each_slot, took_q && take)
  `RDX_COVER_RUN(slot_taken_again, take && !took_q)
  `RDX_COVER_RUN(hit_goes_round, give && !given && record.hit)
  `RDX_COVER_RUN(end_goes_round, give && !given && !record.hit)
  `RDX_COVER_RUN(restarted_for_next_root, give && given && !record.last)
  `RDX_COVER_RUN(restarted_at_dead_end, again)
  `RDX_COVER_RUN(roots_wanted_none_pending, give && back.status == Hit && back.roots > 1 && !back.pending)
  `RDX_COVER_RUN(output_stalled, hit_valid_o && !hit_ready_i)
  `RDX_COVER_RUN(given_up_at_limit, give && given && limit && !record.hit)
endmodule

bind rdx_ring rdx_ring_cover #(
    .N1(N1),
    .K(K),
    .Rules(Rules)
) u_cover (.*);

`default_nettype wire
