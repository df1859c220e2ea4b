// SPDX-License-Identifier: Apache-2.0
// Scales control points by a common power of two: shifts out the sign bits that all of them can lose.
//
// Formats    values_i: Count values s<WIn>p0; values_o: s<WOut>p0, the top WOut bits after the shift.
// Rounding   floor (less than one ulp of the output, in all values downwards); exact for WIn = WOut.
// Overflow   cannot happen: only redundant sign bits are shifted out.
// Timing     latency Stages clocks in which en_i = 1. 2: shift amount, then shift. 3: a register behind the bits in use. 4: the
//            shift by eights has a clock of its own.
// Model      model/raydix/normalize.py
`default_nettype none

module rdx_normalize #(
    parameter int unsigned WIn = 36,
    parameter int unsigned WOut = 36,
    parameter int unsigned Count = 5,
    parameter int unsigned Limit = 7,  // largest shift, 2^b - 1 and below WIn
    parameter int unsigned Stages = 2
) (
    input  wire logic                   clk_i,
    input  wire logic                   en_i,
    input  wire logic signed [ WIn-1:0] values_i[Count],
    output logic signed      [WOut-1:0] values_o[Count]
);

  localparam int unsigned Bits = $clog2(Limit + 1);
  localparam int unsigned Fine = Stages == 4 ? 3 : Bits;  // bits of the last shift
  localparam int unsigned Places = (1 << Fine) - 1;
  localparam int unsigned Kept = Stages == 4 && WOut + Places < WIn ? WOut + Places : WIn;  // before it
  if (WOut > WIn) begin : gen_illegal_wout
    $fatal(1, "rdx_normalize: WOut = %0d; allowed: at most WIn = %0d", WOut, WIn);
  end
  if (Limit < 1 || Limit >= WIn) begin : gen_illegal_limit
    $fatal(1, "rdx_normalize: Limit = %0d; allowed: 1 to %0d", Limit, WIn - 1);
  end
  if (Limit != (1 << Bits) - 1) begin : gen_illegal_limit_2
    $fatal(1, "rdx_normalize: Limit = %0d; allowed: a power of two less one", Limit);
  end
  if (Stages < 2 || Stages > 4 || (Stages == 4 && Bits < 4)) begin : gen_illegal_stages
    $fatal(1, "rdx_normalize: Stages = %0d; allowed: 2, 3 and, with Limit = 15 or more, 4", Stages);
  end

  // ---- bits in use below the sign in any of the values, as many as a shift can lose, the top one at the top ----
  logic [Limit-1:0] used_d, used;
  logic signed [WIn-1:0] values[Count];
  always_comb begin
    used_d = '0;
    for (int unsigned i = 0; i < Count; i++) used_d |= values_i[i][WIn-2-:Limit] ^ {Limit{values_i[i][WIn-1]}};
  end
  if (Stages > 2) begin : gen_used
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        used   <= used_d;
        values <= values_i;
      end
    end
  end else begin : gen_used_now
    assign used   = used_d;
    assign values = values_i;
  end

  // ---- by eights: how many of the groups of eight bits, from the top, none of the values uses ----
  logic [Places-1:0] left;  // bits in use behind that
  logic signed [Kept-1:0] kept[Count];
  if (Stages == 4) begin : gen_eights
    localparam int unsigned Groups = 1 << (Bits - 3);  // the last one has seven
    logic [Bits-4:0] eights_d, eights_q;
    logic [Limit-1:0] used_q;
    logic signed [WIn-1:0] values_q[Count];
    always_comb begin
      eights_d = (Bits - 3)'(Groups - 1);
      for (int unsigned g = 1; g < Groups; g++)
      if (used[Limit-1-8*(Groups-1-g)-:8] != '0) eights_d = (Bits - 3)'(Groups - 1 - g);
    end
    always_ff @(posedge clk_i) begin
      if (en_i) begin
        eights_q <= eights_d;
        used_q   <= used;
        values_q <= values;
      end
    end
    wire [Limit-1:0] used_left = used_q << {eights_q, 3'd0};
    assign left = used_left[Limit-1-:Places];
    wire unused_left = &{1'b0, used_left[Limit-Places-1:0]};
    for (genvar i = 0; i < Count; i++) begin : gen_value
      wire signed [WIn-1:0] shifted = values_q[i] <<< {eights_q, 3'd0};
      assign kept[i] = shifted[WIn-1-:Kept];
      if (WIn > Kept) begin : gen_dropped
        wire unused = &{1'b0, shifted[WIn-Kept-1:0]};
      end
    end
  end else begin : gen_all
    assign left = used;
    assign kept = values;
  end

  // ---- by ones ----
  logic [Fine-1:0] shift_d, shift_q;
  logic signed [Kept-1:0] values_q[Count];
  always_comb begin
    shift_d = Fine'(Places);
    for (int unsigned s = 0; s < Places; s++) if (left[s]) shift_d = Fine'(Places - 1 - s);
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      shift_q  <= shift_d;
      values_q <= kept;
    end
  end
  for (genvar i = 0; i < Count; i++) begin : gen_fine
    wire signed [Kept-1:0] shifted = values_q[i] <<< shift_q;
    always_ff @(posedge clk_i) if (en_i) values_o[i] <= shifted[Kept-1-:WOut];
    if (Kept > WOut) begin : gen_dropped
      wire unused = &{1'b0, shifted[Kept-WOut-1:0]};
    end
  end

endmodule

`default_nettype wire
