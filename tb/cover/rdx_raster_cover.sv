// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_raster.
`default_nettype none
`include "rdx_cover.svh"

module rdx_raster_cover #(
    parameter int unsigned D = 4,
    parameter bit Vector = 1'b0
) (
    input wire logic                  clk_i,
    input wire logic                  rst_ni,
    input wire logic                  desc_valid_i,
    input wire logic                  desc_ready_o,
    input wire logic                  ray_ready_i,
    input wire logic                  vector_idle_i,
    input wire logic            [2:0] state_q,
    input wire logic                  quartic_q,
    input wire logic                  vector_q,
    input wire logic                  paper_q,
    input wire rdx_pkg::roots_t       roots_q,
    input wire rdx_pkg::pixel_t       x0_q,
    input wire rdx_pkg::pixel_t       x1_q,
    input wire rdx_pkg::pixel_t       y1_q,
    input wire rdx_pkg::pixel_t       x_q,
    input wire rdx_pkg::pixel_t       y_q,
    input wire logic                  row_end,
    input wire logic                  step,
    input wire logic                  load
);
  localparam logic [2:0] Form = 3'd4;
  localparam logic [2:0] Walk = 3'd5;
  wire last = row_end && y_q == y1_q;
  logic walked_q, taken_q;  // the clock before
  logic [1:0] pixels_q;  // of this surface: 0, 1, more
  always_ff @(posedge clk_i) begin
    walked_q <= state_q == Walk;
    taken_q  <= step;
    if (state_q != Walk) pixels_q <= '0;
    else if (step && !pixels_q[1]) pixels_q <= pixels_q + 1'b1;
  end

  for (genvar s = 0; s < 5; s++) begin : gen_state
    if (s != 4 || Vector) begin : gen_built
      `RDX_COVER_RUN(word, state_q == 3'(s) && load)
      `RDX_COVER_RUN(no_word, state_q == 3'(s) && !desc_valid_i)
    end
  end
  `RDX_COVER_RUN(word_waits_for_walk, state_q == Walk && desc_valid_i)
  `RDX_COVER_RUN(next_surface_at_once, walked_q && state_q == 0 && load)
  `RDX_COVER_RUN(pixel, step && !row_end)
  `RDX_COVER_RUN(end_of_row, step && row_end && !last && x0_q != x1_q)
  `RDX_COVER_RUN(end_of_rectangle, step && last && x0_q != x1_q)
  `RDX_COVER_RUN(one_pixel, step && last && pixels_q == 0)
  `RDX_COVER_RUN(one_column, step && row_end && !last && x0_q == x1_q)
  `RDX_COVER_RUN(one_row, step && last && pixels_q[1] && x0_q != x1_q)
  `RDX_COVER_RUN(row_end_stalled, state_q == Walk && !ray_ready_i && row_end && !last)
  `RDX_COVER_RUN(last_pixel_stalled, state_q == Walk && !ray_ready_i && last)
  `RDX_COVER_RUN(ray_each_clock, taken_q && step)
  `RDX_COVER_RUN(last_column, step && &x_q)
  `RDX_COVER_RUN(last_row, step && &y_q)
  for (genvar r = 1; r <= 4; r++) begin : gen_roots
    `RDX_COVER_RUN(wanted, step && roots_q == 3'(r))
  end
  for (genvar p = 0; p < 2; p++) begin : gen_rule
    `RDX_COVER_RUN(paper, step && paper_q == p)
  end
  if (D == 4) begin : gen_quartic
    `RDX_COVER_RUN(quartic, step && quartic_q)
  end
  if (D > 0) begin : gen_quadric
    `RDX_COVER_RUN(quadric, step && !quartic_q && !vector_q)
  end
  if (Vector) begin : gen_vector
    `RDX_COVER_RUN(vector, step && vector_q)
    `RDX_COVER_RUN(constants_wait, state_q == Form && desc_valid_i && !desc_ready_o)
    `RDX_COVER_RUN(constants_at_once, state_q == Form && load)
    `RDX_COVER_RUN(lanes_do_not_wait, state_q < Form && load && !vector_idle_i)
  end
endmodule

bind rdx_raster rdx_raster_cover #(
    .D(D),
    .Vector(Vector)
) u_cover (.*);

`default_nettype wire
