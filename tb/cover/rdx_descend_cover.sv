// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_descend.
`default_nettype none
`include "rdx_cover.svh"

module rdx_descend_cover #(
    parameter int unsigned N1 = 3
) (
    input wire logic                    clk_i,
    input wire rdx_pkg::ends_t          ends_i,
    input wire logic           [N1-1:0] pick_i,
    input wire logic                    close_i
);
  for (genvar j = 0; j < (1 << N1); j++) begin : gen_cell
    `RDX_COVER(picked, 32'(pick_i) == j)
  end
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    `RDX_COVER(rounded_up, ends_i.start[axis][0] != ends_i.stop[axis][0])
    `RDX_COVER(exact, ends_i.start[axis][0] == ends_i.stop[axis][0])
  end
  `RDX_COVER(closed, close_i)
  `RDX_COVER(left_open, !close_i)
  `RDX_COVER(depth_rounded_up, ends_i.depth_start[0] != ends_i.depth_stop[0])
endmodule

bind rdx_descend rdx_descend_cover #(.N1(N1)) u_cover (.*);

`default_nettype wire
