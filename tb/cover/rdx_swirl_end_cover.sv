// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_swirl_end.
`default_nettype none
`include "rdx_cover.svh"

module rdx_swirl_end_cover (
    input wire logic        clk_i,
    input wire logic [11:0] stop_q,
    input wire logic [11:0] small_q,
    input wire logic        far_qq,
    input wire logic        ball_o
);
  for (genvar stop = 0; stop < 2; stop++) begin : gen_end
    `RDX_COVER(few_turns, stop_q[9] == 1'(stop) && small_q[9])
    `RDX_COVER(half_a_turn_and_more, stop_q[9] == 1'(stop) && !small_q[9])
  end
  `RDX_COVER(ball, ball_o)
  `RDX_COVER(tube, !ball_o && !far_qq)
  `RDX_COVER(too_far, far_qq)
endmodule

bind rdx_swirl_end rdx_swirl_end_cover u_cover (.*);

`default_nettype wire
