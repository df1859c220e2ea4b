// SPDX-License-Identifier: Apache-2.0
// Which cells of a vector-sum surface may hold a root although the indicator has one sign at both ends.
//
// A cell is certain to hold none if the magnitudes at its ends add up to more than the indicator can change over it. From
// a level on a second bound holds outside of the solid: the indicator lies above its chord less x*(1-x)*curvature, so the
// cell holds none if the sum is above the curvature, or both are above a quarter of it. Both bounds depend on the zone: how
// near to the axis the step's boundaries come.
//
// Formats    zone_i, level_i: of the item whose values come two clocks later; values_i: indicator at the J+1
//            boundaries, s5p33. possible_o: bit j for cell j.
// Rounding   bounds are rounded up.
// Timing     possible_o follows values_i by rdx_pkg::BoundLatency = 3 clocks, values_i the zone by 2; one item a clock.
// Model      model/raydix/bound.py
`default_nettype none

module rdx_bound #(
    parameter  int unsigned N1 = 3,
    localparam int unsigned J  = 1 << N1,
    localparam int unsigned Z  = $clog2(rdx_pkg::Zones)
) (
    input  wire logic                     clk_i,
    input  wire rdx_pkg::form_t           form_i,
    input  wire logic             [Z-1:0] zone_i,
    input  wire logic             [  4:0] level_i,
    input  wire rdx_pkg::vector_t         values_i  [J+1],
    output logic                  [J-1:0] possible_o
);
  import rdx_pkg::*;

  localparam int unsigned BoundWidth = 56;
  localparam type bound_t = logic [BoundWidth-1:0];
  localparam type sum_t = logic [VectorWidth:0];

  // ---- the bounds: looked up, scaled to the cell, rounded up and cut to what a sum can be ----
  bound_t lipschitz_q, curvature_q, lipschitz_qq, curvature_qq;
  logic [5:0] from_level_q, digits_q, digits_qq;
  logic [6:0] bend_digits_qq;
  logic [4:0] level_q;
  sum_t most_q, bend_q;
  logic curved_qqq, curved_q;
  function automatic sum_t cut(bound_t bound);
    logic [BoundWidth:0] up;
    up = (BoundWidth + 1)'(bound) + 1'b1;
    return |up[BoundWidth:VectorWidth+1] ? '1 : up[VectorWidth:0];
  endfunction
  always_ff @(posedge clk_i) begin
    // the zone's, and digits of t at the cell's end
    lipschitz_q <= form_i.lipschitz[zone_i];
    curvature_q <= form_i.curvature[zone_i];
    from_level_q <= form_i.from_level[zone_i];
    level_q <= level_i;
    digits_q <= (6'(level_i) + 6'd1) * 6'(N1);
    // the curvature is that of from_level
    lipschitz_qq <= lipschitz_q;
    curvature_qq <= curvature_q;
    digits_qq <= digits_q;
    bend_digits_qq <= 7'(6'(level_q) - from_level_q) * 7'(2 * N1);
    curved_qqq <= 6'(level_q) >= from_level_q;
    most_q <= cut(lipschitz_qq >> digits_qq);
    bend_q <= cut(curvature_qq >> bend_digits_qq);
    curved_q <= curved_qqq;
  end

  // ---- first clock: magnitudes ----
  vector_t size_q[J+1];
  logic [J:0] positive_q;
  always_ff @(posedge clk_i) begin
    for (int unsigned j = 0; j <= J; j++) begin
      size_q[j] <= values_i[j] < 0 ? -values_i[j] : values_i[j];
      positive_q[j] <= values_i[j] > 0;
    end
  end

  // ---- second clock: their sums ----
  sum_t sum_q[J];
  logic [J:0] outside_q, flat_q;  // positive; above a quarter of the curvature
  sum_t most_qq, bend_qq;
  logic curved_qq;
  always_ff @(posedge clk_i) begin
    for (int unsigned j = 0; j < J; j++) sum_q[j] <= sum_t'(size_q[j]) + sum_t'(size_q[j+1]);
    for (int unsigned j = 0; j <= J; j++) begin
      flat_q[j] <= sum_t'(size_q[j]) > (bend_q >> 2);
    end
    outside_q <= positive_q;
    most_qq   <= most_q;
    bend_qq   <= bend_q;
    curved_qq <= curved_q;
  end

  // ---- third clock: the comparisons ----
  logic [J-1:0] possible;
  always_comb begin
    for (int unsigned j = 0; j < J; j++) begin
      possible[j] = sum_q[j] <= most_qq;
      if (curved_qq && outside_q[j] && (sum_q[j] > bend_qq || (flat_q[j] && flat_q[j+1]))) possible[j] = 1'b0;
    end
  end
  always_ff @(posedge clk_i) possible_o <= possible;
  wire unused = &{1'b0, form_i, outside_q[J]};

endmodule

`default_nettype wire
