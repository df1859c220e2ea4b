// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_vector.
`default_nettype none
`include "rdx_cover.svh"

module rdx_vector_cover (
    input wire logic        clk_i,
    input wire logic        rst_ni,
    input wire logic        ray_valid_i,
    input wire logic        ray_ready_o,
    input wire logic        ray_valid,
    input wire logic        ray_ready,
    input wire logic        hit_valid_o,
    input wire logic        hit_ready_i,
    input wire logic [15:0] rays_q,
    input wire logic        entered,
    input wire logic        left,
    input wire logic        idle_o
);
  `RDX_COVER_RUN(ring_has_no_room, ray_valid && !ray_ready)
  `RDX_COVER_RUN(stall_reaches_input, ray_valid_i && !ray_ready_o)
  `RDX_COVER_RUN(hit_stalled, hit_valid_o && !hit_ready_i)
  `RDX_COVER_RUN(enters_only, entered && !left)
  `RDX_COVER_RUN(leaves_only, left && !entered)
  `RDX_COVER_RUN(enters_and_leaves, entered && left)
  `RDX_COVER_RUN(last_ray_leaves, left && rays_q == 1 && !entered)
  `RDX_COVER_RUN(idle, idle_o)
  `RDX_COVER_RUN(record_not_the_last, hit_valid_o && hit_ready_i && !left)
endmodule

bind rdx_vector rdx_vector_cover u_cover (.*);

`default_nettype wire
