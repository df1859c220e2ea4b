// SPDX-License-Identifier: Apache-2.0
// Rays of algebraic surfaces to hits: control points, then the rings.
//
// Formats    as rdx_product and rdx_rings.
// Timing     as rdx_product and rdx_rings.
// Reset      control only.
// Model      model/raydix/core.py
`default_nettype none
`include "rdx_types.svh"

module rdx_algebraic #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rings = 1,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter bit Sift = 1'b0,  // rays that cannot have a hit do not enter the ring
    parameter bit Limit = 1'b0,  // items behind their ray's limit end
    localparam int unsigned Quads = D == 4 ? 9 : 3
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire logic                  ray_valid_i,
    output logic                       ray_ready_o,
    input  wire rdx_pkg::ray_t         ray_i,
    input  wire rdx_pkg::ends_t        ends_i,
    input  wire logic                  quartic_i,
    input  wire rdx_pkg::quad_t        quads_i     [Quads],
    output logic                       hit_valid_o,
    input  wire logic                  hit_ready_i,
    output rdx_pkg::hit_t              hit_o,
    output logic                 [5:0] steps_o,
    output logic                 [5:0] ended_o,
    input  wire logic                  rootless_i,
    input  wire logic                  boxes_i,
    output logic                       rootless_o,
    output logic                       beyond_o,
    output rdx_pkg::line_t             sifted_row_o
);
  import rdx_pkg::*;

  localparam type segment_t = `RDX_SEGMENT_T(W, D);

  logic ray_valid, ray_ready, wanted_valid, wanted_ready;
  ray_t ray, wanted;
  segment_t segment, wanted_segment;
  rdx_product #(
      .W(W),
      .D(D)
  ) u_product (
      .clk_i,
      .rst_ni,
      .ray_valid_i,
      .ray_ready_o,
      .ray_i,
      .ends_i,
      .quartic_i,
      .quads_i,
      .ray_valid_o(ray_valid),
      .ray_ready_i(ray_ready),
      .ray_o(ray),
      .segment_o(segment)
  );
  if (Sift) begin : gen_sift
    rdx_sift #(
        .W(W),
        .D(D),
        .Clip(Clip),
        .Levels(N1),
        .HalveStages(HalveStages)
    ) u_sift (
        .clk_i,
        .rst_ni,
        .rootless_i,
        .boxes_i,
        .ray_valid_i(ray_valid),
        .ray_ready_o(ray_ready),
        .ray_i(ray),
        .segment_i(segment),
        .ray_valid_o(wanted_valid),
        .ray_ready_i(wanted_ready),
        .ray_o(wanted),
        .segment_o(wanted_segment),
        .rootless_o,
        .beyond_o,
        .row_o(sifted_row_o)
    );
  end else begin : gen_all
    assign wanted_valid = ray_valid;
    assign ray_ready = wanted_ready;
    assign wanted = ray;
    assign wanted_segment = segment;
    assign {rootless_o, beyond_o, sifted_row_o} = '0;
    wire unused = &{1'b0, rootless_i, boxes_i};
  end
  rdx_rings #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rings(Rings),
      .Rules(Rules),
      .Clip(Clip),
      .HalveStages(HalveStages),
      .Limit(Limit)
  ) u_rings (
      .clk_i,
      .rst_ni,
      .form_i('0),
      .modes_i,
      .ray_valid_i(wanted_valid),
      .ray_ready_o(wanted_ready),
      .ray_i(wanted),
      .segment_i(wanted_segment),
      .hit_valid_o,
      .hit_ready_i,
      .hit_o,
      .steps_o,
      .ended_o
  );

endmodule

`default_nettype wire
