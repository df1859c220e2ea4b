// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_rows.
`default_nettype none
`include "rdx_cover.svh"

module rdx_rows_cover #(
    parameter int unsigned Slots = 64
) (
    input wire logic                     clk_i,
    input wire logic                     rst_ni,
    input wire logic                     start_i,
    input wire logic                     abort_i,
    input wire rdx_pkg::frame_t          frame_i,
    input wire rdx_pkg::row_info_t       info_i,
    input wire rdx_pkg::error_e          error_o,
    input wire logic                     full_i,
    input wire logic                     idle_i,
    input wire logic                     vector_idle_i,
    input wire logic                     words_i,
    input wire logic                     free_i,
    input wire logic                     lanes_end_i,
    input wire logic               [3:0] state_q,
    input wire logic                     crosses,
    input wire logic                     last_slot,
    input wire logic                     loaded,
    input wire logic                     go,
    input wire logic                     skip,
    input wire logic                     next,
    input wire logic                     line_end,
    input wire logic                     abort_q,
    input wire logic                     form_valid_q,
    input wire rdx_pkg::pixel_t          y_q
);
  import rdx_pkg::*;

  localparam logic [3:0] Rest = 4'd0;
  localparam logic [3:0] Line = 4'd3;
  localparam logic [3:0] Slot = 4'd4;
  localparam logic [3:0] Wait = 4'd5;
  localparam logic [3:0] Send = 4'd6;
  localparam logic [3:0] Drain = 4'd7;
  localparam logic [3:0] Pad = 4'd9;

  for (genvar s = 0; s < 11; s++) begin : gen_state
    `RDX_COVER_RUN(seen, state_q == 4'(s))
    if (s != Rest) begin : gen_busy
      `RDX_COVER_RUN(aborted, state_q == 4'(s) && abort_i)
    end
  end
  `RDX_COVER_RUN(empty, state_q == Rest && start_i && frame_i.empty)
  `RDX_COVER_RUN(error, error_o != ErrorNone)
  `RDX_COVER_RUN(layers_not_free, state_q == Line && !free_i)
  for (genvar k = 0; k < 2; k++) begin : gen_skip
    `RDX_COVER_RUN(crosses_line, state_q == Slot && crosses && skip == 1'(k))
    `RDX_COVER_RUN(does_not_cross, state_q == Slot && !crosses && skip == 1'(k))
    `RDX_COVER_RUN(last_of_line_does_not_cross, state_q == Slot && !crosses && last_slot && skip == 1'(k))
    `RDX_COVER_RUN(last_line, line_end && y_q == frame_i.last_y && skip == 1'(k))
    `RDX_COVER_RUN(lanes_end_row, state_q == Send && lanes_end_i && loaded && skip == 1'(k))
  end
  `RDX_COVER_RUN(above, state_q == Slot && y_q < info_i.y0)
  `RDX_COVER_RUN(below, state_q == Slot && y_q > info_i.y1)
  `RDX_COVER_RUN(first_row, state_q == Slot && y_q == info_i.y0)
  `RDX_COVER_RUN(last_row, state_q == Slot && y_q == info_i.y1)
  `RDX_COVER_RUN(one_row, state_q == Slot && y_q == info_i.y0 && y_q == info_i.y1)
  `RDX_COVER_RUN(no_room, state_q == Wait && full_i)
  `RDX_COVER_RUN(words_under_way, state_q == Wait && !full_i && words_i)
  `RDX_COVER_RUN(row_before_is_walked, go && !idle_i)
  `RDX_COVER_RUN(constants_there, go && info_i.vector && loaded)
  `RDX_COVER_RUN(first_constants, go && info_i.vector && !form_valid_q)
  if (Slots > 1) begin : gen_several
    `RDX_COVER_RUN(other_constants, go && info_i.vector && form_valid_q && !loaded)
    `RDX_COVER_RUN(next_surface, next && !last_slot && !abort_q)
    `RDX_COVER_RUN(abort_leaves_surfaces, line_end && next && abort_q && !last_slot)
  end
  `RDX_COVER_RUN(constants_wait_for_pixels, state_q == Drain && !idle_i)
  `RDX_COVER_RUN(constants_wait_for_rays, state_q == Drain && idle_i && !vector_idle_i)
  `RDX_COVER_RUN(constants_wait_for_words, state_q == Drain && words_i)
  `RDX_COVER_RUN(pad_waits, state_q == Pad && !idle_i)
  `RDX_COVER_RUN(background_after_abort, state_q == Line && abort_q && line_end)
endmodule

bind rdx_rows rdx_rows_cover #(.Slots(Slots)) u_cover (.*);

`default_nettype wire
