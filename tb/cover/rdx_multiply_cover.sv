// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_multiply.
`default_nettype none
`include "rdx_cover.svh"

module rdx_multiply_cover #(
    parameter  int unsigned Drop = 25,
    localparam int unsigned Full = 2 * rdx_pkg::OperandWidth
) (
    input wire logic                         clk_i,
    input wire logic                         en_i,
    input wire rdx_pkg::operand_t            a_i,
    input wire rdx_pkg::operand_t            b_i,
    input wire logic signed       [Full-1:0] total
);
  localparam rdx_pkg::operand_t Least = {1'b1, {(rdx_pkg::OperandWidth - 1) {1'b0}}};
  for (genvar s = 0; s < 4; s++) begin : gen_signs
    `RDX_COVER(signs, {a_i < 0, b_i < 0} == 2'(s))
    `RDX_COVER(low_halves, {a_i[Full/4-1], b_i[Full/4-1]} == 2'(s))
    `RDX_COVER(extremes, a_i == (s[1] ? Least : ~Least) && b_i == (s[0] ? Least : ~Least))
  end
  `RDX_COVER(zero, a_i == 0 || b_i == 0)
  if (Drop > 0) begin : gen_floor
    `RDX_COVER(exact, total != 0 && (total & ((Full'(1) << Drop) - 1)) == 0)
    `RDX_COVER(floor_of_negative, total < 0 && (total & ((Full'(1) << Drop) - 1)) != 0)
    `RDX_COVER(floor_to_minus_one, total < 0 && (total >>> Drop) == -1)
  end
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_multiply rdx_multiply_cover #(.Drop(Drop)) u_cover (.*);

`default_nettype wire
