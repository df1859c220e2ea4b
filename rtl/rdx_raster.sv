// SPDX-License-Identifier: Apache-2.0
// Walks the pixels of a surface's screen rectangle and gives each what its ray starts with.
//
// A surface descriptor comes in as 64-bit words (docs/number-formats.md, "Surface descriptor"): header, coordinate
// lanes, then the control points of Q3 and, for a quartic, of Q1 and Q2; or the constants of a vector-sum surface, which
// wait until no ray of the one before is under way. Then the rays go out, row by row.
//
// Formats    ends_o: coordinates s2p30 (the accumulator's s2p46, floor), depths s1p31. quads_o: accumulators s64p0 of
//            q(h,h), q(h,e), q(e,e) of Q3, Q1, Q2; only those of Q3 are built for D = 2.
// Rounding   floor of the coordinates; the lanes are exact.    Overflow   cannot happen: compile scales the lanes.
// Timing     descriptor: a word a clock, 39, 75 or, of a vector sum, 98 words, whose constants wait for vector_idle_i. Rays:
//            one a clock, the first one clock after the last word.
// Reset      control only.
// Model      model/raydix/raster.py
`default_nettype none
`include "rdx_assert.svh"

module rdx_raster #(
    parameter int unsigned D = 4,
    parameter bit Vector = 1'b0,  // vector-sum surfaces, too
    localparam int unsigned Quads = D == 4 ? 9 : 3
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             desc_valid_i,
    output logic                  desc_ready_o,
    input  wire logic      [63:0] desc_data_i,
    output logic                  ray_valid_o,
    input  wire logic             ray_ready_i,
    output rdx_pkg::ray_t         ray_o,
    output rdx_pkg::ends_t        ends_o,
    output logic                  quartic_o,
    output logic                  vector_o,             // of a vector-sum surface
    input  wire logic             vector_idle_i,        // no ray of one is under way
    output rdx_pkg::form_t        form_o,
    output rdx_pkg::quad_t        quads_o      [Quads]
);
  import rdx_pkg::*;

  localparam int unsigned Lanes = CoordLanes + (D == 0 ? 0 : Quads);
  if (D != 0 && D != 2 && D != 4) begin : gen_illegal_d
    $fatal(1, "rdx_raster: D = %0d; allowed: 4 (quartics too), 2 (quadrics) or 0 (none)", D);
  end

  // ---- descriptor: header words, then lane after lane ----
  typedef enum logic [2:0] {
    Header,
    Rectangle,
    Depth,
    Load,
    Form,
    Walk
  } state_e;
  state_e state_q;
  logic [3:0] lane_q;
  logic [2:0] index_q;
  pixel_t x0_q, x1_q, y1_q;
  pixel_t x_q, y_q;
  logic quartic_q, vector_q;
  logic [6:0] word_q;
  surface_t surface_q;
  roots_t roots_q;
  logic paper_q;
  box_t [2:0] box_q;
  depth_t near_q, far_q;

  wire load = desc_valid_i && desc_ready_o;
  wire lane_end = index_q == (lane_q < 4'(CoordLanes) ? 3'd2 : 3'd5);
  wire all_end = lane_end && lane_q == (vector_q ? 4'(CoordLanes - 1) : quartic_q ? 4'(Lanes - 1) : 4'(CoordLanes + 2));
  wire row_end = x_q == x1_q;
  wire step = ray_valid_o && ray_ready_i;
  assign desc_ready_o = state_q == Form ? vector_idle_i : state_q != Walk;
  assign ray_valid_o  = state_q == Walk;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q <= Header;
    end else begin
      case (state_q)
        Header:    if (load) state_q <= Rectangle;
        Rectangle: if (load) state_q <= Depth;
        Depth:     if (load) state_q <= Load;
        Load:      if (load && all_end) state_q <= vector_q ? Form : Walk;
        Form:      if (load && word_q == 7'(FormWords - 1)) state_q <= Walk;
        default:   if (step && row_end && y_q == y1_q) state_q <= Header;
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    if (load) begin
      case (state_q)
        Header: begin
          surface_q <= desc_data_i[0+:SurfaceWidth];
          roots_q <= desc_data_i[SurfaceWidth+:RootsWidth];
          paper_q <= desc_data_i[SurfaceWidth+RootsWidth];
          quartic_q <= desc_data_i[SurfaceWidth+RootsWidth+1] && D == 4;
          box_q <= desc_data_i[SurfaceWidth+RootsWidth+2+:3*BoxWidth];
          vector_q <= desc_data_i[SurfaceWidth+RootsWidth+2+3*BoxWidth] && Vector;
        end
        Rectangle: begin
          x0_q <= desc_data_i[0+:PixelWidth];
          x_q  <= desc_data_i[0+:PixelWidth];
          y_q  <= desc_data_i[16+:PixelWidth];
          x1_q <= desc_data_i[32+:PixelWidth];
          y1_q <= desc_data_i[48+:PixelWidth];
        end
        Depth: begin
          near_q  <= desc_data_i[0+:DepthWidth];
          far_q   <= desc_data_i[32+:DepthWidth];
          lane_q  <= '0;
          index_q <= '0;
          word_q  <= '0;
        end
        Form: word_q <= word_q + 1'b1;
        default: begin
          index_q <= lane_end ? '0 : index_q + 1'b1;
          if (lane_end) lane_q <= lane_q + 1'b1;
        end
      endcase
    end else if (step) begin
      x_q <= row_end ? x0_q : x_q + 1'b1;
      if (row_end) y_q <= y_q + 1'b1;
    end
  end

  // ---- lanes ----
  logic signed [CoordAccWidth-1:0] coords[CoordLanes];
  for (genvar i = 0; i < Lanes; i++) begin : gen_lane
    wire load_lane = load && state_q == Load && lane_q == 4'(i);
    if (i < CoordLanes) begin : gen_coord
      rdx_fdiff #(
          .W(CoordAccWidth),
          .Quadratic(1'b0)
      ) u_fdiff (
          .clk_i,
          .load_i (load_lane),
          .index_i(index_q),
          .word_i (desc_data_i),
          .pixel_i(step),
          .row_i  (step && row_end),
          .value_o(coords[i])
      );
    end else begin : gen_quad
      rdx_fdiff #(
          .W(QuadAccWidth),
          .Quadratic(1'b1)
      ) u_fdiff (
          .clk_i,
          .load_i (load_lane),
          .index_i(index_q),
          .word_i (desc_data_i),
          .pixel_i(step),
          .row_i  (step && row_end),
          .value_o(quads_o[i-CoordLanes])
      );
    end
  end

  always_comb begin
    ray_o = '{surface: surface_q, x: x_q, y: y_q, paper: paper_q, roots: roots_q, box: box_q, limit: NoLimit};
    for (int unsigned axis = 0; axis < 3; axis++) begin
      ends_o.start[axis] = coords[2*axis][CoordAccWidth-1-:CoordWidth];
      ends_o.stop[axis]  = coords[2*axis+1][CoordAccWidth-1-:CoordWidth];
    end
    ends_o.depth_start = near_q;
    ends_o.depth_stop  = far_q;
  end
  assign quartic_o = quartic_q;
  assign vector_o  = vector_q;
  if (D == 0) begin : gen_no_quads
    // nobody would take its rays
    `RDX_ASSERT(a_vector, !(load && state_q == Header && !desc_data_i[SurfaceWidth+RootsWidth+2+3*BoxWidth]))
    always_comb for (int unsigned i = 0; i < Quads; i++) quads_o[i] = '0;
  end
  if (Vector) begin : gen_form
    rdx_form u_form (
        .clk_i,
        .load_i (load && state_q == Form),
        .index_i(word_q),
        .word_i (desc_data_i),
        .form_o
    );
  end else begin : gen_no_form
    assign form_o = '0;
    // its words would be taken for something else
    `RDX_ASSERT(a_algebraic, !(load && state_q == Header && desc_data_i[SurfaceWidth+RootsWidth+2+3*BoxWidth]))
  end

  if (D == 2) begin : gen_quadrics
    // the words of Q1 and Q2 would be taken for the next descriptor
    `RDX_ASSERT(a_quadric, !(load && state_q == Header && desc_data_i[SurfaceWidth+RootsWidth+1]))
  end
  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, ends_o})

endmodule

`default_nettype wire
