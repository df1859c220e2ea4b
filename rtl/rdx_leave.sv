// SPDX-License-Identifier: Apache-2.0
// What becomes of the items that come back to the wrap of a ring: their records, and the places that get free.
//
// A Hit or Done item hands over its record and leaves, or goes on as Again where more roots are wanted and a cell is pending. An
// item whose cell begins behind the nearest opaque hit that its ray knew of ends here: all of it that is left lies behind.
//
// Formats    control_i, ends_i: the item, and its cell's ends; origin_i: of its ray, with the limit (u0p18). hit_o: rdx_pkg::hit_t.
// Timing     control_o, ended_o: combinational; a record stands at hit_o a clock later. A record that finds the
//            output taken goes round with its item.
// Reset      the output's valid. filled_i = 0: nothing has come back yet, the place is made Idle.
// Model      model/raydix/ring.py (more, behind)
`default_nettype none
`include "rdx_types.svh"

module rdx_leave #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned U = 8,
    parameter bit Limit = 1'b0,  // limits count
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             early_i,      // a Done item leaves at once; else after as many steps as a hit takes
    input  wire logic             filled_i,
    input  wire control_t         control_i,
    input  wire rdx_pkg::ends_t   ends_i,
    input  wire rdx_pkg::origin_t origin_i,
    output control_t              control_o,
    output logic                  ended_o,      // the item ends here, behind its limit
    output logic                  hit_valid_o,
    input  wire logic             hit_ready_i,
    output rdx_pkg::hit_t         hit_o
);
  import rdx_pkg::*;

  // ---- what lies behind the limit is done ----
  wire there = control_i.status == Run || control_i.status == Again || control_i.status == Hit;
  assign ended_o = Limit && filled_i && there && limit_of(ends_i.depth_start) > origin_i.limit;
  wire status_e status = ended_o ? Done : control_i.status;

  // ---- the record ----
  wire more_roots = control_i.roots > 1 && control_i.pending && !(&control_i.steps);
  wire linger = !early_i && status == Done && control_i.level != 5'(K - 1);
  wire offer = filled_i && (status == Hit || (status == Done && !linger));
  logic free;
  wire give = offer && free;
  hit_t record;
  assign record = '{
          surface: origin_i.surface,
          x: origin_i.x,
          y: origin_i.y,
          hit: status == Hit,
          last: status == Done || !more_roots,
          t: 32'(control_i.t),
          depth: ends_i.depth_start,
          point: ends_i.start,
          enters: control_i.enters,
          steps: control_i.steps
      };
  rdx_register #(
      .W($bits(hit_t))
  ) u_out (
      .clk_i,
      .rst_ni,
      .valid_i(offer),
      .ready_o(free),
      .data_i (record),
      .valid_o(hit_valid_o),
      .ready_i(hit_ready_i),
      .data_o (hit_o)
  );

  // ---- the item ----
  always_comb begin
    control_o = control_i;
    control_o.status = status;
    if (!filled_i) begin
      control_o.status = Idle;
    end else if (give) begin
      control_o.status = record.last ? Idle : Again;
      control_o.roots  = control_i.roots - 1'b1;
    end
    if (linger) control_o.level = 32'(control_i.level) + U < K ? control_i.level + 5'(U) : 5'(K - 1);
  end
  wire unused = &{1'b0, origin_i, ends_i};

endmodule

`default_nettype wire
