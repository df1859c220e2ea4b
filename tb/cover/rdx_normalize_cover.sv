// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_normalize.
`default_nettype none
`include "rdx_cover.svh"

module rdx_normalize_cover #(
    parameter  int unsigned WIn   = 36,
    parameter  int unsigned Limit = 7,
    localparam int unsigned Bits  = $clog2(Limit + 1)
) (
    input wire logic            clk_i,
    input wire logic            en_i,
    input wire logic [ WIn-2:0] used,
    input wire logic [Bits-1:0] shift_d
);
  for (genvar s = 0; s <= Limit; s++) begin : gen_shift
    `RDX_COVER(amount, en_i && 32'(shift_d) == s)
  end
  `RDX_COVER(limit_reached, en_i && used != '0 && used >> (WIn - 2 - Limit) == '0)
  `RDX_COVER(all_zero_or_minus_one, en_i && used == '0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_normalize rdx_normalize_cover #(
    .WIn  (WIn),
    .Limit(Limit)
) u_cover (.*);

`default_nettype wire
