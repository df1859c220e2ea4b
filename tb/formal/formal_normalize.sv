// SPDX-License-Identifier: Apache-2.0
// rdx_normalize: all values are shifted by one number of places, as far as none overflows or the limit says, and keep their sign.
`default_nettype none
`include "formal.svh"

module formal_normalize #(
    parameter  int unsigned WIn   = 36,
    parameter  int unsigned WOut  = 36,
    parameter  int unsigned Count = 5,
    parameter  int unsigned Limit = 7,
    localparam int unsigned Bits  = $clog2(Limit + 1)
) (
    input wire logic                  clk_i,
    input wire logic                  en_i,
    input wire logic signed [WIn-1:0] values_i[Count]
);

  logic signed [WOut-1:0] values[Count];
  rdx_normalize #(
      .WIn  (WIn),
      .WOut (WOut),
      .Count(Count),
      .Limit(Limit)
  ) u_normalize (
      .clk_i,
      .en_i,
      .values_i,
      .values_o(values)
  );

  // ---- what went in last, and before that, of what counted ----
  localparam type value_t = logic signed [WIn-1:0];
  value_t earlier_q[Count], wanted_q[Count];
  logic [1:0] filled = '0;

  // ---- shifts that lose nothing: the places above the sign are copies of it ----
  logic [Limit:0] fits;
  always_comb begin
    for (int s = 0; s <= Limit; s++) begin
      fits[s] = 1'b1;
      for (int i = 0; i < Count; i++) if (((earlier_q[i] <<< s) >>> s) != earlier_q[i]) fits[s] = 1'b0;
    end
  end
  wire [Bits-1:0] shift = u_normalize.shift_q;
  `CHECK(p_fits, !filled[0] || fits[shift])
  `CHECK(p_most, !filled[0] || shift == Bits'(Limit) || !fits[Bits'(shift+1'b1)])

  logic [Count-1:0] sign_q;
  for (genvar i = 0; i < Count; i++) begin : gen_value
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        earlier_q[i] <= values_i[i];
        wanted_q[i]  <= earlier_q[i] <<< shift;
        sign_q[i]    <= earlier_q[i] < 0;
      end
    end
    `CHECK(p_held, !filled[0] || u_normalize.values_q[i] == earlier_q[i])
    `CHECK(p_value, !filled[1] || values[i] == wanted_q[i][WIn-1-:WOut])
    `CHECK(p_sign, !filled[1] || values[i][WOut-1] == sign_q[i])
  end
  always_ff @(posedge clk_i) if (en_i) filled <= {filled[0], 1'b1};
  for (genvar s = 1; s <= Limit; s++) begin : gen_shift
    `CHECK(p_all_below, !fits[s] || fits[s-1])
  end

  `REACH(r_limit, filled[1] && fits[Limit] && earlier_q[0] != '0)
  `REACH(r_none, filled[1] && !fits[1])

endmodule

`default_nettype wire
