// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_guess.
`default_nettype none
`include "rdx_cover.svh"

module rdx_guess_cover #(
    parameter  int unsigned W  = 36,
    parameter  int unsigned N1 = 3,
    localparam int unsigned J  = 1 << N1
) (
    input wire logic                 clk_i,
    input wire logic signed [ W-1:0] values_i    [J+1],
    input wire logic signed [ W-1:0] size_q      [J+1],
    input wire logic        [  N1:0] best,
    input wire logic        [ W-1:0] right_second,
    input wire logic        [ W-1:0] left_second,
    input wire logic        [N1-1:0] cell_o
);
  // how many boundaries have the least magnitude
  logic [W-1:0] least;
  logic [ N1:0] ties;
  always_comb begin
    least = '1;
    ties  = '0;
    for (int unsigned j = 0; j <= J; j++) if (unsigned'(size_q[j]) < least) least = size_q[j];
    for (int unsigned j = 0; j <= J; j++) if (size_q[j] == least) ties = ties + 1'b1;
  end
  wire inner = best != '0 && 32'(best) != J;

  for (genvar j = 0; j < J; j++) begin : gen_cell
    `RDX_COVER(guessed, 32'(cell_o) == j)
  end
  for (genvar j = 0; j <= J; j++) begin : gen_boundary
    `RDX_COVER(nearest, 32'(best) == j)
  end
  `RDX_COVER(one_least, ties == 1)
  `RDX_COVER(tie_of_two, ties == 2)
  `RDX_COVER(right_smaller, inner && right_second < left_second)
  `RDX_COVER(left_smaller, inner && right_second > left_second)
  `RDX_COVER(tie_of_seconds, inner && right_second == left_second)
  `RDX_COVER(least_number, values_i[0] == {1'b1, {(W - 1) {1'b0}}})
endmodule

bind rdx_guess rdx_guess_cover #(
    .W (W),
    .N1(N1)
) u_cover (.*);

`default_nettype wire
