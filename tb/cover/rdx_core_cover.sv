// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_core.
`default_nettype none
`include "rdx_cover.svh"

module rdx_core_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       desc_valid_i,
    input wire logic       desc_ready_o,
    input wire logic       hit_valid_o,
    input wire logic       hit_ready_i,
    input wire logic       raster_valid,
    input wire logic       raster_ready,
    input wire logic       vector,
    input wire logic       vector_idle,
    input wire logic [1:0] hit_valid
);
  `RDX_COVER_RUN(both_offer, &hit_valid)
  `RDX_COVER_RUN(algebraic_while_vector_works, raster_valid && raster_ready && !vector && !vector_idle)
  `RDX_COVER_RUN(constants_wait, desc_valid_i && !desc_ready_o && !raster_valid)
  `RDX_COVER_RUN(hit_stalled, hit_valid_o && !hit_ready_i)
  for (genvar k = 0; k < 2; k++) begin : gen_kind
    `RDX_COVER_RUN(ray, raster_valid && raster_ready && vector == k)
    `RDX_COVER_RUN(ray_stalled, raster_valid && !raster_ready && vector == k)
    `RDX_COVER_RUN(hit_alone, hit_valid == 2'b01 << k)
  end
endmodule

bind rdx_core rdx_core_cover u_cover (.*);

`default_nettype wire
