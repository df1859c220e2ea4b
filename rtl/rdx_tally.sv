// SPDX-License-Identifier: Apache-2.0
// How many pixels of each of the lines at work still wait for their verdict: no ray, or a ray's last record.
//
// Formats    *_row_i: the line. add_count_i: pixels of a surface's row less one, u12p0.
// Overflow   cannot happen: 64 surfaces of 4,096 pixels.
// Timing     zero_o follows by a clock.
// Reset      counts 0.
// Model      none: it counts
`default_nettype none
`include "rdx_assert.svh"

module rdx_tally #(
    parameter int unsigned Lines = 2,  // 2 or 4
    parameter int unsigned Verdicts = 4  // that can come in a clock
) (
    input  wire logic                           clk_i,
    input  wire logic                           rst_ni,
    input  wire logic                           add_i,
    input  wire rdx_pkg::line_t                 add_row_i,
    input  wire rdx_pkg::pixel_t                add_count_i,
    input  wire logic            [Verdicts-1:0] verdict_i,
    input  wire rdx_pkg::line_t  [Verdicts-1:0] verdict_row_i,
    output logic                 [   Lines-1:0] zero_o
);
  import rdx_pkg::*;

  localparam int unsigned Width = PixelWidth + SurfaceWidth + 1;
  localparam type index_t = logic [$clog2(Lines)-1:0];
  if (Lines != 2 && Lines != 4) begin : gen_illegal_lines
    $fatal(1, "rdx_tally: Lines = %0d; allowed: 2, 4", Lines);
  end
  for (genvar row = 0; row < Lines; row++) begin : gen_row
    logic [Width-1:0] count_q, less;
    always_comb begin
      less = '0;
      for (int unsigned i = 0; i < Verdicts; i++)
      if (verdict_i[i] && index_t'(verdict_row_i[i]) == index_t'(row)) less = less + 1'b1;
    end
    wire [Width-1:0] more = add_i && index_t'(add_row_i) == index_t'(row) ? Width'(add_count_i) + 1'b1 : '0;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) count_q <= '0;
      else count_q <= count_q + more - less;
    end
    assign zero_o[row] = count_q == '0;
    `RDX_ASSERT(a_enough, count_q + more >= less)
  end
  wire unused = &{1'b0, add_row_i, verdict_row_i};

endmodule

`default_nettype wire
