// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_blend.
`default_nettype none
`include "rdx_cover.svh"

module rdx_blend_cover #(
    parameter int unsigned Layers = 4
) (
    input wire logic           clk_i,
    input wire logic           rst_ni,
    input wire logic           valid_i,
    input wire logic           first_i,
    input wire logic           last_i,
    input wire rdx_pkg::unit_t opacity_i,
    input wire rdx_pkg::unit_t through_q,
    input wire logic           valid_o
);
  import rdx_pkg::*;
  `RDX_COVER_RUN(alone, valid_i && first_i && last_i)
  `RDX_COVER_RUN(transparent, valid_i && opacity_i == '0)
  `RDX_COVER_RUN(opaque, valid_i && opacity_i == One)
  `RDX_COVER_RUN(between, valid_i && opacity_i != '0 && opacity_i != One)
  `RDX_COVER_RUN(gap, !valid_i)
  `RDX_COVER_RUN(nothing_behind, through_q == '0)
  `RDX_COVER_RUN(pixel, valid_o)
  if (Layers > 1) begin : gen_many
    `RDX_COVER_RUN(first_of_many, valid_i && first_i && !last_i)
    `RDX_COVER_RUN(middle, valid_i && !first_i && !last_i)
    `RDX_COVER_RUN(last_of_many, valid_i && !first_i && last_i)
  end
endmodule

bind rdx_blend rdx_blend_cover #(.Layers(Layers)) u_cover (.*);

`default_nettype wire
