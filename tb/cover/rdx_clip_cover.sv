// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_clip.
`default_nettype none
`include "rdx_cover.svh"

module rdx_clip_cover #(
    parameter  int unsigned N1 = 3,
    localparam int unsigned J  = 1 << N1
) (
    input wire logic                    clk_i,
    input wire rdx_pkg::coord_t [  2:0] start_i,
    input wire rdx_pkg::coord_t [  2:0] stop_i,
    input wire rdx_pkg::box_t   [  2:0] box_i,
    input wire logic            [J-1:0] beyond   [3],
    input wire logic            [J-1:0] outside_o
);
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    for (genvar m = 0; m < 1 << rdx_pkg::BoxWidth; m++) begin : gen_box
      `RDX_COVER(box, 32'(box_i[axis]) == m)
    end
    `RDX_COVER(rises, start_i[axis] < stop_i[axis])
    `RDX_COVER(falls, start_i[axis] > stop_i[axis])
    `RDX_COVER(stays, start_i[axis] == stop_i[axis])
    `RDX_COVER(all_beyond, &beyond[axis])
    `RDX_COVER(begins_beyond, beyond[axis][0] && !(&beyond[axis]))
    `RDX_COVER(ends_beyond, beyond[axis][J-1] && !(&beyond[axis]))
    if (J > 2) begin : gen_both
      `RDX_COVER(from_face_to_face, beyond[axis][0] && beyond[axis][J-1] && !(&beyond[axis]))
    end
  end
  `RDX_COVER(by_two_axes, (beyond[0] & beyond[1]) != '0 && (beyond[0] ^ beyond[1]) != '0)
  `RDX_COVER(none, outside_o == '0)
endmodule

bind rdx_clip rdx_clip_cover #(.N1(N1)) u_cover (.*);

`default_nettype wire
