// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_light.
`default_nettype none
`include "rdx_cover.svh"

module rdx_light_cover (
    input wire logic               clk_i,
    input wire logic               turned_q,
    input wire logic               doubled,
    input wire logic        [35:0] square_q,
    input wire logic signed [19:0] cosine_q
);
  import rdx_pkg::*;
  `RDX_COVER(enters, !turned_q)
  `RDX_COVER(leaves, turned_q)
  `RDX_COVER(no_gradient, square_q == '0)
  `RDX_COVER(doubled_root, doubled)
  `RDX_COVER(plain_root, !doubled)
  `RDX_COVER(away_from_light, cosine_q[19])
  `RDX_COVER(above_one, !cosine_q[19] && cosine_q[18:1] > 18'(One))
  `RDX_COVER(slanted, !cosine_q[19] && cosine_q[18:1] < 18'(One) && cosine_q[18:1] != '0)
endmodule

bind rdx_light rdx_light_cover u_cover (.*);

`default_nettype wire
