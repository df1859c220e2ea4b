// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_register.
`default_nettype none
`include "rdx_cover.svh"

module rdx_register_cover (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic valid_i,
    input wire logic valid_o,
    input wire logic ready_i
);
  `RDX_COVER_RUN(empty, !valid_o && !valid_i)
  `RDX_COVER_RUN(filled, !valid_o && valid_i && !ready_i)
  `RDX_COVER_RUN(full_and_stalled, valid_o && !ready_i && valid_i)
  `RDX_COVER_RUN(full_and_passed_on, valid_o && ready_i && valid_i)
  `RDX_COVER_RUN(emptied, valid_o && ready_i && !valid_i)
endmodule

bind rdx_register rdx_register_cover u_cover (.*);

`default_nettype wire
