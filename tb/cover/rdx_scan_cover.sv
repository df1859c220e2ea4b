// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_scan.
`default_nettype none
`include "rdx_cover.svh"

module rdx_scan_cover #(
    parameter int unsigned D = 4,
    parameter bit Vector = 1'b0
) (
    input wire logic               clk_i,
    input wire logic               rst_ni,
    input wire logic               load_valid_i,
    input wire rdx_pkg::row_word_t load_i,
    input wire logic               full_q,
    input wire logic               start,
    input wire logic               step,
    input wire logic               walk_idle,
    input wire logic               hidden_o,
    input wire logic               ray_valid_o,
    input wire logic               ray_ready_i,
    input wire rdx_pkg::ray_t      ray_o,
    input wire logic               quartic_o,
    input wire logic               vector_o
);
  import rdx_pkg::*;

  logic started_q, ray_q;
  always_ff @(posedge clk_i) begin
    started_q <= start;
    ray_q <= ray_valid_o && ray_ready_i;
  end
  wire ray = ray_valid_o && ray_ready_i;
  wire algebraic = ray && !vector_o;

  for (genvar i = 0; i < 3; i++) begin : gen_header
    `RDX_COVER_RUN(word_while_walking, load_valid_i && load_i.kind == RowHeader && 32'(load_i.index) == i && step)
  end
  `RDX_COVER_RUN(lane_while_walking, load_valid_i && load_i.kind == RowLane && step)
  `RDX_COVER_RUN(lane_while_idle, load_valid_i && load_i.kind == RowLane && walk_idle)
  `RDX_COVER_RUN(last_is_mark, load_valid_i && load_i.last && load_i.kind == RowLane)
  `RDX_COVER_RUN(row_waits, full_q && !start && !walk_idle)
  `RDX_COVER_RUN(row_into_idle, full_q && walk_idle)
  `RDX_COVER_RUN(word_behind_start, load_valid_i && started_q)
  `RDX_COVER_RUN(rays_of_two_rows_behind_each_other, ray && ray_q && started_q)
  `RDX_COVER_RUN(stalled, ray_valid_o && !ray_ready_i)
  `RDX_COVER_RUN(hidden_while_loading, hidden_o && load_valid_i)
  for (genvar p = 0; p < 2; p++) begin : gen_rule
    `RDX_COVER_RUN(paper, ray && ray_o.paper == 1'(p))
  end
  for (genvar r = 1; r <= 4; r++) begin : gen_roots
    `RDX_COVER_RUN(wanted, ray && ray_o.roots == 3'(r))
  end
  if (D == 4) begin : gen_quartic
    `RDX_COVER_RUN(quartic, algebraic && quartic_o)
  end
  if (D > 0) begin : gen_quadric
    `RDX_COVER_RUN(quadric, algebraic && !quartic_o)
  end
  if (Vector) begin : gen_vector
    `RDX_COVER_RUN(vector, ray && vector_o)
    `RDX_COVER_RUN(constant, load_valid_i && load_i.kind == RowForm && !load_i.last)
    `RDX_COVER_RUN(last_is_constant, load_valid_i && load_i.kind == RowForm && load_i.last)
  end
endmodule

bind rdx_scan rdx_scan_cover #(
    .D(D),
    .Vector(Vector)
) u_cover (.*);

`default_nettype wire
