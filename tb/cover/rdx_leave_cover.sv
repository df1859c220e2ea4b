// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_leave.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_leave_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter bit Limit = 1'b0,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire logic             clk_i,
    input wire logic             rst_ni,
    input wire logic             filled_i,
    input wire control_t         control_i,
    input wire rdx_pkg::ends_t   ends_i,
    input wire rdx_pkg::origin_t origin_i,
    input wire logic             ended_o,
    input wire logic             hit_valid_o,
    input wire logic             hit_ready_i,
    input wire rdx_pkg::hit_t    record,
    input wire logic             offer,
    input wire logic             give,
    input wire logic             linger
);
  import rdx_pkg::*;

  wire limit = &control_i.steps;
  wire searches = filled_i && (control_i.status == Run || control_i.status == Again);
  wire same = limit_of(ends_i.depth_start) == origin_i.limit;

  for (genvar r = 1; r <= 4; r++) begin : gen_roots
    `RDX_COVER_RUN(hit, give && record.hit && control_i.roots == 3'(r))
    `RDX_COVER_RUN(last_hit, give && record.hit && record.last && control_i.roots == 3'(r))
    `RDX_COVER_RUN(ends_without, give && !record.hit && control_i.roots == 3'(r))
  end
  for (genvar s = 0; s < 5; s++) begin : gen_status
    `RDX_COVER_RUN(first_turn, !filled_i && control_i.status == s)
    `RDX_COVER_RUN(came, filled_i && control_i.status == s)
  end
  `RDX_COVER_RUN(hit_goes_round, offer && !give && record.hit)
  `RDX_COVER_RUN(end_goes_round, offer && !give && !record.hit)
  `RDX_COVER_RUN(restarted_for_next_root, give && !record.last)
  `RDX_COVER_RUN(roots_wanted_none_pending, give && record.hit && control_i.roots > 1 && !control_i.pending)
  `RDX_COVER_RUN(output_stalled, hit_valid_o && !hit_ready_i)
  `RDX_COVER_RUN(given_up_at_limit, give && limit && !record.hit)
  `RDX_COVER_RUN(lingers, filled_i && linger)
  if (Limit) begin : gen_limit
    for (genvar s = 1; s < 4; s++) begin : gen_ended
      `RDX_COVER_RUN(given, ended_o && give && control_i.status == s)
      `RDX_COVER_RUN(goes_round, ended_o && offer && !give && control_i.status == s)
    end
    `RDX_COVER_RUN(same_depth, searches && same)
    `RDX_COVER_RUN(no_limit, searches && origin_i.limit == NoLimit)
    `RDX_COVER_RUN(ended_lingers, ended_o && linger)
  end
endmodule

bind rdx_leave rdx_leave_cover #(
    .N1(N1),
    .K(K),
    .Limit(Limit)
) u_cover (.*);

`default_nettype wire
