// SPDX-License-Identifier: Apache-2.0
// Hits to the layers of finished lines: which pixels still wait for a verdict, their layers, and the reading of a line that is
// complete.
//
// Formats    verdicts: [2:0] pixels without a ray; hits: rdx_pkg::hit_t. layer_o, whole_o: see rdx_drain.
// Timing     a line is read when all of it has been sent and no pixel waits; see rdx_tally, rdx_layers, rdx_drain. A queue of two
//            before the layers: hit_ready_o is a register, whatever pixel the hit is for.
// Reset      control only; ready_o when the layers are swept.
// Model      model/raydix/layers.py
`default_nettype none

module rdx_lines #(
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1,
    parameter int unsigned Layers = 1,
    parameter int unsigned Lines = 2,
    parameter bit Limit = 1'b1
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    output logic                        ready_o,
    input  wire logic                   start_i,
    input  wire rdx_pkg::pixel_t        last_x_i,
    input  wire logic            [63:0] opaque_i,
    input  wire rdx_pkg::line_t         row_i,          // the line that is sent
    output logic                        free_o,         // its layers are empty
    input  wire logic                   add_i,
    input  wire rdx_pkg::pixel_t        add_count_i,
    input  wire logic                   line_end_i,
    input  wire logic            [ 2:0] skipped_i,
    input  wire rdx_pkg::line_t  [ 2:0] skipped_row_i,
    input  wire logic                   hit_valid_i,
    output logic                        hit_ready_o,
    input  wire rdx_pkg::hit_t          hit_i,
    output logic                        lost_o,
    input  wire logic                   look_i,
    input  wire rdx_pkg::pixel_t        look_x_i,
    input  wire rdx_pkg::line_t         look_row_i,
    output logic                        limit_valid_o,
    output rdx_pkg::depth_t             limit_o,
    input  wire logic                   room_i,
    output logic                        begin_o,
    output logic                        layer_valid_o,
    output rdx_pkg::layer_t             layer_o,
    output logic                        whole_o
);
  import rdx_pkg::*;

  localparam int unsigned GroupWidth = $clog2(MaxWidth / Pixels);
  localparam type count_t = logic [$clog2(Layers+1)-1:0];

  localparam type index_t = logic [$clog2(Lines)-1:0];
  logic last, read;
  line_t  last_row;
  index_t read_row;
  logic [Lines-1:0] zero, emptied, sent_q, finished_q;
  logic [GroupWidth-1:0] read_group;
  count_t counts[Pixels];
  entry_t entries[Pixels][Layers];

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      sent_q <= '0;
      finished_q <= '0;
    end else begin
      sent_q <= sent_q & ~emptied;
      finished_q <= sent_q & zero & ~emptied;
      if (line_end_i) sent_q[index_t'(row_i)] <= 1'b1;
    end
  end
  assign free_o = !sent_q[index_t'(row_i)];

  rdx_tally #(
      .Lines(Lines),
      .Verdicts(4)
  ) u_tally (
      .clk_i,
      .rst_ni,
      .add_i,
      .add_row_i(row_i),
      .add_count_i,
      .verdict_i({last, skipped_i}),
      .verdict_row_i({last_row, skipped_row_i}),
      .zero_o(zero)
  );
  logic waiting_valid, waiting_ready;
  hit_t waiting;
  rdx_fifo #(
      .W($bits(hit_t)),
      .Depth(2)
  ) u_waiting (
      .clk_i,
      .rst_ni,
      .valid_i(hit_valid_i),
      .ready_o(hit_ready_o),
      .data_i (hit_i),
      .valid_o(waiting_valid),
      .ready_i(waiting_ready),
      .data_o (waiting)
  );
  rdx_layers #(
      .MaxWidth(MaxWidth),
      .Pixels(Pixels),
      .Layers(Layers),
      .Lines(Lines),
      .Limit(Limit)
  ) u_layers (
      .clk_i,
      .rst_ni,
      .opaque_i,
      .hit_valid_i(waiting_valid),
      .hit_ready_o(waiting_ready),
      .hit_i(waiting),
      .last_o(last),
      .last_row_o(last_row),
      .lost_o,
      .read_i(read),
      .read_row_i(read_row),
      .read_group_i(read_group),
      .count_o(counts),
      .entries_o(entries),
      .look_i,
      .look_x_i,
      .look_row_i,
      .limit_valid_o,
      .limit_o
  );
  rdx_drain #(
      .MaxWidth(MaxWidth),
      .Pixels  (Pixels),
      .Layers  (Layers),
      .Lines   (Lines)
  ) u_drain (
      .clk_i,
      .rst_ni,
      .ready_o,
      .last_group_i(GroupWidth'(last_x_i >> $clog2(Pixels))),
      .line_i(finished_q),
      .start_i,
      .free_o(emptied),
      .read_o(read),
      .read_row_o(read_row),
      .read_group_o(read_group),
      .count_i(counts),
      .entries_i(entries),
      .room_i,
      .begin_o,
      .layer_valid_o,
      .layer_o,
      .whole_o
  );

endmodule

`default_nettype wire
