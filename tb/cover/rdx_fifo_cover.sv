// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_fifo.
`default_nettype none
`include "rdx_cover.svh"

module rdx_fifo_cover #(
    parameter  int unsigned Depth = 16,
    localparam int unsigned Bits  = $clog2(Depth)
) (
    input wire logic          clk_i,
    input wire logic          rst_ni,
    input wire logic          valid_i,
    input wire logic          ready_o,
    input wire logic          valid_o,
    input wire logic          ready_i,
    input wire logic [Bits:0] write_place_q,
    input wire logic [Bits:0] read_place_q,
    input wire logic          next_valid,
    input wire logic          filled,
    input wire logic          store,
    input wire logic          fetch
);
  `RDX_COVER_RUN(full, !ready_o && valid_i)
  `RDX_COVER_RUN(full_and_one_leaves, !ready_o && valid_o && ready_i)
  `RDX_COVER_RUN(empty, !filled && !next_valid && !valid_o)
  `RDX_COVER_RUN(last_leaves, !filled && !next_valid && valid_o && ready_i)
  `RDX_COVER_RUN(store_and_fetch, store && fetch)
  `RDX_COVER_RUN(head_waits, valid_o && !ready_i && next_valid && filled)
  if (Depth > 16) begin : gen_block
    `RDX_COVER_RUN(fetch_into_empty, fetch && !next_valid)
  end
  `RDX_COVER_RUN(bubble_at_head, next_valid && !valid_o)
  `RDX_COVER_RUN(write_wraps, store && &write_place_q[Bits-1:0])
  `RDX_COVER_RUN(read_wraps, fetch && &read_place_q[Bits-1:0])
endmodule

bind rdx_fifo rdx_fifo_cover #(.Depth(Depth)) u_cover (.*);

`default_nettype wire
