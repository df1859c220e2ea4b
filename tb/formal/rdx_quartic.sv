// SPDX-License-Identifier: Apache-2.0
// Stands in for rdx_quartic where streams are proved: coefficients that may be anything.
`default_nettype none

module rdx_quartic (
    input  wire logic           clk_i,
    input  wire logic           quartic_i,
    input  wire rdx_pkg::quad_t quads_i  [9],
    output rdx_pkg::quad_t      form_o   [5]
);

  rdx_pkg::quad_t any[5];  // anything: the driver leaves what nothing drives free
  always_ff @(posedge clk_i) form_o <= any;
  wire unused = &{1'b0, quartic_i, quads_i[0]};

endmodule

`default_nettype wire
