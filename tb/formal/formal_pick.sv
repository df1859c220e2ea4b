// SPDX-License-Identifier: Apache-2.0
// rdx_pick: the choice becomes the digits of one level, and nothing else changes.
`default_nettype none
`include "formal.svh"
`include "rdx_types.svh"

module formal_pick #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    localparam int unsigned N = N1 * K,
    localparam type control_t = `RDX_CONTROL_T(N)
) (
    input wire control_t          control_i,
    input wire logic     [N1-1:0] first_i,
    input wire logic              found_i,
    input wire logic              more_i,
    input wire logic     [N1-1:0] pick_i,
    input wire logic     [N1-1:0] next_i
);
  import rdx_pkg::*;

  control_t got, same;
  rdx_pick #(
      .N1(N1),
      .K (K)
  ) u_pick (
      .control_i,
      .first_i,
      .found_i,
      .more_i,
      .pick_i,
      .next_i,
      .control_o(got)
  );

  wire run = control_i.status == Run;
  wire chosen = run && found_i;
  always_comb begin  // the fields that may change, as they were
    same = got;
    same.steps = control_i.steps;
    same.follow = control_i.follow;
    same.pending = control_i.pending;
    same.t = control_i.t;
    same.t_next = control_i.t_next;
  end

  // the digits of the level, as places of a number: the level's lowest has the weight 2^(N1*(K-1-level))
  wire [  9:0] shift = 10'(N1) * (10'(K - 1) - 10'(control_i.level));
  wire [N-1:0] hole = ~(N'((1 << N1) - 1) << shift);
  wire [N-1:0] picked = (control_i.t & hole) | (N'(pick_i) << shift);
  wire [N-1:0] second = (control_i.t & hole) | (N'(next_i) << shift);

  `GIVEN(g_level, control_i.level < 5'(K))
  `CHECK(p_others, same == control_i)
  `CHECK(p_not_run, run || got == control_i)
  `CHECK(p_steps, !run || got.steps == control_i.steps + 1'b1)
  `CHECK(p_dead, found_i || (got.t == control_i.t && got.follow == control_i.follow))
  `CHECK(p_t, !chosen || got.t == picked)
  `CHECK(p_follow, !chosen || got.follow == (control_i.follow && pick_i == first_i))
  `CHECK(p_more, !(chosen && more_i) || (got.pending && got.t_next == second))
  `CHECK(p_no_more, (chosen && more_i) || (got.pending == control_i.pending && got.t_next == control_i.t_next))
  `REACH(r_last, chosen && more_i && control_i.level == 5'(K - 1))

endmodule

`default_nettype wire
