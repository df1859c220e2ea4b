// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_lines.
`default_nettype none
`include "rdx_cover.svh"

module rdx_lines_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       start_i,
    input wire logic       row_i,
    input wire logic       free_o,
    input wire logic       add_i,
    input wire logic       line_end_i,
    input wire logic [2:0] skipped_i,
    input wire logic       last,
    input wire logic       last_row,
    input wire logic [1:0] zero,
    input wire logic [1:0] emptied,
    input wire logic [1:0] sent_q
);
  for (genvar r = 0; r < 2; r++) begin : gen_row
    `RDX_COVER_RUN(sent_but_pixels_wait, sent_q[r] && !zero[r])
    `RDX_COVER_RUN(all_verdicts_before_the_end, !sent_q[r] && zero[r] && !(&zero))
    `RDX_COVER_RUN(emptied_while_other_is_sent, emptied[r] && row_i != 1'(r) && (add_i || line_end_i))
    `RDX_COVER_RUN(emptied_and_wanted, emptied[r] && row_i == 1'(r))
    `RDX_COVER_RUN(verdict_of_line_before, last && last_row == 1'(r) && row_i != 1'(r))
  end
  `RDX_COVER_RUN(waits_for_free, !free_o)
  `RDX_COVER_RUN(both_sent, &sent_q)
  `RDX_COVER_RUN(every_verdict_at_once, last && &skipped_i)
  `RDX_COVER_RUN(start, start_i)
endmodule

bind rdx_lines rdx_lines_cover u_cover (.*);

`default_nettype wire
