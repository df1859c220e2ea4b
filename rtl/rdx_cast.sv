// SPDX-License-Identifier: Apache-2.0
// Rows of surfaces to hits: the raster, the two rings, one hit stream.
//
// As rdx_core, but row by row, and rays that cannot show are left out. What a scene does not need is not built: D = 0 leaves out
// the algebraic part, Vecsum = 0 the other.
//
// Formats    load_i: see rdx_scan. hit_o: rdx_pkg::hit_t. skipped_o: pixels that have no ray, [0] hidden, [1] no root, [2] beyond a
//            face; skipped_row_o: lowest bits of their rows.
// Timing     see rdx_scan, rdx_product, rdx_sift, rdx_ends and rdx_ring.
// Reset      control only.
// Model      model/raydix/core.py
`default_nettype none

module rdx_cast #(
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
    parameter int unsigned VectorRings = 1,
    parameter bit Limit = 1'b1  // limits are given
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::frame_t          frame_i,
    input  wire logic                     load_valid_i,
    input  wire rdx_pkg::row_word_t       load_i,
    output logic                          full_o,
    output logic                          idle_o,
    output logic                          vector_idle_o,
    output logic                          look_o,
    output rdx_pkg::pixel_t               look_x_o,
    output rdx_pkg::line_t                look_row_o,
    input  wire logic                     limit_valid_i,
    input  wire rdx_pkg::depth_t          limit_i,
    output logic                    [2:0] skipped_o,
    output rdx_pkg::line_t          [2:0] skipped_row_o,
    output logic                    [5:0] steps_o,
    output logic                    [5:0] ended_o,
    output logic                          hit_valid_o,
    input  wire logic                     hit_ready_i,
    output rdx_pkg::hit_t                 hit_o
);
  import rdx_pkg::*;

  logic ray_valid, quartic, vector;
  ray_t  ray;
  ends_t ends;
  quad_t quads[D == 4 ? 9 : 3];
  form_t form;

  // [0]: algebraic surfaces, [1]: vector sums
  logic [1:0] ready, hit_valid, hit_ready;
  hit_t hits[2];
  logic [5:0] steps[2], ended[2];

  wire modes_t modes =
  '{first_level: 5'(6'(K) - frame_i.k_stop), boxes: frame_i.skip.boxes, early: frame_i.skip.early}
  ;
  rdx_scan #(
      .D(D),
      .Vector(Vecsum != VecsumNone)
  ) u_scan (
      .clk_i,
      .rst_ni,
      .load_valid_i,
      .load_i,
      .full_o,
      .idle_o,
      .look_o,
      .look_x_o,
      .look_row_o,
      .limit_valid_i,
      .limit_i,
      .hidden_o(skipped_o[0]),
      .hidden_row_o(skipped_row_o[0]),
      .ray_valid_o(ray_valid),
      .ray_ready_i(ready[vector]),
      .ray_o(ray),
      .ends_o(ends),
      .quartic_o(quartic),
      .vector_o(vector),
      .form_o(form),
      .quads_o(quads)
  );

  if (D > 0) begin : gen_algebraic
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
        .HalveStages(HalveStages),
        .Sift(1'b1),
        .Limit(Limit)
    ) u_algebraic (
        .clk_i,
        .rst_ni,
        .modes_i(modes),
        .ray_valid_i(ray_valid && !vector),
        .ray_ready_o(ready[0]),
        .ray_i(ray),
        .ends_i(ends),
        .quartic_i(quartic),
        .quads_i(quads),
        .hit_valid_o(hit_valid[0]),
        .hit_ready_i(hit_ready[0]),
        .hit_o(hits[0]),
        .steps_o(steps[0]),
        .ended_o(ended[0]),
        .rootless_i(frame_i.skip.rootless),
        .boxes_i(frame_i.skip.boxes),
        .rootless_o(skipped_o[1]),
        .beyond_o(skipped_o[2]),
        .sifted_row_o(sifted_row)
    );
    assign skipped_row_o[2:1] = {2{sifted_row}};
  end else begin : gen_no_algebraic
    assign ready[0] = 1'b0;
    assign hit_valid[0] = 1'b0;
    assign hits[0] = '0;
    assign steps[0] = '0;
    assign ended[0] = '0;
    assign skipped_o[2:1] = '0;
    assign skipped_row_o[2:1] = '0;
    wire unused = &{1'b0, hit_ready[0], quartic, quads[0], quads[1], quads[2]};
  end

  if (Vecsum != VecsumNone) begin : gen_vector
    rdx_vector #(
        .N1(N1),
        .K(K),
        .U(VectorUnits),
        .Rings(VectorRings),
        .Rules(Rules),
        .Lanes(Lanes),
        .General(Vecsum != VecsumHelix),
        .VectorDrop(VectorDrop),
        .Limit(Limit)
    ) u_vector (
        .clk_i,
        .rst_ni,
        .form_i(form),
        .modes_i(modes),
        .ray_valid_i(ray_valid && vector),
        .ray_ready_o(ready[1]),
        .ray_i(ray),
        .ends_i(ends),
        .idle_o(vector_idle_o),
        .hit_valid_o(hit_valid[1]),
        .hit_ready_i(hit_ready[1]),
        .hit_o(hits[1]),
        .steps_o(steps[1]),
        .ended_o(ended[1])
    );
  end else begin : gen_no_vector
    assign ready[1] = 1'b0;
    assign vector_idle_o = 1'b1;
    assign hit_valid[1] = 1'b0;
    assign hits[1] = '0;
    assign steps[1] = '0;
    assign ended[1] = '0;
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
      .data_o (hit_o)
  );
  assign steps_o = steps[0] + steps[1];
  assign ended_o = ended[0] + ended[1];
  wire unused_frame = &{1'b0, frame_i};

endmodule

`default_nettype wire
