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
// Timing     latency rdx_pkg::QuarticLatency = 7 clocks: operands, products (3), sums (2), weights; each adds two numbers. One
//            a clock; no reset, no stall.
// Model      model/raydix/quartic.py
`default_nettype none

module rdx_quartic (
    input  wire logic           clk_i,
    input  wire logic           quartic_i,
    input  wire rdx_pkg::quad_t quads_i  [9],
    output rdx_pkg::quad_t      form_o   [5]
);
  import rdx_pkg::*;

  localparam int unsigned ProductWidth = 2 * OperandWidth - ProductDrop;
  localparam type product_t = logic signed [ProductWidth-1:0];

  // half up: the bits kept, and the one below them
  function automatic operand_t operand(quad_t value);
    return operand_t'(value >>> OperandShift) + operand_t'({1'b0, value[OperandShift-1]});
  endfunction

  operand_t a_q[3], b_q[3];
  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 3; i++) begin
      a_q[i] <= quartic_i ? operand(quads_i[3+i]) : '0;
      b_q[i] <= quartic_i ? operand(quads_i[6+i]) : '0;
    end
  end

  quad_t product[3][3];  // a[i] * b[j]
  for (genvar i = 0; i < 3; i++) begin : gen_row
    for (genvar j = 0; j < 3; j++) begin : gen_product
      product_t scaled;
      rdx_multiply #(
          .W(ProductWidth),
          .Drop(ProductDrop)
      ) u_multiply (
          .clk_i,
          .en_i(1'b1),
          .a_i(a_q[i]),
          .b_i(b_q[j]),
          .product_o(scaled)
      );
      assign product[i][j] = quad_t'(scaled);
    end
  end

  // Q3 beside the operands and the products
  quad_t c_i[3], c[3];
  assign c_i = quads_i[0:2];
  rdx_delay #(
      .T(quad_t),
      .Count(3),
      .Depth(QuarticLatency - 3)
  ) u_wait (
      .clk_i,
      .data_i(c_i),
      .data_o(c)
  );

  quad_t outer_q[5], lower_q[5], middle_q, sum_q[5], middle_qq;
  always_ff @(posedge clk_i) begin
    outer_q[0] <= product[0][0];
    outer_q[1] <= product[0][1] + product[1][0];
    outer_q[2] <= product[0][2] + product[2][0];
    outer_q[3] <= product[1][2] + product[2][1];
    outer_q[4] <= product[2][2];
    lower_q[0] <= c[0];
    lower_q[1] <= c[0] + c[1];
    lower_q[2] <= c[0] + c[2];
    lower_q[3] <= c[1] + c[2];
    lower_q[4] <= c[2];
    middle_q   <= product[1][1] + c[1];

    for (int unsigned k = 0; k < 5; k++) sum_q[k] <= outer_q[k] + lower_q[k];
    middle_qq <= middle_q;

    form_o[0] <= (sum_q[0] <<< 2) + (sum_q[0] <<< 1);
    form_o[1] <= (sum_q[1] <<< 1) + sum_q[1];
    form_o[2] <= sum_q[2] + (middle_qq <<< 2);
    form_o[3] <= (sum_q[3] <<< 1) + sum_q[3];
    form_o[4] <= (sum_q[4] <<< 2) + (sum_q[4] <<< 1);
  end

endmodule

`default_nettype wire
