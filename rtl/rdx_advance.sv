// SPDX-License-Identifier: Apache-2.0
// Descriptor words become those of a row, and are moved on to the next row.
//
// The words asked for come out of the table; those that change from row to row are kept here, so that the table stays as it
// is. Of a lane the value, difference per column and difference per row change: by dy, dxy and dyy.
//
// Formats    ask_i.word is not used; ask_i.index counts the words of a lane, 0 to 5, as in a descriptor. table_i: the word asked
//            for, a clock later. load_o: for rdx_scan; value, difference and second difference have index 0, 1, 2.
// Rounding   none: exact.    Overflow   wraps; compile scales the lanes so that it does not.
// Timing     a word a clock; load_o two clocks after ask_i. A slot's row may be asked for again when four clocks have passed.
// Reset      control only.
// Model      model/raydix/fdiff.py (next_row)
`default_nettype none

module rdx_advance #(
    parameter int unsigned Slots = 64,
    localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic ask_valid_i,
    input wire rdx_pkg::row_word_t ask_i,
    input wire logic [SlotWidth-1:0] slot_i,
    input wire logic first_i,  // the surface's first row: all words are those of the table
    input wire rdx_pkg::pixel_t y_i,  // the row
    input wire logic [63:0] table_i,
    output logic busy_o,  // a word is under way
    output logic load_valid_o,
    output rdx_pkg::row_word_t load_o
);
  import rdx_pkg::*;

  typedef struct packed {
    row_kind_e            kind;
    logic                 last;
    logic [3:0]           lane;
    logic [6:0]           index;
    logic                 kept;   // comes from here, not from the table
    logic [SlotWidth-1:0] slot;
  } tag_t;

  wire quadratic = ask_i.lane >= 4'(CoordLanes);
  wire kept = ask_i.kind == RowLane && !first_i && (quadratic ? ask_i.index < 7'd3 : ask_i.index == 7'd0);
  logic valid_q, valid_qq;
  tag_t tag_q, tag_qq;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) {valid_q, valid_qq} <= '0;
    else {valid_q, valid_qq} <= {ask_valid_i, valid_q};
  end

  // ---- what changes from row to row ----
  logic [63:0] memory[64<<SlotWidth];
  logic [63:0] kept_q, word_q, sum_q;
  logic write_q;
  logic [SlotWidth+5:0] write_place_q;
  always_ff @(posedge clk_i) begin
    kept_q <= memory[{slot_i, ask_i.lane, ask_i.index[1:0]}];
    if (write_q) memory[write_place_q] <= sum_q;
  end
  always_ff @(posedge clk_i) begin
    tag_q  <= '{kind: ask_i.kind, last: ask_i.last, lane: ask_i.lane, index: ask_i.index, kept: kept, slot: slot_i};
    tag_qq <= tag_q;
    word_q <= tag_q.kept ? kept_q : table_i;
    if (tag_q.kind == RowHeader && tag_q.index == 7'd1) word_q[16+:PixelWidth] <= y_i;
  end

  // ---- moved on ----
  wire lane = valid_qq && tag_qq.kind == RowLane;
  logic [63:0] value_q, slope_q, rise_q;
  always_ff @(posedge clk_i) begin
    if (lane) begin
      case (tag_qq.index[2:0])
        3'd0: value_q <= word_q;
        3'd1: slope_q <= word_q;
        3'd2: rise_q <= word_q;
        default: ;
      endcase
    end
    sum_q <= word_q + (tag_qq.index[2:0] == 3'd2 ? value_q : tag_qq.index[2:0] == 3'd4 ? slope_q : rise_q);
    write_place_q <= {
      tag_qq.slot, tag_qq.lane, tag_qq.index[2:0] == 3'd2 ? 2'd0 : tag_qq.index[2:0] == 3'd4 ? 2'd1 : 2'd2
    };
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) write_q <= 1'b0;
    else write_q <= lane && (tag_qq.index == 7'd2 || tag_qq.index == 7'd4 || tag_qq.index == 7'd5);
  end

  // ---- to the row: value, difference, second difference per column ----
  wire wanted = tag_qq.kind != RowLane || tag_qq.index < 7'd2 || tag_qq.index == 7'd3;
  assign load_valid_o = valid_qq && (wanted || tag_qq.last);
  always_comb begin
    load_o = '{kind: tag_qq.kind, last: tag_qq.last, lane: tag_qq.lane, index: tag_qq.index, word: word_q};
    if (tag_qq.kind == RowLane && tag_qq.index == 7'd3) load_o.index = 7'd2;
    else if (tag_qq.kind == RowLane && !wanted) load_o.index = 7'd3;  // nobody's; only the mark counts
  end
  assign busy_o = valid_q || valid_qq || write_q;
  wire unused = &{1'b0, ask_i.word, tag_qq};

endmodule

`default_nettype wire
