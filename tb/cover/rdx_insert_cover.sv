// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_insert.
`default_nettype none
`include "rdx_cover.svh"

module rdx_insert_cover #(
    parameter int unsigned Layers = 1,
    localparam type count_t = logic [$clog2(Layers+1)-1:0]
) (
    input wire count_t                       count_i,
    input wire rdx_pkg::entry_t              entries_i[Layers],
    input wire rdx_pkg::entry_t              hit_i,
    input wire count_t                       count_o,
    input wire logic                         lost_o,
    input wire logic            [Layers-1:0] ahead,
    input wire logic            [Layers-1:0] there,
    input wire logic                         hidden
);
  for (genvar i = 0; i < Layers; i++) begin : gen_place
    wire first = !hidden && !ahead[i] && (i == 0 || ahead[i>0?i-1 : 0]);
    `RDX_COVER_NOW(at_the_end, first && !there[i])
    `RDX_COVER_NOW(in_front, first && there[i] && !hit_i.opaque)
    `RDX_COVER_NOW(opaque_in_front, first && there[i] && hit_i.opaque)
    `RDX_COVER_NOW(behind_opaque, hidden && there[i] && entries_i[i].opaque)
    `RDX_COVER_NOW(equal_depth_lower_surface,
                   there[i] && entries_i[i].depth == hit_i.depth && hit_i.surface < entries_i[i].surface)
    `RDX_COVER_NOW(equal_depth_and_surface,
                   there[i] && entries_i[i].depth == hit_i.depth && hit_i.surface == entries_i[i].surface)
  end
  `RDX_COVER_NOW(lost_itself, lost_o && ahead[Layers-1])
  `RDX_COVER_NOW(lost_another, lost_o && !ahead[Layers-1])
  `RDX_COVER_NOW(full_opaque_loses_none, 32'(count_i) == Layers && hit_i.opaque && !hidden && !lost_o)
  if (Layers > 2) begin : gen_several
    `RDX_COVER_NOW(drops_two_at_once, count_i > count_o + 1'b1)
  end
endmodule

bind rdx_insert rdx_insert_cover #(.Layers(Layers)) u_cover (.*);

`default_nettype wire
