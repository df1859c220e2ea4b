// SPDX-License-Identifier: Apache-2.0
// Counts through the descriptor words of a row: header, lanes, and the constants of a vector sum.
//
// Formats    place_o: number of the word in the descriptor. ask_o: see rdx_advance.
// Timing     start_i: begin at word 0 in the next clock; lanes_i, form_i: a word in this clock. lanes_end_o, form_end_o: it is the
//            last one.
// Reset      none: start_i.
// Model      none: the order of words
`default_nettype none

module rdx_ask (
    input  wire logic                clk_i,
    input  wire logic                start_i,
    input  wire logic                lanes_i,
    input  wire logic                form_i,
    input  wire logic                vector_i,
    input  wire logic                quartic_i,
    input  wire logic                loaded_i,     // the row ends with its lanes
    output logic               [6:0] place_o,
    output logic                     lanes_end_o,
    output logic                     form_end_o,
    output logic                     ask_valid_o,
    output rdx_pkg::row_word_t       ask_o
);
  import rdx_pkg::*;

  localparam int unsigned HeaderWords = 3;
  logic [6:0] place_q, index_q;
  logic [3:0] lane_q;
  wire lanes = place_q >= 7'(HeaderWords);
  wire lane_end = index_q == (lane_q < 4'(CoordLanes) ? 7'd2 : 7'd5);
  wire [3:0] last_lane = vector_i ? 4'(CoordLanes - 1) : quartic_i ? 4'(CoordLanes + 8) : 4'(CoordLanes + 2);
  assign lanes_end_o = lanes && lane_end && lane_q == last_lane;
  assign form_end_o  = index_q == 7'(FormWords - 1);

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      place_q <= '0;
      index_q <= '0;
      lane_q  <= '0;
    end else if (lanes_i || form_i) begin
      place_q <= place_q + 1'b1;
      index_q <= index_q + 1'b1;
      if (lanes_i && (place_q == 7'(HeaderWords - 1) || (lanes && lane_end))) index_q <= '0;
      if (lanes_i && lanes && lane_end) lane_q <= lane_q + 1'b1;
    end
  end

  assign place_o = place_q;
  assign ask_valid_o = lanes_i || form_i;
  assign ask_o = '{
          kind: form_i ? RowForm : lanes ? RowLane : RowHeader,
          last: form_i ? form_end_o : lanes_end_o && loaded_i,
          lane: lane_q,
          index: index_q,
          word: '0
      };

endmodule

`default_nettype wire
