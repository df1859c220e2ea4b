// SPDX-License-Identifier: Apache-2.0
// A point as seen from the tube's centre at a place of the spiral, in the half plane of its azimuth; the tube's radius.
//
// Formats    place_i: turns, s8p22. rho_i, z_i: two clocks after it: K times distance from the axis, s4p22, and height,
//            s2p22. across_o, along_o, size_o: s1p17, times 2^E; size_o has no meaning without General.
// Rounding   floor.    Overflow   the outputs saturate; before, it cannot happen where there is a turn.
// Timing     latency SwirlLegsLatency = 6 clocks, one point a clock; material_i two clocks before. No reset.
// Model      model/raydix/swirl.py (swirl)
`default_nettype none

module rdx_swirl_legs #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                        clk_i,
    input  wire rdx_pkg::material_write_t    write_i,
    input  wire rdx_pkg::material_t          material_i,
    input  wire rdx_swirl_pkg::place_t       place_i,
    input  wire rdx_swirl_pkg::swirl_t       rho_i,
    input  wire rdx_swirl_pkg::swirl_coord_t z_i,
    output rdx_pkg::normal_t                 across_o,
    output rdx_pkg::normal_t                 along_o,
    output rdx_pkg::normal_t                 size_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Growths = General ? 3 : 1;  // of the height, the radius, the tube
  localparam int unsigned Index[3] = '{SwirlPitch, SwirlRadiusGrowth, SwirlTubeGrowth};
  localparam int unsigned Begin[3] = '{SwirlHeight, SwirlRadius, SwirlTube};
  localparam int unsigned Drop = 26;  // s6p26

  material_t material_q[5];
  always_ff @(posedge clk_i) begin
    material_q[0] <= material_i;
    for (int unsigned i = 1; i < 5; i++) material_q[i] <= material_q[i-1];
  end
  swirl_scale_t scale;
  rdx_constant #(
      .W($bits(swirl_scale_t)),
      .Index(SwirlScale),
      .Surfaces(Surfaces)
  ) u_scale (
      .clk_i,
      .write_i,
      .material_i(material_q[3]),
      .data_o(scale)
  );

  for (genvar i = 0; i < 3; i++) begin : gen_leg
    swirl_t begins, from_begin_q, leg_q;
    normal_t part;
    if (General || i < 2) begin : gen_begin
      rdx_constant #(
          .W(SwirlWidth),
          .Index(Begin[i]),
          .Surfaces(Surfaces)
      ) u_begin (
          .clk_i,
          .write_i,
          .material_i(material_q[1]),
          .data_o(begins)
      );
      // third clock: from the centre at the start; fourth: less what the place adds
      always_ff @(posedge clk_i) begin
        from_begin_q <= i == 0 ? swirl_t'(z_i) - begins : i == 1 ? rho_i - begins : begins;
      end
      rdx_swirl_part u_part (
          .clk_i,
          .length_i(leg_q),
          .scale_i (scale),
          .part_o  (part)
      );
    end else begin : gen_none
      assign part = '0;
      assign {begins, from_begin_q} = '0;
      wire unused = &{1'b0, begins, leg_q};
    end
    if (i < Growths) begin : gen_growth
      swirl_growth_t growth;
      swirl_t grown;
      rdx_constant #(
          .W($bits(swirl_growth_t)),
          .Index(Index[i]),
          .Surfaces(Surfaces)
      ) u_growth (
          .clk_i,
          .write_i,
          .material_i,
          .data_o(growth)
      );
      rdx_multiply #(
          .W(SwirlWidth),
          .Drop(Drop)
      ) u_grown (
          .clk_i,
          .en_i(1'b1),
          .a_i(operand_t'(place_i)),
          .b_i(operand_t'(growth)),
          .product_o(grown)
      );
      always_ff @(posedge clk_i) leg_q <= i == 2 ? from_begin_q + grown : from_begin_q - grown;
    end else begin : gen_even
      always_ff @(posedge clk_i) leg_q <= from_begin_q;
    end
  end
  assign along_o  = gen_leg[0].part;
  assign across_o = gen_leg[1].part;
  assign size_o   = gen_leg[2].part;
  wire unused_material = &{1'b0, material_q[4]};

endmodule

`default_nettype wire
