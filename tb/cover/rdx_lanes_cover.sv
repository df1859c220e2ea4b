// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_lanes.
`default_nettype none
`include "rdx_cover.svh"

module rdx_lanes_cover #(
    parameter int unsigned Phases = 1
) (
    input wire logic       clk_i,
    input wire logic       en_i,
    input wire logic [3:0] phase_i,
    input wire logic [3:0] leaving_q
);
  for (genvar p = 0; p < Phases; p++) begin : gen_phase
    `RDX_COVER(enters, en_i && 32'(phase_i) == p)
    `RDX_COVER(leaves, en_i && 32'(leaving_q) == p)
    `RDX_COVER(stalled, !en_i && 32'(phase_i) == p)
  end
endmodule

bind rdx_lanes rdx_lanes_cover #(.Phases(Phases)) u_cover (.*);

`default_nettype wire
