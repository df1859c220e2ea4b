// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_lines.
`default_nettype none
`include "rdx_cover.svh"

module rdx_lines_cover #(
    parameter int unsigned Lines = 2,
    localparam type index_t = logic [$clog2(Lines)-1:0]
) (
    input wire logic                       clk_i,
    input wire logic                       rst_ni,
    input wire logic                       start_i,
    input wire rdx_pkg::line_t             row_i,
    input wire logic                       free_o,
    input wire logic                       add_i,
    input wire logic                       line_end_i,
    input wire logic           [      2:0] skipped_i,
    input wire logic                       last,
    input wire rdx_pkg::line_t             last_row,
    input wire logic           [Lines-1:0] zero,
    input wire logic           [Lines-1:0] emptied,
    input wire logic           [Lines-1:0] sent_q
);
  for (genvar r = 0; r < Lines; r++) begin : gen_row
    `RDX_COVER_RUN(sent_but_pixels_wait, sent_q[r] && !zero[r])
    `RDX_COVER_RUN(all_verdicts_before_the_end, !sent_q[r] && zero[r] && !(&zero))
    `RDX_COVER_RUN(emptied_while_other_is_sent, emptied[r] && index_t'(row_i) != index_t'(r) && (add_i || line_end_i))
    `RDX_COVER_RUN(emptied_and_wanted, emptied[r] && index_t'(row_i) == index_t'(r))
    `RDX_COVER_RUN(verdict_of_line_before, last && index_t'(last_row) == index_t'(r) && index_t'(row_i) != index_t'(r))
  end
  `RDX_COVER_RUN(waits_for_free, !free_o)
  `RDX_COVER_RUN(all_sent, &sent_q)
  `RDX_COVER_RUN(every_verdict_at_once, last && &skipped_i)
  `RDX_COVER_RUN(start, start_i)
endmodule

bind rdx_lines rdx_lines_cover #(.Lines(Lines)) u_cover (.*);

`default_nettype wire
