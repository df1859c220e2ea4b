// SPDX-License-Identifier: Apache-2.0
// Whether a point of the surface belongs to the ball at an end of the spiral, not to the tube.
//
// The power of a point is distance squared less radius squared. The ball's less the tube's, d turns from the end, is
// 4 rho R sin^2(pi d) + 4 pi d side + d^2 (R_growth^2 + pitch^2 - r_growth^2), without squares that cancel. Where d is
// below a half it is divided by d; from a turn on the tube is nearer.
//
// Formats    place_i: s8p22. azimuth_i: u0p22. stop_i: 1: the ball at the end. rho_i: s3p15, 6 clocks after them.
//            side_i: s3p25, 9 clocks after them. ball_o: 1: the ball's power is less.
// Rounding   floor.    Overflow   cannot happen.
// Timing     latency SwirlEndLatency = 13 clocks, one point a clock; material_i two clocks before. No reset.
// Model      model/raydix/swirl.py (in_ball)
`default_nettype none

module rdx_swirl_end #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                     clk_i,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_swirl_pkg::place_t    place_i,
    input  wire rdx_swirl_pkg::azimuth_t  azimuth_i,
    input  wire logic                     stop_i,
    input  wire rdx_pkg::normal_t         rho_i,
    input  wire rdx_swirl_pkg::slope_t    side_i,
    output logic                          ball_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Fine = SwirlFrac - (NormalWidth - 1);  // bits of turns that a factor has not
  localparam type product_t = logic signed [2*NormalWidth-1:0];
  localparam type sum_t = logic signed [2*NormalWidth:0];
  localparam type turns_t = logic [SwirlFrac-2:0];

  material_t material_q[9];
  logic [11:0] stop_q, small_q, far_q;  // [i]: i + 1 clocks after place_i
  always_ff @(posedge clk_i) begin
    material_q[0] <= material_i;
    for (int unsigned i = 1; i < 9; i++) material_q[i] <= material_q[i-1];
    stop_q <= {stop_q[10:0], stop_i};
  end

  // ---- two clocks: turns from the end along the spiral, and around the axis, the shorter way ----
  swirl_turns_t turns;
  place_t away_q;
  azimuth_t beyond_q;
  normal_t distance_q[10];  // [i]: i + 2 clocks after place_i
  turns_t around_q;
  rdx_constant #(
      .W($bits(swirl_turns_t)),
      .Index(SwirlTurns),
      .Surfaces(Surfaces)
  ) u_turns (
      .clk_i,
      .write_i,
      .material_i,
      .data_o(turns)
  );
  always_ff @(posedge clk_i) begin
    away_q   <= stop_i ? turns - place_i : place_i;
    beyond_q <= stop_i ? azimuth_i - azimuth_t'(turns) : azimuth_i;
    around_q <= turns_t'(beyond_q) ^ {(SwirlFrac - 1) {beyond_q[SwirlFrac-1]}};
    small_q  <= {small_q[10:1], away_q < place_t'(1 << (SwirlFrac - 1)), 1'b0};
    far_q    <= {far_q[10:1], away_q >= place_t'(1 << SwirlFrac), 1'b0};
    distance_q[0] <= {1'b0, away_q[SwirlFrac-1:Fine]};
    for (int unsigned i = 1; i < 10; i++) distance_q[i] <= distance_q[i-1];
  end

  // ---- to the seventh clock: sin^2, divided by the turns if there are few; the radius ----
  normal_t chord, chord_q, arc_q, reach, rise_q;
  normal_t around_to_chord[1];
  product_t lowered_q, reached;
  rdx_swirl_chord u_chord (
      .clk_i,
      .turns_i(around_q),
      .chord_o(chord)
  );
  rdx_delay #(
      .T(normal_t),
      .Depth(3)
  ) u_around (
      .clk_i,
      .data_i('{{2'b00, around_q[SwirlFrac-2:Fine]}}),
      .data_o(around_to_chord)
  );
  if (General) begin : gen_reaches
    normal_t from_start, from_stop;
    rdx_constant #(
        .W(NormalWidth),
        .Index(SwirlStartReach),
        .Surfaces(Surfaces)
    ) u_start_reach (
        .clk_i,
        .write_i,
        .material_i(material_q[5]),
        .data_o(from_start)
    );
    rdx_constant #(
        .W(NormalWidth),
        .Index(SwirlStopReach),
        .Surfaces(Surfaces)
    ) u_stop_reach (
        .clk_i,
        .write_i,
        .material_i(material_q[5]),
        .data_o(from_stop)
    );
    assign reach = stop_q[5] ? from_stop : from_start;
  end else begin : gen_reach
    rdx_constant #(
        .W(NormalWidth),
        .Index(SwirlStartReach),
        .Surfaces(Surfaces)
    ) u_reach (
        .clk_i,
        .write_i,
        .material_i(material_q[5]),
        .data_o(reach)
    );
  end
  assign reached = product_t'(rho_i) * product_t'(reach);
  always_ff @(posedge clk_i) begin
    chord_q <= chord;
    lowered_q <= product_t'(chord) * product_t'(around_to_chord[0]);
    arc_q <= small_q[5] ? chord_q : normal_t'(lowered_q >>> (NormalWidth - 1));
    rise_q <= normal_t'(reached >>> (NormalWidth - 1));
  end

  // ---- to the eleventh: how the tube leans ----
  normal_t near, bend;
  product_t pull_q[5];  // [i]: i + 8 clocks after place_i
  product_t bend_q, lean_q, lever_q, leaning_qq;
  sum_t leaning_q, sum_q;
  rdx_constant #(
      .W(NormalWidth),
      .Index(SwirlNear),
      .Surfaces(Surfaces)
  ) u_near (
      .clk_i,
      .write_i,
      .material_i(material_q[8]),
      .data_o(near)
  );
  rdx_constant #(
      .W(NormalWidth),
      .Index(SwirlBend),
      .Surfaces(Surfaces)
  ) u_bend (
      .clk_i,
      .write_i,
      .material_i(material_q[8]),
      .data_o(bend)
  );
  wire normal_t  side = normal_t'(side_i >>> (SlopeWidth - NormalWidth));
  wire normal_t  leaning = normal_t'(leaning_q >>> NormalWidth);
  wire product_t bent = bend_q >>> 2;
  wire product_t lever = lever_q >>> 1;
  always_ff @(posedge clk_i) begin
    pull_q[0] <= product_t'(arc_q) * product_t'(rise_q);
    for (int unsigned i = 1; i < 5; i++) pull_q[i] <= pull_q[i-1];
    bend_q <= product_t'(bend) * product_t'(distance_q[7]);
    lean_q <= product_t'(near) * product_t'(side);
    leaning_q <= stop_q[9] ? sum_t'(bent) - sum_t'(lean_q) : sum_t'(bent) + sum_t'(lean_q);
    // ---- and the sum ----
    leaning_qq <= product_t'(leaning_q >>> 2);
    lever_q <= product_t'(leaning) * product_t'(distance_q[9]);
    sum_q <= sum_t'(pull_q[4]) + (small_q[11] ? sum_t'(leaning_qq) : sum_t'(lever));
  end
  logic far_qq;
  always_ff @(posedge clk_i) far_qq <= far_q[11];
  assign ball_o = sum_q < 0 && !far_qq;
  wire unused = &{1'b0, away_q, beyond_q, lowered_q, reached, side_i, stop_q[11:10], stop_q[8:6], small_q, far_q};

endmodule

`default_nettype wire
