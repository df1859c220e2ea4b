// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_form.
`default_nettype none
`include "rdx_cover.svh"

module rdx_form_cover (
    input wire logic       clk_i,
    input wire logic       load_i,
    input wire logic [6:0] index_i
);
  for (genvar i = 0; i < rdx_pkg::FormWords; i++) begin : gen_word
    `RDX_COVER(loaded, load_i && 32'(index_i) == i)
  end
  `RDX_COVER(waits, !load_i)
endmodule

bind rdx_form rdx_form_cover u_cover (.*);

`default_nettype wire
