// SPDX-License-Identifier: Apache-2.0
// Distance of a point from the ball at an end of the spiral: two lengths one after the other, less the ball's radius.
//
// Formats    point_i: x, y, z in s2p30, z carries K. stop_i: the ball at the end, not that at the start. size_i: K^2 times
//            its radius, s5p33. distance_o: K^2 times the distance, s5p33 without its last VectorDrop digits.
// Rounding   floor where digits are left away; rdx_cordic.    Overflow   cannot happen: compile scales the scene.
// Timing     latency rdx_pkg::ball_latency, twice the iterations of a length and 4, clocks in which en_i = 1, one point a clock.
// Reset      of the waiting line's place only.
// Model      model/raydix/vecsum.py (ball)
`default_nettype none

module rdx_ball #(
    parameter int unsigned VectorDrop = 0,
    localparam int unsigned V = rdx_pkg::VectorWidth - VectorDrop,
    localparam type length_t = logic signed [V-1:0]
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             en_i,
    input  wire rdx_pkg::form_t   form_i,
    input  wire logic             stop_i,
    input  wire rdx_pkg::vector_t size_i,         // K^2 times the ball's radius, constant
    input  wire rdx_pkg::coord_t  point_i   [3],
    output length_t               distance_o
);
  import rdx_pkg::*;

  localparam int unsigned Iterations = length_iterations(VectorDrop);

  // ---- first clock: the point as seen from the centre ----
  length_t leg_q[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    coord_t  centre;
    vector_t leg;
    assign centre = stop_i ? form_i.stop[axis] : form_i.start[axis];
    assign leg = (vector_t'(point_i[axis]) - vector_t'(centre)) <<< (VectorFrac - CoordFrac);
    always_ff @(posedge clk_i) if (en_i) leg_q[axis] <= length_t'(leg >>> VectorDrop);
  end

  // ---- length in the plane, then with the height, then less the radius ----
  length_t plane, height, length;
  angle_t unused_plane, unused_length;
  rdx_cordic #(
      .W(V),
      .Iterations(Iterations),
      .Angle(1'b0)
  ) u_plane (
      .clk_i,
      .en_i,
      .x_i(leg_q[0]),
      .y_i(leg_q[1]),
      .x_o(plane),
      .angle_o(unused_plane)
  );
  rdx_line #(
      .W(V),
      .Depth(Iterations + 1)
  ) u_height (
      .clk_i,
      .rst_ni,
      .en_i,
      .data_i(leg_q[2]),
      .data_o(height)
  );
  rdx_cordic #(
      .W(V),
      .Iterations(Iterations),
      .Angle(1'b0)
  ) u_length (
      .clk_i,
      .en_i,
      .x_i(plane),
      .y_i(height),
      .x_o(length),
      .angle_o(unused_length)
  );
  always_ff @(posedge clk_i) if (en_i) distance_o <= length - length_t'(size_i >>> VectorDrop);
  wire unused = &{1'b0, form_i, unused_plane, unused_length};

endmodule

`default_nettype wire
