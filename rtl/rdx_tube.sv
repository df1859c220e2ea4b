// SPDX-License-Identifier: Apache-2.0
// Distance of a point from a turn of the spiral: from the centre of the tube's circle in the point's half plane, less the
// circle's radius.
//
// Formats    rho_i: K times the distance from the axis, s5p33 without its last VectorDrop digits. z_i: K times the height,
//            s2p30. place_i: the turn's place on the centre curve, s8p28. none_i: there is no turn. distance_o: K^2 times
//            the distance, as rho_i, the largest number if there is no turn.
// Rounding   floor of the products, and where digits are left away; rdx_cordic.    Overflow   cannot happen: compile scales the scene.
// Timing     latency rdx_pkg::tube_latency, the iterations of a length and 6, clocks in which en_i = 1, one point a clock.
// Reset      of the waiting line's place only.
// Model      model/raydix/vecsum.py (tube)
`default_nettype none

module rdx_tube #(
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    localparam int unsigned V = rdx_pkg::VectorWidth - VectorDrop,
    localparam type length_t = logic signed [V-1:0]
) (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            en_i,
    input  wire rdx_pkg::form_t  form_i,
    input  wire length_t         rho_i,
    input  wire rdx_pkg::coord_t z_i,
    input  wire rdx_pkg::turn_t  place_i,
    input  wire logic            none_i,
    output length_t              distance_o
);
  import rdx_pkg::*;

  localparam int unsigned Drop = 30 + TurnFrac - VectorFrac;  // s6p30 times s8p28
  localparam int unsigned Wait = 3;  // for the products
  localparam int unsigned Iterations = length_iterations(VectorDrop);

  vector_t rise, radius, size;
  rdx_multiply #(
      .W(VectorWidth),
      .Drop(Drop)
  ) u_rise (
      .clk_i,
      .en_i,
      .a_i(place_i),
      .b_i(form_i.pitch),
      .product_o(rise)
  );
  if (General) begin : gen_growth
    vector_t radius_growth, tube_growth;
    rdx_multiply #(
        .W(VectorWidth),
        .Drop(Drop)
    ) u_radius_growth (
        .clk_i,
        .en_i,
        .a_i(place_i),
        .b_i(form_i.radius_growth),
        .product_o(radius_growth)
    );
    rdx_multiply #(
        .W(VectorWidth),
        .Drop(Drop)
    ) u_tube_growth (
        .clk_i,
        .en_i,
        .a_i(place_i),
        .b_i(form_i.tube_growth),
        .product_o(tube_growth)
    );
    assign radius = form_i.radius + radius_growth;
    assign size   = form_i.tube + tube_growth;
  end else begin : gen_constant
    assign radius = form_i.radius;
    assign size   = form_i.tube;
  end

  // ---- fourth clock: legs of the triangle between point and centre ----
  length_t rho_q[Wait], u_q, v_q;
  vector_t over;  // the centre's height
  coord_t z_q[Wait];
  logic [Wait-1:0] none_q;
  assign over = (vector_t'(z_q[Wait-1]) <<< (VectorFrac - CoordFrac)) - form_i.height - rise;
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      rho_q[0] <= rho_i;
      z_q[0]   <= z_i;
      for (int unsigned i = 1; i < Wait; i++) begin
        rho_q[i] <= rho_q[i-1];
        z_q[i]   <= z_q[i-1];
      end
      none_q <= {none_q[Wait-2:0], none_i};
      u_q <= rho_q[Wait-1] - length_t'(radius >>> VectorDrop);
      v_q <= length_t'(over >>> VectorDrop);
    end
  end

  // ---- then their length, and one clock more: less the radius ----
  length_t length, size_here;
  angle_t unused_angle;
  rdx_cordic #(
      .W(V),
      .Iterations(Iterations),
      .Angle(1'b0)
  ) u_length (
      .clk_i,
      .en_i,
      .x_i(u_q),
      .y_i(v_q),
      .x_o(length),
      .angle_o(unused_angle)
  );
  localparam int unsigned Size = General ? V + 1 : 1;  // what waits for the length
  logic [Size-1:0] waiting, waited;
  logic none;
  rdx_line #(
      .W(Size),
      .Depth(Iterations + 2)
  ) u_size (
      .clk_i,
      .rst_ni,
      .en_i,
      .data_i(waiting),
      .data_o(waited)
  );
  if (General) begin : gen_size
    assign waiting = {none_q[Wait-1], length_t'(size >>> VectorDrop)};
    assign {none, size_here} = waited;
  end else begin : gen_same_size
    assign waiting = none_q[Wait-1];
    assign none = waited[0];
    assign size_here = length_t'(size >>> VectorDrop);
  end
  always_ff @(posedge clk_i) begin
    if (en_i) distance_o <= none ? {1'b0, {(V - 1) {1'b1}}} : length - size_here;
  end
  wire unused = &{1'b0, form_i, unused_angle};

endmodule

`default_nettype wire
