// SPDX-License-Identifier: Apache-2.0
// The end of a step: scales the control points (values of a vector sum, D = 1, keep their scale), and says what becomes of the item.
//
// After the last digit the cell shrinks to its middle, the hit point: a hit if the cell's ends differ in sign and the
// point is inside of the box. Without a hit or a cell the item goes on at its pending cell, or is done.
//
// Formats    as in rdx_step; dead_i: no cell was found.
// Rounding   half up in the middle; the scaling is exact.    Overflow   cannot happen (rdx_halve, rdx_normalize).
// Timing     latency rdx_pkg::SettleLatency = 3 clocks, one item a clock; no reset, no stall.
// Model      model/raydix/settle.py, and the verdict in model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_settle #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    localparam type control_t = `RDX_CONTROL_T(N1 * K),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                  clk_i,
    input  wire control_t              control_i,
    input  wire segment_t              segment_i,
    input  wire logic                  dead_i,
    input  wire rdx_pkg::coord_t [2:0] low_i,      // the box where D = 1
    input  wire rdx_pkg::coord_t [2:0] high_i,
    output control_t                   control_o,
    output segment_t                   segment_o
);
  import rdx_pkg::*;

  // ---- control points ----
  logic signed [W-1:0] b[D+1], scaled[D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = segment_i.b[i];
  if (D > 1) begin : gen_scale
    rdx_normalize #(
        .WIn(W),
        .WOut(W),
        .Count(D + 1),
        .Limit(norm_limit(N1)),
        .Stages(SettleLatency)
    ) u_normalize (
        .clk_i,
        .en_i(1'b1),
        .values_i(b),
        .values_o(scaled)
    );
  end else begin : gen_wait
    rdx_delay #(
        .T(logic signed [W-1:0]),
        .Count(D + 1),
        .Depth(SettleLatency)
    ) u_wait (
        .clk_i,
        .data_i(b),
        .data_o(scaled)
    );
  end

  // ---- first clock: the middle of the cell, and whether it holds a sign change ----
  ends_t middle;
  for (genvar axis = 0; axis < 3; axis++) begin : gen_middle
    coord_t ends[2], left[2], right[2];
    assign ends = '{segment_i.ends.start[axis], segment_i.ends.stop[axis]};
    rdx_halve #(
        .W(CoordWidth),
        .D(1),
        .Stages(0)
    ) u_halve (
        .clk_i,
        .b_i(ends),
        .left_o(left),
        .right_o(right)
    );
    assign middle.start[axis] = left[1];
    assign middle.stop[axis]  = right[0];
    wire unused = &{1'b0, left[0], right[1]};
  end
  depth_t depths[2], left_depth[2], right_depth[2];
  assign depths = '{segment_i.ends.depth_start, segment_i.ends.depth_stop};
  rdx_halve #(
      .W(DepthWidth),
      .D(1),
      .Stages(0)
  ) u_halve_depth (
      .clk_i,
      .b_i(depths),
      .left_o(left_depth),
      .right_o(right_depth)
  );
  assign middle.depth_start = left_depth[1];
  assign middle.depth_stop  = right_depth[0];
  wire unused_depth = &{1'b0, left_depth[0], right_depth[1]};

  wire run = control_i.status == Run;
  wire last = run && !dead_i && control_i.level == 5'(K - 1);
  control_t control_q;
  ends_t ends_q;
  logic dead_q, last_q, changes_q, positive_q;
  always_ff @(posedge clk_i) begin
    control_q <= control_i;
    ends_q    <= last ? middle : segment_i.ends;
    dead_q    <= dead_i;
    last_q    <= last;
    changes_q <= (b[0] > 0) != (b[D] > 0);
    positive_q <= b[0] > 0;
  end

  // ---- second clock: whether the point is outside ----
  coord_t point[3][2];
  logic point_outside;
  always_comb for (int unsigned axis = 0; axis < 3; axis++) point[axis] = '{default: ends_q.start[axis]};
  rdx_outside #(
      .J(1),
      .Faces(D == 1)
  ) u_point (
      .boundaries_i(point),
      .box_i(control_q.box),
      .low_i,
      .high_i,
      .outside_o(point_outside)
  );

  control_t control_qq;
  ends_t ends_qq, ends_qqq;
  logic dead_qq, last_qq, hit_q, positive_qq, spent_q;
  always_ff @(posedge clk_i) begin
    control_qq <= control_q;
    ends_qq <= ends_q;
    dead_qq <= dead_q;
    last_qq <= last_q;
    hit_q <= last_q && changes_q && !point_outside;
    positive_qq <= positive_q;
    spent_q <= &control_q.steps;
  end

  // ---- third clock: the verdict ----
  control_t control_d;
  always_comb begin
    control_d = control_qq;
    if (control_d.status == Run) begin
      if (!dead_qq && !last_qq) control_d.level = control_qq.level + 1'b1;
      if (hit_q) begin
        control_d.status = Hit;
        control_d.enters = positive_qq;
      end else if (spent_q) control_d.status = Done;
      else if (last_qq || dead_qq) control_d.status = control_qq.pending ? Again : Done;
    end
  end
  always_ff @(posedge clk_i) begin
    control_o <= control_d;
    ends_qqq  <= ends_qq;
  end

  always_comb begin
    segment_o.ends = ends_qqq;
    for (int unsigned i = 0; i <= D; i++) segment_o.b[i] = scaled[i];
  end

endmodule

`default_nettype wire
