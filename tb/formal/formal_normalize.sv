// SPDX-License-Identifier: Apache-2.0
// rdx_normalize: all values are shifted by one number of places, as far as none overflows or the limit says, and keep their sign.
`default_nettype none
`include "formal.svh"

module formal_normalize #(
    parameter  int unsigned WIn    = 36,
    parameter  int unsigned WOut   = 36,
    parameter  int unsigned Count  = 5,
    parameter  int unsigned Limit  = 7,
    parameter  int unsigned Stages = 2,
    localparam int unsigned Bits   = $clog2(Limit + 1)
) (
    input wire logic                  clk_i,
    input wire logic                  en_i,
    input wire logic signed [WIn-1:0] values_i[Count]
);

  logic signed [WOut-1:0] values[Count];
  rdx_normalize #(
      .WIn(WIn),
      .WOut(WOut),
      .Count(Count),
      .Limit(Limit),
      .Stages(Stages)
  ) u_normalize (
      .clk_i,
      .en_i,
      .values_i,
      .values_o(values)
  );

  // ---- what went in, of what counted: [0] last; the shift is that of earlier, the result that of the one before ----
  localparam type value_t = logic signed [WIn-1:0];
  value_t line_q[Stages-1][Count], earlier[Count], wanted_q[Count];
  assign earlier = line_q[Stages-2];
  logic [Stages-1:0] filled = '0;
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      line_q[0] <= values_i;
      for (int k = 1; k < Stages - 1; k++) line_q[k] <= line_q[k-1];
      filled <= {filled[Stages-2:0], 1'b1};
    end
  end

  // ---- shifts that lose nothing: the places above the sign are copies of it ----
  logic [Limit:0] fits;
  always_comb begin
    for (int s = 0; s <= Limit; s++) begin
      fits[s] = 1'b1;
      for (int i = 0; i < Count; i++) if (((earlier[i] <<< s) >>> s) != earlier[i]) fits[s] = 1'b0;
    end
  end
  wire shifted = filled[Stages-2];
  logic [Bits-1:0] shift;
  `CHECK(p_fits, !shifted || fits[shift])
  `CHECK(p_most, !shifted || shift == Bits'(Limit) || !fits[Bits'(shift+1'b1)])

  logic [Count-1:0] sign_q;
  if (Stages == 4) begin : gen_eights
    `GIVEN(g_always, en_i)
    logic [Bits-4:0] eights_q;
    always_ff @(posedge clk_i) if (en_i) eights_q <= u_normalize.gen_eights.eights_q;
    assign shift = {eights_q, u_normalize.shift_q};
  end else begin : gen_all
    assign shift = u_normalize.shift_q;
    for (genvar i = 0; i < Count; i++) begin : gen_held
      `CHECK(p_held, !shifted || u_normalize.values_q[i] == earlier[i])
    end
  end
  for (genvar i = 0; i < Count; i++) begin : gen_value
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        wanted_q[i] <= earlier[i] <<< shift;
        sign_q[i]   <= earlier[i] < 0;
      end
    end
    `CHECK(p_value, !filled[Stages-1] || values[i] == wanted_q[i][WIn-1-:WOut])
    `CHECK(p_sign, !filled[Stages-1] || values[i][WOut-1] == sign_q[i])
  end
  for (genvar s = 1; s <= Limit; s++) begin : gen_shift
    `CHECK(p_all_below, !fits[s] || fits[s-1])
  end

  `REACH(r_limit, filled[Stages-1] && fits[Limit] && earlier[0] != '0)
  `REACH(r_none, filled[Stages-1] && !fits[1])

endmodule

`default_nettype wire
