// SPDX-License-Identifier: Apache-2.0
// Which cells lie beyond a face of the surface's box: both ends of the cell on the far side of one face.
//
// The box is [-2^(1-m), 2^(1-m)) on each axis, so a coordinate is inside where its top m+1 bits agree: no
// comparator. m = 0 is the whole range: no face cuts. With Faces = 1 the box is [low, high] and takes comparators.
//
// Formats    boundaries_i: x, y, z (s2p30) at the J+1 cell boundaries; box_i: m of x, y, z; low_i, high_i: s2p30.
// Timing     combinational
// Model      model/raydix/outside.py
`default_nettype none

module rdx_outside #(
    parameter int unsigned J = 8,
    parameter bit Faces = 1'b0
) (
    input  wire rdx_pkg::coord_t         boundaries_i[3][J+1],
    input  wire rdx_pkg::box_t   [  2:0] box_i,
    input  wire rdx_pkg::coord_t [  2:0] low_i,
    input  wire rdx_pkg::coord_t [  2:0] high_i,
    output logic                 [J-1:0] outside_o
);
  import rdx_pkg::*;

  logic [J:0] over[3];  // beyond a face of this axis
  logic [J:0] sign[3];  // and which of the two
  if (Faces) begin : gen_faces
    always_comb begin
      for (int unsigned axis = 0; axis < 3; axis++) begin
        for (int unsigned j = 0; j <= J; j++) begin
          sign[axis][j] = boundaries_i[axis][j] < low_i[axis];
          over[axis][j] = sign[axis][j] || boundaries_i[axis][j] > high_i[axis];
        end
      end
    end
    wire unused = &{1'b0, box_i};
  end else begin : gen_box
    // Whether the upper m bits below the sign differ from it: by the bits of m, from the upper one. What is left to be
    // looked at is half as long each time, which takes half the LUTs of a mask of m ones.
    function automatic logic differs(coord_t value, box_t m);
      coord_t left;
      left = value;
      differs = 1'b0;
      for (int unsigned i = BoxWidth; i > 0; i--) begin
        for (int unsigned b = 0; b < 1 << (i - 1); b++)
        if (m[i-1] && left[CoordWidth-2-b] != left[CoordWidth-1]) differs = 1'b1;
        if (m[i-1]) left = left << (1 << (i - 1));
      end
    endfunction
    always_comb begin
      for (int unsigned axis = 0; axis < 3; axis++) begin
        for (int unsigned j = 0; j <= J; j++) begin
          sign[axis][j] = boundaries_i[axis][j][CoordWidth-1];
          over[axis][j] = differs(boundaries_i[axis][j], box_i[axis]);
        end
      end
    end
    wire unused = &{1'b0, low_i, high_i};
  end

  always_comb begin
    outside_o = '0;
    for (int unsigned axis = 0; axis < 3; axis++) begin
      for (int unsigned j = 0; j < J; j++)
      if (over[axis][j] && over[axis][j+1] && sign[axis][j] == sign[axis][j+1]) outside_o[j] = 1'b1;
    end
  end

endmodule

`default_nettype wire
