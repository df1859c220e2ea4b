// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_merge.
`default_nettype none
`include "rdx_cover.svh"

module rdx_merge_cover #(
    parameter  int unsigned Count = 2,
    localparam int unsigned Bits  = Count > 1 ? $clog2(Count) : 1
) (
    input wire logic             clk_i,
    input wire logic             rst_ni,
    input wire logic [Count-1:0] valid_i,
    input wire logic             ready_i,
    input wire logic [ Bits-1:0] turn_q,
    input wire logic [ Bits-1:0] chosen
);
  if (Count > 1) begin : gen_several
    for (genvar i = 0; i < Count; i++) begin : gen_stream
      `RDX_COVER_RUN(alone, valid_i == Count'(1) << i)
      `RDX_COVER_RUN(first_of_all, &valid_i && chosen == Bits'(i))
      `RDX_COVER_RUN(stalled, valid_i[i] && chosen == Bits'(i) && !ready_i)
      `RDX_COVER_RUN(out_of_turn, valid_i[i] && chosen == Bits'(i) && turn_q != Bits'(i))
    end
    `RDX_COVER_RUN(none, valid_i == '0)
  end
endmodule

bind rdx_merge rdx_merge_cover #(.Count(Count)) u_cover (.*);

`default_nettype wire
