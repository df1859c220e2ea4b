// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_feed.
`default_nettype none
`include "rdx_cover.svh"

module rdx_feed_cover #(
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Slots  = 64
) (
    input wire logic               clk_i,
    input wire logic               rst_ni,
    input wire rdx_pkg::error_e    error_o,
    input wire rdx_pkg::surface_t  error_slot_o,
    input wire logic               full_i,
    input wire logic               idle_i,
    input wire logic               load_valid_o,
    input wire rdx_pkg::row_word_t load_o,
    input wire rdx_pkg::pixel_t    y_o,
    input wire rdx_pkg::row_info_t info,
    input wire logic               add_o,
    input wire logic               line_end_o,
    input wire logic               audit,
    input wire logic               words
);
  import rdx_pkg::*;

  `RDX_COVER_RUN(audited, audit)
  `RDX_COVER_RUN(error_of_first, error_o != ErrorNone && error_slot_o == '0)
  `RDX_COVER_RUN(row_from_table, add_o && y_o == info.y0)
  `RDX_COVER_RUN(row_moved_on, add_o && y_o != info.y0)
  `RDX_COVER_RUN(row_of_one_pixel, add_o && info.width == '0)
  `RDX_COVER_RUN(words_while_walking, load_valid_o && !idle_i)
  `RDX_COVER_RUN(last_word_of_row, load_valid_o && load_o.last)
  `RDX_COVER_RUN(line_ends_with_words_under_way, line_end_o && words)
  `RDX_COVER_RUN(line_ends_with_row_waiting, line_end_o && full_i)
  if (Vecsum != VecsumNone) begin : gen_vector
    `RDX_COVER_RUN(constants, load_valid_o && load_o.kind == RowForm)
    `RDX_COVER_RUN(row_with_constants_there, add_o && info.vector && y_o != info.y0)
  end
  if (Slots > 1) begin : gen_several
    `RDX_COVER_RUN(error_of_another, error_o != ErrorNone && error_slot_o != '0)
  end
endmodule

bind rdx_feed rdx_feed_cover #(
    .Vecsum(Vecsum),
    .Slots (Slots)
) u_cover (.*);

`default_nettype wire
