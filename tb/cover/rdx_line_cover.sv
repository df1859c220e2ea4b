// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_line.
`default_nettype none
`include "rdx_cover.svh"

module rdx_line_cover #(
    parameter int unsigned Depth = 16
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic en_i,
    input wire logic [$clog2(Depth)-1:0] read_q
);
  `RDX_COVER_RUN(wraps, en_i && 32'(read_q) == Depth - 1)
  `RDX_COVER_RUN(stalled_at_wrap, !en_i && 32'(read_q) == Depth - 1)
  `RDX_COVER_RUN(stalled, !en_i)
endmodule

bind rdx_line rdx_line_cover #(.Depth(Depth)) u_cover (.*);

`default_nettype wire
