// SPDX-License-Identifier: Apache-2.0
// Stands in for rdx_step where the ring is proved: same ports and latency, any result that keeps the contract of its header.
//
// A Run item comes back as Run with the next level, or Again where a cell is pending, Hit (after the last digit) or Done.
// Others pass unchanged. Control points and ends become anything; here the depth
// at which the cell begins, which is compared with the ray's limit, and the bit that formal_ring.sv marks.
`default_nettype none
`include "formal.svh"
`include "rdx_types.svh"

module rdx_step #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    localparam int unsigned N = N1 * K,
    localparam type control_t = `RDX_CONTROL_T(N),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire logic            [3:0] phase_i,
    input  wire rdx_pkg::form_t        form_i,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire control_t              control_i,
    input  wire segment_t              segment_i,
    output control_t                   control_o,
    output segment_t                   segment_o
);
  import rdx_pkg::*;

  localparam int unsigned Latency = step_latency(N1, D, HalveStages, Lanes, VectorDrop, Rules);

  // anything: the driver leaves what nothing drives free
  logic root, dead, found, scrambled;
  depth_t moved;
  control_t control_d, control_q[Latency];
  segment_t segment_d, segment_q[Latency];
  always_comb begin
    control_d = control_i;
    segment_d = segment_i;
    if (control_i.status == Run) begin
      control_d.steps = control_i.steps + 1'b1;
      control_d.pending = control_i.pending || found;
      segment_d.ends.start[0][0] = scrambled;
      segment_d.ends.depth_start = moved;
      if (!dead && control_i.level != 5'(K - 1)) control_d.level = control_i.level + 1'b1;
      else if (!dead && root) control_d.status = Hit;
      else control_d.status = control_d.pending ? Again : Done;
      if (control_d.status != Hit && (&control_d.steps)) control_d.status = Done;
    end
  end
  always_ff @(posedge clk_i) begin
    control_q[0] <= control_d;
    segment_q[0] <= segment_d;
    for (int i = 1; i < Latency; i++) begin
      control_q[i] <= control_q[i-1];
      segment_q[i] <= segment_q[i-1];
    end
  end
  assign control_o = control_q[Latency-1];
  assign segment_o = segment_q[Latency-1];
  wire unused = &{1'b0, rst_ni, phase_i, form_i};

endmodule

`default_nettype wire
