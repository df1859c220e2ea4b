// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_quadric.
`default_nettype none
`include "rdx_cover.svh"

module rdx_quadric_cover (
    input wire logic                    clk_i,
    input wire logic signed      [22:0] value_q,
    input wire rdx_pkg::normal_t        value_o
);
  import rdx_pkg::*;
  localparam normal_t Most = {1'b0, {(NormalWidth - 1) {1'b1}}};
  `RDX_COVER(above, $signed(value_q[22:2]) > 21'(Most))
  `RDX_COVER(below, $signed(value_q[22:2]) < 21'(~Most))
  `RDX_COVER(inside_surface, value_o < 0)
  `RDX_COVER(outside_surface, value_o > 0)
  `RDX_COVER(on_surface, value_o == 0)
endmodule

bind rdx_quadric rdx_quadric_cover u_cover (.*);

`default_nettype wire
