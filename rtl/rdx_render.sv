// SPDX-License-Identifier: Apache-2.0
// Descriptors to pixels: the processor without its registers.
//
// Rows of surfaces go through the raster and the rings; their hits become layers of pixels; finished lines are shaded. All that is
// asked for (docs/processor.md) is skipped.
//
// Formats    frame_i: held while busy_o = 1. The table's word {slot_o, place_o} comes a clock later. Materials: see rdx_shade. The
//            pixel stream: see rdx_pixels. tap_o: each record of the rings, for test benches.
// Timing     start_i while ready_o = 1 begins a frame. done_o: its last pixel has left; error_o: it was not begun.
// Reset      control only; then ready_o rises when the layers are swept.
// Model      model/raydix/processor.py
`default_nettype none

module rdx_render #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter int unsigned VectorUnits = 1,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Layers = 4,
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1
) (
    input  wire logic                               clk_i,
    input  wire logic                               rst_ni,
    output logic                                    ready_o,
    input  wire logic                               start_i,
    input  wire rdx_pkg::frame_t                    frame_i,
    output logic                                    done_o,
    output rdx_pkg::error_e                         error_o,
    output rdx_pkg::surface_t                       error_slot_o,
    output rdx_pkg::counters_t                      counters_o,
    output logic                    [          5:0] slot_o,
    output logic                    [          6:0] place_o,
    input  wire logic               [         63:0] table_i,
    input  wire logic                               bank_i,
    input  wire logic                               material_we_i,
    input  wire rdx_pkg::surface_t                  material_surface_i,
    input  wire rdx_pkg::constant_t                 material_constant_i,
    input  wire logic               [         31:0] material_data_i,
    output logic                                    m_axis_tvalid_o,
    input  wire logic                               m_axis_tready_i,
    output logic                    [24*Pixels-1:0] m_axis_tdata_o,
    output logic                    [ 3*Pixels-1:0] m_axis_tkeep_o,
    output logic                                    m_axis_tuser_o,
    output logic                                    m_axis_tlast_o,
    output logic                                    tap_valid_o,
    output rdx_pkg::hit_t                           tap_o
);
  import rdx_pkg::*;

  localparam int unsigned SlotWidth = Surfaces > 1 ? $clog2(Surfaces) : 1;
  localparam int unsigned GroupWidth = $clog2(MaxWidth / Pixels);
  localparam int unsigned Shift = $clog2(Pixels);
  localparam type count_t = logic [$clog2(Layers+1)-1:0];

  events_t events;
  logic finish;
  logic [1:0] sent, free, zero;

  // ---- rows ----
  logic [SlotWidth-1:0] slot;
  logic busy, ask_valid, first, advance_busy, load_valid, full, idle, vector_idle, add;
  row_word_t ask, load;
  pixel_t y, add_count;
  logic [63:0] opaque;
  rdx_rows #(
      .D(D),
      .Rules(Rules),
      .Vecsum(Vecsum),
      .Slots(Surfaces)
  ) u_rows (
      .clk_i,
      .rst_ni,
      .start_i,
      .frame_i,
      .busy_o(busy),
      .finish_i(finish),
      .error_o,
      .error_slot_o,
      .opaque_o(opaque),
      .slot_o(slot),
      .place_o,
      .table_i,
      .ask_valid_o(ask_valid),
      .ask_o(ask),
      .first_o(first),
      .y_o(y),
      .advance_busy_i(advance_busy),
      .full_i(full),
      .idle_i(idle),
      .vector_idle_i(vector_idle),
      .add_o(add),
      .add_count_o(add_count),
      .sent_o(sent),
      .free_i(free),
      .skipped_o(events.rectangle)
  );
  assign slot_o = 6'(slot);
  rdx_advance #(
      .Slots(Surfaces)
  ) u_advance (
      .clk_i,
      .rst_ni,
      .ask_valid_i(ask_valid),
      .ask_i(ask),
      .slot_i(slot),
      .first_i(first),
      .y_i(y),
      .table_i,
      .busy_o(advance_busy),
      .load_valid_o(load_valid),
      .load_o(load)
  );

  // ---- rays and hits ----
  logic hit_valid, hit_ready;
  hit_t hit;
  logic look, look_row, limit_valid;
  pixel_t look_x;
  depth_t limit;
  logic [2:0] skipped, skipped_row;
  rdx_cast #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .Vecsum(Vecsum),
      .Lanes(Lanes),
      .VectorUnits(VectorUnits)
  ) u_cast (
      .clk_i,
      .rst_ni,
      .frame_i,
      .load_valid_i(load_valid),
      .load_i(load),
      .full_o(full),
      .idle_o(idle),
      .vector_idle_o(vector_idle),
      .look_o(look),
      .look_x_o(look_x),
      .look_row_o(look_row),
      .limit_valid_i(limit_valid && frame_i.skip.depth),
      .limit_i(limit),
      .skipped_o(skipped),
      .skipped_row_o(skipped_row),
      .steps_o(events.steps),
      .hit_valid_o(hit_valid),
      .hit_ready_i(hit_ready),
      .hit_o(hit)
  );
  assign {events.beyond, events.rootless, events.hidden} = skipped;
  wire taken = hit_valid && hit_ready;
  assign events.ray = taken && hit.last;
  assign events.hit = taken && hit.hit;
  assign events.given_up = taken && hit.last && (&hit.steps);
  assign events.early = taken && hit.last && hit.steps < steps_t'(frame_i.k_stop) ? frame_i.k_stop - 5'(hit.steps) : '0;
  assign tap_valid_o = taken;
  assign tap_o = hit;

  // ---- lines ----
  logic last, last_row, read, read_row, swept, begins, room, layer_valid, layer_whole;
  logic [GroupWidth-1:0] read_group;
  count_t counts[Pixels];
  entry_t entries[Pixels][Layers];
  layer_t layer;
  rdx_tally #(
      .Verdicts(4)
  ) u_tally (
      .clk_i,
      .rst_ni,
      .add_i(add),
      .add_row_i(y[0]),
      .add_count_i(add_count),
      .verdict_i({last, skipped}),
      .verdict_row_i({last_row, skipped_row}),
      .zero_o(zero)
  );
  rdx_layers #(
      .MaxWidth(MaxWidth),
      .Pixels(Pixels),
      .Layers(Layers),
      .Limit(Surfaces > 1)
  ) u_layers (
      .clk_i,
      .rst_ni,
      .opaque_i(opaque),
      .hit_valid_i(hit_valid),
      .hit_ready_o(hit_ready),
      .hit_i(hit),
      .last_o(last),
      .last_row_o(last_row),
      .lost_o(events.lost),
      .read_i(read),
      .read_row_i(read_row),
      .read_group_i(read_group),
      .count_o(counts),
      .entries_o(entries),
      .look_i(look),
      .look_x_i(look_x),
      .look_row_i(look_row),
      .limit_valid_o(limit_valid),
      .limit_o(limit)
  );
  rdx_drain #(
      .MaxWidth(MaxWidth),
      .Pixels  (Pixels),
      .Layers  (Layers)
  ) u_drain (
      .clk_i,
      .rst_ni,
      .ready_o(swept),
      .last_group_i(GroupWidth'(frame_i.last_x >> Shift)),
      .line_i(sent & zero),
      .start_i,
      .free_o(free),
      .read_o(read),
      .read_row_o(read_row),
      .read_group_o(read_group),
      .count_i(counts),
      .entries_i(entries),
      .room_i(room),
      .begin_o(begins),
      .layer_valid_o(layer_valid),
      .layer_o(layer),
      .whole_o(layer_whole)
  );
  assign events.visible = layer_valid && layer.shade;

  // ---- pixels ----
  rdx_finish #(
      .D(D),
      .Vecsum(Vecsum),
      .Surfaces(Surfaces),
      .Layers(Layers),
      .Pixels(Pixels)
  ) u_finish (
      .clk_i,
      .rst_ni,
      .frame_i,
      .bank_i,
      .material_we_i,
      .material_surface_i,
      .material_constant_i,
      .material_data_i,
      .begin_i(begins),
      .room_o(room),
      .layer_valid_i(layer_valid),
      .layer_i(layer),
      .whole_i(layer_whole),
      .finish_o(finish),
      .stalled_o(events.stalled),
      .m_axis_tvalid_o,
      .m_axis_tready_i,
      .m_axis_tdata_o,
      .m_axis_tkeep_o,
      .m_axis_tuser_o,
      .m_axis_tlast_o
  );

  rdx_count u_count (
      .clk_i,
      .clear_i (start_i),
      .events_i(events),
      .counters_o
  );
  assign ready_o = swept && !busy;
  assign done_o  = finish;

endmodule

`default_nettype wire
