// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_swirl_side.
`default_nettype none
`include "rdx_cover.svh"

module rdx_swirl_side_cover (
    input wire logic clk_i,
    input wire logic stop_o
);
  `RDX_COVER(start, !stop_o)
  `RDX_COVER(stop, stop_o)
endmodule

bind rdx_swirl_side rdx_swirl_side_cover u_cover (.*);

`default_nettype wire
