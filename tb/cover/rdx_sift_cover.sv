// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_sift.
`default_nettype none
`include "rdx_cover.svh"

module rdx_sift_cover #(
    parameter int unsigned D = 4
) (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       rootless_i,
    input wire logic       boxes_i,
    input wire logic       ray_valid_i,
    input wire logic       ray_ready_i,
    input wire logic       ray_valid_o,
    input wire logic       rootless_o,
    input wire logic       beyond_o,
    input wire logic [D:0] positive,
    input wire logic       beyond,
    input wire logic       valid_q,
    input wire logic       beyond_q,
    input wire logic       drop,
    input wire logic       en
);
  wire taken = ray_valid_i && en;
  wire one_sign = positive == '0 || &positive;

  `RDX_COVER_RUN(all_positive, taken && rootless_i && &positive)
  `RDX_COVER_RUN(none_positive, taken && rootless_i && positive == '0)
  `RDX_COVER_RUN(one_sign_does_not_count, taken && !rootless_i && one_sign)
  `RDX_COVER_RUN(beyond_does_not_count, taken && !boxes_i && beyond)
  `RDX_COVER_RUN(beyond_alone, beyond_o)
  `RDX_COVER_RUN(both_reasons, rootless_o && beyond_q)
  for (genvar i = 0; i <= D; i++) begin : gen_point
    `RDX_COVER_RUN(only_this_positive, taken && rootless_i && positive == (D + 1)'(1 << i))
    `RDX_COVER_RUN(only_this_not_positive, taken && rootless_i && ~positive == (D + 1)'(1 << i))
  end
  `RDX_COVER_RUN(passes, ray_valid_o && ray_ready_i)
  `RDX_COVER_RUN(stalled, ray_valid_o && !ray_ready_i)
  `RDX_COVER_RUN(dropped_while_not_ready, valid_q && drop && !ray_ready_i)
  `RDX_COVER_RUN(next_behind_dropped, valid_q && drop && taken)
endmodule

bind rdx_sift rdx_sift_cover #(.D(D)) u_cover (.*);

`default_nettype wire
