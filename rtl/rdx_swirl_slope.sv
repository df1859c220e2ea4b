// SPDX-License-Identifier: Apache-2.0
// The gradient of the distance from the tube, turned to azimuth 0: outwards, to the side, upwards.
//
// All three times distance from the centre and from the axis: A rho and B rho, and for a radian of azimuth
// -(A R_growth + B pitch + r r_growth), because on the surface the distance from the centre is the tube's radius r.
//
// Formats    across_i, along_i, size_i: A, B, r in s1p17. rho_i: s3p15. outwards_o, side_o, upwards_o: s3p25.
// Rounding   floor.    Overflow   side_o saturates (with General = 0 it cannot happen).
// Timing     one point a clock; outwards_o and upwards_o follow by 1 clock, side_o by SwirlSlopeLatency = 3.
//            material_i two clocks before the point. No reset.
// Model      model/raydix/swirl.py (swirl)
`default_nettype none

module rdx_swirl_slope #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                     clk_i,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::normal_t         across_i,
    input  wire rdx_pkg::normal_t         along_i,
    input  wire rdx_pkg::normal_t         size_i,
    input  wire rdx_pkg::normal_t         rho_i,
    output rdx_swirl_pkg::slope_t         outwards_o,
    output rdx_swirl_pkg::slope_t         side_o,
    output rdx_swirl_pkg::slope_t         upwards_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Parts = General ? 3 : 1;
  localparam int unsigned Index[3] = '{SwirlPitchRadian, SwirlRadiusRadian, SwirlTubeRadian};
  localparam int unsigned Product = 2 * NormalWidth;
  localparam int unsigned Drop = Product - 4 - (SlopeWidth - 3);  // s4p32 to s3p25
  localparam type product_t = logic signed [Product-1:0];
  localparam type sum_t = logic signed [Product+1:0];
  localparam type kept_t = logic signed [Product+1-Drop:0];

  product_t part_q[3];
  normal_t  factor[3];
  assign factor = '{along_i, across_i, size_i};
  for (genvar i = 0; i < 3; i++) begin : gen_part
    if (i < Parts) begin : gen_product
      normal_t per_radian;
      rdx_constant #(
          .W(NormalWidth),
          .Index(Index[i]),
          .Surfaces(Surfaces)
      ) u_per_radian (
          .clk_i,
          .write_i,
          .material_i,
          .data_o(per_radian)
      );
      always_ff @(posedge clk_i) part_q[i] <= product_t'(factor[i]) * product_t'(per_radian);
    end else begin : gen_none
      assign part_q[i] = '0;
    end
  end

  localparam kept_t Most = kept_t'((1 << (SlopeWidth - 1)) - 1);
  product_t outwards_q, upwards_q;
  sum_t  sum_q;
  kept_t kept;
  assign kept = kept_t'(sum_q >>> Drop);
  always_ff @(posedge clk_i) begin
    outwards_q <= product_t'(across_i) * product_t'(rho_i);
    upwards_q <= product_t'(along_i) * product_t'(rho_i);
    sum_q <= sum_t'(part_q[0]) + sum_t'(part_q[1]) + sum_t'(part_q[2]);
    side_o <= kept > Most ? slope_t'(Most) : kept < -Most - 1 ? slope_t'(-Most - 1) : slope_t'(kept);
  end
  assign outwards_o = slope_t'(outwards_q >>> Drop);
  assign upwards_o  = slope_t'(upwards_q >>> Drop);
  wire unused = &{1'b0, outwards_q, upwards_q, sum_q, size_i};

endmodule

`default_nettype wire
