// SPDX-License-Identifier: Apache-2.0
// Product of two 36-bit operands, scaled: floor(a*b / 2^Drop), in three clocks and four 18 by 18 multipliers.
//
// With a = a1*2^18 + a0 the low half is a0 = as + 2^18*s, where as is the same bits as a signed number and s the top one
// of them. So every partial product is one of two signed, or two unsigned, halves.
//
// Formats    a_i, b_i: s36p0. product_o: s<W>p0, the low W bits of the result.
// Rounding   floor.    Overflow   the caller's W holds the result.
// Timing     latency 3 clocks in which en_i = 1, one product a clock; no reset.
// Note       the low halves are extended by zeros, not by a cast: read_slang of yosys 0.70 takes a part of a vector for signed
//            where a typedef made the vector signed.
// Model      model/raydix/multiply.py
`default_nettype none

module rdx_multiply #(
    parameter int unsigned W = 38,
    parameter int unsigned Drop = 25
) (
    input  wire logic                      clk_i,
    input  wire logic                      en_i,
    input  wire rdx_pkg::operand_t         a_i,
    input  wire rdx_pkg::operand_t         b_i,
    output logic signed            [W-1:0] product_o
);

  localparam int unsigned Half = rdx_pkg::OperandWidth / 2;
  if (W + Drop > 4 * Half) begin : gen_illegal_w
    $fatal(1, "rdx_multiply: W = %0d; allowed: at most %0d with Drop = %0d", W, 4 * Half - Drop, Drop);
  end
  localparam type half_t = logic signed [Half-1:0];
  localparam type twice_t = logic signed [2*Half-1:0];
  localparam type middle_t = logic signed [2*Half+1:0];

  wire half_t a1 = a_i[2*Half-1:Half];
  wire half_t b1 = b_i[2*Half-1:Half];
  wire half_t as = a_i[Half-1:0];
  wire half_t bs = b_i[Half-1:0];

  twice_t high_q, left_q, right_q, high_qq;
  logic [2*Half-1:0] low_q, low_qq;
  logic signed [Half:0] carry_q;
  middle_t middle_q;
  logic signed [4*Half-1:0] total;
  always_comb total = {high_qq, low_qq} + ((4 * Half)'(middle_q) <<< Half);

  always_ff @(posedge clk_i) begin
    if (en_i) begin
      high_q <= twice_t'(a1) * twice_t'(b1);
      left_q <= twice_t'(a1) * twice_t'(bs);
      right_q <= twice_t'(as) * twice_t'(b1);
      low_q <= {{Half{1'b0}}, a_i[Half-1:0]} * {{Half{1'b0}}, b_i[Half-1:0]};  // no cast, see Note
      carry_q <= (b_i[Half-1] ? (Half + 1)'(a1) : '0) + (a_i[Half-1] ? (Half + 1)'(b1) : '0);
      high_qq <= high_q;
      low_qq <= low_q;
      middle_q <= middle_t'(left_q) + middle_t'(right_q) + (middle_t'(carry_q) <<< Half);
      product_o <= W'(total >>> Drop);
    end
  end

endmodule

`default_nettype wire
