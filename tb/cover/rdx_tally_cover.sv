// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_tally.
`default_nettype none
`include "rdx_cover.svh"

module rdx_tally_cover #(
    parameter int unsigned Lines = 2,
    parameter int unsigned Verdicts = 4,
    localparam type index_t = logic [$clog2(Lines)-1:0]
) (
    input wire logic                          clk_i,
    input wire logic                          rst_ni,
    input wire logic                          add_i,
    input wire rdx_pkg::line_t                add_row_i,
    input wire logic           [Verdicts-1:0] verdict_i,
    input wire rdx_pkg::line_t [Verdicts-1:0] verdict_row_i,
    input wire logic           [   Lines-1:0] zero_o
);
  for (genvar row = 0; row < Lines; row++) begin : gen_row
    logic [Verdicts-1:0] mine;
    always_comb begin
      for (int unsigned i = 0; i < Verdicts; i++) mine[i] = verdict_i[i] && index_t'(verdict_row_i[i]) == index_t'(row);
    end
    for (genvar n = 0; n <= Verdicts; n++) begin : gen_many
      `RDX_COVER_RUN(at_once, $countones(mine) == n)
    end
    `RDX_COVER_RUN(add_and_verdict, add_i && index_t'(add_row_i) == index_t'(row) && mine != '0)
    `RDX_COVER_RUN(add_to_other, add_i && index_t'(add_row_i) != index_t'(row) && mine != '0)
    `RDX_COVER_RUN(zero, zero_o[row])
    `RDX_COVER_RUN(waits_alone, zero_o == ~(Lines'(1) << row))
  end
  `RDX_COVER_RUN(all_wait, zero_o == '0)
endmodule

bind rdx_tally rdx_tally_cover #(
    .Lines(Lines),
    .Verdicts(Verdicts)
) u_cover (.*);

`default_nettype wire
