// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_tube.
`default_nettype none
`include "rdx_cover.svh"

module rdx_tube_cover (
    input wire logic             clk_i,
    input wire logic             en_i,
    input wire logic             none_i,
    input wire rdx_pkg::vector_t u_q,
    input wire rdx_pkg::vector_t v_q,
    input wire rdx_pkg::vector_t distance_o
);
  for (genvar q = 0; q < 4; q++) begin : gen_quadrant
    `RDX_COVER(seen_from_centre, {u_q < 0, v_q < 0} == 2'(q))
  end
  `RDX_COVER(none, none_i)
  `RDX_COVER(farthest, distance_o == {1'b0, {(rdx_pkg::VectorWidth - 1) {1'b1}}})
  `RDX_COVER(inside_tube, distance_o < 0)
  `RDX_COVER(outside_tube, distance_o > 0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_tube rdx_tube_cover u_cover (.*);

`default_nettype wire
