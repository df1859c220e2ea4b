// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_bound.
`default_nettype none
`include "rdx_cover.svh"

module rdx_bound_cover #(
    parameter int unsigned N1 = 3,
    localparam int unsigned J = 1 << N1,
    localparam int unsigned Z = $clog2(rdx_pkg::Zones),
    localparam type sum_t = logic [rdx_pkg::VectorWidth:0]
) (
    input wire logic         clk_i,
    input wire logic [Z-1:0] zone_i,
    input wire sum_t         most_q,
    input wire sum_t         bend_q,
    input wire sum_t         sum_q    [J],
    input wire sum_t         most_qq,
    input wire sum_t         bend_qq,
    input wire logic         curved_qq,
    input wire logic [  J:0] outside_q,
    input wire logic [  J:0] flat_q,
    input wire logic [J-1:0] possible
);
  for (genvar z = 0; z < rdx_pkg::Zones; z++) begin : gen_zone
    `RDX_COVER(looked_up, 32'(zone_i) == z)
  end
  for (genvar j = 0; j < J; j++) begin : gen_cell
    wire in_reach = sum_q[j] <= most_qq;
    wire curved = curved_qq && outside_q[j];
    wire over = sum_q[j] > bend_qq;
    wire flat = flat_q[j] && flat_q[j+1];
    `RDX_COVER(free_by_change, !in_reach && !curved)
    `RDX_COVER(not_free, in_reach && curved && !over && !flat)
    `RDX_COVER(free_by_curvature, in_reach && curved && over && !flat)
    `RDX_COVER(free_by_both_ends, in_reach && curved && !over && flat)
    `RDX_COVER(too_early_for_curvature, in_reach && !curved_qq && outside_q[j] && (over || flat))
    `RDX_COVER(no_curvature_inside, in_reach && curved_qq && !outside_q[j] && (over || flat))
    `RDX_COVER(sum_equals_change, sum_q[j] == most_qq)
    `RDX_COVER(sum_equals_curvature, in_reach && curved && !flat && sum_q[j] == bend_qq)
  end
  `RDX_COVER(all_possible, &possible)
  `RDX_COVER(none_possible, possible == '0)
  `RDX_COVER(change_cut, &most_q)
  `RDX_COVER(curvature_cut, &bend_q)
endmodule

bind rdx_bound rdx_bound_cover #(.N1(N1)) u_cover (.*);

`default_nettype wire
