// SPDX-License-Identifier: Apache-2.0
// First part of a step of a vector-sum surface: the indicator at the J+1 boundaries, and later the chosen cell.
//
// The coordinates of the boundaries come from the segment's ends by halving. The lanes evaluate the J-1 new ones; both
// ends are known from the step before. Everything else waits in memories.
//
// Formats    segment_i: ends s2p30 and s1p31, b: indicator at both ends, s5p33. cells_o: indicator at the boundaries.
//            outside_o, possible_o: bit j for cell j. b_o, ends_o: indicator and ends of cell pick_i,
//            point_o the start; close_i: the ends meet in the middle.
// Rounding   half up in each average.    Overflow   cannot happen.
// Timing     an item every Phases clocks, where phase_i = 0. cells_o, outside_o, possible_o and control_o after Latency =
//            rdx_pkg::cells_latency clocks; pick_i comes Wait clocks later, b_o N1 clocks after that.
//            close_i comes a clock before b_o, point_o a clock after it, ends_o 3. No stall.
// Reset      of waiting lines' places only.
// Model      model/raydix/step.py (boundaries), bound.py, outside.py, carry.py
`default_nettype none
`include "rdx_types.svh"

module rdx_sample #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned Lanes = 7,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    parameter int unsigned Wait = 1,
    localparam int unsigned J = 1 << N1,
    localparam type control_t = `RDX_CONTROL_T(N1 * K),
    localparam type segment_t = `RDX_SEGMENT_T(rdx_pkg::VectorWidth, 1)
) (
    input  wire logic                                               clk_i,
    input  wire logic                                               rst_ni,
    input  wire logic            [   3:0]                           phase_i,
    input  wire rdx_pkg::form_t                                     form_i,
    input  wire rdx_pkg::modes_t                                    modes_i,
    input  wire control_t                                           control_i,
    input  wire segment_t                                           segment_i,
    input  wire logic            [N1-1:0]                           pick_i,
    input  wire logic                                               close_i,
    output control_t                                                control_o,
    output rdx_pkg::vector_t                                        cells_o   [J+1],
    output logic                 [ J-1:0]                           outside_o,
    output logic                 [ J-1:0]                           possible_o,
    output logic                 [   1:0][rdx_pkg::VectorWidth-1:0] b_o,
    output rdx_pkg::coord_t      [   2:0]                           point_o,
    output rdx_pkg::ends_t                                          ends_o
);
  import rdx_pkg::*;

  localparam int unsigned Halving = N1;  // clocks: until the coordinates are there
  localparam int unsigned Phases = phases(J - 1, Lanes);
  localparam int unsigned Evaluation = vecsum_latency(VectorDrop) + Phases - 1;
  localparam int unsigned Latency = cells_latency(N1, 1, 1, Lanes, VectorDrop);
  localparam int unsigned Moving = descend_stages(N1, 2);  // clocks of the ends that are over when b_o is there

  // ---- coordinates ----
  coord_t coords[3][J+1], points[3][J-1];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    coord_t ends[2];
    assign ends = '{segment_i.ends.start[axis], segment_i.ends.stop[axis]};
    rdx_cells #(
        .W(CoordWidth),
        .D(1),
        .N1(N1),
        .HalveStages(1)
    ) u_cells (
        .clk_i,
        .b_i(ends),
        .cells_o(coords[axis])
    );
    assign points[axis] = coords[axis][1:J-1];
  end

  // ---- box and zone, a clock later ----
  logic [J-1:0] outside, outside_q;
  rdx_outside #(
      .J(J),
      .Faces(1'b1)
  ) u_outside (
      .boundaries_i(coords),
      .box_i('0),
      .low_i(form_i.low),
      .high_i(form_i.high),
      .outside_o(outside)
  );
  logic [$clog2(Zones)-1:0] zone, zone_q, zone_here;
  rdx_zone #(
      .Count(J + 1)
  ) u_zone (
      .x_i(coords[0]),
      .y_i(coords[1]),
      .zone_o(zone)
  );
  always_ff @(posedge clk_i) begin
    outside_q <= outside;
    zone_q <= zone;
  end

  // ---- values ----
  logic [3:0] phase_q;  // of the points
  always_ff @(posedge clk_i) phase_q <= phase_before(phase_i, Halving - 1, Phases);
  vector_t values[J+1], new_values[J-1], start, stop;
  logic [4:0] level_here;
  rdx_lanes #(
      .Points(J - 1),
      .Lanes(Lanes),
      .General(General),
      .VectorDrop(VectorDrop)
  ) u_lanes (
      .clk_i,
      .rst_ni,
      .en_i(1'b1),
      .phase_i(phase_q),
      .form_i,
      .points_i(points),
      .values_o(new_values)
  );
  always_comb begin
    values[0] = start;
    values[J] = stop;
    for (int unsigned j = 1; j < J; j++) values[j] = new_values[j-1];
  end
  rdx_bound #(
      .N1(N1)
  ) u_bound (
      .clk_i,
      .form_i,
      .zone_i  (zone_here),
      .level_i (level_here),
      .values_i(values),
      .possible_o
  );
  vector_t cells_q[J+1];
  rdx_delay #(
      .T(vector_t),
      .Count(J + 1),
      .Depth(BoundLatency)
  ) u_cells (
      .clk_i,
      .data_i(values),
      .data_o(cells_o)
  );
  rdx_delay #(
      .T(vector_t),
      .Count(J + 1),
      .Depth(Wait)
  ) u_cells_q (
      .clk_i,
      .data_i(cells_o),
      .data_o(cells_q)
  );

  // ---- what waits ----
  `define RDX_WAIT(NAME, WIDTH, DEPTH, IN, OUT) \
    rdx_line #(.W(WIDTH), .Depth(DEPTH)) NAME (.clk_i, .rst_ni, .en_i(1'b1), .data_i(IN), .data_o(OUT));
  ends_t ends_here;
  `RDX_WAIT(u_wait_level, 5, Halving + Evaluation - 2, control_i.level - modes_i.first_level, level_here)
  `RDX_WAIT(u_wait_zone, $clog2(Zones), Evaluation - 3, zone_q, zone_here)
  `RDX_WAIT(u_wait_values, 2 * VectorWidth, Halving + Evaluation, segment_i.b, {stop, start})
  `RDX_WAIT(u_wait_outside, J, Evaluation + BoundLatency - 1, outside_q, outside_o)
  `RDX_WAIT(u_wait_control, $bits(control_t), Latency, control_i, control_o)
  `RDX_WAIT(u_wait_ends, $bits(ends_t), Latency + Wait + N1 - Moving, segment_i.ends, ends_here)

  // ---- the chosen cell ----
  logic [N1-1:0] pick[1], pick_q[1];
  assign pick[0] = pick_i;
  rdx_delay #(
      .T(logic [N1-1:0]),
      .Depth(N1 - Moving)
  ) u_pick (
      .clk_i,
      .data_i(pick),
      .data_o(pick_q)
  );
  rdx_descend #(
      .N1(N1)
  ) u_descend (
      .clk_i,
      .ends_i(ends_here),
      .pick_i(pick_q[0]),
      .close_i,
      .point_o,
      .ends_o
  );
  vector_t chosen[2], chosen_q[2];
  assign chosen = '{cells_q[(N1+1)'(pick_i)], cells_q[(N1+1)'(pick_i)+1]};
  rdx_delay #(
      .T(vector_t),
      .Count(2),
      .Depth(N1)
  ) u_chosen (
      .clk_i,
      .data_i(chosen),
      .data_o(chosen_q)
  );
  assign b_o = {chosen_q[1], chosen_q[0]};
  wire unused_modes = &{1'b0, modes_i};
endmodule

`default_nettype wire
