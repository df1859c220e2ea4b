// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_cordic.
`default_nettype none
`include "rdx_cover.svh"

module rdx_cordic_cover #(
    parameter int unsigned W = 38,
    parameter bit Angle = 1'b1
) (
    input wire logic                    clk_i,
    input wire logic                    en_i,
    input wire logic signed     [W-1:0] x_i,
    input wire logic signed     [W-1:0] y_i,
    input wire rdx_pkg::angle_t         angle_o
);
  for (genvar q = 0; q < 4; q++) begin : gen_quadrant
    `RDX_COVER(open, x_i != 0 && y_i != 0 && {x_i < 0, y_i < 0} == 2'(q))
    if (Angle) begin : gen_angle
      `RDX_COVER(angle, angle_o[31:30] == 2'(q))
    end
  end
  `RDX_COVER(right, x_i > 0 && y_i == 0)
  `RDX_COVER(left, x_i < 0 && y_i == 0)
  `RDX_COVER(up, x_i == 0 && y_i > 0)
  `RDX_COVER(down, x_i == 0 && y_i < 0)
  `RDX_COVER(zero, x_i == 0 && y_i == 0)
  `RDX_COVER(one_ulp, x_i == -1 && y_i == -1)
  `RDX_COVER(stalled, !en_i)
  if (Angle) begin : gen_turn
    `RDX_COVER(just_above_axis, angle_o >> 20 == '0)
    `RDX_COVER(just_below_axis, &angle_o[31:20])
  end
endmodule

bind rdx_cordic rdx_cordic_cover #(
    .W(W),
    .Angle(Angle)
) u_cover (.*);

`default_nettype wire
