// SPDX-License-Identifier: Apache-2.0
// Bernstein coefficients of a ray's polynomial from the control points of its quadrics: F = Q1*Q2 + Q3, or F = Q3.
//
// For D = 4 everything is formed times 6, so that the weights 1/2 and 1/6 of the product of two quadratics and of degree
// elevation are whole numbers. For D = 2 the control points of Q3 are the coefficients.
//
// Formats    quads_i: s64p0, q(h,h), q(h,e), q(e,e) of Q3, Q1, Q2. Operands: s36p0, products s60p0.
//            segment_o.b: sWp0, normalised so that the largest coefficient uses all W bits.
// Rounding   operands half up (2^-27), products floor (2^-12), result floor to W bits; all else is exact.
// Overflow   cannot happen: compile keeps |Q1|, |Q2| < 2^62 - 2^26 and |Q3| <= 2^59 (2^60 without a product), so |6F| < 2^63.
// Timing     a ray a clock; it is at the output 13 clocks later (6 for D = 2) at the earliest. No stage waits: rays are
//            let in as long as there is a place in the queues at the end for every ray under way, and ray_ready_o is a register.
// Reset      control only.
// Error      docs/method.md, "Rounding"
// Model      model/raydix/product.py
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_product #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    localparam int unsigned Quads = D == 4 ? 9 : 3,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire logic           ray_valid_i,
    output logic                ray_ready_o,
    input  wire rdx_pkg::ray_t  ray_i,
    input  wire rdx_pkg::ends_t ends_i,
    input  wire logic           quartic_i,
    input  wire rdx_pkg::quad_t quads_i    [Quads],
    output logic                ray_valid_o,
    input  wire logic           ray_ready_i,
    output rdx_pkg::ray_t       ray_o,
    output segment_t            segment_o
);
  import rdx_pkg::*;

  if (D != 2 && D != 4) begin : gen_illegal_d
    $fatal(1, "rdx_product: D = %0d; allowed: 2 (quadrics) or 4 (quartics too)", D);
  end

  localparam int unsigned NormalizeStages = 4;
  localparam int unsigned Latency = (D == 4 ? QuarticLatency : 0) + NormalizeStages;
  localparam int unsigned Places = Latency + 4 > 8 ? 16 : 8;  // and the queue, and until a place is free

  // ---- rays under way ----
  logic [$clog2(Places):0] count_q, count_d;
  wire take = ray_valid_i && ray_ready_o;
  wire give = ray_valid_o && ray_ready_i;
  assign count_d = count_q + ($clog2(Places) + 1)'(take) - ($clog2(Places) + 1)'(give);
  logic [Latency-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
      count_q <= '0;
      ray_ready_o <= 1'b0;
    end else begin
      valid_q <= {valid_q[Latency-2:0], take};
      count_q <= count_d;
      ray_ready_o <= count_d != ($clog2(Places) + 1)'(Places);
    end
  end

  // ---- control points of F, times 6 for D = 4 ----
  quad_t form[D+1];
  if (D == 2) begin : gen_quadric
    wire unused = quartic_i;
    assign form = quads_i;
  end else begin : gen_quartic
    rdx_quartic u_quartic (
        .clk_i,
        .quartic_i,
        .quads_i,
        .form_o(form)
    );
  end

  logic signed [W-1:0] scaled[D+1];
  rdx_normalize #(
      .WIn(QuadAccWidth),
      .WOut(W),
      .Count(D + 1),
      .Limit(QuadAccWidth - 1),
      .Stages(NormalizeStages)
  ) u_normalize (
      .clk_i,
      .en_i(1'b1),
      .values_i(form),
      .values_o(scaled)
  );

  // ---- queues: what belongs to a ray waits in one for its control points in the other ----
  logic [D:0][W-1:0] points;
  always_comb for (int unsigned i = 0; i <= D; i++) points[i] = scaled[i];
  logic rays_ready, points_ready, rays_valid, points_valid;
  rdx_fifo #(
      .W($bits(ray_t) + $bits(ends_t)),
      .Depth(Places)
  ) u_rays (
      .clk_i,
      .rst_ni,
      .valid_i(take),
      .ready_o(rays_ready),
      .data_i ({ray_i, ends_i}),
      .valid_o(rays_valid),
      .ready_i(give),
      .data_o ({ray_o, segment_o.ends})
  );
  rdx_fifo #(
      .W((D + 1) * W),
      .Depth(Places)
  ) u_points (
      .clk_i,
      .rst_ni,
      .valid_i(valid_q[Latency-1]),
      .ready_o(points_ready),
      .data_i (points),
      .valid_o(points_valid),
      .ready_i(give),
      .data_o (segment_o.b)
  );
  assign ray_valid_o = rays_valid && points_valid;

  wire unused_ready = &{1'b0, rays_ready, points_ready};
  `RDX_ASSERT(a_places, (rays_ready || !take) && (points_ready || !valid_q[Latency-1]))
  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, segment_o})

endmodule

`default_nettype wire
