// SPDX-License-Identifier: Apache-2.0
// Descriptors in a table to rows of surfaces, in the order in which the frame wants them.
//
// Formats    frame_i: held while busy_o. The table's word {slot_o, place_o} comes a clock later. load_o: see rdx_scan.
// Timing     see rdx_rows, rdx_audit, rdx_ask and rdx_advance.
// Reset      control only.
// Model      model/raydix/fdiff.py (next_row)
`default_nettype none

module rdx_feed #(
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Slots = 64
) (
    input  wire logic                                    clk_i,
    input  wire logic                                    rst_ni,
    input  wire logic                                    start_i,
    input  wire logic                                    abort_i,
    input  wire rdx_pkg::frame_t                         frame_i,
    output logic                                         busy_o,
    input  wire logic                                    finish_i,
    output rdx_pkg::error_e                              error_o,
    output rdx_pkg::surface_t                            error_slot_o,
    output logic                 [                 63:0] opaque_o,
    output logic                 [                  5:0] slot_o,
    output logic                 [                  6:0] place_o,
    input  wire logic            [                 63:0] table_i,
    output logic                                         load_valid_o,
    output rdx_pkg::row_word_t                           load_o,
    input  wire logic                                    full_i,
    input  wire logic                                    idle_i,
    input  wire logic                                    vector_idle_i,
    output rdx_pkg::pixel_t                              y_o,
    input  wire logic                                    free_i,
    output logic                                         add_o,
    output rdx_pkg::pixel_t                              add_count_o,
    output logic                                         line_end_o,
    output logic                 [rdx_pkg::PixelWidth:0] skipped_o
);
  import rdx_pkg::*;

  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1;

  logic [SlotWidth-1:0] slot;
  logic rest, audit, second, waits, lanes, forms, loaded, lanes_end, form_end, ask_valid, words;
  logic [6:0] place;
  error_e fault;
  row_info_t info;
  row_word_t ask;
  rdx_rows #(
      .Slots(Slots)
  ) u_rows (
      .clk_i,
      .rst_ni,
      .start_i,
      .abort_i,
      .frame_i,
      .busy_o,
      .rest_o(rest),
      .finish_i,
      .slot_o(slot),
      .audit_o(audit),
      .second_o(second),
      .fault_i(fault),
      .error_o,
      .info_i(info),
      .y_o,
      .wait_o(waits),
      .lanes_o(lanes),
      .form_o(forms),
      .loaded_o(loaded),
      .lanes_end_i(lanes_end),
      .form_end_i(form_end),
      .words_i(words),
      .full_i,
      .idle_i,
      .vector_idle_i,
      .free_i,
      .add_o,
      .line_end_o,
      .skipped_o
  );
  rdx_audit #(
      .D(D),
      .Rules(Rules),
      .Clip(Clip),
      .Vecsum(Vecsum),
      .Slots(Slots)
  ) u_audit (
      .clk_i,
      .clear_i(rest),
      .asked_i(audit),
      .second_i(second),
      .slot_i(slot),
      .table_i,
      .last_x_i(frame_i.last_x),
      .last_y_i(frame_i.last_y),
      .fault_o(fault),
      .fault_slot_o(error_slot_o),
      .info_o(info),
      .opaque_o
  );
  rdx_ask u_ask (
      .clk_i,
      .start_i(waits),
      .lanes_i(lanes),
      .form_i(forms),
      .vector_i(info.vector),
      .quartic_i(info.quartic),
      .loaded_i(loaded),
      .place_o(place),
      .lanes_end_o(lanes_end),
      .form_end_o(form_end),
      .ask_valid_o(ask_valid),
      .ask_o(ask)
  );
  rdx_advance #(
      .Slots(Slots)
  ) u_advance (
      .clk_i,
      .rst_ni,
      .ask_valid_i(ask_valid),
      .ask_i(ask),
      .slot_i(slot),
      .first_i(y_o == info.y0),
      .y_i(y_o),
      .table_i,
      .busy_o(words),
      .load_valid_o,
      .load_o
  );
  assign slot_o = 6'(slot);
  assign place_o = audit ? {6'd0, second} : place;
  assign add_count_o = info.width;
  wire unused = &{1'b0, frame_i};

endmodule

`default_nettype wire
