// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_zone.
`default_nettype none
`include "rdx_cover.svh"

module rdx_zone_cover #(
    parameter int unsigned Count = 9,
    localparam int unsigned Z = $clog2(rdx_pkg::Zones)
) (
    input wire rdx_pkg::coord_t         x_i   [Count],
    input wire rdx_pkg::coord_t         y_i   [Count],
    input wire logic            [Z-1:0] zone_o
);
  for (genvar i = 0; i < rdx_pkg::Zones; i++) begin : gen_zone
    `RDX_COVER_NOW(reached, 32'(zone_o) == i)
  end
  for (genvar q = 0; q < 4; q++) begin : gen_quadrant
    `RDX_COVER_NOW(quadrant, {x_i[0] < 0, y_i[0] < 0} == 2'(q))
  end
  `RDX_COVER_NOW(minus_one, x_i[0] == '1 && y_i[0] == '1)
endmodule

bind rdx_zone rdx_zone_cover #(.Count(Count)) u_cover (.*);

`default_nettype wire
