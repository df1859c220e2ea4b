// SPDX-License-Identifier: Apache-2.0
// Forward differences: a polynomial of the pixel, linear or quadratic, with one addition or two a pixel.
//
// Formats    word_i: 64-bit words of the lane: value, dx, dy and, if Quadratic, dxx, dxy, dyy; the low W bits count.
//            value_o: sWp0 (the caller knows the scale).
// Rounding   none: exact.
// Overflow   wraps; compile scales the lane so that it does not (docs/number-formats.md).
// Timing     value_o is a register; it follows load_i (index 0), pixel_i and row_i by one clock.
// Model      model/raydix/fdiff.py
`default_nettype none

module rdx_fdiff #(
    parameter int unsigned W = 64,
    parameter bit Quadratic = 1'b1
) (
    input  wire logic           clk_i,
    input  wire logic           load_i,   // word_i is word index_i of this lane
    input  wire logic   [  2:0] index_i,
    input  wire logic   [ 63:0] word_i,
    input  wire logic           pixel_i,  // one pixel to the right
    input  wire logic           row_i,    // first pixel of the next row
    output logic signed [W-1:0] value_o
);

  logic signed [W-1:0] word;
  logic signed [W-1:0] value_q, slope_q;  // at the pixel: value, x-difference
  logic signed [W-1:0] row_value_q, row_slope_q;  // the same at the row's first pixel
  logic signed [W-1:0] row_rise_q;  // y-difference there
  logic signed [W-1:0] dxx, dxy, dyy;  // second differences

  assign word = word_i[W-1:0];
  if (W < 64) begin : gen_narrow
    wire unused = &{1'b0, word_i[63:W]};
  end

  if (Quadratic) begin : gen_quadratic
    logic signed [W-1:0] dxx_q, dxy_q, dyy_q;
    always_ff @(posedge clk_i) begin
      if (load_i && index_i == 3'd3) dxx_q <= word;
      if (load_i && index_i == 3'd4) dxy_q <= word;
      if (load_i && index_i == 3'd5) dyy_q <= word;
    end
    assign {dxx, dxy, dyy} = {dxx_q, dxy_q, dyy_q};
  end else begin : gen_linear
    assign {dxx, dxy, dyy} = '0;
  end

  wire signed [W-1:0] next_row_value = row_value_q + row_rise_q;
  wire signed [W-1:0] next_row_slope = row_slope_q + dxy;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      if (index_i == 3'd0) {value_q, row_value_q} <= {word, word};
      if (index_i == 3'd1) {slope_q, row_slope_q} <= {word, word};
      if (index_i == 3'd2) row_rise_q <= word;
    end else if (row_i) begin
      {value_q, row_value_q} <= {next_row_value, next_row_value};
      {slope_q, row_slope_q} <= {next_row_slope, next_row_slope};
      row_rise_q <= row_rise_q + dyy;
    end else if (pixel_i) begin
      value_q <= value_q + slope_q;
      slope_q <= slope_q + dxx;
    end
  end

  assign value_o = value_q;

endmodule

`default_nettype wire
