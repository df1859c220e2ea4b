// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_walk.
`default_nettype none
`include "rdx_cover.svh"

module rdx_walk_cover (
    input wire logic            clk_i,
    input wire logic            rst_ni,
    input wire logic            next_i,
    input wire logic            limit_valid_i,
    input wire rdx_pkg::depth_t limit_i,
    input wire logic            ray_ready_i,
    input wire logic            start_o,
    input wire logic            step_o,
    input wire logic            ray_valid_o,
    input wire logic            hidden_o,
    input wire logic            taken_q,
    input wire logic            walk_q,
    input wire logic            answer_q,
    input wire logic            valid_q,
    input wire logic            hidden_q,
    input wire logic            en,
    input wire logic            begins,
    input wire logic            row_end,
    input wire logic            first_q,
    input wire rdx_pkg::depth_t answer_near_q,
    input wire rdx_pkg::pixel_t x_q,
    input wire rdx_pkg::pixel_t x1_q
);
  logic hidden_before_q, ray_before_q;
  always_ff @(posedge clk_i) begin
    hidden_before_q <= hidden_o;
    ray_before_q <= ray_valid_o && ray_ready_i;
  end
  wire last = walk_q && row_end && en;
  wire ask = en && answer_q && limit_valid_i;

  `RDX_COVER_RUN(row_into_empty, begins && !walk_q && !answer_q && !valid_q)
  `RDX_COVER_RUN(row_without_gap, begins && walk_q)
  `RDX_COVER_RUN(row_waits_for_last_pixel, next_i && !taken_q && walk_q && !row_end)
  `RDX_COVER_RUN(row_waits_for_start, next_i && taken_q && walk_q && row_end)
  `RDX_COVER_RUN(end_without_row, last && !begins)
  `RDX_COVER_RUN(one_pixel, last && first_q)
  `RDX_COVER_RUN(many_pixels, last && !first_q)
  `RDX_COVER_RUN(last_column, walk_q && &x1_q && row_end)
  `RDX_COVER_RUN(first_column, walk_q && first_q && x_q == '0)
  `RDX_COVER_RUN(start_stalled, answer_q && !en && !start_o)
  `RDX_COVER_RUN(row_end_stalled, walk_q && row_end && !en)
  `RDX_COVER_RUN(start_as_last_leaves, start_o && valid_q)
  `RDX_COVER_RUN(no_limit, en && answer_q && !limit_valid_i)
  `RDX_COVER_RUN(limit_nearer, ask && limit_i < answer_near_q)
  `RDX_COVER_RUN(limit_equal, ask && limit_i == answer_near_q)
  `RDX_COVER_RUN(limit_farther, ask && limit_i > answer_near_q)
  `RDX_COVER_RUN(hidden_while_not_ready, hidden_o && !ray_ready_i)
  `RDX_COVER_RUN(hidden_behind_ray, ray_before_q && hidden_o)
  `RDX_COVER_RUN(ray_behind_hidden, hidden_before_q && ray_valid_o)
  `RDX_COVER_RUN(hidden_first, hidden_q && valid_q && start_o)
  `RDX_COVER_RUN(step_each_clock, ray_before_q && ray_valid_o && step_o)
endmodule

bind rdx_walk rdx_walk_cover u_cover (.*);

`default_nettype wire
