// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_rings.
`default_nettype none
`include "rdx_cover.svh"

module rdx_rings_cover #(
    parameter int unsigned Rings = 1
) (
    input wire logic             clk_i,
    input wire logic             rst_ni,
    input wire logic             ray_valid_i,
    input wire logic [Rings-1:0] free,
    input wire logic [Rings-1:0] chosen,
    input wire logic [Rings-1:0] valid,
    input wire logic [Rings-1:0] ready
);
  for (genvar r = 0; r < Rings; r++) begin : gen_ring
    `RDX_COVER_RUN(takes, ray_valid_i && chosen[r])
    `RDX_COVER_RUN(gives, valid[r] && ready[r])
    `RDX_COVER_RUN(waits, valid[r] && !ready[r])
  end
  `RDX_COVER_RUN(all_full, ray_valid_i && free == '0)
  if (Rings > 1) begin : gen_several
    `RDX_COVER_RUN(several_give, !$onehot0(valid))
    `RDX_COVER_RUN(several_free, ray_valid_i && !$onehot0(free))
  end
endmodule

bind rdx_rings rdx_rings_cover #(.Rings(Rings)) u_cover (.*);

`default_nettype wire
