// SPDX-License-Identifier: Apache-2.0
// rdx_outside: a cell is outside if both ends lie beyond the same face of the box, whose faces are numbers here.
`default_nettype none
`include "formal.svh"

module formal_outside #(
    parameter int unsigned J = 8,
    parameter bit Faces = 1'b0
) (
    input wire rdx_pkg::coord_t       boundaries_i[3][J+1],
    input wire rdx_pkg::box_t   [2:0] box_i,
    input wire rdx_pkg::coord_t [2:0] low_i,
    input wire rdx_pkg::coord_t [2:0] high_i
);
  import rdx_pkg::*;

  logic [J-1:0] outside;
  rdx_outside #(
      .J(J),
      .Faces(Faces)
  ) u_outside (
      .boundaries_i,
      .box_i,
      .low_i,
      .high_i,
      .outside_o(outside)
  );

  // ---- faces: of s2p30 [-2^(1-m), 2^(1-m)) is [-2^(31-m), 2^(31-m)), or low and high, both inside ----
  localparam type wide_t = logic signed [CoordWidth+1:0];
  wide_t least[3], most[3];  // the lowest and the highest place inside
  always_comb begin
    for (int axis = 0; axis < 3; axis++) begin
      wide_t half;
      half = wide_t'(1) <<< (CoordWidth - 1 - 32'(box_i[axis]));
      least[axis] = Faces ? wide_t'(signed'(low_i[axis])) : -half;
      most[axis] = Faces ? wide_t'(signed'(high_i[axis])) : half - wide_t'(1);
    end
  end
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    `GIVEN(g_order, !Faces || signed'(low_i[axis]) <= signed'(high_i[axis]))
  end

  for (genvar j = 0; j < J; j++) begin : gen_cell
    logic [2:0] beyond;
    always_comb begin
      for (int axis = 0; axis < 3; axis++) begin
        wide_t a, b;
        a = wide_t'(boundaries_i[axis][j]);
        b = wide_t'(boundaries_i[axis][j+1]);
        beyond[axis] = (a < least[axis] && b < least[axis]) || (a > most[axis] && b > most[axis]);
      end
    end
    `CHECK(p_outside, outside[j] == (|beyond))
  end
  `REACH(r_some, outside != '0 && outside != '1)

endmodule

`default_nettype wire
