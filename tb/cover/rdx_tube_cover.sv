// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_tube.
`default_nettype none
`include "rdx_cover.svh"

module rdx_tube_cover #(
    parameter int unsigned V = rdx_pkg::VectorWidth
) (
    input wire logic                clk_i,
    input wire logic                en_i,
    input wire logic                none_i,
    input wire logic signed [V-1:0] u_q,
    input wire logic signed [V-1:0] v_q,
    input wire logic signed [V-1:0] distance_o
);
  for (genvar q = 0; q < 4; q++) begin : gen_quadrant
    `RDX_COVER(seen_from_centre, {u_q < 0, v_q < 0} == 2'(q))
  end
  `RDX_COVER(none, none_i)
  `RDX_COVER(farthest, distance_o == {1'b0, {(V - 1) {1'b1}}})
  `RDX_COVER(inside_tube, distance_o < 0)
  `RDX_COVER(outside_tube, distance_o > 0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_tube rdx_tube_cover #(.V(V)) u_cover (.*);

`default_nettype wire
