// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_advance.
`default_nettype none
`include "rdx_cover.svh"

module rdx_advance_cover (
    input wire logic               clk_i,
    input wire logic               rst_ni,
    input wire logic               ask_valid_i,
    input wire rdx_pkg::row_word_t ask_i,
    input wire logic               first_i,
    input wire logic               kept,
    input wire logic               quadratic,
    input wire logic               write_q,
    input wire logic               load_valid_o,
    input wire rdx_pkg::row_word_t load_o
);
  import rdx_pkg::*;

  for (genvar k = 0; k < 3; k++) begin : gen_kind
    `RDX_COVER_RUN(asked, ask_valid_i && ask_i.kind == row_kind_e'(k))
    `RDX_COVER_RUN(last, load_valid_o && load_o.kind == row_kind_e'(k) && (load_o.last || k == RowHeader))
  end
  wire lane = ask_valid_i && ask_i.kind == RowLane;
  for (genvar i = 0; i < 6; i++) begin : gen_index
    `RDX_COVER_RUN(first_row, lane && quadratic && 32'(ask_i.index) == i && first_i)
    `RDX_COVER_RUN(next_row, lane && quadratic && 32'(ask_i.index) == i && !first_i)
  end
  for (genvar i = 0; i < 3; i++) begin : gen_linear
    `RDX_COVER_RUN(first_row, lane && !quadratic && 32'(ask_i.index) == i && first_i)
    `RDX_COVER_RUN(next_row, lane && !quadratic && 32'(ask_i.index) == i && !first_i)
  end
  `RDX_COVER_RUN(write_and_read, write_q && lane && kept)
  `RDX_COVER_RUN(mark_only, load_valid_o && load_o.kind == RowLane && load_o.index == 7'd3)
  `RDX_COVER_RUN(last_word_of_lane_left_out, !load_valid_o && write_q)
endmodule

bind rdx_advance rdx_advance_cover u_cover (.*);

`default_nettype wire
