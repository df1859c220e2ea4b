// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_fdiff.
`default_nettype none
`include "rdx_cover.svh"

module rdx_fdiff_cover #(
    parameter int unsigned W = 64,
    parameter bit Quadratic = 1'b1
) (
    input wire logic                clk_i,
    input wire logic                load_i,
    input wire logic        [  2:0] index_i,
    input wire logic                pixel_i,
    input wire logic                row_i,
    input wire logic signed [W-1:0] value_q,
    input wire logic signed [W-1:0] slope_q
);
  for (genvar i = 0; i < (Quadratic ? 6 : 3); i++) begin : gen_word
    `RDX_COVER(loaded, load_i && 32'(index_i) == i)
  end
  wire signed [W:0] sum = value_q + slope_q;
  `RDX_COVER(pixel, pixel_i && !row_i)
  `RDX_COVER(row, pixel_i && row_i)
  `RDX_COVER(waits, !load_i && !pixel_i && !row_i)
  `RDX_COVER(rises_above_zero, pixel_i && value_q < 0 && sum >= 0)
  `RDX_COVER(falls_below_zero, pixel_i && value_q >= 0 && sum < 0)
endmodule

bind rdx_fdiff rdx_fdiff_cover #(
    .W(W),
    .Quadratic(Quadratic)
) u_cover (.*);

`default_nettype wire
