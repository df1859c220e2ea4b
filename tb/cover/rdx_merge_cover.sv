// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_merge.
`default_nettype none
`include "rdx_cover.svh"

module rdx_merge_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic [1:0] valid_i,
    input wire logic       ready_i,
    input wire logic       held_q,
    input wire logic       turn_q,
    input wire logic       chosen
);
  for (genvar i = 0; i < 2; i++) begin : gen_stream
    `RDX_COVER_RUN(alone, valid_i == 2'b01 << i)
    `RDX_COVER_RUN(first_of_both, &valid_i && chosen == i)
    `RDX_COVER_RUN(stalled, valid_i[i] && chosen == i && !ready_i)
    `RDX_COVER_RUN(out_of_turn, valid_i[i] && chosen == i && turn_q != i)
  end
  `RDX_COVER_RUN(other_comes_while_held, held_q && &valid_i)
  `RDX_COVER_RUN(neither, valid_i == '0)
endmodule

bind rdx_merge rdx_merge_cover u_cover (.*);

`default_nettype wire
