// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_check.
`default_nettype none
`include "rdx_cover.svh"

module rdx_check_cover
  import rdx_pkg::*;
#(
    parameter int unsigned K = 8,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned MaxWidth = 1920
) (
    input wire logic     clk_i,
    input wire logic     rst_ni,
    input wire logic     start_i,
    input wire request_t request_i,
    input wire logic     start_valid_o,
    input wire logic     start_ready_i,
    input wire logic     done_i,
    input wire logic     error_valid_i,
    input wire logic     error_o,
    input wire logic     known_i,
    input wire error_e   code,
    input wire logic     legal
);
  `RDX_COVER_RUN(largest, legal && request_i.width == 13'(MaxWidth) && request_i.height[12])
  `RDX_COVER_RUN(no_surface, legal && request_i.count == '0)
  `RDX_COVER_RUN(every_surface, legal && request_i.count == 7'(Surfaces))
  `RDX_COVER_RUN(deepest, legal && request_i.k_stop == 6'(K))
  `RDX_COVER_RUN(taken_and_next, legal && start_valid_o && start_ready_i)
  `RDX_COVER_RUN(queued, start_i && code == ErrorQueued)
  `RDX_COVER_RUN(size, start_i && code == ErrorSize)
  `RDX_COVER_RUN(count, start_i && code == ErrorCount)
  `RDX_COVER_RUN(k_stop, start_i && code == ErrorKStop)
  `RDX_COVER_RUN(two_errors, start_i && !legal && error_valid_i)
  `RDX_COVER_RUN(first_error, error_o && !known_i)
  `RDX_COVER_RUN(later_error, error_o && known_i)
  `RDX_COVER_RUN(done_with_start, done_i && legal)
endmodule

bind rdx_check rdx_check_cover #(
    .K       (K),
    .Surfaces(Surfaces),
    .MaxWidth(MaxWidth)
) u_cover (.*);

`default_nettype wire
