// SPDX-License-Identifier: Apache-2.0
// The walk through a frame: line after line, and on a line the surfaces whose rectangles it crosses.
//
// First all descriptors are audited; an error ends the frame before it begins. A line begins when its layers are free. The
// words of a row are asked for while the row before is walked. A line is sent when the words of its last surface are. After
// abort_i no surface is looked at any more, and the frame ends with lines of background.
//
// Formats    frame_i: held while busy. info_i: of descriptor slot_o.
// Timing     a row's words, hidden where the row before has as many pixels; a clock for a surface that does not cross the line.
// Reset      control only.
// Model      none: which pixels are looked at changes no visible hit (docs/processor.md)
`default_nettype none

module rdx_rows #(
    parameter int unsigned Slots = 64,
    localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic start_i,  // while not busy
    input wire logic abort_i,
    input wire rdx_pkg::frame_t frame_i,
    output logic busy_o,
    output logic rest_o,  // the audit begins anew
    input wire logic finish_i,  // the last pixel has left
    // descriptors
    output logic [SlotWidth-1:0] slot_o,
    output logic audit_o,  // a word is asked for
    output logic second_o,  // it is word 1, not word 0
    input wire rdx_pkg::error_e fault_i,
    output rdx_pkg::error_e error_o,  // ErrorNone, or in a single clock an error
    input wire rdx_pkg::row_info_t info_i,
    output rdx_pkg::pixel_t y_o,
    // words of a row
    output logic wait_o,
    output logic lanes_o,
    output logic form_o,
    output logic loaded_o,  // the row ends with its lanes
    input wire logic lanes_end_i,
    input wire logic form_end_i,
    input wire logic words_i,  // words are under way
    // rdx_scan and the rings
    input wire logic full_i,
    input wire logic idle_i,
    input wire logic vector_idle_i,
    // lines
    input wire logic free_i,  // layers of line y_o
    output logic add_o,  // pixels of a row that will have a verdict
    output logic line_end_o,  // all of line y_o is under way
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
  logic [SlotWidth-1:0] slot_q, form_slot_q;
  logic second_q, settled_q, form_valid_q, abort_q;
  pixel_t y_q, pad_q;

  wire crosses = y_q >= info_i.y0 && y_q <= info_i.y1;
  wire last_slot = surface_t'(slot_q) == frame_i.last_slot;
  wire none = frame_i.empty || abort_q;
  wire loaded = !info_i.vector || (form_valid_q && form_slot_q == slot_q);
  wire pixel_t outside = frame_i.last_x - info_i.width;  // pixels of the line that are not in the rectangle
  wire go = state_q == Wait && !full_i && !words_i;
  wire skip = frame_i.skip.rectangle;

  // the next surface, or the end of the line
  logic next;
  always_comb begin
    case (state_q)
      Slot: next = !crosses && skip;
      Send: next = lanes_end_i && loaded && skip;
      Form: next = form_end_i && skip;
      Pad: next = idle_i && !words_i && pad_q == '0;
      default: next = 1'b0;
    endcase
  end
  wire line_end = (next && (last_slot || abort_q)) || (state_q == Line && none && free_i);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q <= Rest;
    end else begin
      case (state_q)
        Rest: if (start_i) state_q <= frame_i.empty ? Line : Audit;
        Audit: if (second_q && last_slot) state_q <= Settle;
        Settle: if (settled_q) state_q <= fault_i == ErrorNone ? Line : Rest;
        Line: if (free_i) state_q <= Slot;
        Slot:
        if (crosses) state_q <= Wait;
        else if (!skip) state_q <= Pad;
        Wait: if (go) state_q <= Send;
        Send: if (lanes_end_i) state_q <= loaded ? Pad : Drain;
        Drain: if (idle_i && vector_idle_i && !words_i) state_q <= Form;
        Form: if (form_end_i) state_q <= Pad;
        Finish: if (finish_i) state_q <= Rest;
        default: ;
      endcase
      if (next) state_q <= Slot;
      if (line_end) state_q <= y_q == frame_i.last_y ? Finish : Line;
    end
  end

  always_ff @(posedge clk_i) begin
    settled_q <= state_q == Settle;
    if (state_q == Rest) begin
      slot_q <= '0;
      second_q <= 1'b0;
      y_q <= '0;
      form_valid_q <= 1'b0;
      abort_q <= 1'b0;
    end else begin
      if (abort_i) abort_q <= 1'b1;
      if (line_end) y_q <= y_q + 1'b1;
      if (state_q == Line) slot_q <= '0;
      else if (next || (state_q == Audit && second_q)) slot_q <= slot_q + 1'b1;
      if (state_q == Audit) second_q <= !second_q;
      if (state_q == Form) begin
        form_slot_q  <= slot_q;
        form_valid_q <= form_end_i;
      end
    end
    if (state_q == Slot) pad_q <= frame_i.last_x;
    else if (state_q == Wait) pad_q <= outside;
    else if (state_q == Pad && idle_i && !words_i) pad_q <= pad_q - 1'b1;
  end

  assign busy_o = state_q != Rest;
  assign rest_o = state_q == Rest;
  assign slot_o = slot_q;
  assign audit_o = state_q == Audit;
  assign second_o = second_q;
  assign error_o = state_q == Settle && settled_q ? fault_i : ErrorNone;
  assign y_o = y_q;
  assign wait_o = state_q == Wait;
  assign lanes_o = state_q == Send;
  assign form_o = state_q == Form;
  assign loaded_o = loaded;
  assign add_o = go;
  assign line_end_o = line_end;
  always_comb begin
    skipped_o = '0;
    if (skip && go) skipped_o = {1'b0, outside};
    if (skip && state_q == Slot && !crosses) skipped_o = {1'b0, frame_i.last_x} + 1'b1;
  end
  wire unused = &{1'b0, frame_i, info_i};

endmodule

`default_nettype wire
