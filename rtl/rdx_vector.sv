// SPDX-License-Identifier: Apache-2.0
// Rays of vector-sum surfaces to hits: indicator at both ends, then the rings with the evaluator in its step units.
//
// Formats    as rdx_ends and rdx_rings. form_i: constants of the surface; they may change where idle_o = 1.
// Timing     as rdx_ends and rdx_rings.
// Reset      control only.
// Model      model/raydix/core.py
`default_nettype none
`include "rdx_types.svh"

module rdx_vector #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned U = 1,
    parameter int unsigned Rings = 1,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned Lanes = 7,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    parameter bit Limit = 1'b0  // items behind their ray's limit end
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire rdx_pkg::form_t        form_i,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire logic                  ray_valid_i,
    output logic                       ray_ready_o,
    input  wire rdx_pkg::ray_t         ray_i,
    input  wire rdx_pkg::ends_t        ends_i,
    output logic                       idle_o,
    output logic                       hit_valid_o,
    input  wire logic                  hit_ready_i,
    output rdx_pkg::hit_t              hit_o,
    output logic                 [5:0] steps_o,
    output logic                 [5:0] ended_o
);
  import rdx_pkg::*;

  localparam type segment_t = `RDX_SEGMENT_T(VectorWidth, 1);

  logic ray_valid, ray_ready;
  ray_t     ray;
  segment_t segment;
  rdx_ends #(
      .Lanes(Lanes == 1 ? 1 : 2),
      .General(General),
      .VectorDrop(VectorDrop)
  ) u_ends (
      .clk_i,
      .rst_ni,
      .form_i,
      .ray_valid_i,
      .ray_ready_o,
      .ray_i,
      .ends_i,
      .ray_valid_o(ray_valid),
      .ray_ready_i(ray_ready),
      .ray_o(ray),
      .segment_o(segment)
  );
  rdx_rings #(
      .N1(N1),
      .K(K),
      .W(VectorWidth),
      .D(1),
      .U(U),
      .Rings(Rings),
      .Rules(Rules),
      .HalveStages(1),
      .Lanes(Lanes),
      .General(General),
      .VectorDrop(VectorDrop),
      .Limit(Limit)
  ) u_rings (
      .clk_i,
      .rst_ni,
      .form_i,
      .modes_i,
      .ray_valid_i(ray_valid),
      .ray_ready_o(ray_ready),
      .ray_i(ray),
      .segment_i(segment),
      .hit_valid_o,
      .hit_ready_i,
      .hit_o,
      .steps_o,
      .ended_o
  );

  // Rays under way. They are far fewer than the counter can hold: the stages of rdx_ends and the slots of the rings.
  logic [15:0] rays_q;
  wire entered = ray_valid_i && ray_ready_o;
  wire left = hit_valid_o && hit_ready_i && hit_o.last;
  assign idle_o = rays_q == '0;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) rays_q <= '0;
    else if (entered != left) rays_q <= entered ? rays_q + 1'b1 : rays_q - 1'b1;
  end

endmodule

`default_nettype wire
