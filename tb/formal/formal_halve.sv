// SPDX-License-Identifier: Apache-2.0
// rdx_halve: every value is that of de Casteljau, each average half up; ends; and that nothing leaves the hull of the inputs.
`default_nettype none
`include "formal.svh"

module formal_halve #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Stages = 0,
    parameter int unsigned Stage = D - 1
) (
    input wire logic                clk_i,
    input wire logic signed [W-1:0] b_i  [D+1],
    input wire logic signed [W-1:0] low,         // any bounds of the inputs: so the least and the largest of them, too
    input wire logic signed [W-1:0] high
);

  logic signed [W-1:0] left [D+1];
  logic signed [W-1:0] right[D+1];
  rdx_halve #(
      .W(W),
      .D(D),
      .Stages(Stages)
  ) u_halve (
      .clk_i,
      .b_i,
      .left_o (left),
      .right_o(right)
  );

  for (genvar i = 0; i <= D; i++) begin : gen_point
    `GIVEN(g_bounds, low <= b_i[i] && b_i[i] <= high)
  end
  // row after row of the averages, each from the one before
  for (genvar r = 1; r < D; r++) begin : gen_row
    for (genvar i = 0; i <= D - r; i++) begin : gen_average
      `LEMMA(r - 1, p_row, low <= u_halve.gen_row[r].work_d[i] && u_halve.gen_row[r].work_d[i] <= high)
    end
  end
  if (Stage == D - 1) begin : gen_all
    for (genvar i = 0; i <= D; i++) begin : gen_hull
      `CHECK(p_left, low <= left[i] && left[i] <= high)
      `CHECK(p_right, low <= right[i] && right[i] <= high)
    end
  end
  `CHECK(p_first, left[0] == b_i[0])
  `CHECK(p_last, right[D] == b_i[D])
  `CHECK(p_shared, left[D] == right[0])

  // each average is of its two neighbours in the row before: twice it is their sum, or one more; and is what the halves get
  for (genvar r = 1; r <= D; r++) begin : gen_casteljau
    for (genvar i = 0; i <= D - r; i++) begin : gen_average
      logic signed [W-1:0] x, y;
      if (r == 1) begin : gen_first
        assign x = b_i[i];
        assign y = b_i[i+1];
      end else begin : gen_next
        assign x = u_halve.gen_row[r-1].work_d[i];
        assign y = u_halve.gen_row[r-1].work_d[i+1];
      end
      wire signed [W:0] sum = (W + 1)'(x) + (W + 1)'(y);
      wire signed [W:0] twice = (W + 1)'(u_halve.gen_row[r].work_d[i]) * 2;
      `CHECK(p_half_up, twice == sum + (W + 1)'(sum[0]))
    end
    `CHECK(p_left_value, left[r] == u_halve.gen_row[r].work_d[0])
    `CHECK(p_right_value, right[D-r] == u_halve.gen_row[r].work_d[D-r])
  end

  `REACH(r_tight, low == high)
  `REACH(r_whole,
         low == {1'b1, {(W - 1) {1'b0}}} && high == {1'b0, {(W - 1) {1'b1}}} && b_i[0] == low && b_i[D] == high)

endmodule

`default_nettype wire
