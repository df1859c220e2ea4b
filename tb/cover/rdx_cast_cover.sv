// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_cast.
`default_nettype none
`include "rdx_cover.svh"

module rdx_cast_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       ray_valid,
    input wire logic [1:0] ready,
    input wire logic       quartic,
    input wire logic       vector,
    input wire logic       vector_idle_o,
    input wire logic [1:0] hit_valid,
    input wire logic       hit_valid_o,
    input wire logic       hit_ready_i,
    input wire logic [2:0] skipped_o
);
  `RDX_COVER_RUN(both_offer, &hit_valid)
  `RDX_COVER_RUN(algebraic_while_vector_works, ray_valid && ready[0] && !vector && !vector_idle_o)
  `RDX_COVER_RUN(hit_stalled, hit_valid_o && !hit_ready_i)
  `RDX_COVER_RUN(quartic_ray, ray_valid && ready[0] && !vector && quartic)
  `RDX_COVER_RUN(quadric_ray, ray_valid && ready[0] && !vector && !quartic)
  for (genvar k = 0; k < 2; k++) begin : gen_kind
    `RDX_COVER_RUN(ray, ray_valid && ready[k] && vector == 1'(k))
    `RDX_COVER_RUN(ray_stalled, ray_valid && !ready[k] && vector == 1'(k))
    `RDX_COVER_RUN(hit_alone, hit_valid == 2'b01 << k)
  end
  for (genvar r = 0; r < 3; r++) begin : gen_reason
    `RDX_COVER_RUN(skipped, skipped_o[r])
  end
  `RDX_COVER_RUN(skipped_at_once, skipped_o[0] && |skipped_o[2:1])
endmodule

bind rdx_cast rdx_cast_cover u_cover (.*);

`default_nettype wire
