// SPDX-License-Identifier: Apache-2.0
// Radius and azimuth of a point, and the point itself where the stages of rdx_swirl want it.
//
// Formats    point_i: s2p30. rho_o, rho_legs_o: K times the distance from the axis, s4p22. azimuth_o: turns, u0p22. The
//            others: coordinates s2p22.
// Rounding   down, once of each coordinate; rdx_cordic.    Overflow   cannot happen.
// Timing     clocks after point_i: point_side_o SwirlSide; rho_o, azimuth_o, z_o one more; rho_legs_o and
//            z_legs_o SwirlLegs + 2; point_o SwirlChoice. A point a clock.
// Reset      of the waiting lines' places only.
// Model      model/raydix/swirl.py (polar)
`default_nettype none

module rdx_swirl_polar (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    input  wire rdx_pkg::coord_t        point_i     [3],
    output rdx_swirl_pkg::swirl_coord_t point_side_o[3],
    output rdx_swirl_pkg::swirl_t       rho_o,
    output rdx_swirl_pkg::azimuth_t     azimuth_o,
    output rdx_swirl_pkg::swirl_coord_t z_o,
    output rdx_swirl_pkg::swirl_t       rho_legs_o,
    output rdx_swirl_pkg::swirl_coord_t z_legs_o,
    output rdx_swirl_pkg::swirl_coord_t point_o     [3]
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam type plane_t = logic [2*SwirlCoordWidth-1:0];

  swirl_coord_t point[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    assign point[axis] = swirl_coord_t'(point_i[axis] >>> (CoordFrac - SwirlFrac));
    wire unused = &{1'b0, point_i[axis]};
  end
  angle_t angle;
  rdx_cordic #(
      .W(SwirlWidth),
      .Iterations(SwirlIterations),
      .Still(SwirlStill),
      .Angle(1'b1)
  ) u_polar (
      .clk_i,
      .en_i(1'b1),
      .x_i(swirl_t'(point[0])),
      .y_i(swirl_t'(point[1])),
      .x_o(rho_o),
      .angle_o(angle)
  );
  assign azimuth_o = azimuth_t'(angle >> (AngleWidth - SwirlFrac));

  // ---- x, y ----
  plane_t plane_later, plane[1];
  rdx_line #(
      .W(3 * SwirlCoordWidth),
      .Depth(SwirlSide)
  ) u_to_side (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({point[2], point[1], point[0]}),
      .data_o({point_side_o[2], point_side_o[1], point_side_o[0]})
  );
  rdx_line #(
      .W($bits(plane_t)),
      .Depth(SwirlSide)
  ) u_plane (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({point_side_o[1], point_side_o[0]}),
      .data_o(plane_later)
  );
  rdx_delay #(
      .T(plane_t),
      .Depth(SwirlChoice - 2 * SwirlSide)
  ) u_plane_choice (
      .clk_i,
      .data_i('{plane_later}),
      .data_o(plane)
  );
  assign {point_o[1], point_o[0]} = plane[0];

  // ---- z ----
  always_ff @(posedge clk_i) z_o <= point_side_o[2];
  rdx_line #(
      .W(SwirlWidth + SwirlCoordWidth),
      .Depth(SwirlTurnLatency + 2)
  ) u_to_legs (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({rho_o, z_o}),
      .data_o({rho_legs_o, z_legs_o})
  );
  rdx_line #(
      .W(SwirlCoordWidth),
      .Depth(SwirlChoice - SwirlLegs - 2)
  ) u_z_choice (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(z_legs_o),
      .data_o(point_o[2])
  );
  wire unused_angle = &{1'b0, angle};

endmodule

`default_nettype wire
