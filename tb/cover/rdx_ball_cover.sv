// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_ball.
`default_nettype none
`include "rdx_cover.svh"

module rdx_ball_cover #(
    parameter int unsigned V = rdx_pkg::VectorWidth
) (
    input wire logic                clk_i,
    input wire logic                en_i,
    input wire logic                stop_i,
    input wire logic signed [V-1:0] leg_q     [3],
    input wire logic signed [V-1:0] distance_o
);
  for (genvar o = 0; o < 8; o++) begin : gen_octant
    `RDX_COVER(seen_from_centre, {leg_q[2] < 0, leg_q[1] < 0, leg_q[0] < 0} == 3'(o))
  end
  for (genvar s = 0; s < 2; s++) begin : gen_end
    `RDX_COVER(of_end, stop_i == s)
  end
  `RDX_COVER(inside_ball, distance_o < 0)
  `RDX_COVER(outside_ball, distance_o > 0)
  `RDX_COVER(at_centre, leg_q[0] == 0 && leg_q[1] == 0 && leg_q[2] == 0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_ball rdx_ball_cover #(.V(V)) u_cover (.*);

`default_nettype wire
