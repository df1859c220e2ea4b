// SPDX-License-Identifier: Apache-2.0
// Splits a cell at its middle by de Casteljau's scheme, with averages only.
//
// Formats    b_i, left_o, right_o: D+1 Bernstein coefficients, sWp0.
// Rounding   each average is (a + b + 1) >> 1: half up, at most half an ulp, never outside [min(a, b), max(a, b)].
// Overflow   cannot happen: every output lies within the hull of the inputs.
// Timing     latency Stages clocks (0 is combinational), one less for Last = 0, one cell a clock; no reset, no stall.
//            The registers stand behind the D rows of averages, as evenly as they can.
// Error      row r adds at most 1/2 ulp: the inner end is within D/2 ulp of the exact value; outer ends are exact.
// Model      model/raydix/halve.py
`default_nettype none

module rdx_halve #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Stages = 2,
    parameter bit Last = 1'b1  // 0: without the registers behind the last row
) (
    input  wire logic                clk_i,
    input  wire logic signed [W-1:0] b_i    [D+1],
    output logic signed      [W-1:0] left_o [D+1],
    output logic signed      [W-1:0] right_o[D+1]
);

  if (W < 2) begin : gen_illegal_w
    $fatal(1, "rdx_halve: W = %0d; allowed: 2 or more", W);
  end
  if (D < 1 || D > 4) begin : gen_illegal_d
    $fatal(1, "rdx_halve: D = %0d; allowed: 1 to 4", D);
  end

  function automatic logic signed [W-1:0] average(logic signed [W-1:0] x, logic signed [W-1:0] y);
    return W'(((W + 1)'(x) + (W + 1)'(y) + (W + 1)'(1)) >>> 1);
  endfunction

  // After row r the left half's places 0 to r are final, and so are the right half's from D-r on, in work; work[0]
  // to work[D-r] are the averages of the row.
  for (genvar r = 1; r <= D; r++) begin : gen_row
    localparam int unsigned All = (r * Stages) / D - ((r - 1) * Stages) / D;
    localparam int unsigned Registers = r == D && !Last && All > 0 ? All - 1 : All;
    logic signed [W-1:0] left_d[D+1];  // places below r are final
    logic signed [W-1:0] work_d[D+1];  // places above D-r are the right half's

    if (r == 1) begin : gen_first
      always_comb begin
        left_d = b_i;
        work_d = b_i;
        for (int unsigned i = 0; i < D; i++) work_d[i] = average(b_i[i], b_i[i+1]);
        left_d[1] = work_d[0];
      end
    end else begin : gen_next
      always_comb begin
        left_d = gen_row[r-1].left_q;
        work_d = gen_row[r-1].work_q;
        for (int unsigned i = 0; i <= D - r; i++) work_d[i] = average(gen_row[r-1].work_q[i], gen_row[r-1].work_q[i+1]);
        left_d[r] = work_d[0];
      end
    end

    logic signed [W-1:0] left_q[D+1];
    logic signed [W-1:0] work_q[D+1];
    rdx_delay #(
        .T(logic signed [W-1:0]),
        .Count(D + 1),
        .Depth(Registers)
    ) u_left (
        .clk_i,
        .data_i(left_d),
        .data_o(left_q)
    );
    rdx_delay #(
        .T(logic signed [W-1:0]),
        .Count(D + 1),
        .Depth(Registers)
    ) u_work (
        .clk_i,
        .data_i(work_d),
        .data_o(work_q)
    );
  end

  if (D >= 1) begin : gen_out
    assign left_o  = gen_row[D].left_q;
    assign right_o = gen_row[D].work_q;
  end

endmodule

`default_nettype wire
