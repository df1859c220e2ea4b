// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_step.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_step_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    localparam int unsigned J = 1 << N1,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic              clk_i,
    input wire control_t          control_i,
    input wire control_t          control_o,
    input wire control_t          chosen,
    input wire logic     [ J-1:0] outside,
    input wire logic     [ J-1:0] possible,
    input wire logic     [N1-1:0] first,
    input wire logic              was_found,
    input wire logic              was_more,
    input wire logic     [N1-1:0] was_pick
);
  import rdx_pkg::*;

  wire run = chosen.status == Run;
  for (genvar s = 0; s <= 4; s++) begin : gen_status
    `RDX_COVER(status_in, control_i.status == status_e'(s))
    `RDX_COVER(status_out, control_o.status == status_e'(s))
  end
  for (genvar k = 0; k < K; k++) begin : gen_level
    `RDX_COVER(level, control_i.status == Run && control_i.level == 5'(k))
  end
  for (genvar j = 0; j < J; j++) begin : gen_cell
    `RDX_COVER(picked, run && was_found && 32'(was_pick) == j)
    `RDX_COVER(starts_there, 32'(first) == j)
  end
  for (genvar p = 0; p < 2; p++) begin : gen_rule
    if (Rules[p]) begin : gen_built
      `RDX_COVER(goes_on, run && was_found && (Rules != 3 || chosen.paper == p))
      `RDX_COVER(dead_end, run && !was_found && (Rules != 3 || chosen.paper == p))
    end
  end
  `RDX_COVER(pending, run && was_found && was_more)
  `RDX_COVER(some_outside, outside != '0 && !(&outside))
  `RDX_COVER(all_outside, &outside)
  if (D == 1) begin : gen_bounds
    `RDX_COVER(some_possible, possible != '0)
  end
endmodule

bind rdx_step rdx_step_cover #(
    .N1(N1),
    .K(K),
    .D(D),
    .Rules(Rules)
) u_cover (.*);

`default_nettype wire
