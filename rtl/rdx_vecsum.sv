// SPDX-License-Identifier: Apache-2.0
// The indicator of a spiral at a point: one lane of the vector-sum evaluator.
//
// Radius and azimuth of the point, then the nearest turn and the distance from its tube, beside it the distance from
// the ball at the (nearer) end: the least of them is the indicator. Its magnitude is limited to what bounds its change:
// at most half of 1.5 K times the distance from the axis, at least the guard less the whole of it (docs/spirals.md).
//
// Formats    point_i: x, y, z in s2p30, z carries K. value_o: K^2 times the indicator, s5p33; positive outside.
//            form_i is constant while points are under way. VectorDrop, 0, 4, 8 or 12: the last digits of lengths and
//            azimuths that are left away, and 0 in value_o; the evaluator is smaller, and rougher, for fewer digits of t.
// Rounding   that of the parts, floor where digits are left away.    Overflow   cannot happen: compile scales the scene.
// Timing     latency rdx_pkg::vecsum_latency clocks in which en_i = 1, one point a clock.
// Reset      of the waiting lines' places only.
// Error      docs/spirals.md, "Error of the evaluator"
// Model      model/raydix/vecsum.py (evaluate)
`default_nettype none

module rdx_vecsum #(
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0
) (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            en_i,
    input  wire rdx_pkg::form_t  form_i,
    input  wire rdx_pkg::coord_t point_i[3],
    output rdx_pkg::vector_t     value_o
);
  import rdx_pkg::*;
  /*verilator no_inline_module*/  // many copies: compiled once

  if (VectorDrop > 12 || VectorDrop % 4 != 0) begin : gen_illegal_drop
    $fatal(1, "rdx_vecsum: VectorDrop = %0d; allowed: 0, 4, 8, 12", VectorDrop);
  end

  localparam int unsigned Parts = General ? 2 : 1;  // turns, and balls, that are looked at
  localparam int unsigned Iterations = angle_iterations(VectorDrop);
  localparam int unsigned ToTube = Iterations + 1 + TurnLatency;
  localparam int unsigned V = VectorWidth - VectorDrop;
  localparam type length_t = logic signed [V-1:0];

  // ---- radius and azimuth ----
  vector_t x, y;
  length_t rho;
  angle_t  angle;
  coord_t z, z_tube;
  assign x = vector_t'(point_i[0]) <<< (VectorFrac - CoordFrac);
  assign y = vector_t'(point_i[1]) <<< (VectorFrac - CoordFrac);
  rdx_cordic #(
      .W(V),
      .Iterations(Iterations),
      .Still(angle_still(VectorDrop)),
      .Angle(1'b1),
      .AngleDrop(VectorDrop)
  ) u_polar (
      .clk_i,
      .en_i,
      .x_i(length_t'(x >>> VectorDrop)),
      .y_i(length_t'(y >>> VectorDrop)),
      .x_o(rho),
      .angle_o(angle)
  );
  rdx_line #(
      .W(CoordWidth),
      .Depth(Iterations + 1)
  ) u_z (
      .clk_i,
      .rst_ni,
      .en_i,
      .data_i(point_i[2]),
      .data_o(z)
  );

  // ---- the nearest turn ----
  turn_t place[Parts];
  logic  none;
  length_t rho_tube, rho_end;
  rdx_turn #(
      .General(General)
  ) u_turn (
      .clk_i,
      .en_i,
      .form_i,
      .rho_i  (vector_t'(rho) <<< VectorDrop),
      .z_i    (z),
      .angle_i(angle),
      .place_o(place),
      .none_o (none)
  );
  rdx_line #(
      .W(V + CoordWidth),
      .Depth(TurnLatency)
  ) u_to_tube (
      .clk_i,
      .rst_ni,
      .en_i,
      .data_i({rho, z}),
      .data_o({rho_tube, z_tube})
  );
  rdx_line #(
      .W(V),
      .Depth(tube_latency(VectorDrop))
  ) u_to_end (
      .clk_i,
      .rst_ni,
      .en_i,
      .data_i(rho_tube),
      .data_o(rho_end)
  );

  // ---- distances; the balls' point comes a clock later, when it is known which of them is the nearer ----
  coord_t point_q [3];
  logic   upper_q;
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      point_q <= point_i;
      upper_q <= point_i[2] >= form_i.split;
    end
  end
  length_t distance[2*Parts];
  for (genvar i = 0; i < Parts; i++) begin : gen_part
    rdx_tube #(
        .General(General),
        .VectorDrop(VectorDrop)
    ) u_tube (
        .clk_i,
        .rst_ni,
        .en_i,
        .form_i,
        .rho_i(rho_tube),
        .z_i(z_tube),
        .place_i(place[i]),
        .none_i(none),
        .distance_o(distance[2*i])
    );
    length_t from_ball;
    wire stop = General ? i == 1 : upper_q;
    rdx_ball #(
        .VectorDrop(VectorDrop)
    ) u_ball (
        .clk_i,
        .rst_ni,
        .en_i,
        .form_i,
        .stop_i(stop),
        .size_i(i == 1 ? form_i.tube_stop : form_i.tube),
        .point_i(point_q),
        .distance_o(from_ball)
    );
    rdx_line #(
        .W(V),
        .Depth(ToTube + tube_latency(VectorDrop) - ball_latency(VectorDrop) - 1)
    ) u_from_ball (
        .clk_i,
        .rst_ni,
        .en_i,
        .data_i(from_ball),
        .data_o(distance[2*i+1])
    );
  end

  // ---- six clocks: the least distance, in two steps, its magnitude, its two limits, its sign ----
  length_t nearer_q[2], least_q, size_q, below_q, limited_q, value_q;
  length_t axis, axis_q[3], guard_q;
  logic [2:0] outside_q;
  assign axis = rho_end + (rho_end >>> 1);
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      for (int unsigned i = 0; i < Parts; i++) begin
        nearer_q[i] <= distance[2*i] < distance[2*i+1] ? distance[2*i] : distance[2*i+1];
      end
      axis_q[0] <= axis;
      least_q <= General && nearer_q[1] < nearer_q[0] ? nearer_q[1] : nearer_q[0];
      axis_q[1] <= axis_q[0];
      size_q <= least_q < 0 ? -least_q : least_q;
      axis_q[2] <= axis_q[1];
      below_q <= size_q < (axis_q[2] >>> 1) ? size_q : axis_q[2] >>> 1;
      guard_q <= length_t'(form_i.guard >>> VectorDrop) - axis_q[2];
      limited_q <= below_q < guard_q ? guard_q : below_q;
      outside_q <= {outside_q[1:0], least_q > 0};
      value_q <= outside_q[2] ? limited_q : -limited_q;
    end
  end
  assign value_o = vector_t'(value_q) <<< VectorDrop;
  if (!General) begin : gen_one_part
    assign nearer_q[1] = '0;
  end
  wire unused = &{1'b0, form_i};

endmodule

`default_nettype wire
