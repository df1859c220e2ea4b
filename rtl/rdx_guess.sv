// SPDX-License-Identifier: Apache-2.0
// The paper rule's Case 1 (equations 8 and 9): where the indicator comes nearest to zero without changing sign.
//
// Let j be the boundary with the smallest |value|, the lowest on a tie. Of the two cells beside it the one with the
// smaller second difference is taken, [j, j+1] on a tie; at either end only one cell is left.
//
// Formats    values_i: indicator at the J+1 boundaries, sWp0. Magnitudes and differences are unsigned, W bits.
// Timing     latency rdx_pkg::select_latency(N1, RulePaper) - 2 clocks, one guess a clock; no reset, no stall.
//            Registers: magnitudes; then one after each two levels of the comparator tree. Then cell_o is combinational.
// Model      model/raydix/guess.py
`default_nettype none

module rdx_guess #(
    parameter  int unsigned W  = 36,
    parameter  int unsigned N1 = 3,
    localparam int unsigned J  = 1 << N1
) (
    input  wire logic                 clk_i,
    input  wire logic signed [ W-1:0] values_i[J+1],
    output logic             [N1-1:0] cell_o
);

  localparam int unsigned Levels = N1 + 1;  // of the comparator tree over J+1 values
  localparam int unsigned TreeStages = (Levels + 1) / 2;

  // Magnitudes and second differences
  logic signed [W-1:0] size_d  [J+1];
  logic signed [W-1:0] size_q  [J+1];
  logic signed [W-1:0] second_d[  J];
  logic signed [W-1:0] second_q[  J];
  always_comb begin
    for (int unsigned j = 0; j <= J; j++) size_d[j] = values_i[j] < 0 ? -values_i[j] : values_i[j];
    for (int unsigned j = 0; j < J; j++)
    second_d[j] = values_i[j] < values_i[j+1] ? values_i[j+1] - values_i[j] : values_i[j] - values_i[j+1];
  end
  rdx_delay #(
      .T(logic signed [W-1:0]),
      .Count(J + 1),
      .Depth(1)
  ) u_size (
      .clk_i,
      .data_i(size_d),
      .data_o(size_q)
  );
  rdx_delay #(
      .T(logic signed [W-1:0]),
      .Count(J),
      .Depth(1 + TreeStages)
  ) u_second (
      .clk_i,
      .data_i(second_d),
      .data_o(second_q)
  );

  // Comparator tree: the smaller of each pair goes on, the left one on a tie; an odd one goes on alone.
  for (genvar l = 0; l <= Levels; l++) begin : gen_level
    localparam int unsigned Count = (J + 1 + (1 << l) - 1) >> l;
    logic [W-1:0] size [Count];
    logic [ N1:0] index[Count];
    if (l == 0) begin : gen_leaves
      for (genvar i = 0; i < Count; i++) begin : gen_leaf
        assign size[i]  = size_q[i];
        assign index[i] = (N1 + 1)'(i);
      end
    end else begin : gen_pairs
      localparam int unsigned Before = (J + 1 + (1 << (l - 1)) - 1) >> (l - 1);
      localparam bit Registered = l % 2 == 0 || l == Levels;
      logic [W-1:0] size_n [Count];
      logic [ N1:0] index_n[Count];
      for (genvar i = 0; i < Count; i++) begin : gen_pair
        if (2 * i + 1 < Before) begin : gen_compare
          wire right = gen_level[l-1].size[2*i+1] < gen_level[l-1].size[2*i];
          assign size_n[i]  = right ? gen_level[l-1].size[2*i+1] : gen_level[l-1].size[2*i];
          assign index_n[i] = right ? gen_level[l-1].index[2*i+1] : gen_level[l-1].index[2*i];
        end else begin : gen_pass
          assign size_n[i]  = gen_level[l-1].size[2*i];
          assign index_n[i] = gen_level[l-1].index[2*i];
        end
      end
      if (Registered) begin : gen_register
        always_ff @(posedge clk_i) begin
          size  <= size_n;
          index <= index_n;
        end
      end else begin : gen_wire
        assign size  = size_n;
        assign index = index_n;
      end
    end
  end

  wire unused = &{1'b0, gen_level[Levels].size[0]};

  // The smaller second difference names the cell
  wire [N1:0] best = gen_level[Levels].index[0];
  logic [W-1:0] right_second, left_second;
  always_comb begin
    right_second = second_q[best[N1-1:0]];
    left_second  = second_q[N1'(best-1)];
    if (best == '0) cell_o = '0;
    else if (best == (N1 + 1)'(J)) cell_o = N1'(J - 1);
    else cell_o = right_second <= left_second ? best[N1-1:0] : N1'(best - 1);
  end

endmodule

`default_nettype wire
