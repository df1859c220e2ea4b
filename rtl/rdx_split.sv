// SPDX-License-Identifier: Apache-2.0
// First part of a step of an algebraic surface: the J cells by halving, and later the chosen one.
//
// The cells are needed for the choice only. The segment waits for it in memories and is halved once more, towards the
// cell chosen. Coordinates take the same averages as control points, so no multiplication is needed for the hit point
// or its depth.
//
// Formats    segment_i: ends s2p30 and s1p31, control points sWp0. cells_o: as rdx_cells. outside_o: bit j for cell j.
//            cell_o: ends and control points of cell pick_i.
// Rounding   half up in each average.    Overflow   cannot happen, as in rdx_halve.
// Timing     cells_o and outside_o after N1*HalveStages clocks; pick_i comes Wait clocks later, cell_o
//            rdx_pkg::pick_latency clocks after that. No stall.
// Reset      of waiting lines' places only.
// Error      of the ends at most N1/2 ulp a step
// Model      model/raydix/cells.py, outside.py, carry.py
`default_nettype none
`include "rdx_types.svh"

module rdx_split #(
    parameter int unsigned N1 = 3,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned HalveStages = 2,
    parameter int unsigned Wait = 3,
    localparam int unsigned J = 1 << N1,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    input  wire rdx_pkg::box_t [   2:0] box_i,
    input  wire segment_t               segment_i,
    input  wire logic          [N1-1:0] pick_i,
    output logic signed        [ W-1:0] cells_o  [J*D+1],
    output logic               [ J-1:0] outside_o,
    output segment_t                    cell_o
);
  import rdx_pkg::*;

  localparam int unsigned Latency = N1 * HalveStages;
  localparam int unsigned Follow = pick_latency(N1, D);

  // ---- control points ----
  logic signed [W-1:0] b[D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = segment_i.b[i];
  rdx_cells #(
      .W(W),
      .D(D),
      .N1(N1),
      .HalveStages(HalveStages)
  ) u_cells (
      .clk_i,
      .b_i(b),
      .cells_o
  );

  // ---- coordinates of the boundaries, ahead of the control points, so that the masks stand in registers ----
  localparam int unsigned CoordStages = HalveStages > 0 ? 1 : 0;
  localparam int unsigned CoordFirst = HalveStages == 1 ? 0 : CoordStages;
  localparam int unsigned CoordLatency = CoordFirst + (N1 - 1) * CoordStages;
  coord_t coords[3][J+1];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    coord_t ends[2];
    assign ends = '{segment_i.ends.start[axis], segment_i.ends.stop[axis]};
    rdx_cells #(
        .W(CoordWidth),
        .D(1),
        .N1(N1),
        .HalveStages(CoordStages),
        .First(CoordFirst)
    ) u_coords (
        .clk_i,
        .b_i(ends),
        .cells_o(coords[axis])
    );
  end
  box_t [2:0] box[1], box_q[1];
  assign box[0] = box_i;
  rdx_delay #(
      .T(box_t[2:0]),
      .Depth(CoordLatency)
  ) u_box (
      .clk_i,
      .data_i(box),
      .data_o(box_q)
  );
  logic [J-1:0] outside[1], outside_q[1];
  rdx_outside #(
      .J(J)
  ) u_outside (
      .boundaries_i(coords),
      .box_i(box_q[0]),
      .low_i('0),
      .high_i('0),
      .outside_o(outside[0])
  );
  rdx_delay #(
      .T(logic [J-1:0]),
      .Depth(Latency - CoordLatency)
  ) u_outside_q (
      .clk_i,
      .data_i(outside),
      .data_o(outside_q)
  );
  assign outside_o = outside_q[0];

  // ---- the chosen cell ----
  segment_t here;
  rdx_line #(
      .W((D + 1) * W),
      .Depth(Latency + Wait)
  ) u_wait_points (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(segment_i.b),
      .data_o(here.b)
  );
  rdx_line #(
      .W($bits(ends_t)),
      .Depth(Latency + Wait + Follow - N1)
  ) u_wait_ends (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(segment_i.ends),
      .data_o(here.ends)
  );
  logic signed [W-1:0] points[D+1], chosen[D+1];
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) begin
      points[i]   = here.b[i];
      cell_o.b[i] = chosen[i];
    end
  end
  rdx_follow #(
      .W (W),
      .D (D),
      .N1(N1)
  ) u_follow (
      .clk_i,
      .b_i(points),
      .pick_i,
      .b_o(chosen)
  );
  logic [N1-1:0] pick[1], pick_q[1];
  assign pick[0] = pick_i;
  rdx_delay #(
      .T(logic [N1-1:0]),
      .Depth(Follow - N1)
  ) u_pick (
      .clk_i,
      .data_i(pick),
      .data_o(pick_q)
  );
  rdx_descend #(
      .N1(N1)
  ) u_descend (
      .clk_i,
      .ends_i(here.ends),
      .pick_i(pick_q[0]),
      .ends_o(cell_o.ends)
  );

endmodule

`default_nettype wire
