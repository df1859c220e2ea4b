// SPDX-License-Identifier: Apache-2.0
// A register in a stream: valid and data come from flip-flops, ready passes through.
//
// Timing     latency 1 clock, one transfer a clock; ready_o depends on ready_i, valid_o on neither.
// Reset      valid only.
// Model      none: it changes no value
`default_nettype none
`include "rdx_assert.svh"

module rdx_register #(
    parameter int unsigned W = 32
) (
    input  wire logic         clk_i,
    input  wire logic         rst_ni,
    input  wire logic         valid_i,
    output logic              ready_o,
    input  wire logic [W-1:0] data_i,
    output logic              valid_o,
    input  wire logic         ready_i,
    output logic      [W-1:0] data_o
);

  assign ready_o = !valid_o || ready_i;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_o <= 1'b0;
    else if (ready_o) valid_o <= valid_i;
  end
  always_ff @(posedge clk_i) if (ready_o && valid_i) data_o <= data_i;

  `RDX_STREAM(a_out, valid_o, ready_i, data_o)

endmodule

`default_nettype wire
