// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_swirl_part.
`default_nettype none
`include "rdx_cover.svh"

module rdx_swirl_part_cover (
    input wire logic             clk_i,
    input wire rdx_pkg::normal_t part_o
);
  import rdx_pkg::*;
  localparam normal_t Most = {1'b0, {(NormalWidth - 1) {1'b1}}};
  `RDX_COVER(above, part_o == Most)
  `RDX_COVER(below, part_o == ~Most)
  `RDX_COVER(positive, part_o > 0 && part_o < Most)
  `RDX_COVER(negative, part_o < 0 && part_o > ~Most)
  `RDX_COVER(none, part_o == 0)
endmodule

bind rdx_swirl_part rdx_swirl_part_cover u_cover (.*);

`default_nettype wire
