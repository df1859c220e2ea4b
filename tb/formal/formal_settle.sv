// SPDX-License-Identifier: Apache-2.0
// rdx_settle: what becomes of an item. Together with formal_pick (a step more each time) it is the contract that the stand-in
// of rdx_step keeps where the ring is proved: a descent ends, whatever its control points are.
`default_nettype none
`include "formal.svh"
`include "rdx_types.svh"

module formal_settle #(
    parameter int unsigned N1 = 1,
    parameter int unsigned K = 2,
    parameter int unsigned W = 4,
    parameter int unsigned D = 2,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic                         clk_i,
    input wire control_t                     control_i,
    input wire logic            [D:0][W-1:0] b_i,
    input wire logic                         dead_i,
    input wire rdx_pkg::coord_t [2:0]        point_i,
    input wire rdx_pkg::coord_t [2:0]        low_i,
    input wire rdx_pkg::coord_t [2:0]        high_i
);
  import rdx_pkg::*;

  control_t got;
  logic [D:0][W-1:0] b;
  rdx_settle #(
      .N1(N1),
      .K (K),
      .W (W),
      .D (D)
  ) u_settle (
      .clk_i,
      .control_i,
      .b_i,
      .dead_i,
      .point_i,
      .low_i,
      .high_i,
      .control_o(got),
      .b_o(b)
  );

  // what came in when the result's item did
  control_t [SettleLatency-1:0] control_q;
  logic [SettleLatency-1:0] dead_q, changes_q, positive_q;
  logic [SettleLatency-2:0] outside_q;  // the point comes a clock later; rdx_outside has a proof of its own
  logic [2:0] began_q = '0;
  wire changes = ($signed(b_i[0]) > 0) != ($signed(b_i[D]) > 0);
  always_ff @(posedge clk_i) begin
    control_q <= {control_q[SettleLatency-2:0], control_i};
    dead_q <= {dead_q[SettleLatency-2:0], dead_i};
    changes_q <= {changes_q[SettleLatency-2:0], changes};
    positive_q <= {positive_q[SettleLatency-2:0], $signed(b_i[0]) > 0};
    outside_q <= {outside_q[SettleLatency-3:0], u_settle.point_outside};
    began_q <= {began_q[1:0], 1'b1};
  end
  wire control_t was = control_q[SettleLatency-1];
  wire dead = dead_q[SettleLatency-1];
  wire run = was.status == Run && began_q[2];
  wire last = was.level == 5'(K - 1);

  control_t same;
  always_comb begin  // the fields that may change, as they were
    same = got;
    same.status = was.status;
    same.level = was.level;
    same.enters = was.enters;
  end

  `CHECK(p_same, !began_q[2] || same == was)
  `CHECK(p_passes, !began_q[2] || was.status == Run || got == was)
  `CHECK(p_level, !run || got.level == was.level + 5'(!dead && !last))
  `CHECK(p_run, !(run && got.status == Run) || (!dead && !last))
  wire hits = !dead && last && changes_q[SettleLatency-1] && !outside_q[SettleLatency-2];
  `CHECK(p_hit, !run || (got.status == Hit) == hits)
  `CHECK(p_enters, !run || got.enters == (hits ? positive_q[SettleLatency-1] : was.enters))
  `CHECK(p_again, !(run && got.status == Again) || (was.pending && (dead || last)))
  `CHECK(p_done, !(run && got.status == Done) || (&was.steps) || (!was.pending && (dead || last)))
  `CHECK(p_spent, !(run && (&was.steps)) || got.status inside {Hit, Done})
  `CHECK(p_status, !run || got.status inside {Run, Hit, Again, Done})
  `REACH(r_hit, run && got.status == Hit)
  `REACH(r_again, run && got.status == Again)
  `REACH(r_given_up, run && got.status == Done && was.pending)
  wire unused = &{1'b0, b};

endmodule

`default_nettype wire
