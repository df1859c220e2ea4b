// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_algebraic.
`default_nettype none
`include "rdx_cover.svh"

module rdx_algebraic_cover (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic ray_valid_i,
    input wire logic ray_ready_o,
    input wire logic ray_valid,
    input wire logic ray_ready,
    input wire logic hit_valid_o,
    input wire logic hit_ready_i
);
  `RDX_COVER_RUN(ring_has_no_room, ray_valid && !ray_ready)
  `RDX_COVER_RUN(stall_reaches_input, ray_valid_i && !ray_ready_o)
  `RDX_COVER_RUN(ring_waits, !ray_valid && ray_ready)
  `RDX_COVER_RUN(hit_stalled, hit_valid_o && !hit_ready_i)
endmodule

bind rdx_algebraic rdx_algebraic_cover u_cover (.*);

`default_nettype wire
