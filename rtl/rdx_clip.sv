// SPDX-License-Identifier: Apache-2.0
// Cells beyond a face of the surface's box, from the segment's ends: halves the coordinates and tests the boundaries.
//
// The box is [-2^(1-m), 2^(1-m)) on each axis: a coordinate is beyond where one of the m bits below its sign differs from
// it. Which bits those are is known before the boundaries are, and stands in registers: found beside them, it would be
// sought once more for each boundary.
//
// Formats    start_i, stop_i: x, y, z (s2p30) at both ends; box_i: m of x, y, z; outside_o: bit j for cell j.
// Rounding   half up in each average.    Overflow   cannot happen, as in rdx_halve.
// Timing     latency Latency clocks, one segment a clock; 0 is combinational. No reset, no stall.
// Model      model/raydix/outside.py (outside_cells)
`default_nettype none

module rdx_clip #(
    parameter int unsigned N1 = 3,
    parameter int unsigned Latency = 6,
    localparam int unsigned J = 1 << N1
) (
    input  wire logic                    clk_i,
    input  wire rdx_pkg::coord_t [  2:0] start_i,
    input  wire rdx_pkg::coord_t [  2:0] stop_i,
    input  wire rdx_pkg::box_t   [  2:0] box_i,
    output logic                 [J-1:0] outside_o
);
  import rdx_pkg::*;

  if (Latency > 0 && Latency < N1) begin : gen_illegal_latency
    $fatal(1, "rdx_clip: Latency = %0d; allowed: 0, or N1 = %0d and up", Latency, N1);
  end
  localparam bit Clocked = Latency > 0;
  // A register behind each halving but the last; behind the tests, if there is a clock left for them; the rest at the end.
  localparam int unsigned Halving = !Clocked ? 0 : N1 == 1 ? 1 : N1 - 1;
  localparam int unsigned Testing = Latency > Halving ? 1 : 0;

  localparam type face_t = logic [CoordWidth-2:0];  // bits below the sign
  localparam type mask_t = logic [J-1:0];
  typedef struct packed {
    logic [J:0] above;
    logic [J:0] below;
  } sides_t;

  mask_t beyond[3];  // of each axis
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    coord_t ends[2], coords[J+1];
    assign ends = '{start_i[axis], stop_i[axis]};
    rdx_cells #(
        .W(CoordWidth),
        .D(1),
        .N1(N1),
        .HalveStages(32'(Clocked)),
        .Last(!(Clocked && N1 > 1))
    ) u_coords (
        .clk_i,
        .b_i(ends),
        .cells_o(coords)
    );

    box_t box[1], box_q[1];
    face_t upper[1], upper_q[1];  // the bits that tell
    assign box[0] = box_i[axis];
    rdx_delay #(
        .T(box_t),
        .Depth(Clocked ? Halving - 1 : 0)
    ) u_box (
        .clk_i,
        .data_i(box),
        .data_o(box_q)
    );
    assign upper[0] = ~({(CoordWidth - 1) {1'b1}} >> box_q[0]);
    rdx_delay #(
        .T(face_t),
        .Depth(32'(Clocked))
    ) u_upper (
        .clk_i,
        .data_i(upper),
        .data_o(upper_q)
    );

    sides_t sides[1], sides_q[1];
    always_comb begin
      for (int unsigned j = 0; j <= J; j++) begin
        sides[0].above[j] = !coords[j][CoordWidth-1] && (coords[j][CoordWidth-2:0] & upper_q[0]) != '0;
        sides[0].below[j] = coords[j][CoordWidth-1] && (~coords[j][CoordWidth-2:0] & upper_q[0]) != '0;
      end
    end
    rdx_delay #(
        .T(sides_t),
        .Depth(Testing)
    ) u_sides (
        .clk_i,
        .data_i(sides),
        .data_o(sides_q)
    );
    assign beyond[axis] = (sides_q[0].above[J-1:0] & sides_q[0].above[J:1]) |
        (sides_q[0].below[J-1:0] & sides_q[0].below[J:1]);
  end

  mask_t outside[1], outside_q[1];
  assign outside[0] = beyond[0] | beyond[1] | beyond[2];
  rdx_delay #(
      .T(mask_t),
      .Depth(Latency - Halving - Testing)
  ) u_outside (
      .clk_i,
      .data_i(outside),
      .data_o(outside_q)
  );
  assign outside_o = outside_q[0];

endmodule

`default_nettype wire
