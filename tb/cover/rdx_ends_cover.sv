// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_ends.
`default_nettype none
`include "rdx_cover.svh"

module rdx_ends_cover #(
    parameter int unsigned Lanes   = 2,
    parameter int unsigned Latency = 64
) (
    input wire logic               clk_i,
    input wire logic               rst_ni,
    input wire logic               ray_valid_i,
    input wire logic               ray_ready_i,
    input wire logic [Latency-1:0] valid_q,
    input wire logic               phase_q,
    input wire logic               en
);
  `RDX_COVER_RUN(empty, valid_q == '0 && !ray_valid_i)
  `RDX_COVER_RUN(stalled, ray_valid_i && !en)
  `RDX_COVER_RUN(bubble_moves_on, !valid_q[Latency-1] && valid_q != '0 && !ray_ready_i)
  if (Lanes == 1) begin : gen_one
    `RDX_COVER_RUN(wrong_phase, ray_valid_i && phase_q && en)
    `RDX_COVER_RUN(stalled_in_second_phase, phase_q && !en)
    `RDX_COVER_RUN(every_second_clock, valid_q[2] && valid_q[0] && !valid_q[1] && ray_valid_i)
  end else begin : gen_two
    `RDX_COVER_RUN(each_clock, &valid_q[1:0] && ray_valid_i && en)
    `RDX_COVER_RUN(full, &valid_q && !ray_ready_i)
  end
endmodule

bind rdx_ends rdx_ends_cover #(
    .Lanes  (Lanes),
    .Latency(Latency)
) u_cover (.*);

`default_nettype wire
