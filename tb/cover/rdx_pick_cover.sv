// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_pick.
`default_nettype none
`include "rdx_cover.svh"
`include "rdx_types.svh"

module rdx_pick_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input wire control_t          control_i,
    input wire logic     [N1-1:0] first_i,
    input wire logic              found_i,
    input wire logic              more_i,
    input wire logic     [N1-1:0] pick_i
);
  import rdx_pkg::*;

  wire run = control_i.status == Run;
  for (genvar k = 0; k < K; k++) begin : gen_level
    `RDX_COVER_NOW(found, run && found_i && !more_i && control_i.level == 5'(k))
    `RDX_COVER_NOW(more, run && found_i && more_i && control_i.level == 5'(k))
  end
  for (genvar s = 0; s <= 4; s++) begin : gen_status
    `RDX_COVER_NOW(seen, control_i.status == status_e'(s))
  end
  `RDX_COVER_NOW(none_pending, run && !found_i && control_i.pending)
  `RDX_COVER_NOW(none_left, run && !found_i && !control_i.pending)
  `RDX_COVER_NOW(pending_replaced, run && found_i && more_i && control_i.pending)
  `RDX_COVER_NOW(pending_kept, run && found_i && !more_i && control_i.pending)
  `RDX_COVER_NOW(follows, run && found_i && control_i.follow && pick_i == first_i)
  `RDX_COVER_NOW(follows_no_longer, run && found_i && control_i.follow && pick_i != first_i)
endmodule

bind rdx_pick rdx_pick_cover #(
    .N1(N1),
    .K (K)
) u_cover (.*);

`default_nettype wire
