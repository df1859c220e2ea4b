// SPDX-License-Identifier: Apache-2.0
// The turn of a spiral that is nearest to a point: its place on the centre curve.
//
// In the half plane of the point's azimuth the turns stand on a line, equally spaced. The point's projection on it, less
// the azimuth, is the number of the nearest turn; it is brought into the range that the spiral has at this azimuth.
// Where the tube grows (General) the least distance from the solid is not at the nearest centre: the place is shifted in
// proportion to the point's distance from the line, and the two turns about it are given.
//
// Formats    rho_i: K times the distance from the axis, s5p33. z_i: K times the height, s2p30. angle_i: turns, u0p32.
//            place_o: turns from the spiral's start, s8p28; none_o: no turn passes this azimuth.
// Rounding   floor of the products; the number of the turn to nearest, for General down and the next.
// Timing     latency rdx_pkg::TurnLatency = 6 clocks in which en_i = 1, one point a clock; no reset.
// Model      model/raydix/turn.py
`default_nettype none

module rdx_turn #(
    parameter bit General = 1'b0,
    localparam int unsigned Turns = General ? 2 : 1
) (
    input  wire logic             clk_i,
    input  wire logic             en_i,
    input  wire rdx_pkg::form_t   form_i,
    input  wire rdx_pkg::vector_t rho_i,
    input  wire rdx_pkg::coord_t  z_i,
    input  wire rdx_pkg::angle_t  angle_i,
    output rdx_pkg::turn_t        place_o[Turns],
    output logic                  none_o
);
  import rdx_pkg::*;

  localparam int unsigned Drop = 31 + 26 - TurnFrac;  // s5p31 times s10p26
  localparam int unsigned Width = 16 + TurnFrac;
  localparam int unsigned Part = 14 + TurnFrac;  // of one product
  localparam type at_t = logic signed [Width-1:0];
  localparam type part_t = logic signed [Part-1:0];
  localparam type azimuth_t = logic [TurnFrac-1:0];

  // ---- three clocks: products ----
  wire operand_t height = operand_t'(z_i) <<< 1;
  wire operand_t radius = operand_t'(rho_i >>> (VectorFrac - 31));
  part_t along_z;
  rdx_multiply #(
      .W(Part),
      .Drop(Drop)
  ) u_along_z (
      .clk_i,
      .en_i,
      .a_i(height),
      .b_i(form_i.turn_z),
      .product_o(along_z)
  );
  azimuth_t azimuth_q[5];
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      azimuth_q[0] <= azimuth_t'(angle_i >> (AngleWidth - TurnFrac));
      for (int unsigned i = 1; i < 5; i++) azimuth_q[i] <= azimuth_q[i-1];
    end
  end

  // ---- fourth and fifth clock: place of the projection, shifted ----
  at_t at_q;
  if (General) begin : gen_general
    part_t along_rho, skew_z, skew_rho;
    at_t sum_q, skew_q;
    rdx_multiply #(
        .W(Part),
        .Drop(Drop)
    ) u_along_rho (
        .clk_i,
        .en_i,
        .a_i(radius),
        .b_i(form_i.turn_rho),
        .product_o(along_rho)
    );
    rdx_multiply #(
        .W(Part),
        .Drop(Drop)
    ) u_skew_z (
        .clk_i,
        .en_i,
        .a_i(height),
        .b_i(form_i.skew_z),
        .product_o(skew_z)
    );
    rdx_multiply #(
        .W(Part),
        .Drop(Drop)
    ) u_skew_rho (
        .clk_i,
        .en_i,
        .a_i(radius),
        .b_i(form_i.skew_rho),
        .product_o(skew_rho)
    );
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        sum_q  <= at_t'(along_z) + at_t'(along_rho) + at_t'(form_i.turn_offset) - at_t'(azimuth_q[2]);
        skew_q <= at_t'(skew_z) + at_t'(skew_rho) + at_t'(form_i.skew_offset);
        at_q   <= (skew_q < 0) ^ form_i.skew_back[0] ? sum_q - skew_q : sum_q + skew_q;
      end
    end
  end else begin : gen_helix
    at_t sum_q;
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        sum_q <= at_t'(along_z) + at_t'(form_i.turn_offset) - at_t'(azimuth_q[2]);
        at_q  <= sum_q + (at_t'(1) <<< (TurnFrac - 1));
      end
    end
    wire unused = &{1'b0, radius};
  end

  // ---- sixth clock: the number of the turn, in range ----
  localparam type number_t = logic signed [Width-TurnFrac-1:0];
  turn_t beyond;  // from this azimuth on: turns that are left
  number_t last, first;
  assign beyond = form_i.turns - turn_t'(azimuth_q[4]);
  assign last   = number_t'(beyond >>> TurnFrac);
  assign first  = number_t'(at_q >>> TurnFrac);
  for (genvar i = 0; i < Turns; i++) begin : gen_turn
    wire number_t wanted = first + number_t'(i);
    wire number_t least = wanted > last ? last : wanted;
    wire number_t turn = least < 0 ? '0 : least;
    always_ff @(posedge clk_i) if (en_i) place_o[i] <= {turn[TurnWidth-TurnFrac-1:0], azimuth_q[4]};
    wire unused_turn = &{1'b0, turn[Width-TurnFrac-1:TurnWidth-TurnFrac]};
  end
  always_ff @(posedge clk_i) if (en_i) none_o <= last < 0;
  wire unused_bits = &{1'b0, form_i, angle_i, at_q, rho_i};

endmodule

`default_nettype wire
