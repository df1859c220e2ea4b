// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_lane.
`default_nettype none
`include "rdx_cover.svh"

module rdx_lane_cover #(
    parameter int unsigned W = 64,
    parameter bit Quadratic = 1'b1
) (
    input wire logic                clk_i,
    input wire logic                load_i,
    input wire logic        [  1:0] index_i,
    input wire logic                start_i,
    input wire logic                step_i,
    input wire logic signed [W-1:0] value_q,
    input wire logic signed [W-1:0] slope_q
);
  logic started_q;
  always_ff @(posedge clk_i) started_q <= start_i;

  for (genvar i = 0; i < (Quadratic ? 3 : 2); i++) begin : gen_word
    `RDX_COVER(loaded, load_i && 32'(index_i) == i && !step_i)
    `RDX_COVER(loaded_while_walking, load_i && 32'(index_i) == i && step_i)
  end
  wire signed [W:0] sum = value_q + slope_q;
  `RDX_COVER(start, start_i && !step_i)
  `RDX_COVER(start_before_step, start_i && step_i)
  `RDX_COVER(step_after_start, started_q && step_i)
  `RDX_COVER(waits, !load_i && !start_i && !step_i)
  `RDX_COVER(rises_above_zero, step_i && value_q < 0 && sum >= 0)
  `RDX_COVER(falls_below_zero, step_i && value_q >= 0 && sum < 0)
endmodule

bind rdx_lane rdx_lane_cover #(
    .W(W),
    .Quadratic(Quadratic)
) u_cover (.*);

`default_nettype wire
