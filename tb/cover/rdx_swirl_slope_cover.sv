// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_swirl_slope.
`default_nettype none
`include "rdx_cover.svh"

module rdx_swirl_slope_cover (
    input wire logic                  clk_i,
    input wire rdx_swirl_pkg::slope_t side_o
);
  import rdx_swirl_pkg::*;
  localparam slope_t Most = {1'b0, {($bits(slope_t) - 1) {1'b1}}};
  `RDX_COVER(above, side_o == Most)
  `RDX_COVER(below, side_o == ~Most)
  `RDX_COVER(positive, side_o > 0 && side_o < Most)
  `RDX_COVER(negative, side_o < 0 && side_o > ~Most)
  `RDX_COVER(none, side_o == 0)
endmodule

bind rdx_swirl_slope rdx_swirl_slope_cover u_cover (.*);

`default_nettype wire
