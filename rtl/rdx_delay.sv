// SPDX-License-Identifier: Apache-2.0
// Delays a vector of values by a fixed number of clocks.
//
// Formats    data_i, data_o: Count values of the packed type T.
// Timing     latency Depth clocks (0 is a wire), one vector a clock; no reset, no stall.
// Model      none: it changes no value
`default_nettype none

module rdx_delay #(
    parameter type T = logic,
    parameter int unsigned Count = 1,
    parameter int unsigned Depth = 1
) (
    input  wire logic clk_i,
    input  wire T     data_i[Count],
    output T          data_o[Count]
);

  if (Depth == 0) begin : gen_wire
    wire unused_clk = clk_i;
    assign data_o = data_i;
  end else begin : gen_delay
    T data_q[Depth][Count];
    always_ff @(posedge clk_i) begin
      data_q[0] <= data_i;
      for (int unsigned i = 1; i < Depth; i++) data_q[i] <= data_q[i-1];
    end
    assign data_o = data_q[Depth-1];
  end

endmodule

`default_nettype wire
