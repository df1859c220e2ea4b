// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_product.
`default_nettype none
`include "rdx_cover.svh"

module rdx_product_cover #(
    parameter int unsigned Latency = 6
) (
    input wire logic               clk_i,
    input wire logic               rst_ni,
    input wire logic               ray_valid_i,
    input wire logic               ray_ready_i,
    input wire logic               quartic_i,
    input wire logic [Latency-1:0] valid_q,
    input wire logic [        5:0] shift
);
  wire last = valid_q[Latency-1];
  `RDX_COVER_RUN(empty, valid_q == '0 && !ray_valid_i)
  `RDX_COVER_RUN(full, &valid_q && ray_valid_i && ray_ready_i)
  `RDX_COVER_RUN(full_and_stalled, &valid_q && ray_valid_i && !ray_ready_i)
  `RDX_COVER_RUN(bubble_moves_on, !last && valid_q != '0 && !ray_ready_i)
  `RDX_COVER_RUN(quartic, ray_valid_i && quartic_i)
  `RDX_COVER_RUN(quadric, ray_valid_i && !quartic_i)
  `RDX_COVER_RUN(no_shift, valid_q[Latency-2] && shift == 0)
  `RDX_COVER_RUN(middle_shift, valid_q[Latency-2] && shift == 31)
  `RDX_COVER_RUN(largest_shift, valid_q[Latency-2] && shift == 63)
endmodule

bind rdx_product rdx_product_cover #(
    .Latency(Latency)
) u_cover (
    .shift(u_normalize.shift_q),
    .*
);

`default_nettype wire
