// SPDX-License-Identifier: Apache-2.0
// The intersection core: surface descriptors in, hits out.
//
// One raster; for algebraic surfaces rdx_product and a ring, for vector-sum surfaces rdx_ends and another ring; one hit
// stream. What a scene does not need is not built: D = 0 leaves out the algebraic part, Vecsum = 0 the other.
//
// Formats    desc_data_i: 64-bit descriptor words; hit_*_o: the fields of rdx_pkg::hit_t.
// Timing     one algebraic ray a clock at U = K where nothing stalls; see rdx_raster, rdx_product, rdx_ends and rdx_ring.
// Reset      rst_ni, synchronous, active low; control only.
// Model      model/raydix/core.py
`default_nettype none
`include "rdx_types.svh"

module rdx_core #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter int unsigned VectorUnits = 1,
    parameter int unsigned VectorDrop = 0,
    parameter int unsigned Rings = 1,
    parameter int unsigned VectorRings = 1
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                desc_valid_i,
    output logic                     desc_ready_o,
    input  wire logic         [63:0] desc_data_i,
    output logic                     hit_valid_o,
    input  wire logic                hit_ready_i,
    output rdx_pkg::surface_t        hit_surface_o,
    output rdx_pkg::pixel_t          hit_x_o,
    output rdx_pkg::pixel_t          hit_y_o,
    output logic                     hit_hit_o,
    output logic                     hit_last_o,
    output logic              [31:0] hit_t_o,
    output rdx_pkg::depth_t          hit_depth_o,
    output rdx_pkg::coord_t          hit_point_o  [3],
    output logic                     hit_enters_o,
    output rdx_pkg::steps_t          hit_steps_o
);
  import rdx_pkg::*;

  if (Vecsum > VecsumGeneral || (Vecsum == VecsumNone && D == 0)) begin : gen_illegal_vecsum
    $fatal(1, "rdx_core: Vecsum = %0d; allowed: 0 none (where D > 0), 1 helix, 2 general", Vecsum);
  end

  logic raster_valid, raster_ready, quartic, vector, vector_idle;
  ray_t raster_ray;
  ends_t raster_ends;
  quad_t quads[D == 4 ? 9 : 3];
  form_t form;
  rdx_raster #(
      .D(D),
      .Vector(Vecsum != VecsumNone)
  ) u_raster (
      .clk_i,
      .rst_ni,
      .desc_valid_i,
      .desc_ready_o,
      .desc_data_i,
      .ray_valid_o(raster_valid),
      .ray_ready_i(raster_ready),
      .ray_o(raster_ray),
      .ends_o(raster_ends),
      .quartic_o(quartic),
      .vector_o(vector),
      .vector_idle_i(vector_idle),
      .form_o(form),
      .quads_o(quads)
  );

  // [0]: algebraic surfaces, [1]: vector sums
  logic [1:0] ready, hit_valid, hit_ready;
  hit_t hits[2], hit;
  assign raster_ready = ready[vector];

  if (D > 0) begin : gen_algebraic
    logic [5:0] steps, ended;
    logic [1:0] sifted;
    line_t sifted_row;
    rdx_algebraic #(
        .N1(N1),
        .K(K),
        .W(W),
        .D(D),
        .U(U),
        .Rings(Rings),
        .Rules(Rules),
        .Clip(Clip),
        .HalveStages(HalveStages)
    ) u_algebraic (
        .clk_i,
        .rst_ni,
        .modes_i(ModesDefault),
        .ray_valid_i(raster_valid && !vector),
        .ray_ready_o(ready[0]),
        .ray_i(raster_ray),
        .ends_i(raster_ends),
        .quartic_i(quartic),
        .quads_i(quads),
        .hit_valid_o(hit_valid[0]),
        .hit_ready_i(hit_ready[0]),
        .hit_o(hits[0]),
        .steps_o(steps),
        .ended_o(ended),
        .rootless_i(1'b0),
        .boxes_i(1'b0),
        .rootless_o(sifted[0]),
        .beyond_o(sifted[1]),
        .sifted_row_o(sifted_row)
    );
    wire unused = &{1'b0, steps, ended, sifted, sifted_row};
  end else begin : gen_no_algebraic
    assign ready[0] = 1'b0;
    assign hit_valid[0] = 1'b0;
    assign hits[0] = '0;
    wire unused = &{1'b0, hit_ready[0], quartic, quads[0], quads[1], quads[2]};
  end

  if (Vecsum != VecsumNone) begin : gen_vector
    logic [5:0] steps, ended;
    rdx_vector #(
        .N1(N1),
        .K(K),
        .U(VectorUnits),
        .Rings(VectorRings),
        .Rules(Rules),
        .Lanes(Lanes),
        .General(Vecsum != VecsumHelix),
        .VectorDrop(VectorDrop)
    ) u_vector (
        .clk_i,
        .rst_ni,
        .form_i(form),
        .modes_i(ModesDefault),
        .ray_valid_i(raster_valid && vector),
        .ray_ready_o(ready[1]),
        .ray_i(raster_ray),
        .ends_i(raster_ends),
        .idle_o(vector_idle),
        .hit_valid_o(hit_valid[1]),
        .hit_ready_i(hit_ready[1]),
        .hit_o(hits[1]),
        .steps_o(steps),
        .ended_o(ended)
    );
    wire unused = &{1'b0, steps, ended};
  end else begin : gen_no_vector
    assign ready[1] = 1'b0;
    assign vector_idle = 1'b1;
    assign hit_valid[1] = 1'b0;
    assign hits[1] = '0;
    wire unused = &{1'b0, hit_ready[1], form};
  end

  rdx_merge #(
      .T(hit_t)
  ) u_merge (
      .clk_i,
      .rst_ni,
      .valid_i(hit_valid),
      .ready_o(hit_ready),
      .data_i (hits),
      .valid_o(hit_valid_o),
      .ready_i(hit_ready_i),
      .data_o (hit)
  );

  assign hit_surface_o = hit.surface;
  assign hit_x_o = hit.x;
  assign hit_y_o = hit.y;
  assign hit_hit_o = hit.hit;
  assign hit_last_o = hit.last;
  assign hit_t_o = hit.t;
  assign hit_depth_o = hit.depth;
  assign hit_point_o = '{hit.point[0], hit.point[1], hit.point[2]};
  assign hit_enters_o = hit.enters;
  assign hit_steps_o = hit.steps;

endmodule

`default_nettype wire
