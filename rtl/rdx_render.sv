// SPDX-License-Identifier: Apache-2.0
// Descriptors to pixels: the processor without its registers.
//
// Rows of surfaces go through the raster and the rings; their hits become layers of pixels; finished lines are shaded.
//
// Formats    frame_i: held while busy_o = 1. Table's word {slot_o, place_o}: a clock later. Materials: see rdx_shade; pixels: rdx_pixels.
//            tap_o: each record of the rings, for test benches.
// Timing     start_i while ready_o = 1 begins a frame. done_o: its last pixel has left; error_o: it was not begun.
// Reset      control only; then ready_o rises when the layers are swept.
// Model      model/raydix/render.py (render_golden)
`default_nettype none

module rdx_render #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter int unsigned VectorUnits = 1,
    parameter int unsigned VectorDrop = 0,
    parameter int unsigned Rings = 1,
    parameter int unsigned VectorRings = 1,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Layers = 4,
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1
) (
    input  wire logic                                     clk_i,
    input  wire logic                                     rst_ni,
    output logic                                          ready_o,
    input  wire logic                                     start_i,
    input  wire logic                                     abort_i,
    input  wire rdx_pkg::frame_t                          frame_i,
    output logic                                          done_o,
    output rdx_pkg::error_e                               error_o,
    output rdx_pkg::surface_t                             error_slot_o,
    output rdx_pkg::counters_t                            counters_o,
    output logic                          [          5:0] slot_o,
    output logic                          [          6:0] place_o,
    input  wire logic                     [         63:0] table_i,
    input  wire logic                                     bank_i,
    input  wire rdx_pkg::material_write_t                 material_i,
    output logic                                          m_axis_tvalid_o,
    input  wire logic                                     m_axis_tready_i,
    output logic                          [24*Pixels-1:0] m_axis_tdata_o,
    output logic                          [ 3*Pixels-1:0] m_axis_tkeep_o,
    output logic                                          m_axis_tuser_o,
    output logic                                          m_axis_tlast_o,
    output logic                                          tap_valid_o,
    output rdx_pkg::hit_t                                 tap_o
);
  import rdx_pkg::*;

  localparam int unsigned Lines = Layers > 1 ? 2 : 4;  // at work; four where they need little memory

  events_t events;
  // ---- rows ----
  logic busy, line_end, free, load_valid, full, idle, vector_idle, add;
  row_word_t load;
  pixel_t y, add_count, look_x;
  logic [63:0] opaque;
  rdx_feed #(
      .D(D),
      .Rules(Rules),
      .Clip(Clip),
      .Vecsum(Vecsum),
      .Slots(Surfaces)
  ) u_feed (
      .*,
      .busy_o(busy),
      .finish_i(done_o),
      .opaque_o(opaque),
      .load_valid_o(load_valid),
      .load_o(load),
      .full_i(full),
      .idle_i(idle),
      .vector_idle_i(vector_idle),
      .y_o(y),
      .free_i(free),
      .add_o(add),
      .add_count_o(add_count),
      .line_end_o(line_end),
      .skipped_o(events.rectangle)
  );
  // ---- rays and hits ----
  logic hit_valid, hit_ready, look, limit_valid;
  line_t look_row;
  depth_t limit;
  logic [2:0] skipped;
  line_t [2:0] skipped_row;
  rdx_cast #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .Clip(Clip),
      .HalveStages(HalveStages),
      .Vecsum(Vecsum),
      .Lanes(Lanes),
      .VectorUnits(VectorUnits),
      .VectorDrop(VectorDrop),
      .Rings(Rings),
      .VectorRings(VectorRings),
      .Limit(Surfaces > 1)
  ) u_cast (
      .*,
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
      .ended_o(events.ended),
      .hit_valid_o(hit_valid),
      .hit_ready_i(hit_ready),
      .hit_o(tap_o)
  );
  assign {events.beyond, events.rootless, events.hidden} = skipped;
  assign tap_valid_o = hit_valid && hit_ready;
  // ---- lines ----
  logic swept, begins, room, layer_valid, layer_whole;
  layer_t layer;
  rdx_lines #(
      .MaxWidth(MaxWidth),
      .Pixels(Pixels),
      .Layers(Layers),
      .Lines(Lines),
      .Limit(Surfaces > 1)
  ) u_lines (
      .*,
      .ready_o(swept),
      .last_x_i(frame_i.last_x),
      .opaque_i(opaque),
      .row_i(y[1:0]),
      .free_o(free),
      .add_i(add),
      .add_count_i(add_count),
      .line_end_i(line_end),
      .skipped_i(skipped),
      .skipped_row_i(skipped_row),
      .hit_valid_i(hit_valid),
      .hit_ready_o(hit_ready),
      .hit_i(tap_o),
      .lost_o(events.lost),
      .look_i(look),
      .look_x_i(look_x),
      .look_row_i(look_row),
      .limit_valid_o(limit_valid),
      .limit_o(limit),
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
      .*,
      .begin_i(begins),
      .room_o(room),
      .layer_valid_i(layer_valid),
      .layer_i(layer),
      .whole_i(layer_whole),
      .finish_o(done_o),
      .stalled_o(events.stalled)
  );
  rdx_count u_count (
      .*,
      .clear_i(start_i),
      .k_stop_i(frame_i.k_stop),
      .hit_valid_i(tap_valid_o),
      .hit_i(tap_o),
      .events_i(events)
  );
  assign ready_o = swept && !busy;
  wire unused = &{1'b0, y};
endmodule
`default_nettype wire
