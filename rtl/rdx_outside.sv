// SPDX-License-Identifier: Apache-2.0
// Which cells lie beyond a face of the surface's box: both ends of the cell on the far side of one face.
//
// The box is [-2^(1-m), 2^(1-m)) on each axis, so a coordinate is inside where its top m+1 bits agree: no
// comparator. m = 0 is the whole range: no face cuts.
//
// Formats    boundaries_i: x, y, z (s2p30) at the J+1 cell boundaries; box_i: m of x, y, z.
// Timing     combinational
// Model      model/raydix/outside.py
`default_nettype none

module rdx_outside #(
    parameter int unsigned J = 8
) (
    input  wire rdx_pkg::coord_t         boundaries_i[3][J+1],
    input  wire rdx_pkg::box_t   [  2:0] box_i,
    output logic                 [J-1:0] outside_o
);
  import rdx_pkg::*;

  logic [J:0] over[3];  // beyond a face of this axis
  logic [J:0] sign[3];
  always_comb begin
    outside_o = '0;
    for (int unsigned axis = 0; axis < 3; axis++) begin
      coord_t face_bits;  // the sign and the m bits below it
      face_bits = ~coord_t'({CoordWidth{1'b1}} >> 1 >> box_i[axis]);
      for (int unsigned j = 0; j <= J; j++) begin
        sign[axis][j] = boundaries_i[axis][j][CoordWidth-1];
        over[axis][j] = |((boundaries_i[axis][j] ^{CoordWidth{sign[axis][j]}}) & face_bits);
      end
      for (int unsigned j = 0; j < J; j++)
      if (over[axis][j] && over[axis][j+1] && sign[axis][j] == sign[axis][j+1]) outside_o[j] = 1'b1;
    end
  end

endmodule

`default_nettype wire
