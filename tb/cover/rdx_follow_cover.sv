// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_follow.
`default_nettype none
`include "rdx_cover.svh"

module rdx_follow_cover #(
    parameter int unsigned N1 = 3
) (
    input wire logic          clk_i,
    input wire logic [N1-1:0] pick_i
);
  for (genvar j = 0; j < (1 << N1); j++) begin : gen_cell
    `RDX_COVER(picked, 32'(pick_i) == j)
  end
endmodule

bind rdx_follow rdx_follow_cover #(.N1(N1)) u_cover (.*);

`default_nettype wire
