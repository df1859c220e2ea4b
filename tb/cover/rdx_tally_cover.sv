// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_tally.
`default_nettype none
`include "rdx_cover.svh"

module rdx_tally_cover #(
    parameter int unsigned Verdicts = 4
) (
    input wire logic                clk_i,
    input wire logic                rst_ni,
    input wire logic                add_i,
    input wire logic                add_row_i,
    input wire logic [Verdicts-1:0] verdict_i,
    input wire logic [Verdicts-1:0] verdict_row_i,
    input wire logic [         1:0] zero_o
);
  for (genvar row = 0; row < 2; row++) begin : gen_row
    wire [Verdicts-1:0] mine = verdict_i & (verdict_row_i ^ {Verdicts{!1'(row)}});
    for (genvar n = 0; n <= Verdicts; n++) begin : gen_many
      `RDX_COVER_RUN(at_once, $countones(mine) == n)
    end
    `RDX_COVER_RUN(add_and_verdict, add_i && add_row_i == 1'(row) && mine != '0)
    `RDX_COVER_RUN(add_to_other, add_i && add_row_i != 1'(row) && mine != '0)
    `RDX_COVER_RUN(zero, zero_o[row])
    `RDX_COVER_RUN(waits_alone, !zero_o[row] && zero_o[!row])
  end
  `RDX_COVER_RUN(verdicts_of_both, |(verdict_i & verdict_row_i) && |(verdict_i & ~verdict_row_i))
  `RDX_COVER_RUN(both_wait, zero_o == '0)
endmodule

bind rdx_tally rdx_tally_cover #(.Verdicts(Verdicts)) u_cover (.*);

`default_nettype wire
