// SPDX-License-Identifier: Apache-2.0
// Scales control points by a common power of two: shifts out the sign bits that all of them can lose.
//
// Formats    values_i: Count values s<WIn>p0; values_o: s<WOut>p0, the top WOut bits after the shift.
// Rounding   floor (less than one ulp of the output, in all values downwards); exact for WIn = WOut.
// Overflow   cannot happen: only redundant sign bits are shifted out.
// Timing     latency rdx_pkg::NormalizeLatency = 2 clocks in which en_i = 1: shift amount, then shift.
// Model      model/raydix/normalize.py
`default_nettype none

module rdx_normalize #(
    parameter int unsigned WIn   = 36,
    parameter int unsigned WOut  = 36,
    parameter int unsigned Count = 5,
    parameter int unsigned Limit = 7    // largest shift, 2^b - 1 and below WIn
) (
    input  wire logic                   clk_i,
    input  wire logic                   en_i,
    input  wire logic signed [ WIn-1:0] values_i[Count],
    output logic signed      [WOut-1:0] values_o[Count]
);

  localparam int unsigned Bits = $clog2(Limit + 1);
  if (WOut > WIn) begin : gen_illegal_wout
    $fatal(1, "rdx_normalize: WOut = %0d; allowed: at most WIn = %0d", WOut, WIn);
  end
  if (Limit < 1 || Limit >= WIn) begin : gen_illegal_limit
    $fatal(1, "rdx_normalize: Limit = %0d; allowed: 1 to %0d", Limit, WIn - 1);
  end
  if (Limit != (1 << Bits) - 1) begin : gen_illegal_limit_2
    $fatal(1, "rdx_normalize: Limit = %0d; allowed: a power of two less one", Limit);
  end

  // Bits in use below the sign in any of the values, then the leading zeros of that, at most Limit
  logic [WIn-2:0] used;
  logic [Bits-1:0] shift_d, shift_q;
  always_comb begin
    used = '0;
    for (int unsigned i = 0; i < Count; i++) used |= values_i[i][WIn-2:0] ^ {(WIn - 1) {values_i[i][WIn-1]}};
    shift_d = Bits'(Limit);
    for (int unsigned s = 0; s < Limit; s++) if (used[WIn-2-(Limit-1-s)]) shift_d = Bits'(Limit - 1 - s);
  end

  logic signed [WIn-1:0] values_q[Count];
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      shift_q  <= shift_d;
      values_q <= values_i;
    end
  end

  for (genvar i = 0; i < Count; i++) begin : gen_value
    wire signed [WIn-1:0] shifted = values_q[i] <<< shift_q;
    always_ff @(posedge clk_i) if (en_i) values_o[i] <= shifted[WIn-1-:WOut];
    if (WIn > WOut) begin : gen_dropped
      wire unused = &{1'b0, shifted[WIn-WOut-1:0]};
    end
  end

endmodule

`default_nettype wire
