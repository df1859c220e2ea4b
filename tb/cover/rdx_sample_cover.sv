// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_sample.
`default_nettype none
`include "rdx_cover.svh"

module rdx_sample_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned Phases = 1,
    localparam int unsigned J = 1 << N1
) (
    input wire logic          clk_i,
    input wire logic [   3:0] phase_i,
    input wire logic [N1-1:0] pick_i,
    input wire logic [   3:0] zone_q,
    input wire logic [ J-1:0] outside_o,
    input wire logic [ J-1:0] possible_o
);
  for (genvar j = 0; j < J; j++) begin : gen_cell
    `RDX_COVER(picked, 32'(pick_i) == j)
  end
  for (genvar p = 0; p < Phases; p++) begin : gen_phase
    `RDX_COVER(phase, 32'(phase_i) == p)
  end
  for (genvar z = 0; z < rdx_pkg::Zones; z++) begin : gen_zone
    `RDX_COVER(zone, 32'(zone_q) == z)
  end
  `RDX_COVER(none_outside, outside_o == '0)
  `RDX_COVER(all_outside, &outside_o)
  `RDX_COVER(some_outside, outside_o != '0 && !(&outside_o))
  `RDX_COVER(all_possible, &possible_o)
  `RDX_COVER(none_possible, possible_o == '0)
endmodule

bind rdx_sample rdx_sample_cover #(
    .N1(N1),
    .Phases(Phases)
) u_cover (.*);

`default_nettype wire
