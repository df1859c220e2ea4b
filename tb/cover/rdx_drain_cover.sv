// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_drain.
`default_nettype none
`include "rdx_cover.svh"

module rdx_drain_cover #(
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1,
    parameter int unsigned Layers = 1,
    parameter int unsigned Lines = 2,
    localparam type index_t = logic [$clog2(Lines)-1:0],
    localparam int unsigned GroupWidth = $clog2(MaxWidth / Pixels)
) (
    input wire logic                    clk_i,
    input wire logic                    rst_ni,
    input wire logic   [GroupWidth-1:0] last_group_i,
    input wire logic   [     Lines-1:0] line_i,
    input wire logic                    start_i,
    input wire logic                    room_i,
    input wire index_t                  row_q,
    input wire logic   [GroupWidth-1:0] group_q,
    input wire logic   [           2:0] ahead_q,
    input wire logic   [           2:0] arrived_q,
    input wire logic                    ask,
    input wire logic                    sweep_q,
    input wire logic                    line_end,
    input wire logic                    give,
    input wire logic                    busy_q,
    input wire logic                    popped,
    input wire logic                    empty,
    input wire logic                    none,
    input wire logic                    pixel_end
);
  `RDX_COVER_RUN(background, give && empty)
  `RDX_COVER_RUN(waits_for_room, arrived_q != '0 && !busy_q && !room_i)
  `RDX_COVER_RUN(full, arrived_q == 3'd4)
  `RDX_COVER_RUN(reads_ahead_no_further, !ask && line_i[row_q] && ahead_q == 3'd4)
  `RDX_COVER_RUN(popped_while_it_arrives, popped && ask && !sweep_q)
  `RDX_COVER_RUN(line_of_one_group, ask && !sweep_q && line_end && last_group_i == '0)
  `RDX_COVER_RUN(waits_for_line, !line_i[row_q] && line_i != '0)
  `RDX_COVER_RUN(one_line_behind_the_other, ask && !sweep_q && line_end && &line_i)
  `RDX_COVER_RUN(start_turns_row_back, start_i && row_q != '0)
  for (genvar r = 0; r < Lines; r++) begin : gen_row
    `RDX_COVER_RUN(reads_widest, ask && !sweep_q && row_q == index_t'(r) && 32'(group_q) == MaxWidth / Pixels - 1)
  end
  if (Pixels > 1) begin : gen_beat
    `RDX_COVER_RUN(goes_on_without_room, give && busy_q && !room_i)
    `RDX_COVER_RUN(pixel_without_layer, give && none && !empty)
  end
  if (Layers > 1) begin : gen_layers
    `RDX_COVER_RUN(more_layers, give && !pixel_end)
    `RDX_COVER_RUN(next_layer_without_room, give && busy_q && !pixel_end && !room_i)
  end
endmodule

bind rdx_drain rdx_drain_cover #(
    .MaxWidth(MaxWidth),
    .Pixels  (Pixels),
    .Layers  (Layers),
    .Lines   (Lines)
) u_cover (.*);

`default_nettype wire
