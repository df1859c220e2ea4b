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
    input wire control_t control_q,
    input wire control_t control_d,
    input wire logic     dead_q,
    input wire logic     last_q,
    input wire logic     changes_q,
    input wire logic     point_outside
);
  import rdx_pkg::*;

  wire run = control_q.status == Run;
  wire limit = &control_q.steps;
  wire hit = run && last_q && changes_q && !point_outside;
  wire beyond = run && last_q && changes_q && point_outside;
  wire no_change = run && last_q && !changes_q;
  wire dead = run && dead_q;
  if (K > 1) begin : gen_steps
    `RDX_COVER(next_level, run && !dead_q && !last_q && !limit)
    `RDX_COVER(next_level_limit, run && !dead_q && !last_q && limit)
  end
  `RDX_COVER(hit_inside, hit && !limit)
  `RDX_COVER(hit_at_limit, hit && limit)
  for (genvar pending = 0; pending < 2; pending++) begin : gen_pending
    wire here = control_q.pending == pending;
    `RDX_COVER(hit_outside, beyond && here && !limit)
    `RDX_COVER(hit_outside_limit, beyond && here && limit)
    `RDX_COVER(last_without_change, no_change && here && !limit)
    `RDX_COVER(dead_end, dead && here && !limit)
    `RDX_COVER(dead_end_limit, dead && here && limit)
  end
  for (genvar s = 0; s <= 4; s++) begin : gen_status
    `RDX_COVER(status_in, control_q.status == status_e'(s))
    `RDX_COVER(status_out, control_d.status == status_e'(s))
  end
endmodule

bind rdx_settle rdx_settle_cover #(
    .N1(N1),
    .K (K)
) u_cover (.*);

`default_nettype wire
