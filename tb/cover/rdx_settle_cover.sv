// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_settle.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_settle_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic     clk_i,
    input wire control_t control_qq,
    input wire control_t control_d,
    input wire logic     dead_qq,
    input wire logic     last_qq,
    input wire logic     changes_q,
    input wire logic     point_outside
);
  import rdx_pkg::*;

  logic changes_qq, outside_q;
  always_ff @(posedge clk_i) begin
    changes_qq <= changes_q;
    outside_q  <= point_outside;
  end
  wire run = control_qq.status == Run;
  wire limit = &control_qq.steps;
  wire hit = run && last_qq && changes_qq && !outside_q;
  wire beyond = run && last_qq && changes_qq && outside_q;
  wire no_change = run && last_qq && !changes_qq;
  wire dead = run && dead_qq;
  if (K > 1) begin : gen_steps
    `RDX_COVER(next_level, run && !dead_qq && !last_qq && !limit)
    `RDX_COVER(next_level_limit, run && !dead_qq && !last_qq && limit)
  end
  `RDX_COVER(hit_inside, hit && !limit)
  `RDX_COVER(hit_at_limit, hit && limit)
  for (genvar pending = 0; pending < 2; pending++) begin : gen_pending
    wire here = control_qq.pending == pending;
    `RDX_COVER(hit_outside, beyond && here && !limit)
    `RDX_COVER(hit_outside_limit, beyond && here && limit)
    `RDX_COVER(last_without_change, no_change && here && !limit)
    `RDX_COVER(dead_end, dead && here && !limit)
    `RDX_COVER(dead_end_limit, dead && here && limit)
  end
  for (genvar s = 0; s <= 4; s++) begin : gen_status
    `RDX_COVER(status_in, control_qq.status == status_e'(s))
    `RDX_COVER(status_out, control_d.status == status_e'(s))
  end
endmodule

bind rdx_settle rdx_settle_cover #(
    .N1(N1),
    .K (K)
) u_cover (.*);

`default_nettype wire
