// SPDX-License-Identifier: Apache-2.0
// The end of a step: scales the control points (values of a vector sum, D = 1, keep their scale), and says what becomes of the item.
//
// After the last digit the cell's start is its middle, the hit point: a hit if the values at the cell's ends differ in
// sign and the point is inside of the box. Without a hit or a cell the item goes on at its pending cell, or is done.
//
// Formats    as in rdx_step; b_i, b_o: control points, sWp0; point_i: s2p30; dead_i: no cell was found.
// Rounding   the scaling is exact.    Overflow   cannot happen (rdx_scale).
// Timing     latency rdx_pkg::SettleLatency = 3 clocks; point_i comes a clock after the rest. One item a clock; no reset, no stall.
// Model      model/raydix/settle.py, and the verdict in model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_settle #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input  wire logic                         clk_i,
    input  wire control_t                     control_i,
    input  wire logic            [D:0][W-1:0] b_i,
    input  wire logic                         dead_i,
    input  wire rdx_pkg::coord_t [2:0]        point_i,    // a clock later
    input  wire rdx_pkg::coord_t [2:0]        low_i,      // the box where D = 1
    input  wire rdx_pkg::coord_t [2:0]        high_i,
    output control_t                          control_o,
    output logic                 [D:0][W-1:0] b_o
);
  import rdx_pkg::*;

  localparam int unsigned Bits = $clog2(norm_limit(N1) + 1);

  // ---- control points ----
  typedef logic signed [W-1:0] value_t;
  value_t b[D+1], scaled[D+1];
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) begin
      b[i]   = b_i[i];
      b_o[i] = scaled[i];
    end
  end
  if (D > 1) begin : gen_scale
    rdx_scale #(
        .W(W),
        .Count(D + 1),
        .Bits(Bits),
        .Stages(SettleLatency)
    ) u_scale (
        .clk_i,
        .values_i(b),
        .values_o(scaled)
    );
  end else begin : gen_wait
    rdx_delay #(
        .T(value_t),
        .Count(D + 1),
        .Depth(SettleLatency)
    ) u_wait (
        .clk_i,
        .data_i(b),
        .data_o(scaled)
    );
  end

  // ---- first clock: whether the cell is the last one and holds a sign change ----
  control_t control_q;
  logic dead_q, last_q, changes_q, positive_q;
  always_ff @(posedge clk_i) begin
    control_q <= control_i;
    dead_q <= dead_i;
    last_q <= control_i.status == Run && !dead_i && control_i.level == 5'(K - 1);
    changes_q <= (b[0] > 0) != (b[D] > 0);
    positive_q <= b[0] > 0;
  end

  // ---- second clock: whether the point is outside ----
  logic point_outside;
  if (D == 1 || Clip) begin : gen_point
    coord_t point[3][2];
    always_comb for (int unsigned axis = 0; axis < 3; axis++) point[axis] = '{default: point_i[axis]};
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
  end else begin : gen_no_point
    assign point_outside = 1'b0;
    wire unused = &{1'b0, point_i, low_i, high_i};
  end

  control_t control_qq;
  logic dead_qq, last_qq, hit_q, positive_qq, spent_q;
  always_ff @(posedge clk_i) begin
    control_qq <= control_q;
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
  always_ff @(posedge clk_i) control_o <= control_d;

endmodule

`default_nettype wire
