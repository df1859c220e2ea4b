// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_normal.
`default_nettype none
`include "rdx_cover.svh"

module rdx_normal_cover #(
    parameter int unsigned D = 4,
    parameter int unsigned Vecsum = 0
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic is_vector
);
  if (D > 0 && Vecsum > 0) begin : gen_both
    logic is_vector_q;
    always_ff @(posedge clk_i) is_vector_q <= is_vector;
    `RDX_COVER_RUN(vector_behind_algebraic, is_vector && !is_vector_q)
    `RDX_COVER_RUN(algebraic_behind_vector, !is_vector && is_vector_q)
    `RDX_COVER_RUN(vector_behind_vector, is_vector && is_vector_q)
    `RDX_COVER_RUN(algebraic_behind_algebraic, !is_vector && !is_vector_q)
  end
endmodule

bind rdx_normal rdx_normal_cover #(
    .D(D),
    .Vecsum(Vecsum)
) u_cover (.*);

`default_nettype wire
