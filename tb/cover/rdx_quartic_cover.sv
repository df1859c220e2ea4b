// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_quartic.
`default_nettype none
`include "rdx_cover.svh"

module rdx_quartic_cover (
    input wire logic              clk_i,
    input wire logic              quartic_i,
    input wire rdx_pkg::quad_t    quads_i  [9],
    input wire rdx_pkg::operand_t a_q      [3],
    input wire rdx_pkg::operand_t b_q      [3],
    input wire rdx_pkg::quad_t    form_o   [5]
);
  localparam int unsigned Shift = rdx_pkg::OperandShift;
  localparam int unsigned Drop = rdx_pkg::ProductDrop;
  localparam rdx_pkg::operand_t Large = rdx_pkg::operand_t'((36'sd1 << 35) - 1);
  for (genvar i = 0; i < 3; i++) begin : gen_operand
    `RDX_COVER(rounded_up, quartic_i && quads_i[3+i][Shift-1])
    `RDX_COVER(rounded_down, quartic_i && !quads_i[3+i][Shift-1] && quads_i[3+i][Shift-2:0] != '0)
    `RDX_COVER(largest, a_q[i] == Large || b_q[i] == Large)
    `RDX_COVER(least, a_q[i] <= -Large || b_q[i] <= -Large)
    for (genvar s = 0; s < 4; s++) begin : gen_signs
      `RDX_COVER(signs, a_q[i] != 0 && b_q[i] != 0 && {a_q[i] < 0, b_q[i] < 0} == 2'(s))
    end
    `RDX_COVER(dropped, (72'(a_q[i]) * 72'(b_q[i]) & ((72'd1 << Drop) - 1)) != 0)
  end
  for (genvar i = 0; i < 5; i++) begin : gen_form
    `RDX_COVER(near_largest, form_o[i][63:61] == 3'b011)
    `RDX_COVER(near_least, form_o[i][63:61] == 3'b101)
  end
  `RDX_COVER(no_product, !quartic_i)
  `RDX_COVER(product, quartic_i)
endmodule

bind rdx_quartic rdx_quartic_cover u_cover (.*);

`default_nettype wire
