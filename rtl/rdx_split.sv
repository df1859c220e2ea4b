// SPDX-License-Identifier: Apache-2.0
// First part of a step of an algebraic surface: the J cells by halving, and later the chosen one.
//
// Formats    segment_i: ends s2p30 and s1p31, control points sWp0. cells_o: as rdx_cells. outside_o: bit j for cell j.
//            cell_o: ends and control points of cell pick_i.
// Rounding   half up in each average.    Overflow   cannot happen, as in rdx_halve.
// Timing     cells_o, outside_o and control_o after N1*HalveStages clocks; pick_i comes Wait clocks later,
//            cell_o one clock after that. No reset, no stall.
// Model      model/raydix/cells.py, outside.py, carry.py
`default_nettype none
`include "rdx_types.svh"

module rdx_split #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned HalveStages = 2,
    parameter int unsigned Wait = 1,
    localparam int unsigned J = 1 << N1,
    localparam type control_t = `RDX_CONTROL_T(N1 * K),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic              clk_i,
    input  wire control_t          control_i,
    input  wire segment_t          segment_i,
    input  wire logic     [N1-1:0] pick_i,
    output control_t               control_o,
    output logic signed   [ W-1:0] cells_o  [J*D+1],
    output logic          [ J-1:0] outside_o,
    output segment_t               cell_o
);
  import rdx_pkg::*;

  logic signed [W-1:0] b[D+1], cells_q[J*D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = segment_i.b[i];
  rdx_cells #(
      .W(W),
      .D(D),
      .N1(N1),
      .HalveStages(HalveStages)
  ) u_cells (
      .clk_i,
      .b_i(b),
      .cells_o
  );
  rdx_delay #(
      .T(logic signed [W-1:0]),
      .Count(J * D + 1),
      .Depth(Wait)
  ) u_cells_q (
      .clk_i,
      .data_i(cells_o),
      .data_o(cells_q)
  );

  control_t control[1], control_q[1];
  assign control[0] = control_i;
  assign control_o  = control_q[0];
  rdx_delay #(
      .T(control_t),
      .Depth(N1 * HalveStages)
  ) u_control (
      .clk_i,
      .data_i(control),
      .data_o(control_q)
  );

  coord_t   coords [3][J+1];
  segment_t cell_d;
  rdx_carry #(
      .N1(N1),
      .HalveStages(HalveStages),
      .Wait(Wait)
  ) u_carry (
      .clk_i,
      .ends_i  (segment_i.ends),
      .coords_o(coords),
      .pick_i,
      .cell_o  (cell_d.ends)
  );
  rdx_outside #(
      .J(J)
  ) u_outside (
      .boundaries_i(coords),
      .box_i(control_o.box),
      .low_i('0),
      .high_i('0),
      .outside_o
  );

  always_comb for (int unsigned i = 0; i <= D; i++) cell_d.b[i] = cells_q[32'(pick_i)*D+i];
  always_ff @(posedge clk_i) cell_o <= cell_d;

endmodule

`default_nettype wire
