// SPDX-License-Identifier: Apache-2.0
// The turn of a spiral that a point of its surface belongs to: its place on the centre curve.
//
// It is the one with the least power, distance squared less radius squared, which is a parabola in the place: its apex
// is linear in radius and height. The number of the nearest turn is brought into the range that the spiral has here.
//
// Formats    rho_i: K times the distance from the axis, s4p22. z_i: K times the height, s2p22. azimuth_i: turns, u0p22.
//            place_o: turns from the spiral's start, s8p22; none_o: no turn passes this azimuth; place_o is
//            beyond the end.
// Rounding   floor of the products, then to the nearest turn.    Overflow   cannot happen: the constants are limited.
// Timing     latency SwirlTurnLatency = 6 clocks, one point a clock; material_i two clocks before. No reset.
// Model      model/raydix/swirl.py (turn)
`default_nettype none

module rdx_swirl_turn #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                        clk_i,
    input  wire rdx_pkg::material_write_t    write_i,
    input  wire rdx_pkg::material_t          material_i,
    input  wire rdx_swirl_pkg::swirl_t       rho_i,
    input  wire rdx_swirl_pkg::swirl_coord_t z_i,
    input  wire rdx_swirl_pkg::azimuth_t     azimuth_i,
    output rdx_swirl_pkg::place_t            place_o,
    output logic                             none_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Whole = 20;  // integer bits of a place before it is brought into the range
  localparam int unsigned Width = Whole + SwirlFrac;
  localparam int unsigned Product = 16 + SwirlFrac;
  localparam int unsigned Drop = 19;  // s13p19
  localparam type at_t = logic signed [Width-1:0];
  localparam type number_t = logic signed [Whole-1:0];

  material_t material_q[5];
  azimuth_t  azimuth_q [5];
  always_ff @(posedge clk_i) begin
    material_q[0] <= material_i;
    azimuth_q[0]  <= azimuth_i;
    for (int unsigned i = 1; i < 5; i++) begin
      material_q[i] <= material_q[i-1];
      azimuth_q[i]  <= azimuth_q[i-1];
    end
  end

  // ---- three clocks: products ----
  swirl_turn_z_t turn_z;
  swirl_turn_offset_t turn_offset;
  swirl_turns_t turns;
  logic signed [Product-1:0] along_z, along_rho;
  rdx_constant #(
      .W($bits(swirl_turn_z_t)),
      .Index(SwirlTurnZ),
      .Surfaces(Surfaces)
  ) u_turn_z (
      .clk_i,
      .write_i,
      .material_i,
      .data_o(turn_z)
  );
  rdx_multiply #(
      .W(Product),
      .Drop(Drop)
  ) u_along_z (
      .clk_i,
      .en_i(1'b1),
      .a_i(operand_t'(z_i)),
      .b_i(operand_t'(turn_z)),
      .product_o(along_z)
  );
  if (General) begin : gen_rho
    swirl_turn_rho_t turn_rho;
    rdx_constant #(
        .W($bits(swirl_turn_rho_t)),
        .Index(SwirlTurnRho),
        .Surfaces(Surfaces)
    ) u_turn_rho (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(turn_rho)
    );
    rdx_multiply #(
        .W(Product),
        .Drop(Drop)
    ) u_along_rho (
        .clk_i,
        .en_i(1'b1),
        .a_i(operand_t'(rho_i)),
        .b_i(operand_t'(turn_rho)),
        .product_o(along_rho)
    );
  end else begin : gen_no_rho
    assign along_rho = '0;
    wire unused = &{1'b0, rho_i};
  end

  // ---- fourth and fifth clock: the place of the apex, less the azimuth; the last turn at this azimuth ----
  rdx_constant #(
      .W($bits(swirl_turn_offset_t)),
      .Index(SwirlTurnOffset),
      .Surfaces(Surfaces)
  ) u_turn_offset (
      .clk_i,
      .write_i,
      .material_i(material_q[2]),
      .data_o(turn_offset)
  );
  rdx_constant #(
      .W($bits(swirl_turns_t)),
      .Index(SwirlTurns),
      .Surfaces(Surfaces)
  ) u_turns (
      .clk_i,
      .write_i,
      .material_i(material_q[3]),
      .data_o(turns)
  );
  at_t along_q, offset_q, at_q;
  place_t beyond;
  logic signed [$bits(place_t)-SwirlFrac-1:0] last_q;
  assign beyond = turns - place_t'(azimuth_q[3]);
  always_ff @(posedge clk_i) begin
    along_q  <= at_t'(along_z) + at_t'(along_rho);
    offset_q <= (at_t'(turn_offset) <<< (SwirlFrac - 16)) + (at_t'(1) <<< (SwirlFrac - 1)) - at_t'(azimuth_q[2]);
    at_q     <= along_q + offset_q;
    last_q   <= $bits(last_q)'(beyond >>> SwirlFrac);
  end

  // ---- sixth clock: the number of the turn, in range ----
  number_t number, least, turn;
  assign number = number_t'(at_q >>> SwirlFrac);
  assign least  = number > number_t'(last_q) ? number_t'(last_q) : number;
  assign turn   = least < 0 ? '0 : least;
  always_ff @(posedge clk_i) begin
    place_o <= {turn[$bits(place_t)-SwirlFrac-1:0], azimuth_q[4]};
    none_o  <= General && last_q < 0;
  end
  wire unused_bits = &{1'b0, material_q[4], turn, at_q, beyond};

endmodule

`default_nettype wire
