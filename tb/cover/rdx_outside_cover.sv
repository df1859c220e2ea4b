// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_outside.
`default_nettype none
`include "rdx_cover.svh"

module rdx_outside_cover #(
    parameter int unsigned J = 8,
    parameter bit Faces = 1'b0
) (
    input wire rdx_pkg::box_t [2:0] box_i,
    input wire logic [J:0] over[3],
    input wire logic [J:0] sign[3],
    input wire logic [J-1:0] outside_o
);
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    for (genvar side = 0; side < 2; side++) begin : gen_face
      wire [J:0] beyond = over[axis] & ~(sign[axis] ^{(J + 1) {side == 1}});
      `RDX_COVER_NOW(all_beyond, &beyond)
      `RDX_COVER_NOW(cell_beyond, (beyond[J-1:0] & beyond[J:1]) != '0)
      `RDX_COVER_NOW(cut, (beyond[J-1:0] & ~over[axis][J:1]) != '0)
    end
    `RDX_COVER_NOW(from_face_to_face, over[axis][0] && over[axis][1] && sign[axis][0] != sign[axis][1])
    if (!Faces) begin : gen_box
      `RDX_COVER_NOW(no_face, box_i[axis] == '0)
      `RDX_COVER_NOW(face, box_i[axis] != '0)
    end
  end
  for (genvar j = 0; j < J; j++) begin : gen_cell
    `RDX_COVER_NOW(only, outside_o == J'(1) << j)
  end
  `RDX_COVER_NOW(none, outside_o == '0)
  `RDX_COVER_NOW(all, &outside_o)
endmodule

bind rdx_outside rdx_outside_cover #(
    .J(J),
    .Faces(Faces)
) u_cover (.*);

`default_nettype wire
