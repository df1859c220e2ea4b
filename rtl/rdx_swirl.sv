// SPDX-License-Identifier: Apache-2.0
// The gradient of a spiral's indicator at a point of its surface, for shading: of reduced width, a point a clock.
//
// Radius and azimuth of the point, the turn that it belongs to, its legs from the tube's centre there, the slope of the
// distance; beside it, whether the ball at an end is nearer. Constants are read where they are needed, by surface and
// bank, so that points of different spirals may follow each other.
//
// Formats    point_i: x, y, z in s2p30, z carries K. gradient_o: in scaled coordinates, up to a positive factor, s1p17;
//            0 only where it vanishes. write_i: every write to the materials.
// Rounding   that of the parts.    Overflow   cannot happen at points of the surface.
// Timing     latency SwirlLatency clocks, one point a clock. Reset of the waiting lines' places only.
// Model      model/raydix/swirl.py (swirl). Error: docs/modules/swirl.md
`default_nettype none

module rdx_swirl #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::coord_t          point_i   [3],
    output rdx_pkg::normal_t              gradient_o[3]
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  material_t material_q[SwirlChoice];  // in each clock
  always_ff @(posedge clk_i) begin
    material_q[0] <= material_i;
    for (int unsigned i = 1; i < SwirlChoice; i++) material_q[i] <= material_q[i-1];
  end

  // ---- radius, azimuth, and the point for later ----
  swirl_t rho, rho_legs;
  azimuth_t azimuth;
  swirl_coord_t z, z_legs;
  swirl_coord_t point_side[3], point_choice[3];
  rdx_swirl_polar u_polar (
      .clk_i,
      .rst_ni,
      .point_i,
      .point_side_o(point_side),
      .rho_o(rho),
      .azimuth_o(azimuth),
      .z_o(z),
      .rho_legs_o(rho_legs),
      .z_legs_o(z_legs),
      .point_o(point_choice)
  );

  // ---- which turn, which ball ----
  place_t place;
  logic none, stop;
  logic [SwirlChoice-SwirlSide-SwirlSideLatency-1:0] stop_q;
  rdx_swirl_turn #(
      .General (General),
      .Surfaces(Surfaces)
  ) u_turn (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlSide-2]),
      .rho_i(rho),
      .z_i(z),
      .azimuth_i(azimuth),
      .place_o(place),
      .none_o(none)
  );
  rdx_swirl_side #(
      .General (General),
      .Surfaces(Surfaces)
  ) u_side (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlSide-3]),
      .point_i(point_side),
      .stop_o(stop)
  );
  always_ff @(posedge clk_i) stop_q <= {stop_q[$bits(stop_q)-2:0], stop};

  // ---- legs, slope ----
  localparam normal_t Most = normal_t'((1 << (NormalWidth - 1)) - 1);  // no leg inside of the tube is as long
  normal_t across, along, size, rho_slope_q[4], up, up_q;
  slope_t outwards, side, upwards, outwards_choice, side_choice, upwards_choice;
  wire swirl_t rho_fine = rho_legs >>> (SwirlFrac - 15);
  logic signed [2*NormalWidth-1:0] up_product_q;
  rdx_swirl_legs #(
      .General (General),
      .Surfaces(Surfaces)
  ) u_legs (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlLegs-3]),
      .place_i(place),
      .rho_i(rho_legs),
      .z_i(z_legs),
      .across_o(across),
      .along_o(along),
      .size_o(size)
  );
  // the radius in 18 bits, s3p15, saturated; over K^2
  always_ff @(posedge clk_i) begin
    rho_slope_q[0] <= rho_fine > swirl_t'(Most) ? Most : normal_t'(rho_fine);
    rho_slope_q[1:3] <= rho_slope_q[0:2];
    up_product_q <= rho_slope_q[3] * $signed(NormalWidth'(SwirlFlat));
    up_q <= normal_t'(up_product_q >>> 16);
  end
  rdx_swirl_slope #(
      .General (General),
      .Surfaces(Surfaces)
  ) u_slope (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlSlope-3]),
      .across_i(across),
      .along_i(along),
      .size_i(size),
      .rho_i(rho_slope_q[3]),
      .outwards_o(outwards),
      .side_o(side),
      .upwards_o(upwards)
  );

  // ---- tube or ball ----
  logic in_ball, ball_q;
  logic [SwirlEndLatency-1:0] none_q, wide_q;  // none_q[i]: i + 1 clocks after place; wide_q[i] as well
  rdx_swirl_end #(
      .General (General),
      .Surfaces(Surfaces)
  ) u_end (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlLegs-3]),
      .place_i(place),
      .azimuth_i(azimuth_t'(place)),
      .stop_i(stop_q[SwirlLegs-SwirlSide-SwirlSideLatency-1]),
      .rho_i(rho_slope_q[3]),
      .side_i(side),
      .ball_o(in_ball)
  );
  wire wide = across >= Most || across <= -Most || along >= Most || along <= -Most;
  always_ff @(posedge clk_i) begin
    none_q <= {none_q[SwirlEndLatency-2:0], none};
    wide_q <= {wide_q[SwirlEndLatency-2:SwirlLegsLatency], wide, (SwirlLegsLatency)'(0)};
    ball_q <= in_ball || none_q[SwirlEndLatency-1] || wide_q[SwirlEndLatency-1];
  end

  // ---- the gradient of what was chosen ----
  rdx_line #(
      .W(2 * SlopeWidth),
      .Depth(SwirlChoice - SwirlSlope)
  ) u_slopes (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({outwards, upwards}),
      .data_o({outwards_choice, upwards_choice})
  );
  rdx_line #(
      .W(SlopeWidth),
      .Depth(SwirlChoice + 1 - SwirlSlope - SwirlSlopeLatency)
  ) u_side_choice (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(side),
      .data_o(side_choice)
  );
  rdx_line #(
      .W(NormalWidth),
      .Depth(SwirlChoice + 1 - SwirlSlope)
  ) u_up (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(up_q),
      .data_o(up)
  );
  rdx_swirl_gradient #(
      .Surfaces(Surfaces)
  ) u_gradient (
      .clk_i,
      .write_i,
      .material_i(material_q[SwirlChoice-3]),
      .point_i(point_choice),
      .stop_i(stop_q[SwirlChoice-SwirlSide-SwirlSideLatency-1]),
      .ball_i(ball_q),
      .outwards_i(outwards_choice),
      .side_i(side_choice),
      .upwards_i(upwards_choice),
      .up_i(up),
      .gradient_o
  );
  wire unused = &{1'b0, material_q[SwirlChoice-2], material_q[SwirlChoice-1], up_product_q};

endmodule

`default_nettype wire
