// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_swirl_turn.
`default_nettype none
`include "rdx_cover.svh"

module rdx_swirl_turn_cover #(
    parameter bit General = 1'b0
) (
    input wire logic               clk_i,
    input wire logic signed [19:0] number,
    input wire logic signed [19:0] last,
    input wire logic               none_o
);
  `RDX_COVER(before_first_turn, number < 0)
  `RDX_COVER(first_turn, number == 0)
  `RDX_COVER(between, number > 0 && number < last)
  `RDX_COVER(last_turn, number == last)
  `RDX_COVER(behind_last_turn, number > last)
  if (General) begin : gen_none
    `RDX_COVER(none, none_o)
  end
endmodule

bind rdx_swirl_turn rdx_swirl_turn_cover #(
    .General(General)
) u_cover (
    .clk_i,
    .number,
    .last(20'(last_q)),
    .none_o
);

`default_nettype wire
