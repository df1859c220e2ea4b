// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_shade.
`default_nettype none
`include "rdx_cover.svh"

module rdx_shade_cover (
    input wire logic            clk_i,
    input wire logic            rst_ni,
    input wire logic            layer_valid_i,
    input wire rdx_pkg::layer_t layer_i,
    input wire logic            read_bank_i
);
  `RDX_COVER_RUN(background, layer_valid_i && !layer_i.shade)
  `RDX_COVER_RUN(layer, layer_valid_i && layer_i.shade)
  `RDX_COVER_RUN(enters, layer_valid_i && layer_i.shade && layer_i.enters)
  `RDX_COVER_RUN(leaves, layer_valid_i && layer_i.shade && !layer_i.enters)
  `RDX_COVER_RUN(other_bank, layer_valid_i && read_bank_i)
  `RDX_COVER_RUN(gap, !layer_valid_i)
endmodule

bind rdx_shade rdx_shade_cover u_cover (.*);

`default_nettype wire
