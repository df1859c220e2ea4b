// SPDX-License-Identifier: Apache-2.0
// rdx_scale, the normaliser of a step: all values are shifted by the largest number of places that none of them overflows at.
`default_nettype none
`include "formal.svh"

module formal_scale #(
    parameter  int unsigned W      = 36,
    parameter  int unsigned Count  = 5,
    parameter  int unsigned Bits   = 3,
    parameter  int unsigned Stages = 3,
    localparam int unsigned Limit  = (1 << Bits) - 1
) (
    input wire logic                clk_i,
    input wire logic signed [W-1:0] values_i[Count]
);

  localparam type value_t = logic signed [W-1:0];
  value_t values[Count], line_q[Stages][Count], was[Count];
  rdx_scale #(
      .W(W),
      .Count(Count),
      .Bits(Bits),
      .Stages(Stages)
  ) u_scale (
      .clk_i,
      .values_i,
      .values_o(values)
  );

  logic [Stages-1:0] filled = '0;
  always_ff @(posedge clk_i) begin
    filled <= {filled[Stages-2:0], 1'b1};
    line_q[0] <= values_i;
    for (int k = 1; k < Stages; k++) line_q[k] <= line_q[k-1];
  end
  assign was = line_q[Stages-1];

  logic [ Limit:0] fits;
  logic [Bits-1:0] most;
  always_comb begin
    most = '0;
    for (int s = 0; s <= Limit; s++) begin
      fits[s] = 1'b1;
      for (int i = 0; i < Count; i++) if (((was[i] <<< s) >>> s) != was[i]) fits[s] = 1'b0;
      if (fits[s]) most = Bits'(s);
    end
  end
  for (genvar i = 0; i < Count; i++) begin : gen_value
    `CHECK(p_value, !filled[Stages-1] || values[i] == was[i] <<< most)
    `CHECK(p_sign, !filled[Stages-1] || (values[i] < 0) == (was[i] < 0))
  end

  `REACH(r_limit, filled[Stages-1] && fits[Limit] && was[0] != '0)
  `REACH(r_none, filled[Stages-1] && !fits[1])

endmodule

`default_nettype wire
