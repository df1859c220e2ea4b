// SPDX-License-Identifier: Apache-2.0
// rdx_fdiff: at column x and row y of its walk the value is the polynomial of x and y that its words give,
//   f + x dx + y dy + x(x-1)/2 dxx + x y dxy + y(y-1)/2 dyy,
// or the sum of the differences on the way there: down the first column, then along the row.
//
// Proved with the lane's other differences along: each register is a polynomial, too.
`default_nettype none
`include "formal.svh"

module formal_fdiff #(
    parameter int unsigned W = 8,
    parameter bit Quadratic = 1'b1,
    parameter int unsigned Places = 2,  // bits of x and y
    parameter int unsigned Stage = 3,
    parameter bit Sums = 1'b0  // the polynomial as the sums of its differences, as the registers have it
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

  // ---- the polynomial: as such, or as the sums of its differences ----
  localparam type number_t = logic signed [W-1:0];
  wire number_t xx = Quadratic ? dxx : '0;
  wire number_t xy = Quadratic ? dxy : '0;
  wire number_t yy = Quadratic ? dyy : '0;
  number_t at, slope_at, row_at, row_slope_at, rise_at;  // at x and y: what the registers should hold
  if (Sums) begin : gen_sums
    number_t column[1<<Places], rise[1<<Places], slope[1<<Places];  // down the first column
    number_t along[1<<Places], next[1<<Places];  // along the row
    always_comb begin
      {column[0], rise[0], slope[0]} = {f, dy, dx};
      for (int k = 1; k < 1 << Places; k++) begin
        column[k] = column[k-1] + rise[k-1];
        rise[k]   = rise[k-1] + yy;
        slope[k]  = slope[k-1] + xy;
      end
      {row_at, rise_at, row_slope_at} = {column[y_q], rise[y_q], slope[y_q]};
      {along[0], next[0]} = {row_at, row_slope_at};
      for (int k = 1; k < 1 << Places; k++) begin
        along[k] = along[k-1] + next[k-1];
        next[k]  = next[k-1] + xx;
      end
      {at, slope_at} = {along[x_q], next[x_q]};
    end
  end else begin : gen_polynomial
    function automatic number_t times(int unsigned number, number_t value);
      number_t sum;
      sum = '0;
      for (int i = 0; i < 2 * Places; i++) if (number[i]) sum = sum + (value <<< i);
      return sum;
    endfunction
    wire [31:0] x = 32'(x_q);
    wire [31:0] y = 32'(y_q);
    wire [31:0] pairs_x = (x * (x - 1)) >> 1;
    wire [31:0] pairs_y = (y * (y - 1)) >> 1;
    assign row_at = f + times(y, dy) + times(pairs_y, yy);
    assign rise_at = dy + times(y, yy);
    assign row_slope_at = dx + times(y, xy);
    assign at = row_at + times(x, row_slope_at) + times(pairs_x, xx);
    assign slope_at = row_slope_at + times(x, xx);
  end
  // while words come in, and what they are
  `LEMMA(0, p_begin, ready || !loaded[0] || (u_fdiff.value_q == f && u_fdiff.row_value_q == f))
  `LEMMA(0, p_begin_x, ready || !loaded[1] || (u_fdiff.slope_q == dx && u_fdiff.row_slope_q == dx))
  `LEMMA(0, p_begin_y, ready || !loaded[2] || u_fdiff.row_rise_q == dy)
  `LEMMA(0, p_begin_place, ready || loaded == '0 || (x_q == '0 && y_q == '0))
  `LEMMA(0, p_second, (!ready && loaded[5:3] != '1) || (u_fdiff.dxx == xx && u_fdiff.dxy == xy && u_fdiff.dyy == yy))
  `LEMMA(0, p_second_x, !loaded[3] || u_fdiff.dxx == dxx)
  `LEMMA(0, p_second_xy, !loaded[4] || u_fdiff.dxy == dxy)
  `LEMMA(0, p_second_y, !loaded[5] || u_fdiff.dyy == dyy)
  // then the registers, each from those that it is made of
  `LEMMA(1, p_rise, !ready || u_fdiff.row_rise_q == rise_at)
  `LEMMA(1, p_row_slope, !ready || u_fdiff.row_slope_q == row_slope_at)
  `LEMMA(2, p_row, !ready || u_fdiff.row_value_q == row_at)
  `LEMMA(2, p_slope, !ready || u_fdiff.slope_q == slope_at)
  `LEMMA(3, p_value, !ready || value == at)
  `REACH(r_corner, ready && x_q == '1 && y_q == '1)

endmodule

`default_nettype wire
