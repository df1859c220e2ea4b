// SPDX-License-Identifier: Apache-2.0
// Walks one row of a surface's screen rectangle and gives each pixel what its ray starts with.
//
// Words of the next row come in while this one is walked. A pixel whose nearest opaque hit so far is nearer than the surface's
// near plane has no ray.
//
// Formats    load_i: rdx_pkg::row_word_t, in any order, the one marked last at the end. ends_o: coordinates s2p30 (the
//            accumulator's s2p46, floor), depths s1p31. quads_o: accumulators s64p0 of q(h,h), q(h,e), q(e,e) of Q3, Q1, Q2;
//            only those of Q3 are built for D = 2.
// Rounding   floor of the coordinates; the lanes are exact.    Overflow   cannot happen: compile scales the lanes.
// Timing     a pixel a clock. Row by row without a gap where words are there in time. load_valid_i only while full_o = 0;
//            a vector sum's constants only while idle_o = 1. look_x_o asks for the nearest opaque hit of a pixel, which
//            comes a clock in which look_o = 1 later.
// Reset      control only.
// Model      model/raydix/raster.py
`default_nettype none
`include "rdx_assert.svh"

module rdx_scan #(
    parameter int unsigned D = 4,
    parameter bit Vector = 1'b0,  // vector-sum surfaces, too
    localparam int unsigned Quads = D == 4 ? 9 : 3
) (
    input  wire logic               clk_i,
    input  wire logic               rst_ni,
    input  wire logic               load_valid_i,
    input  wire rdx_pkg::row_word_t load_i,
    output logic                    full_o,               // a row waits
    output logic                    idle_o,               // no pixel is under way, and none waits
    output logic                    look_o,
    output rdx_pkg::pixel_t         look_x_o,
    output rdx_pkg::line_t          look_row_o,
    input  wire logic               limit_valid_i,        // there is an opaque hit
    input  wire rdx_pkg::depth_t    limit_i,
    output logic                    hidden_o,             // the pixel in this clock has no ray
    output rdx_pkg::line_t          hidden_row_o,
    output logic                    ray_valid_o,
    input  wire logic               ray_ready_i,
    output rdx_pkg::ray_t           ray_o,
    output rdx_pkg::ends_t          ends_o,
    output logic                    quartic_o,
    output logic                    vector_o,
    output rdx_pkg::form_t          form_o,
    output rdx_pkg::quad_t          quads_o      [Quads]
);
  import rdx_pkg::*;

  localparam int unsigned Lanes = CoordLanes + (D == 0 ? 0 : Quads);

  typedef struct packed {
    surface_t   surface;
    roots_t     roots;
    logic       paper;
    logic       quartic;
    box_t [2:0] box;
    logic       vector;
    pixel_t     y;
    depth_t     near_depth;
    depth_t     far_depth;
  } row_t;

  // ---- the row that waits ----
  row_t next_q, row_q;
  pixel_t next_x0_q, next_x1_q;
  logic full_q, start;
  always_ff @(posedge clk_i) begin
    if (load_valid_i && load_i.kind == RowHeader) begin
      case (load_i.index[1:0])
        2'd0: begin
          next_q.surface <= load_i.word[0+:SurfaceWidth];
          next_q.roots <= load_i.word[SurfaceWidth+:RootsWidth];
          next_q.paper <= load_i.word[SurfaceWidth+RootsWidth];
          next_q.quartic <= load_i.word[SurfaceWidth+RootsWidth+1] && D == 4;
          next_q.box <= load_i.word[SurfaceWidth+RootsWidth+2+:3*BoxWidth];
          next_q.vector <= load_i.word[SurfaceWidth+RootsWidth+2+3*BoxWidth] && Vector;
        end
        2'd1: begin
          next_x0_q <= load_i.word[0+:PixelWidth];
          next_q.y  <= load_i.word[16+:PixelWidth];
          next_x1_q <= load_i.word[32+:PixelWidth];
        end
        default: begin
          next_q.near_depth <= load_i.word[0+:DepthWidth];
          next_q.far_depth  <= load_i.word[32+:DepthWidth];
        end
      endcase
    end
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) full_q <= 1'b0;
    else if (load_valid_i && load_i.last) full_q <= 1'b1;
    else if (start) full_q <= 1'b0;
  end
  assign full_o = full_q;

  // ---- its pixels ----
  logic step, walk_idle;
  pixel_t ray_x;
  limit_t ray_limit;
  rdx_walk u_walk (
      .clk_i,
      .rst_ni,
      .next_i(full_q),
      .next_x0_i(next_x0_q),
      .next_x1_i(next_x1_q),
      .next_row_i(next_q.y[1:0]),
      .next_near_i(next_q.near_depth),
      .start_o(start),
      .step_o(step),
      .idle_o(walk_idle),
      .look_o,
      .look_x_o,
      .look_row_o,
      .limit_valid_i,
      .limit_i,
      .hidden_o,
      .hidden_row_o,
      .ray_valid_o,
      .ray_ready_i,
      .ray_x_o(ray_x),
      .ray_limit_o(ray_limit)
  );
  always_ff @(posedge clk_i) if (start) row_q <= next_q;
  assign idle_o = walk_idle && !full_q;

  // ---- lanes ----
  logic signed [CoordAccWidth-1:0] coords[CoordLanes];
  for (genvar i = 0; i < Lanes; i++) begin : gen_lane
    wire load_lane = load_valid_i && load_i.kind == RowLane && load_i.lane == 4'(i);
    if (i < CoordLanes) begin : gen_coord
      rdx_lane #(
          .W(CoordAccWidth),
          .Quadratic(1'b0)
      ) u_lane (
          .clk_i,
          .load_i (load_lane),
          .index_i(load_i.index[1:0]),
          .word_i (load_i.word),
          .start_i(start),
          .step_i (step),
          .value_o(coords[i])
      );
    end else begin : gen_quad
      rdx_lane #(
          .W(QuadAccWidth),
          .Quadratic(1'b1)
      ) u_lane (
          .clk_i,
          .load_i (load_lane),
          .index_i(load_i.index[1:0]),
          .word_i (load_i.word),
          .start_i(start),
          .step_i (step),
          .value_o(quads_o[i-CoordLanes])
      );
    end
  end
  if (D == 0) begin : gen_no_quads
    always_comb for (int unsigned i = 0; i < Quads; i++) quads_o[i] = '0;
  end
  if (Vector) begin : gen_form
    rdx_form u_form (
        .clk_i,
        .load_i (load_valid_i && load_i.kind == RowForm),
        .index_i(load_i.index),
        .word_i (load_i.word),
        .form_o
    );
  end else begin : gen_no_form
    assign form_o = '0;
  end

  always_comb begin
    ray_o = '{
        surface: row_q.surface,
        x: ray_x,
        y: row_q.y,
        paper: row_q.paper,
        roots: row_q.roots,
        box: row_q.box,
        limit: ray_limit
    };
    for (int unsigned axis = 0; axis < 3; axis++) begin
      ends_o.start[axis] = coords[2*axis][CoordAccWidth-1-:CoordWidth];
      ends_o.stop[axis]  = coords[2*axis+1][CoordAccWidth-1-:CoordWidth];
    end
    ends_o.depth_start = row_q.near_depth;
    ends_o.depth_stop  = row_q.far_depth;
  end
  assign quartic_o = row_q.quartic;
  assign vector_o  = row_q.vector;
  `RDX_ASSERT(a_load, !(load_valid_i && full_q))
  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, ends_o})

endmodule

`default_nettype wire
