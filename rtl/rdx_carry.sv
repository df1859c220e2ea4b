// SPDX-License-Identifier: Apache-2.0
// What an item carries linearly along its segment: local coordinates and depth at the boundaries of the J cells.
//
// They are halved by the same averages as the control points (rdx_cells with D = 1), so no multiplication is needed
// for the hit point or its depth.
//
// Formats    ends_i: at the cell's ends; coords_o: x, y, z (s2p30) at the J+1 boundaries;
//            cell_o: both ends of cell pick_i.
// Rounding   half up in each average.    Overflow   cannot happen, as in rdx_halve.
// Timing     coords_o after N1*HalveStages clocks; cell_o belongs to pick_i, Wait clocks later. No reset, no stall.
// Error      at most N1/2 ulp a step
// Model      model/raydix/carry.py
`default_nettype none

module rdx_carry #(
    parameter int unsigned N1 = 3,
    parameter int unsigned HalveStages = 2,
    parameter int unsigned Wait = 1,
    localparam int unsigned J = 1 << N1
) (
    input wire logic clk_i,
    input wire rdx_pkg::ends_t ends_i,
    output rdx_pkg::coord_t coords_o[3][J+1],
    input wire logic [N1-1:0] pick_i,
    output rdx_pkg::ends_t cell_o
);
  import rdx_pkg::*;

  localparam int unsigned Width = CoordWidth;
  if (Width != DepthWidth) begin : gen_illegal_width
    $fatal(1, "rdx_carry: CoordWidth = %0d; allowed: DepthWidth = %0d", CoordWidth, DepthWidth);
  end

  // lanes x, y, z, depth
  logic signed [Width-1:0] ends[4][2];
  logic signed [Width-1:0] cells[4][J+1];
  logic signed [Width-1:0] cells_q[4][J+1];
  assign ends[3] = '{ends_i.depth_start, ends_i.depth_stop};
  for (genvar lane = 0; lane < 4; lane++) begin : gen_lane
    if (lane < 3) begin : gen_coord
      assign ends[lane] = '{ends_i.start[lane], ends_i.stop[lane]};
      assign coords_o[lane] = cells[lane];
    end
    rdx_cells #(
        .W(Width),
        .D(1),
        .N1(N1),
        .HalveStages(HalveStages)
    ) u_cells (
        .clk_i,
        .b_i(ends[lane]),
        .cells_o(cells[lane])
    );
    rdx_delay #(
        .T(logic signed [Width-1:0]),
        .Count(J + 1),
        .Depth(Wait)
    ) u_wait (
        .clk_i,
        .data_i(cells[lane]),
        .data_o(cells_q[lane])
    );
  end

  always_comb begin
    for (int unsigned axis = 0; axis < 3; axis++) begin
      cell_o.start[axis] = cells_q[axis][(N1+1)'(pick_i)];
      cell_o.stop[axis]  = cells_q[axis][(N1+1)'(pick_i)+1];
    end
    cell_o.depth_start = cells_q[3][(N1+1)'(pick_i)];
    cell_o.depth_stop  = cells_q[3][(N1+1)'(pick_i)+1];
  end

endmodule

`default_nettype wire
