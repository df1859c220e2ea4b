// SPDX-License-Identifier: Apache-2.0
// Drops the rays of algebraic surfaces that cannot have a hit: all control points have one sign, or both ends of the segment
// lie beyond one face of the box.
//
// Every cell of such a segment has control points of that sign (averages stay within the hull), or ends beyond that face.
//
// Formats    ray_i, segment_i: as rdx_ring. rootless_i, boxes_i: 1 where that reason counts.
// Timing     latency 1 clock, one ray a clock. rootless_o, beyond_o: a ray is dropped in this clock, row_o: lowest bit of its
//            row.
// Reset      valid only.
// Model      none: it changes no hit
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_sift #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire logic          rootless_i,
    input  wire logic          boxes_i,
    input  wire logic          ray_valid_i,
    output logic               ray_ready_o,
    input  wire rdx_pkg::ray_t ray_i,
    input  wire segment_t      segment_i,
    output logic               ray_valid_o,
    input  wire logic          ray_ready_i,
    output rdx_pkg::ray_t      ray_o,
    output segment_t           segment_o,
    output logic               rootless_o,
    output logic               beyond_o,
    output logic               row_o
);
  import rdx_pkg::*;

  logic [D:0] positive;
  coord_t ends[3][2];
  logic beyond;
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) positive[i] = $signed(segment_i.b[i]) > 0;
    for (int unsigned axis = 0; axis < 3; axis++) ends[axis] = '{segment_i.ends.start[axis], segment_i.ends.stop[axis]};
  end
  rdx_outside #(
      .J(1)
  ) u_outside (
      .boundaries_i(ends),
      .box_i(ray_i.box),
      .low_i('0),
      .high_i('0),
      .outside_o(beyond)
  );

  logic valid_q, rootless_q, beyond_q;
  wire drop = rootless_q || beyond_q;
  wire en = !valid_q || drop || ray_ready_i;
  assign ray_ready_o = en;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (en) valid_q <= ray_valid_i;
  end
  always_ff @(posedge clk_i) begin
    if (en) begin
      ray_o <= ray_i;
      segment_o <= segment_i;
      rootless_q <= rootless_i && (positive == '0 || &positive);
      beyond_q <= boxes_i && beyond;
    end
  end

  assign ray_valid_o = valid_q && !drop;
  assign rootless_o = valid_q && rootless_q;
  assign beyond_o = valid_q && !rootless_q && beyond_q;
  assign row_o = ray_o.y[0];
  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, segment_o})

endmodule

`default_nettype wire
