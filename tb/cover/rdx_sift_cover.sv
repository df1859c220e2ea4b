// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_sift.
`default_nettype none
`include "rdx_cover.svh"

module rdx_sift_cover #(
    parameter int unsigned D = 4,
    parameter int unsigned Levels = 3,
    parameter int unsigned Queue = 512,
    localparam int unsigned Cells = 1 << Levels
) (
    input wire logic                   clk_i,
    input wire logic                   rst_ni,
    input wire logic                   rootless_i,
    input wire logic                   boxes_i,
    input wire logic                   ray_valid_i,
    input wire logic                   ray_ready_i,
    input wire logic                   ray_ready_o,
    input wire logic                   ray_valid_o,
    input wire logic                   rootless_o,
    input wire logic                   beyond_o,
    input wire logic                   rootless_q,
    input wire logic                   beyond_q,
    input wire logic                   here,
    input wire logic [$clog2(Queue):0] count_q,
    input wire logic [      Cells*D:0] positive_q,
    input wire logic [      Cells-1:0] mixed
);
  logic [Cells*D:0] were_positive_q;
  logic [Cells-1:0] were_mixed_q;
  always_ff @(posedge clk_i) {were_positive_q, were_mixed_q} <= {positive_q, mixed};

  `RDX_COVER_RUN(all_positive, rootless_o && &were_positive_q)
  `RDX_COVER_RUN(none_positive, rootless_o && were_positive_q == '0)
  `RDX_COVER_RUN(one_sign_does_not_count, here && !rootless_i && were_mixed_q == '0)
  `RDX_COVER_RUN(beyond_alone, beyond_o)
  `RDX_COVER_RUN(both_reasons, rootless_o && beyond_q)
  for (genvar i = 0; i < Cells; i++) begin : gen_cell
    `RDX_COVER_RUN(only_this_mixed, here && rootless_i && !rootless_q && were_mixed_q == Cells'(1) << i)
  end
  `RDX_COVER_RUN(passes, ray_valid_o && ray_ready_i)
  `RDX_COVER_RUN(stalled, ray_valid_o && !ray_ready_i)
  `RDX_COVER_RUN(full, !ray_ready_o && ray_valid_i)
  `RDX_COVER_RUN(empty, count_q == '0)
  `RDX_COVER_RUN(dropped_while_full, !ray_ready_o && (rootless_o || beyond_o))
  wire unused = boxes_i;
endmodule

bind rdx_sift rdx_sift_cover #(
    .D(D),
    .Levels(Levels),
    .Queue(Queue)
) u_cover (.*);

`default_nettype wire
