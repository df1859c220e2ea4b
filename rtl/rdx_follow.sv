// SPDX-License-Identifier: Apache-2.0
// The control points of a chosen cell: the segment's halved towards it, a binary digit of its number after the other.
//
// The halves are those of rdx_cells, bit for bit: to halve once more takes fewer registers than to keep all the cells until
// one of them is chosen.
//
// Formats    b_i, b_o: D+1 Bernstein coefficients, sWp0. pick_i: number of the cell.
// Rounding   that of rdx_halve.    Overflow   cannot happen, as there.
// Timing     latency N1*Stages clocks, one segment a clock; no reset, no stall.
// Model      model/raydix/select.py (certified: its walk)
`default_nettype none

module rdx_follow #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned N1 = 3,
    parameter int unsigned Stages = (D + 1) / 2  // clocks of a digit, 1 or more
) (
    input  wire logic                 clk_i,
    input  wire logic signed [ W-1:0] b_i   [D+1],
    input  wire logic        [N1-1:0] pick_i,
    output logic signed      [ W-1:0] b_o   [D+1]
);

  for (genvar l = 0; l <= N1; l++) begin : gen_level
    logic signed [W-1:0] b[D+1];
    logic [N1-1:0] pick[1];  // the digits that are left, the next one on top
    if (l == 0) begin : gen_first
      assign b = b_i;
      assign pick[0] = pick_i;
    end else begin : gen_half
      logic signed [W-1:0] left[D+1], right[D+1];
      logic [N1-1:0] late[1];
      rdx_halve #(
          .W(W),
          .D(D),
          .Stages(Stages),
          .Last(1'b0)
      ) u_halve (
          .clk_i,
          .b_i(gen_level[l-1].b),
          .left_o(left),
          .right_o(right)
      );
      rdx_delay #(
          .T(logic [N1-1:0]),
          .Depth(Stages - 1)
      ) u_pick (
          .clk_i,
          .data_i(gen_level[l-1].pick),
          .data_o(late)
      );
      always_ff @(posedge clk_i) begin
        for (int unsigned i = 0; i <= D; i++) b[i] <= late[0][N1-1] ? right[i] : left[i];
        pick[0] <= late[0] << 1;
      end
    end
  end
  assign b_o = gen_level[N1].b;
  wire unused = &{1'b0, gen_level[N1].pick[0]};

endmodule

`default_nettype wire
