// SPDX-License-Identifier: Apache-2.0
// Streams into one, taking turns where several offer.
//
// Formats    data_i[0] to data_i[Count-1], data_o: the packed type T.
// Timing     combinational; an offer once made stays the same until it is taken, and none waits for more than Count - 1 others.
// Reset      whose turn it is.
// Model      none: the order of records does not matter
`default_nettype none
`include "rdx_assert.svh"

module rdx_merge #(
    parameter int unsigned Count = 2,
    parameter type T = logic
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Count-1:0] valid_i,
    output logic      [Count-1:0] ready_o,
    input  wire T                 data_i [Count],
    output logic                  valid_o,
    input  wire logic             ready_i,
    output T                      data_o
);

  localparam int unsigned Bits = Count > 1 ? $clog2(Count) : 1;
  if (Count < 1) begin : gen_illegal_count
    $fatal(1, "rdx_merge: Count = %0d; allowed: 1 or more", Count);
  end

  logic [Bits-1:0] turn_q, chosen;  // the stream that goes first if it offers; behind it those that follow, round about
  always_comb begin
    chosen = turn_q;
    for (int i = int'(Count) - 1; i >= 0; i--) if (valid_i[i] && i < int'(turn_q)) chosen = Bits'(i);
    for (int i = int'(Count) - 1; i >= 0; i--) if (valid_i[i] && i >= int'(turn_q)) chosen = Bits'(i);
  end

  assign valid_o = |valid_i;
  assign data_o  = data_i[chosen];
  always_comb begin
    ready_o = '0;
    ready_o[chosen] = ready_i;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) turn_q <= '0;
    else if (valid_o) turn_q <= !ready_i ? chosen : chosen == Bits'(Count - 1) ? '0 : chosen + 1'b1;
  end

  `RDX_STREAM(a_out, valid_o, ready_i, data_o)

endmodule

`default_nettype wire
