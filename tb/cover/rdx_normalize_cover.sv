// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_normalize.
`default_nettype none
`include "rdx_cover.svh"

module rdx_normalize_cover #(
    parameter int unsigned Limit = 7,
    parameter int unsigned Fine  = 3
) (
    input wire logic             clk_i,
    input wire logic             en_i,
    input wire logic [Limit-1:0] used_d,
    input wire logic [ Fine-1:0] shift_d
);
  for (genvar s = 0; s < 1 << Fine; s++) begin : gen_shift
    `RDX_COVER(amount, en_i && 32'(shift_d) == s)
  end
  `RDX_COVER(limit_reached, en_i && used_d == '0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_normalize rdx_normalize_cover #(
    .Limit(Limit),
    .Fine (Fine)
) u_cover (.*);

`default_nettype wire
