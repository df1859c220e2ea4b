// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_product.
`default_nettype none
`include "rdx_cover.svh"

module rdx_product_cover #(
    parameter int unsigned Latency = 11,
    parameter int unsigned Places  = 16
) (
    input wire logic                    clk_i,
    input wire logic                    rst_ni,
    input wire logic                    ray_valid_i,
    input wire logic                    ray_ready_o,
    input wire logic                    ray_valid_o,
    input wire logic                    ray_ready_i,
    input wire logic                    quartic_i,
    input wire logic [     Latency-1:0] valid_q,
    input wire logic [$clog2(Places):0] count_q
);
  `RDX_COVER_RUN(empty, count_q == '0 && !ray_valid_i)
  `RDX_COVER_RUN(full, 32'(count_q) == Places && ray_valid_i && ray_valid_o && !ray_ready_i)
  `RDX_COVER_RUN(full_and_given, 32'(count_q) == Places && ray_valid_o && ray_ready_i)
  `RDX_COVER_RUN(every_clock, (&valid_q) && ray_valid_i && ray_ready_o && ray_valid_o && ray_ready_i)
  `RDX_COVER_RUN(moves_on, valid_q != '0 && ray_valid_o && !ray_ready_i)
  `RDX_COVER_RUN(quartic, ray_valid_i && ray_ready_o && quartic_i)
  `RDX_COVER_RUN(quadric, ray_valid_i && ray_ready_o && !quartic_i)
endmodule

bind rdx_product rdx_product_cover #(
    .Latency(Latency),
    .Places (Places)
) u_cover (.*);

`default_nettype wire
