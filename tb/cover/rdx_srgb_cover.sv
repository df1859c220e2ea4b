// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_srgb.
`default_nettype none
`include "rdx_cover.svh"

module rdx_srgb_cover (
    input wire logic           clk_i,
    input wire rdx_pkg::unit_t linear_i
);
  import rdx_pkg::*;
  `RDX_COVER(black, linear_i == '0)
  `RDX_COVER(white, linear_i == One)
  `RDX_COVER(between, linear_i != '0 && linear_i != One)
endmodule

bind rdx_srgb rdx_srgb_cover u_cover (.*);

`default_nettype wire
