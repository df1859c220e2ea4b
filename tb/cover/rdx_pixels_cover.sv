// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_pixels.
`default_nettype none
`include "rdx_cover.svh"

module rdx_pixels_cover #(
    parameter int unsigned Pixels = 1,
    parameter int unsigned Depth = 128,
    localparam int unsigned PixelBits = Pixels > 1 ? $clog2(Pixels) : 1,
    localparam type reserved_t = logic [$clog2(Depth):0]
) (
    input wire logic                            clk_i,
    input wire logic                            rst_ni,
    input wire logic                            begin_i,
    input wire logic                            room_o,
    input wire logic                            pixel_valid_i,
    input wire logic                            whole_i,
    input wire reserved_t                       reserved_q,
    input wire logic            [PixelBits-1:0] at_q,
    input wire logic                            sent,
    input wire logic                            line_end,
    input wire rdx_pkg::pixel_t                 x_q,
    input wire rdx_pkg::pixel_t                 y_q,
    input wire logic            [ 3*Pixels-1:0] m_axis_tkeep_o,
    input wire logic                            stalled_o,
    input wire logic                            finish_o,
    input wire logic                            beat_valid
);
  for (genvar p = 0; p < Pixels; p++) begin : gen_pixel
    `RDX_COVER_RUN(single, pixel_valid_i && !whole_i && 32'(at_q) == p)
    `RDX_COVER_RUN(line_ends_with, sent && line_end && $countones(m_axis_tkeep_o) == 3 * (p + 1))
  end
  `RDX_COVER_RUN(whole, pixel_valid_i && whole_i)
  `RDX_COVER_RUN(begins_as_one_leaves, begin_i && sent)
  `RDX_COVER_RUN(all_reserved, !room_o && 32'(reserved_q) == Depth - 1)
  `RDX_COVER_RUN(all_reserved_and_one_leaves, !room_o && sent)
  `RDX_COVER_RUN(none_reserved, reserved_q == '0)
  `RDX_COVER_RUN(stalled_at_first, stalled_o && x_q == '0 && y_q == '0)
  `RDX_COVER_RUN(stalled_at_line_end, stalled_o && line_end)
  `RDX_COVER_RUN(line_of_one_beat, sent && line_end && x_q == '0)
  `RDX_COVER_RUN(frame_of_one_beat, finish_o && x_q == '0 && y_q == '0)
  `RDX_COVER_RUN(frame_behind_frame, finish_o && 32'(reserved_q) == 1)
  `RDX_COVER_RUN(receiver_waits, reserved_q != '0 && !beat_valid)
endmodule

bind rdx_pixels rdx_pixels_cover #(
    .Pixels(Pixels),
    .Depth (Depth)
) u_cover (.*);

`default_nettype wire
