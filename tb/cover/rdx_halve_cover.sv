// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_halve.
`default_nettype none
`include "rdx_cover.svh"

module rdx_halve_cover #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4
) (
    input wire logic                clk_i,
    input wire logic signed [W-1:0] b_i  [D+1]
);
  localparam logic signed [W-1:0] Least = {1'b1, {(W - 1) {1'b0}}};
  localparam logic signed [W-1:0] Largest = ~Least;
  for (genvar i = 0; i < D; i++) begin : gen_pair
    `RDX_COVER(rounded_up, b_i[i][0] != b_i[i+1][0])
    `RDX_COVER(exact, b_i[i][0] == b_i[i+1][0])
    `RDX_COVER(rounded_up_to_zero, b_i[i] + b_i[i+1] == '1)
    `RDX_COVER(both_least, b_i[i] == Least && b_i[i+1] == Least)
    `RDX_COVER(both_largest, b_i[i] == Largest && b_i[i+1] == Largest)
    `RDX_COVER(least_and_largest, b_i[i] == Least && b_i[i+1] == Largest)
    `RDX_COVER(largest_and_least, b_i[i] == Largest && b_i[i+1] == Least)
  end
endmodule

bind rdx_halve rdx_halve_cover #(
    .W(W),
    .D(D)
) u_cover (.*);

`default_nettype wire
