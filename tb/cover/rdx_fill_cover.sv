// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_fill.
`default_nettype none
`include "rdx_cover.svh"

module rdx_fill_cover (
    input wire logic       clk_i,
    input wire logic       zero,   // no bit is used even after all shifts
    input wire logic [5:1] skip
);
  for (genvar s = 1; s <= 5; s++) begin : gen_stage
    `RDX_COVER(shifted, skip[s])
    `RDX_COVER(kept, !skip[s])
  end
  `RDX_COVER(nothing, zero)
endmodule

bind rdx_fill rdx_fill_cover u_cover (
    .clk_i,
    .zero(gen_stage[5].used_q == '0),
    .skip({
      gen_stage[5].gen_shift.skip,
      gen_stage[4].gen_shift.skip,
      gen_stage[3].gen_shift.skip,
      gen_stage[2].gen_shift.skip,
      gen_stage[1].gen_shift.skip
    })
);

`default_nettype wire
