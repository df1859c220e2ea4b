// SPDX-License-Identifier: Apache-2.0
// Forward differences along a row: a polynomial of the column, linear or quadratic, with one addition or two a pixel.
//
// The next row's words are written into a shadow while this one is walked.
//
// Formats    word_i: 64-bit words of the lane: value, difference and, if Quadratic, second difference; the low W bits
//            count. value_o: sWp0 (the caller knows the scale).
// Rounding   none: exact.
// Overflow   wraps; compile scales the lane so that it does not.
// Timing     value_o is a register; it follows start_i (the shadow's row begins) and step_i by one clock.
// Model      model/raydix/fdiff.py
`default_nettype none

module rdx_lane #(
    parameter int unsigned W = 64,
    parameter bit Quadratic = 1'b1
) (
    input  wire logic           clk_i,
    input  wire logic           load_i,   // word_i is word index_i of this lane
    input  wire logic   [  1:0] index_i,
    input  wire logic   [ 63:0] word_i,
    input  wire logic           start_i,  // first pixel of the row in the shadow
    input  wire logic           step_i,   // one pixel to the right
    output logic signed [W-1:0] value_o
);

  logic signed [W-1:0] word;
  logic signed [W-1:0] next_value_q, next_slope_q;
  logic signed [W-1:0] value_q, slope_q, curve;
  assign word = word_i[W-1:0];
  if (W < 64) begin : gen_narrow
    wire unused = &{1'b0, word_i[63:W]};
  end

  if (Quadratic) begin : gen_quadratic
    logic signed [W-1:0] next_curve_q, curve_q;
    always_ff @(posedge clk_i) begin
      if (load_i && index_i == 2'd2) next_curve_q <= word;
      if (start_i) curve_q <= next_curve_q;
    end
    assign curve = curve_q;
  end else begin : gen_linear
    assign curve = '0;
  end

  always_ff @(posedge clk_i) begin
    if (load_i && index_i == 2'd0) next_value_q <= word;
    if (load_i && index_i == 2'd1) next_slope_q <= word;
    if (start_i) begin
      value_q <= next_value_q;
      slope_q <= next_slope_q;
    end else if (step_i) begin
      value_q <= value_q + slope_q;
      slope_q <= slope_q + curve;
    end
  end

  assign value_o = value_q;

endmodule

`default_nettype wire
