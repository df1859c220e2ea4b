// SPDX-License-Identifier: Apache-2.0
// The gradient at a point of the tube or of a ball, scaled to 18 bits.
//
// Tube: the gradient turned to azimuth 0 (outwards, side, upwards) is turned back by x, y and multiplied by the
// distance from the axis. Ball: the vector from its centre, turned by nothing. Upwards the gradient loses K twice: once
// for the length and once for the coordinate.
//
// Formats    point_i: s2p22, stop_i and ball_i with it. outwards_i, side_i, upwards_i: s3p25, a clock later. up_i:
//            distance from the axis over K, s2p16, three clocks later. gradient_o: s1p17; at most 7 sign bits are
//            shifted out: more there are only next to the axis.
// Rounding   floor.    Overflow   cannot happen.
// Timing     latency SwirlGradientLatency = 8 clocks, one point a clock; material_i two clocks before. No
//            reset.
// Model      model/raydix/swirl.py (swirl)
`default_nettype none

module rdx_swirl_gradient #(
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                        clk_i,
    input  wire rdx_pkg::material_write_t    write_i,
    input  wire rdx_pkg::material_t          material_i,
    input  wire rdx_swirl_pkg::swirl_coord_t point_i   [3],
    input  wire logic                        stop_i,
    input  wire logic                        ball_i,
    input  wire rdx_swirl_pkg::slope_t       outwards_i,
    input  wire rdx_swirl_pkg::slope_t       side_i,
    input  wire rdx_swirl_pkg::slope_t       upwards_i,
    input  wire rdx_pkg::normal_t            up_i,
    output rdx_pkg::normal_t                 gradient_o[3]
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Product = 2 * NormalWidth;
  localparam int unsigned Drop = 7;
  localparam int unsigned Width = Product + 1 - Drop;
  localparam type product_t = logic signed [Product-1:0];
  localparam type sum_t = logic signed [Product:0];
  localparam type kept_t = logic signed [Width-1:0];

  // ---- first clock: from the centre of the ball ----
  slope_t legs_q[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    swirl_coord_t from_start, from_stop, centre;
    rdx_constant #(
        .W(SwirlCoordWidth),
        .Index(SwirlStart + axis),
        .Surfaces(Surfaces)
    ) u_start (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(from_start)
    );
    rdx_constant #(
        .W(SwirlCoordWidth),
        .Index(SwirlStop + axis),
        .Surfaces(Surfaces)
    ) u_stop (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(from_stop)
    );
    assign centre = stop_i ? from_stop : from_start;
    wire slope_t place = slope_t'(point_i[axis]) <<< (SlopeWidth - 3 - SwirlFrac);
    wire slope_t origin = slope_t'(centre) <<< (SlopeWidth - 3 - SwirlFrac);
    always_ff @(posedge clk_i) legs_q[axis] <= axis == 1 ? origin - place : place - origin;
  end

  // ---- second: of the ball or of the tube; two more: 18 bits ----
  slope_t slopes_q[3];
  normal_t slopes[3];
  logic [2:0] ball_q;
  always_ff @(posedge clk_i) begin
    ball_q <= {ball_q[1:0], ball_i};
    slopes_q[0] <= ball_q[0] ? legs_q[0] : outwards_i;
    slopes_q[1] <= ball_q[0] ? legs_q[1] : side_i;
    slopes_q[2] <= ball_q[0] ? legs_q[2] : upwards_i;
  end
  rdx_normalize #(
      .WIn  (SlopeWidth),
      .WOut (NormalWidth),
      .Count(3),
      .Limit(7)
  ) u_slopes (
      .clk_i,
      .en_i(1'b1),
      .values_i(slopes_q),
      .values_o(slopes)
  );

  // ---- what they are multiplied with ----
  normal_t turn_q[3][2], x_q, y_q, up_q;
  always_ff @(posedge clk_i) begin
    for (int unsigned axis = 0; axis < 2; axis++) begin
      turn_q[0][axis] <= normal_t'(point_i[axis] >>> (SwirlFrac - 16));
      for (int unsigned i = 1; i < 3; i++) turn_q[i][axis] <= turn_q[i-1][axis];
    end
    x_q  <= ball_q[2] ? normal_t'(1 << 16) : turn_q[2][0];
    y_q  <= ball_q[2] ? '0 : turn_q[2][1];
    up_q <= ball_q[2] ? normal_t'(SwirlFlat >> 1) : up_i;
  end

  // ---- fifth clock: products; sixth: sums; two more: 18 bits ----
  product_t product_q[5];
  kept_t sum_q[3];
  always_ff @(posedge clk_i) begin
    product_q[0] <= product_t'(slopes[0]) * product_t'(x_q);
    product_q[1] <= product_t'(slopes[1]) * product_t'(y_q);
    product_q[2] <= product_t'(slopes[0]) * product_t'(y_q);
    product_q[3] <= product_t'(slopes[1]) * product_t'(x_q);
    product_q[4] <= product_t'(slopes[2]) * product_t'(up_q);
    sum_q[0] <= kept_t'((sum_t'(product_q[0]) + sum_t'(product_q[1])) >>> Drop);
    sum_q[1] <= kept_t'((sum_t'(product_q[2]) - sum_t'(product_q[3])) >>> Drop);
    sum_q[2] <= kept_t'(sum_t'(product_q[4]) >>> Drop);
  end
  rdx_normalize #(
      .WIn  (Width),
      .WOut (NormalWidth),
      .Count(3),
      .Limit(7)
  ) u_gradient (
      .clk_i,
      .en_i(1'b1),
      .values_i(sum_q),
      .values_o(gradient_o)
  );

endmodule

`default_nettype wire
