// SPDX-License-Identifier: Apache-2.0
// Walks the frame: line after line, and on a line the surfaces whose rectangles it crosses.
//
// First all descriptors are audited; an error ends the frame before it begins. A line begins when its layers are free. The
// words of a row are asked for while the row before is walked. A line is sent when the words of its last surface are.
//
// Formats    frame_i: held while busy. ask_o: see rdx_advance; the word asked for is {slot_o, place_o} of the table.
// Timing     39 or 75 clocks a row (21 of a vector sum, 98 where its constants are not those loaded last), hidden where the row
//            before has as many pixels; a clock for a surface that does not cross the line.
// Reset      control only.
// Model      model/raydix/processor.py (skipped): the pixels that are not looked at
`default_nettype none

module rdx_rows #(
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Slots = 64,
    localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic start_i,  // while not busy
    input wire rdx_pkg::frame_t frame_i,
    output logic busy_o,
    input wire logic finish_i,  // the last pixel has left
    output rdx_pkg::error_e error_o,  // ErrorNone, or in a single clock an error, of error_slot_o
    output rdx_pkg::surface_t error_slot_o,
    output logic [63:0] opaque_o,  // bit i: surface i is opaque
    // table and rdx_advance
    output logic [SlotWidth-1:0] slot_o,
    output logic [6:0] place_o,
    input wire logic [63:0] table_i,
    output logic ask_valid_o,
    output rdx_pkg::row_word_t ask_o,
    output logic first_o,
    output rdx_pkg::pixel_t y_o,
    input wire logic advance_busy_i,
    // rdx_scan and the rings
    input wire logic full_i,
    input wire logic idle_i,
    input wire logic vector_idle_i,
    // lines
    output logic add_o,  // pixels of a row that will have a verdict
    output rdx_pkg::pixel_t add_count_o,  // less one
    output logic [1:0] sent_o,  // all of the line is under way; index: lowest bit of its row
    input wire logic [1:0] free_i,  // the line has been read
    output logic [rdx_pkg::PixelWidth:0] skipped_o  // pixels outside of a rectangle that were skipped in this clock
);
  import rdx_pkg::*;

  typedef enum logic [3:0] {
    Rest,
    Audit,   // words 0 and 1 of each descriptor
    Settle,  // the last of them is on its way
    Line,    // until the layers are free
    Slot,
    Wait,    // until the raster has room
    Send,    // header and lanes
    Drain,   // until constants may be changed
    Form,
    Pad,     // as long as the pixels outside of the rectangle would take
    Finish
  } state_e;

  state_e state_q;
  logic [SlotWidth-1:0] slot_q;
  logic second_q;  // word 1 in the audit
  pixel_t y_q, pad_q;
  logic [1:0] sent_q;
  logic form_valid_q;
  logic [SlotWidth-1:0] form_slot_q;

  // ---- audit ----
  logic asked_q;
  error_e fault;
  row_info_t info;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) asked_q <= 1'b0;
    else asked_q <= state_q == Audit;
  end
  rdx_audit #(
      .D(D),
      .Rules(Rules),
      .Vecsum(Vecsum),
      .Slots(Slots)
  ) u_audit (
      .clk_i,
      .clear_i(state_q == Rest),
      .asked_i(state_q == Audit),
      .second_i(second_q),
      .slot_i(slot_q),
      .table_i,
      .last_x_i(frame_i.last_x),
      .last_y_i(frame_i.last_y),
      .fault_o(fault),
      .fault_slot_o(error_slot_o),
      .info_o(info),
      .opaque_o
  );
  assign error_o = state_q == Settle && !asked_q ? fault : ErrorNone;

  // ---- lines and surfaces ----
  wire crosses = y_q >= info.y0 && y_q <= info.y1;
  wire last_slot = surface_t'(slot_q) == frame_i.last_slot;
  wire last_line = y_q == frame_i.last_y;
  logic lanes_end, form_end;
  wire loaded = !info.vector || (form_valid_q && form_slot_q == slot_q);
  wire pixel_t outside = frame_i.last_x - info.width;  // pixels of the line that are not in the rectangle
  wire go = state_q == Wait && !full_i && !advance_busy_i;

  // the next surface, or the end of the line
  logic next;
  always_comb begin
    case (state_q)
      Slot: next = !crosses && frame_i.skip.rectangle;
      Send: next = lanes_end && loaded && frame_i.skip.rectangle;
      Form: next = form_end && frame_i.skip.rectangle;
      Pad: next = idle_i && !advance_busy_i && pad_q == '0;
      default: next = 1'b0;
    endcase
  end
  wire line_end = next && last_slot || state_q == Line && frame_i.empty && !sent_q[y_q[0]];

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q <= Rest;
      sent_q <= '0;
      form_valid_q <= 1'b0;
    end else begin
      sent_q <= sent_q & ~free_i;
      if (line_end) sent_q[y_q[0]] <= 1'b1;
      case (state_q)
        Rest: if (start_i) state_q <= frame_i.empty ? Line : Audit;
        Audit: if (second_q && last_slot) state_q <= Settle;
        Settle: if (!asked_q) state_q <= fault == ErrorNone ? Line : Rest;
        Line: if (!sent_q[y_q[0]] && !frame_i.empty) state_q <= Slot;
        Slot:
        if (crosses) state_q <= Wait;
        else if (!frame_i.skip.rectangle) state_q <= Pad;
        Wait: if (go) state_q <= Send;
        Send: if (lanes_end) state_q <= loaded ? Pad : Drain;
        Drain: if (idle_i && vector_idle_i && !advance_busy_i) state_q <= Form;
        Form: if (form_end) state_q <= Pad;
        Finish: if (finish_i) state_q <= Rest;
        default: ;
      endcase
      if (next) state_q <= Slot;
      if (line_end) state_q <= last_line ? Finish : Line;
      if (state_q == Rest) form_valid_q <= 1'b0;
      else if (state_q == Form && form_end) form_valid_q <= 1'b1;
    end
  end

  always_ff @(posedge clk_i) begin
    case (state_q)
      Rest: begin
        slot_q <= '0;
        second_q <= 1'b0;
        y_q <= '0;
      end
      Audit: begin
        second_q <= !second_q;
        if (second_q) slot_q <= slot_q + 1'b1;
      end
      Line: slot_q <= '0;
      Slot: pad_q <= frame_i.last_x;
      Wait: pad_q <= outside;
      Form: form_slot_q <= slot_q;
      Pad: if (idle_i && !advance_busy_i) pad_q <= pad_q - 1'b1;
      default: ;
    endcase
    if (next) slot_q <= slot_q + 1'b1;
    if (line_end) y_q <= y_q + 1'b1;
  end

  // ---- the words of a row ----
  logic [6:0] place;
  rdx_ask u_ask (
      .clk_i,
      .start_i(state_q == Wait),
      .lanes_i(state_q == Send),
      .form_i(state_q == Form),
      .vector_i(info.vector),
      .quartic_i(info.quartic),
      .loaded_i(loaded),
      .place_o(place),
      .lanes_end_o(lanes_end),
      .form_end_o(form_end),
      .ask_valid_o,
      .ask_o
  );

  wire unused = &{1'b0, frame_i};
  assign busy_o = state_q != Rest;
  assign slot_o = slot_q;
  assign place_o = state_q == Audit ? {6'd0, second_q} : place;
  assign first_o = y_q == info.y0;
  assign y_o = y_q;
  assign add_o = go;
  assign add_count_o = info.width;
  assign sent_o = sent_q;
  always_comb begin
    skipped_o = '0;
    if (frame_i.skip.rectangle && go) skipped_o = {1'b0, outside};
    if (frame_i.skip.rectangle && state_q == Slot && !crosses) skipped_o = {1'b0, frame_i.last_x} + 1'b1;
  end

endmodule

`default_nettype wire
