// SPDX-License-Identifier: Apache-2.0
// First part of a step of an algebraic surface: the J cells by halving, and later the chosen one.
//
// The cells are needed for the choice only. The segment waits for it in memories and is halved once more, towards the
// cell chosen. Coordinates take the same averages as control points, so no multiplication is needed for the hit point
// or its depth.
//
// Formats    segment_i: ends s2p30 and s1p31, control points sWp0. cells_o: as rdx_cells. outside_o: bit j for cell j.
//            b_o, ends_o: control points and ends of cell pick_i, point_o the start; close_i: the ends meet in the middle.
// Rounding   half up in each average.    Overflow   cannot happen, as in rdx_halve.
// Timing     cells_o and outside_o after N1*HalveStages clocks; pick_i comes Wait clocks later, b_o rdx_pkg::pick_latency
//            clocks after that. close_i comes a clock before b_o, point_o a clock after it, ends_o 3. No stall.
// Reset      of waiting lines' places only.
// Error      of the ends at most N1/2 ulp a step
// Model      model/raydix/cells.py, outside.py, carry.py
`default_nettype none
`include "rdx_types.svh"

module rdx_split #(
    parameter int unsigned N1 = 3,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = 2,
    parameter int unsigned Wait = 3,
    parameter bit Below = 1'b0,  // 1: cells_o less by one, which a register more tells from the signs
    localparam int unsigned J = 1 << N1,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                               clk_i,
    input  wire logic                               rst_ni,
    input  wire rdx_pkg::box_t [        2:0]        box_i,
    input  wire segment_t                           segment_i,
    input  wire logic          [     N1-1:0]        pick_i,
    input  wire logic                               close_i,
    output logic signed        [W+Below-1:0]        cells_o  [J*D+1],
    output logic               [      J-1:0]        outside_o,
    output logic               [        D:0][W-1:0] b_o,
    output rdx_pkg::coord_t    [        2:0]        point_o,
    output rdx_pkg::ends_t                          ends_o
);
  import rdx_pkg::*;

  localparam int unsigned Latency = N1 * HalveStages;
  localparam int unsigned Follow = pick_latency(N1, D, HalveStages);
  localparam int unsigned Moves = follow_moves(D, HalveStages);
  localparam int unsigned Moving = descend_stages(N1, Moves);  // clocks of the ends that are over when b_o is there

  // ---- control points; averages of values that are less by one are less by one ----
  localparam type value_t = logic signed [W+Below-1:0];
  localparam bit Early = Below && HalveStages > 0;
  value_t b[D+1], b_q[D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = value_t'($signed(segment_i.b[i])) - value_t'(Below);
  rdx_delay #(
      .T(value_t),
      .Count(D + 1),
      .Depth(32'(Early))
  ) u_less (
      .clk_i,
      .data_i(b),
      .data_o(b_q)
  );
  rdx_cells #(
      .W(W + 32'(Below)),
      .D(D),
      .N1(N1),
      .HalveStages(HalveStages),
      .Last(!Early)
  ) u_cells (
      .clk_i,
      .b_i(b_q),
      .cells_o
  );

  // ---- box ----
  if (Clip) begin : gen_clip
    rdx_clip #(
        .N1(N1),
        .Latency(Latency)
    ) u_clip (
        .clk_i,
        .start_i(segment_i.ends.start),
        .stop_i (segment_i.ends.stop),
        .box_i,
        .outside_o
    );
  end else begin : gen_no_clip
    assign outside_o = '0;
    wire unused = &{1'b0, box_i};
  end

  // ---- the chosen cell: control points, and its ends, which take longer ----
  logic [D:0][W-1:0] here;
  ends_t ends_here;
  rdx_line #(
      .W((D + 1) * W),
      .Depth(Latency + Wait)
  ) u_wait_points (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(segment_i.b),
      .data_o(here)
  );
  rdx_line #(
      .W($bits(ends_t)),
      .Depth(Latency + Wait + Follow - Moving)
  ) u_wait_ends (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(segment_i.ends),
      .data_o(ends_here)
  );
  logic signed [W-1:0] points[D+1], chosen[D+1];
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) begin
      points[i] = here[i];
      b_o[i] = chosen[i];
    end
  end
  rdx_follow #(
      .W(W),
      .D(D),
      .N1(N1),
      .Stages(follow_stages(D, HalveStages))
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
      .Depth(Follow - Moving)
  ) u_pick (
      .clk_i,
      .data_i(pick),
      .data_o(pick_q)
  );
  rdx_descend #(
      .N1(N1),
      .Moves(Moves)
  ) u_descend (
      .clk_i,
      .ends_i(ends_here),
      .pick_i(pick_q[0]),
      .close_i,
      .point_o,
      .ends_o
  );

endmodule

`default_nettype wire
