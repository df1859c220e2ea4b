// SPDX-License-Identifier: Apache-2.0
// Two streams into one, taking turns where both offer.
//
// Formats    data_i[0], data_i[1], data_o: the packed type T.
// Timing     combinational; an offer once made stays the same until it is taken, and none waits for more than one other.
// Reset      whose turn it is.
// Model      none: the order of records does not matter
`default_nettype none
`include "rdx_assert.svh"

module rdx_merge #(
    parameter type T = logic
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [1:0] valid_i,
    output logic      [1:0] ready_o,
    input  wire T           data_i [2],
    output logic            valid_o,
    input  wire logic       ready_i,
    output T                data_o
);

  logic held_q;  // an offer is waiting, of the stream turn_q
  logic turn_q;  // the stream that goes first if both offer
  wire  chosen = held_q || valid_i[turn_q] ? turn_q : !turn_q;

  assign valid_o = |valid_i;
  assign data_o  = data_i[chosen];
  always_comb begin
    ready_o = '0;
    ready_o[chosen] = ready_i;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      held_q <= 1'b0;
      turn_q <= 1'b0;
    end else if (valid_o) begin
      held_q <= !ready_i;
      turn_q <= ready_i ? !chosen : chosen;
    end
  end

  `RDX_STREAM(a_out, valid_o, ready_i, data_o)

endmodule

`default_nettype wire
