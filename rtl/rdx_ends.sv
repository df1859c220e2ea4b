// SPDX-License-Identifier: Apache-2.0
// Indicator of a vector-sum surface at both ends of a new ray's segment, on one lane or two.
//
// Formats    ends_i: s2p30 and s1p31. segment_o: the ends, and b: the indicator at the near and the far end, s5p33.
// Timing     latency rdx_pkg::vecsum_latency + Phases - 1 clocks that advance, a ray every Phases = 2/Lanes clocks; it
//            advances when the last stage is empty or taken.
// Reset      valid, the phase and waiting lines' places.
// Model      model/raydix/ends.py
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_ends #(
    parameter int unsigned Lanes = 2,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    localparam type segment_t = `RDX_SEGMENT_T(rdx_pkg::VectorWidth, 1)
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire rdx_pkg::form_t form_i,
    input  wire logic           ray_valid_i,
    output logic                ray_ready_o,
    input  wire rdx_pkg::ray_t  ray_i,
    input  wire rdx_pkg::ends_t ends_i,
    output logic                ray_valid_o,
    input  wire logic           ray_ready_i,
    output rdx_pkg::ray_t       ray_o,
    output segment_t            segment_o
);
  import rdx_pkg::*;

  localparam int unsigned Phases = phases(2, Lanes);
  localparam int unsigned Latency = vecsum_latency(VectorDrop) + Phases - 1;

  // ---- stream: all stages advance together; a ray enters in phase 0 ----
  logic [Latency-1:0] valid_q;
  logic phase_q;
  wire en = !valid_q[Latency-1] || ray_ready_i;
  assign ray_ready_o = en && !phase_q;
  assign ray_valid_o = valid_q[Latency-1];
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
      phase_q <= 1'b0;
    end else if (en) begin
      valid_q <= {valid_q[Latency-2:0], ray_valid_i && !phase_q};
      phase_q <= Phases == 2 && !phase_q;
    end
  end

  rdx_line #(
      .W($bits(ray_t) + $bits(ends_t)),
      .Depth(Latency)
  ) u_wait (
      .clk_i,
      .rst_ni,
      .en_i  (en),
      .data_i({ray_i, ends_i}),
      .data_o({ray_o, segment_o.ends})
  );

  // ---- values ----
  coord_t  points[3] [2];
  vector_t values[2];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    assign points[axis] = '{ends_i.start[axis], ends_i.stop[axis]};
  end
  rdx_lanes #(
      .Points(2),
      .Lanes(Lanes),
      .General(General),
      .VectorDrop(VectorDrop)
  ) u_lanes (
      .clk_i,
      .rst_ni,
      .en_i(en),
      .phase_i({3'b000, phase_q}),
      .form_i,
      .points_i(points),
      .values_o(values)
  );
  assign segment_o.b = {values[1], values[0]};

  `RDX_STREAM(a_ray, ray_valid_o, ray_ready_i, {ray_o, segment_o})

endmodule

`default_nettype wire
