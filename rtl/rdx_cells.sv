// SPDX-License-Identifier: Apache-2.0
// Halves a cell N1 times: the J = 2^N1 cells of a step, as a tree of J - 1 halvers.
//
// Formats    b_i: D+1 Bernstein coefficients, sWp0. cells_o: J*D+1 values, sWp0; cell j is cells_o[j*D +: D+1], so
//            neighbours share an end and cells_o[j*D] is the indicator at boundary j, 0 <= j <= J.
// Rounding   that of rdx_halve.    Overflow   cannot happen, as there.
// Timing     latency First + (N1-1)*HalveStages clocks, one less for Last = 0, one cell a clock; no reset, no stall.
// Error      at most N1*D/2 ulp.
// Model      model/raydix/cells.py (subdivide)
`default_nettype none

module rdx_cells #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned N1 = 3,
    parameter int unsigned HalveStages = 2,
    parameter int unsigned First = HalveStages,  // clocks of the first halving
    parameter bit Last = 1'b1  // 0: without the registers behind the last row of the last halving
) (
    input  wire logic                clk_i,
    input  wire logic signed [W-1:0] b_i    [        D+1],
    output logic signed      [W-1:0] cells_o[(1<<N1)*D+1]
);

  if (N1 < 1 || N1 > 4) begin : gen_illegal_n1
    $fatal(1, "rdx_cells: N1 = %0d; allowed: 1 to 4", N1);
  end

  for (genvar l = 0; l <= N1; l++) begin : gen_level
    logic signed [W-1:0] points[(1<<l)*D+1];  // the 2^l cells after l halvings
    if (l == 0) begin : gen_root
      assign points = b_i;
    end else begin : gen_halves
      for (genvar c = 0; c < (1 << (l - 1)); c++) begin : gen_cell
        logic signed [W-1:0] whole[D+1];
        logic signed [W-1:0] left [D+1];
        logic signed [W-1:0] right[D+1];
        for (genvar i = 0; i <= D; i++) begin : gen_point
          assign whole[i] = gen_level[l-1].points[c*D+i];
          // neighbours share an end: only the first cell gives its first point
          if (i > 0 || c == 0) begin : gen_left
            assign points[2*c*D+i] = left[i];
          end
          if (i > 0) begin : gen_right
            assign points[(2*c+1)*D+i] = right[i];
          end
        end
        rdx_halve #(
            .W(W),
            .D(D),
            .Stages(l == 1 ? First : HalveStages),
            .Last(Last || l < N1)
        ) u_halve (
            .clk_i,
            .b_i(whole),
            .left_o(left),
            .right_o(right)
        );
      end
    end
  end

  assign cells_o = gen_level[N1].points;

endmodule

`default_nettype wire
