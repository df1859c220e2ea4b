// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_scale.
`default_nettype none
`include "rdx_cover.svh"

module rdx_scale_cover #(
    parameter int unsigned W = 36,
    parameter int unsigned Count = 5,
    parameter int unsigned Bits = 3
) (
    input wire logic                clk_i,
    input wire logic signed [W-1:0] values_i[Count]
);
  logic [W-1:0] used;  // bits in which a value differs from its sign
  always_comb begin
    used = '0;
    for (int unsigned i = 0; i < Count; i++) used |= values_i[i] ^ {W{values_i[i][W-1]}};
  end
  for (genvar s = 0; s < 1 << Bits; s++) begin : gen_shift
    if (s < (1 << Bits) - 1) begin : gen_bounded
      `RDX_COVER(amount, used >> (W - 2 - s) == W'(1))
    end else begin : gen_most
      `RDX_COVER(amount, used >> (W - 1 - s) == '0)
    end
  end
  `RDX_COVER(zero, used == '0)
endmodule

bind rdx_scale rdx_scale_cover #(
    .W(W),
    .Count(Count),
    .Bits(Bits)
) u_cover (.*);

`default_nettype wire
