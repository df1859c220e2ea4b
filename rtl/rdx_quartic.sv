// SPDX-License-Identifier: Apache-2.0
// Six times the Bernstein coefficients of degree 4 of Q1*Q2 + Q3, or of Q3 alone.
//
// With control points a, b, c of Q1, Q2, Q3 on the segment:
//   6 F0 = 6 (a0 b0 + c0)          6 F1 = 3 (a0 b1 + a1 b0 + c0 + c1)
//   6 F2 = a0 b2 + 4 a1 b1 + a2 b0 + c0 + 4 c1 + c2          and so on, symmetrically.
//
// Formats    quads_i: s64p0, c then a then b; operands of the product s36p0 (accumulator / 2^27, half up), products s60p0
//            (/ 2^12, floor); form_o: s64p0.
// Overflow   cannot happen: compile keeps |a|, |b| < 2^62 - 2^26 and |c| <= 2^59, or 2^60 where quartic_i = 0.
// Timing     latency 4 clocks in which en_i = 1: operands, products, sums, weights; one a clock.
// Model      model/raydix/quartic.py
`default_nettype none

module rdx_quartic (
    input  wire logic           clk_i,
    input  wire logic           en_i,
    input  wire logic           quartic_i,
    input  wire rdx_pkg::quad_t quads_i  [9],
    output rdx_pkg::quad_t      form_o   [5]
);
  import rdx_pkg::*;

  localparam type operand_t = logic signed [OperandWidth-1:0];
  localparam type twice_t = logic signed [2*OperandWidth-1:0];

  function automatic operand_t operand(quad_t value);
    return operand_t'((value + quad_t'(64'd1 << (OperandShift - 1))) >>> OperandShift);
  endfunction

  function automatic quad_t multiply(operand_t a, operand_t b);
    return quad_t'((twice_t'(a) * twice_t'(b)) >>> ProductDrop);
  endfunction

  operand_t a_q[3], b_q[3];
  quad_t c_q[3], c_qq[3];  // Q3, beside the operands and the products
  quad_t    product_q[3][3];  // a[i] * b[j]
  quad_t    sum_q[5];
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      for (int unsigned i = 0; i < 3; i++) begin
        a_q[i] <= quartic_i ? operand(quads_i[3+i]) : '0;
        b_q[i] <= quartic_i ? operand(quads_i[6+i]) : '0;
      end
      c_q  <= quads_i[0:2];
      c_qq <= c_q;
      for (int unsigned i = 0; i < 3; i++) begin
        for (int unsigned j = 0; j < 3; j++) product_q[i][j] <= multiply(a_q[i], b_q[j]);
      end
      sum_q[0]  <= product_q[0][0] + c_qq[0];
      sum_q[1]  <= product_q[0][1] + product_q[1][0] + c_qq[0] + c_qq[1];
      sum_q[2]  <= product_q[0][2] + product_q[2][0] + c_qq[0] + c_qq[2] + ((product_q[1][1] + c_qq[1]) <<< 2);
      sum_q[3]  <= product_q[1][2] + product_q[2][1] + c_qq[1] + c_qq[2];
      sum_q[4]  <= product_q[2][2] + c_qq[2];
      form_o[0] <= (sum_q[0] <<< 2) + (sum_q[0] <<< 1);
      form_o[1] <= (sum_q[1] <<< 1) + sum_q[1];
      form_o[2] <= sum_q[2];
      form_o[3] <= (sum_q[3] <<< 1) + sum_q[3];
      form_o[4] <= (sum_q[4] <<< 2) + (sum_q[4] <<< 1);
    end
  end

endmodule

`default_nettype wire
