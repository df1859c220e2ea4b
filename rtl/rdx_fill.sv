// SPDX-License-Identifier: Apache-2.0
// Scales a vector by a power of two so that its largest component fills the word: rdx_normalize in short stages, for 32 bits.
//
// The bits in use below the sign in any component are found first; then shifts by 16, 8, 4, 2 and 1, each where so many of the
// top bits are not in use.
//
// Formats    values_i: Count values s32p0; values_o: Count values s<WOut>p0, the top WOut bits after the shift.
// Rounding   floor.    Overflow   cannot happen: only redundant sign bits are shifted out.
// Timing     latency rdx_pkg::FillLatency = 6 clocks, one vector a clock; no reset.
// Model      model/raydix/normalize.py (WIn = 32, Limit = 31)
`default_nettype none

module rdx_fill #(
    parameter int unsigned WOut  = 18,
    parameter int unsigned Count = 3
) (
    input  wire logic                   clk_i,
    input  wire logic signed [    31:0] values_i[Count],
    output logic signed      [WOut-1:0] values_o[Count]
);

  localparam int unsigned Bits = 5;
  if (WOut < 2 || WOut > 32) begin : gen_illegal_wout
    $fatal(1, "rdx_fill: WOut = %0d; allowed: 2 to 32", WOut);
  end

  // Bits that still count where at most so much is left to be shifted
  function automatic int unsigned kept(int unsigned left);
    return WOut + left < 32 ? WOut + left : 32;
  endfunction

  for (genvar s = 0; s <= Bits; s++) begin : gen_stage
    localparam int unsigned Left = (32 >> s) - 1;  // largest shift after this stage
    localparam int unsigned W = kept(Left);
    logic signed [W-1:0] values_q[Count];
    logic [W-2:0] used_q;
    if (s == 0) begin : gen_used
      logic [30:0] used;
      always_comb begin
        used = '0;
        for (int unsigned i = 0; i < Count; i++) used |= values_i[i][30:0] ^ {31{values_i[i][31]}};
      end
      always_ff @(posedge clk_i) begin
        values_q <= values_i;
        used_q   <= used;
      end
    end else begin : gen_shift
      localparam int unsigned Shift = Left + 1;
      localparam int unsigned Before = kept(Left + Shift);
      wire skip = gen_stage[s-1].used_q[Before-2-:Shift] == '0;
      wire [Before-2:0] used = skip ? gen_stage[s-1].used_q << Shift : gen_stage[s-1].used_q;
      always_ff @(posedge clk_i) used_q <= used[Before-2-:W-1];
      for (genvar i = 0; i < Count; i++) begin : gen_value
        wire [Before-1:0] whole = gen_stage[s-1].values_q[i];
        wire [Before-1:0] after = skip ? whole << Shift : whole;
        always_ff @(posedge clk_i) values_q[i] <= after[Before-1-:W];
        wire unused = &{1'b0, after};
      end
      wire unused = &{1'b0, used};
    end
  end
  assign values_o = gen_stage[Bits].values_q;
  wire unused = &{1'b0, gen_stage[Bits].used_q};

endmodule

`default_nettype wire
