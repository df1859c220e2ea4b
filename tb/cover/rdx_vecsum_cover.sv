// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_vecsum.
`default_nettype none
`include "rdx_cover.svh"

module rdx_vecsum_cover #(
    parameter bit General = 1'b0,
    parameter int unsigned V = rdx_pkg::VectorWidth,
    localparam int unsigned Parts = General ? 2 : 1
) (
    input wire logic                     clk_i,
    input wire logic                     en_i,
    input wire logic                     none,
    input wire logic signed      [V-1:0] distance[2*Parts],
    input wire logic signed      [V-1:0] nearer_q[      2],
    input wire logic signed      [V-1:0] size_q,
    input wire logic signed      [V-1:0] axis_q  [      3],
    input wire logic signed      [V-1:0] below_q,
    input wire logic signed      [V-1:0] guard_q,
    input wire logic signed      [V-1:0] least_q,
    input wire rdx_pkg::vector_t         value_o
);
  for (genvar i = 0; i < Parts; i++) begin : gen_part
    `RDX_COVER(tube_nearer, distance[2*i] < distance[2*i+1])
    `RDX_COVER(ball_nearer, distance[2*i] > distance[2*i+1])
  end
  if (General) begin : gen_general
    `RDX_COVER(first_part, nearer_q[0] < nearer_q[1])
    `RDX_COVER(second_part, nearer_q[1] < nearer_q[0])
    `RDX_COVER(no_turn, none)
  end
  `RDX_COVER(not_limited, size_q < (axis_q[2] >>> 1))
  `RDX_COVER(limited_by_axis, size_q > (axis_q[2] >>> 1))
  `RDX_COVER(raised_by_guard, below_q < guard_q)
  `RDX_COVER(guard_below, below_q > guard_q)
  `RDX_COVER(inside_solid, least_q < 0)
  `RDX_COVER(outside_solid, least_q > 0)
  `RDX_COVER(inside_value, value_o < 0)
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_vecsum rdx_vecsum_cover #(
    .General(General),
    .V(V)
) u_cover (.*);

`default_nettype wire
