// SPDX-License-Identifier: Apache-2.0
// rdx_bound: a cell of one sign is excluded if, and only if, one of the bounds of docs/spirals.md ("Two bounds") says so, in
// exact numbers. The least value of the format, which no indicator has, is left out.
`default_nettype none
`include "formal.svh"

module formal_bound #(
    parameter int unsigned N1 = 3,
    parameter int unsigned Stage = 1,
    localparam int unsigned J = 1 << N1,
    localparam int unsigned Z = $clog2(rdx_pkg::Zones)
) (
    input wire logic                     clk_i,
    input wire rdx_pkg::form_t           form_i,
    input wire logic             [Z-1:0] zone_i,
    input wire logic             [  4:0] level_i,
    input wire rdx_pkg::vector_t         values_i[J+1]
);
  import rdx_pkg::*;

  logic [J-1:0] possible;
  rdx_bound #(
      .N1(N1)
  ) u_bound (
      .clk_i,
      .form_i,
      .zone_i,
      .level_i,
      .values_i,
      .possible_o(possible)
  );

  localparam type number_t = logic [57:0];
  `GIVEN(g_level, 32'(level_i) < 32 / N1)

  logic [2:0] clocks = '0;

  // ---- the bounds of the cell, rounded up, two clocks before the values ----
  number_t change, curvature, change_q, curvature_q;
  logic curved, curved_q;
  wire [5:0] digits = 6'(N1) * (6'(level_i) + 6'd1);  // the cell is 2^-digits of the segment
  assign change = (number_t'(form_i.lipschitz[zone_i]) >> digits) + 58'd1;
  wire [6:0] since = 7'(2 * N1) * 7'(6'(level_i) - form_i.from_level[zone_i]);  // the word is that of from_level
  assign curved = 6'(level_i) >= form_i.from_level[zone_i];
  assign curvature = (number_t'(form_i.curvature[zone_i]) >> (curved ? since : 7'd0)) + 58'd1;
  number_t change_d[2], curvature_d[2];
  logic curved_d[2];
  always_ff @(posedge clk_i) begin
    {change_d[0], curvature_d[0], curved_d[0]} <= {change, curvature, curved};
    {change_d[1], curvature_d[1], curved_d[1]} <= {change_d[0], curvature_d[0], curved_d[0]};
    {change_q, curvature_q, curved_q} <= {change_d[1], curvature_d[1], curved_d[1]};
  end

  // the module keeps them in 39 bits, the largest of which no sum of two magnitudes exceeds
  localparam number_t Most = number_t'({VectorWidth + 1{1'b1}});
  `LEMMA(0, p_change, clocks < 3'd3 || number_t'(u_bound.most_q) == (change_q > Most ? Most : change_q))
  `LEMMA(0, p_curvature,
         clocks < 3'd3 || !curved_q || number_t'(u_bound.bend_q) == (curvature_q > Most ? Most : curvature_q))
  `LEMMA(0, p_curved, clocks < 3'd3 || u_bound.curved_q == curved_q)

  logic [J-1:0] wanted, wanted_d[2], wanted_q, one_sign, one_sign_d[2], one_sign_q;
  for (genvar j = 0; j < J; j++) begin : gen_cell
    number_t left, right, sum;
    logic none;
    always_comb begin
      left  = 58'(values_i[j]);
      right = 58'(values_i[j+1]);
      if (values_i[j] < 0) left = -left;
      if (values_i[j+1] < 0) right = -right;
      sum  = left + right;
      none = sum > change_d[1];
      if (curved_d[1] && values_i[j] > 0)
        none = none || sum > curvature_d[1] || (4 * left > curvature_d[1] && 4 * right > curvature_d[1]);
    end
    assign wanted[j]   = !none;
    assign one_sign[j] = (values_i[j] > 0) == (values_i[j+1] > 0);
  end
  for (genvar j = 0; j <= J; j++) begin : gen_boundary
    `GIVEN(g_value, values_i[j] != vector_t'({1'b1, {VectorWidth - 1{1'b0}}}))
  end
  always_ff @(posedge clk_i) begin
    {wanted_d[0], wanted_d[1], wanted_q} <= {wanted, wanted_d[0], wanted_d[1]};
    {one_sign_d[0], one_sign_d[1], one_sign_q} <= {one_sign, one_sign_d[0], one_sign_d[1]};
    if (clocks != 3'd5) clocks <= clocks + 1'b1;
  end
  `LEMMA(1, p_possible, clocks != 3'd5 || ((possible ^ wanted_q) & one_sign_q) == '0)
  `REACH(r_both, clocks == 3'd5 && one_sign_q == '1 && wanted_q != '0 && wanted_q != '1)

endmodule

`default_nettype wire
