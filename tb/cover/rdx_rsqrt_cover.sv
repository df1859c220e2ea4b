// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_rsqrt.
`default_nettype none
`include "rdx_cover.svh"

module rdx_rsqrt_cover (
    input wire logic        clk_i,
    input wire logic [35:0] square_i,
    input wire logic        doubled
);
  `RDX_COVER(nothing, square_i == '0)
  `RDX_COVER(least, square_i == 36'd1 << 32)
  `RDX_COVER(most, square_i == 36'd3 << 34)  // of a normal that fills 18 bits
  `RDX_COVER(below_a_quarter, doubled)
  `RDX_COVER(from_a_quarter_on, !doubled)
endmodule

bind rdx_rsqrt rdx_rsqrt_cover u_cover (.*);

`default_nettype wire
