// SPDX-License-Identifier: Apache-2.0
// Scales control points by a common power of two, at most 2^(2^Bits - 1), a bit of the exponent after the other.
//
// For each bit, from the upper one: do all values have that many sign bits to lose? Then they are shifted out at once, so
// that a multiplexer has two inputs, and nothing is counted.
//
// Formats    values_i, values_o: Count values, sWp0.
// Rounding   exact.    Overflow   cannot happen: only redundant sign bits are shifted out.
// Timing     latency Stages clocks, one vector a clock; no reset, no stall. The registers stand behind the bits of the
//            exponent, as evenly as they can.
// Model      model/raydix/normalize.py
`default_nettype none

module rdx_scale #(
    parameter int unsigned W = 36,
    parameter int unsigned Count = 5,
    parameter int unsigned Bits = 3,
    parameter int unsigned Stages = 3
) (
    input  wire logic                clk_i,
    input  wire logic signed [W-1:0] values_i[Count],
    output logic signed      [W-1:0] values_o[Count]
);

  if (Bits < 1 || (1 << Bits) > W) begin : gen_illegal_bits
    $fatal(1, "rdx_scale: Bits = %0d; allowed: 1 and up, 2^Bits at most W = %0d", Bits, W);
  end

  for (genvar s = 0; s <= Bits; s++) begin : gen_bit
    logic signed [W-1:0] values[Count];
    if (s == 0) begin : gen_first
      assign values = values_i;
    end else begin : gen_shift
      localparam int unsigned Places = 1 << (Bits - s);
      localparam int unsigned Registers = (s * Stages) / Bits - ((s - 1) * Stages) / Bits;
      logic free;  // all values have Places sign bits beside the sign
      logic signed [W-1:0] shifted[Count];
      always_comb begin
        free = 1'b1;
        for (int unsigned i = 0; i < Count; i++)
        if (gen_bit[s-1].values[i][W-2-:Places] != {Places{gen_bit[s-1].values[i][W-1]}}) free = 1'b0;
        for (int unsigned i = 0; i < Count; i++)
        shifted[i] = free ? gen_bit[s-1].values[i] <<< Places : gen_bit[s-1].values[i];
      end
      rdx_delay #(
          .T(logic signed [W-1:0]),
          .Count(Count),
          .Depth(Registers)
      ) u_values (
          .clk_i,
          .data_i(shifted),
          .data_o(values)
      );
    end
  end
  assign values_o = gen_bit[Bits].values;

endmodule

`default_nettype wire
