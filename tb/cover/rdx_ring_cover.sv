// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_ring.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_ring_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Limit = 1'b0,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic          clk_i,
    input wire logic          rst_ni,
    input wire rdx_pkg::ray_t ray_i,
    input wire logic          ray_valid_i,
    input wire logic          hit_valid_o,
    input wire logic          hit_ready_i,
    input wire control_t      back,
    input wire logic          ray_ready_o,
    input wire logic          next,
    input wire logic          filled,
    input wire logic          behind,
    input wire logic          take
);
  import rdx_pkg::*;

  logic took_q;
  logic next_q;  // the place that enters may hold an item
  always_ff @(posedge clk_i) {took_q, next_q} <= {take, next};
  wire again = filled && back.status == Again;

  for (genvar r = 1; r <= 4; r++) begin : gen_roots
    `RDX_COVER_RUN(wanted, take && ray_i.roots == 3'(r))
  end
  for (genvar p = 0; p < 2; p++) begin : gen_rule
    if (Rules[p]) begin : gen_built
      `RDX_COVER_RUN(rule, take && (Rules != 3 || ray_i.paper == p))
    end
  end
  `RDX_COVER_RUN(first_turn, !filled && ray_valid_i)
  `RDX_COVER_RUN(empty_slot_not_taken, ray_ready_o && !ray_valid_i)
  `RDX_COVER_RUN(full, filled && next_q && !ray_ready_o && ray_valid_i)
  `RDX_COVER_RUN(ray_each_slot, took_q && take)
  `RDX_COVER_RUN(slot_taken_again, take && !took_q)
  `RDX_COVER_RUN(restarted_at_dead_end, again)
  if (Limit) begin : gen_limit
    `RDX_COVER_RUN(ended, behind)
  end
  `RDX_COVER_RUN(output_stalled, hit_valid_o && !hit_ready_i)
endmodule

bind rdx_ring rdx_ring_cover #(
    .N1(N1),
    .K(K),
    .Rules(Rules),
    .Limit(Limit)
) u_cover (.*);

`default_nettype wire
