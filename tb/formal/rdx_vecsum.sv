// SPDX-License-Identifier: Apache-2.0
// Stands in for rdx_vecsum where streams are proved: a value that may be anything, and that stays while en_i = 0.
`default_nettype none

module rdx_vecsum #(
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0
) (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            en_i,
    input  wire rdx_pkg::form_t  form_i,
    input  wire rdx_pkg::coord_t point_i[3],
    output rdx_pkg::vector_t     value_o
);

  rdx_pkg::vector_t any;  // anything: the driver leaves what nothing drives free
  always_ff @(posedge clk_i) if (en_i) value_o <= any;
  wire unused = &{1'b0, rst_ni, form_i, point_i[0], point_i[1], point_i[2], General, VectorDrop};

endmodule

`default_nettype wire
