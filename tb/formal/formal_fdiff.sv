// SPDX-License-Identifier: Apache-2.0
// rdx_fdiff: at column x and row y of its walk the value is the polynomial of x and y that its words give.
//
// Proved with the lane's other differences along: each register is a polynomial, too.
`default_nettype none
`include "formal.svh"

module formal_fdiff #(
    parameter int unsigned W = 8,
    parameter bit Quadratic = 1'b1,
    parameter int unsigned Places = 2  // bits of x and y
) (
    input wire logic        clk_i,
    input wire logic        load_i,
    input wire logic [ 2:0] index_i,
    input wire logic [63:0] word_i,
    input wire logic        pixel_i,
    input wire logic        row_i
);

  logic signed [W-1:0] value;
  rdx_fdiff #(
      .W(W),
      .Quadratic(Quadratic)
  ) u_fdiff (
      .clk_i,
      .load_i,
      .index_i,
      .word_i,
      .pixel_i,
      .row_i,
      .value_o(value)
  );

  // ---- the words, and the place: all words are loaded before the walk begins, or again after it has ended ----
  logic signed [W-1:0] f, dx, dy, dxx, dxy, dyy;
  logic [5:0] loaded = '0;
  logic [Places-1:0] x_q, y_q;
  wire ready = loaded == (Quadratic ? 6'h3f : 6'h07);
  `GIVEN(g_index, index_i < (Quadratic ? 3'd6 : 3'd3))
  `GIVEN(g_words, ready || !(row_i || pixel_i) || load_i)
  `GIVEN(g_columns, !(pixel_i && !row_i && !load_i) || x_q != '1)
  `GIVEN(g_rows, !(row_i && !load_i) || y_q != '1)
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      loaded <= (ready ? 6'h00 : loaded) | 6'(1) << index_i;
      if (index_i == 3'd0) f <= word_i[W-1:0];
      if (index_i == 3'd1) dx <= word_i[W-1:0];
      if (index_i == 3'd2) dy <= word_i[W-1:0];
      if (index_i == 3'd3) dxx <= word_i[W-1:0];
      if (index_i == 3'd4) dxy <= word_i[W-1:0];
      if (index_i == 3'd5) dyy <= word_i[W-1:0];
      x_q <= '0;
      y_q <= '0;
    end else if (row_i) begin
      x_q <= '0;
      y_q <= y_q + 1'b1;
    end else if (pixel_i) begin
      x_q <= x_q + 1'b1;
    end
  end

  // ---- the polynomial ----
  localparam type number_t = logic signed [W-1:0];
  function automatic number_t times(int unsigned number, number_t value);
    number_t sum;
    sum = '0;
    for (int i = 0; i < 2 * Places; i++) if (number[i]) sum = sum + (value <<< i);
    return sum;
  endfunction
  wire number_t xx = Quadratic ? dxx : '0;
  wire number_t xy = Quadratic ? dxy : '0;
  wire number_t yy = Quadratic ? dyy : '0;
  wire [31:0] x = 32'(x_q);
  wire [31:0] y = 32'(y_q);
  wire [31:0] pairs_x = (x * (x - 1)) >> 1;
  wire [31:0] pairs_y = (y * (y - 1)) >> 1;
  wire number_t row = f + times(y, dy) + times(pairs_y, yy);
  wire number_t slope = dx + times(y, xy);
  `CHECK(p_value, !ready || value == row + times(x, slope) + times(pairs_x, xx))
  `CHECK(p_slope, !ready || u_fdiff.slope_q == slope + times(x, xx))
  `CHECK(p_row, !ready || (u_fdiff.row_value_q == row && u_fdiff.row_slope_q == slope))
  `CHECK(p_rise, !ready || u_fdiff.row_rise_q == dy + times(y, yy))
  // while words come in, and what they are
  `CHECK(p_begin, ready || !loaded[0] || (u_fdiff.value_q == f && u_fdiff.row_value_q == f))
  `CHECK(p_begin_x, ready || !loaded[1] || (u_fdiff.slope_q == dx && u_fdiff.row_slope_q == dx))
  `CHECK(p_begin_y, ready || !loaded[2] || u_fdiff.row_rise_q == dy)
  `CHECK(p_begin_place, ready || loaded == '0 || (x_q == '0 && y_q == '0))
  `CHECK(p_second, (!ready && loaded[5:3] != '1) || (u_fdiff.dxx == xx && u_fdiff.dxy == xy && u_fdiff.dyy == yy))
  `CHECK(p_second_x, !loaded[3] || u_fdiff.dxx == dxx)
  `CHECK(p_second_xy, !loaded[4] || u_fdiff.dxy == dxy)
  `CHECK(p_second_y, !loaded[5] || u_fdiff.dyy == dyy)
  `REACH(r_corner, ready && x_q == '1 && y_q == '1)

endmodule

`default_nettype wire
