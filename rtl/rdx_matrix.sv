// SPDX-License-Identifier: Apache-2.0
// Product of a matrix of the material and a vector: nine multipliers.
//
// Formats    write_i, material_i: as those of rdx_constant. The matrix, s1p17, is that from place Index on: nine constants by
//            rows, or, Symmetric, six: 11, 22, 33, 12, 23, 31. vector_i: 18 bits. product_o: 37 bits, 17 fractional bits more.
// Rounding   none.    Overflow   cannot happen: a component is at most 3 * 2^34.
// Timing     vector_i rdx_pkg::ConstantLatency = 2 clocks after material_i, product_o rdx_pkg::MatrixLatency = 3 clocks after
//            vector_i; one product a clock; no reset.
// Model      model/raydix/gradient.py (slope), light.py (cosine)
`default_nettype none

module rdx_matrix #(
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Index = 0,
    parameter bit Symmetric = 1'b1
) (
    input  wire logic                            clk_i,
    input  wire rdx_pkg::material_write_t        write_i,
    input  wire rdx_pkg::material_t              material_i,
    input  wire rdx_pkg::normal_t                vector_i  [3],
    output logic signed                   [36:0] product_o [3]
);
  import rdx_pkg::*;

  localparam int unsigned Count = Symmetric ? 6 : 9;
  logic [NormalWidth-1:0] words[Count];
  for (genvar i = 0; i < Count; i++) begin : gen_constant
    rdx_constant #(
        .Surfaces(Surfaces),
        .W(NormalWidth),
        .Index(Index + i)
    ) u_constant (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(words[i])
    );
  end

  // Which constant stands in a row and a column
  function automatic int unsigned place(int unsigned row, int unsigned column);
    if (!Symmetric) return 3 * row + column;
    if (row == column) return row;
    return row + column == 1 ? 3 : row + column == 3 ? 4 : 5;
  endfunction

  for (genvar row = 0; row < 3; row++) begin : gen_row
    product_t parts_q[3], third_q;
    logic signed [36:0] two_q;
    for (genvar column = 0; column < 3; column++) begin : gen_column
      wire normal_t factor = words[place(row, column)];
      always_ff @(posedge clk_i) parts_q[column] <= product_t'(factor) * product_t'(vector_i[column]);
    end
    always_ff @(posedge clk_i) begin
      two_q <= 37'(parts_q[0]) + 37'(parts_q[1]);
      third_q <= parts_q[2];
      product_o[row] <= two_q + 37'(third_q);
    end
  end

endmodule

`default_nettype wire
