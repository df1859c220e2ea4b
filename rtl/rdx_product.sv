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
// Timing     latency 6 clocks that advance (3 for D = 2), one ray a clock; it advances when the last stage is
//            empty or taken.
// Reset      valid only.
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

  localparam int unsigned FormLatency = D == 4 ? 4 : 1;  // operands, products, sums, weights
  localparam int unsigned Latency = FormLatency + NormalizeLatency;

  // ---- stream: all stages advance together ----
  logic [Latency-1:0] valid_q;
  ray_t ray_q[Latency];
  ends_t ends_q[Latency];
  wire en = !valid_q[Latency-1] || ray_ready_i;
  assign ray_ready_o = en;
  assign ray_valid_o = valid_q[Latency-1];
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= '0;
    else if (en) valid_q <= {valid_q[Latency-2:0], ray_valid_i};
  end
  always_ff @(posedge clk_i) begin
    if (en) begin
      ray_q[0]  <= ray_i;
      ends_q[0] <= ends_i;
      for (int unsigned i = 1; i < Latency; i++) begin
        ray_q[i]  <= ray_q[i-1];
        ends_q[i] <= ends_q[i-1];
      end
    end
  end

  // ---- control points of F, times 6 for D = 4 ----
  quad_t form[D+1];
  if (D == 2) begin : gen_quadric
    wire unused = quartic_i;
    always_ff @(posedge clk_i) if (en) form <= quads_i;
  end else begin : gen_quartic
    rdx_quartic u_quartic (
        .clk_i,
        .en_i  (en),
        .quartic_i,
        .quads_i,
        .form_o(form)
    );
  end

  logic signed [W-1:0] scaled[D+1];
  rdx_normalize #(
      .WIn  (QuadAccWidth),
      .WOut (W),
      .Count(D + 1),
      .Limit(QuadAccWidth - 1)
  ) u_normalize (
      .clk_i,
      .en_i(en),
      .values_i(form),
      .values_o(scaled)
  );

  assign ray_o = ray_q[Latency-1];
  always_comb begin
    segment_o.ends = ends_q[Latency-1];
    for (int unsigned i = 0; i <= D; i++) segment_o.b[i] = scaled[i];
  end

  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, segment_o})

endmodule

`default_nettype wire
