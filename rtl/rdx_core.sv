// SPDX-License-Identifier: Apache-2.0
// The intersection core: surface descriptors in, hits out.
//
// Formats    desc_data_i: 64-bit descriptor words; hit_*_o: the fields of rdx_pkg::hit_t.
// Timing     one ray a clock at U = K where nothing stalls; see rdx_raster, rdx_product and rdx_ring.
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
    parameter int unsigned HalveStages = (D + 1) / 2
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
    output rdx_pkg::steps_t          hit_steps_o
);
  import rdx_pkg::*;

  localparam int unsigned Quads = D == 4 ? 9 : 3;
  localparam type segment_t = `RDX_SEGMENT_T(W, D);

  logic raster_valid, raster_ready, quartic;
  ray_t raster_ray;
  ends_t raster_ends;
  quad_t quads[Quads];
  rdx_raster #(
      .D(D)
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
      .quads_o(quads)
  );

  logic ray_valid, ray_ready;
  ray_t     ray;
  segment_t segment;
  rdx_product #(
      .W(W),
      .D(D)
  ) u_product (
      .clk_i,
      .rst_ni,
      .ray_valid_i(raster_valid),
      .ray_ready_o(raster_ready),
      .ray_i(raster_ray),
      .ends_i(raster_ends),
      .quartic_i(quartic),
      .quads_i(quads),
      .ray_valid_o(ray_valid),
      .ray_ready_i(ray_ready),
      .ray_o(ray),
      .segment_o(segment)
  );

  hit_t hit;
  rdx_ring #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .HalveStages(HalveStages)
  ) u_ring (
      .clk_i,
      .rst_ni,
      .ray_valid_i(ray_valid),
      .ray_ready_o(ray_ready),
      .ray_i(ray),
      .segment_i(segment),
      .hit_valid_o,
      .hit_ready_i,
      .hit_o(hit)
  );

  assign hit_surface_o = hit.surface;
  assign hit_x_o = hit.x;
  assign hit_y_o = hit.y;
  assign hit_hit_o = hit.hit;
  assign hit_last_o = hit.last;
  assign hit_t_o = hit.t;
  assign hit_depth_o = hit.depth;
  assign hit_point_o = '{hit.point[0], hit.point[1], hit.point[2]};
  assign hit_steps_o = hit.steps;

endmodule

`default_nettype wire
