// SPDX-License-Identifier: Apache-2.0
// Evaluates a number of points on fewer lanes: the points of an item take turns.
//
// An item comes every Phases = ceil(Points/Lanes) clocks, where phase_i = 0. Its first points go to the lanes at once, the
// others wait for their phase. The values are collected, and all are there at the end.
//
// Formats    points_i: x, y, z of each point, s2p30. values_o: s5p33.
// Timing     latency rdx_pkg::vecsum_latency + Phases - 1 clocks in which en_i = 1, one item every Phases clocks; phase_i
//            counts them.
// Reset      of waiting lines' places only.
// Model      model/raydix/vecsum.py (evaluate)
`default_nettype none

module rdx_lanes #(
    parameter int unsigned Points = 7,
    parameter int unsigned Lanes = 7,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    localparam int unsigned Phases = rdx_pkg::phases(Points, Lanes),
    localparam type phase_t = logic [3:0]
) (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            en_i,
    input  wire phase_t          phase_i,
    input  wire rdx_pkg::form_t  form_i,
    input  wire rdx_pkg::coord_t points_i[     3][Points],
    output rdx_pkg::vector_t     values_o[Points]
);
  import rdx_pkg::*;

  if (Lanes < 1 || Lanes > Points || Points > 15) begin : gen_illegal_lanes
    $fatal(1, "rdx_lanes: Lanes = %0d; allowed: 1 to Points = %0d, which is at most 15", Lanes, Points);
  end

  // the phase of the item that leaves: of vecsum_latency(VectorDrop) clocks ago
  phase_t leaving_q;
  always_ff @(posedge clk_i) if (en_i) leaving_q <= phase_before(phase_i, vecsum_latency(VectorDrop) - 1, Phases);

  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    localparam int unsigned Mine = (Points - l + Lanes - 1) / Lanes;  // points of this lane: l, l + Lanes, …
    coord_t  point [3];
    vector_t value;
    rdx_vecsum #(
        .General(General),
        .VectorDrop(VectorDrop)
    ) u_vecsum (
        .clk_i,
        .rst_ni,
        .en_i,
        .form_i,
        .point_i(point),
        .value_o(value)
    );

    // ---- in: the first point at once, the others from where they wait ----
    for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
      if (Mine == 1) begin : gen_direct
        assign point[axis] = points_i[axis][l];
      end else begin : gen_turns
        coord_t waiting_q[Mine];
        always_ff @(posedge clk_i) begin
          if (en_i && phase_i == '0) for (int unsigned i = 1; i < Mine; i++) waiting_q[i] <= points_i[axis][l+i*Lanes];
        end
        always_comb begin
          point[axis] = points_i[axis][l];
          for (int unsigned i = 1; i < Mine; i++) if (phase_i == phase_t'(i)) point[axis] = waiting_q[i];
        end
        assign waiting_q[0] = '0;
      end
    end

    // ---- out: what leaves in the last phase is passed on, the rest has been kept ----
    for (genvar i = 0; i < Mine; i++) begin : gen_value
      if (i == Phases - 1) begin : gen_last
        assign values_o[l+i*Lanes] = value;
      end else begin : gen_kept
        vector_t value_q;
        always_ff @(posedge clk_i) if (en_i && leaving_q == phase_t'(i)) value_q <= value;
        assign values_o[l+i*Lanes] = value_q;
      end
    end
  end

  if (Phases == 1) begin : gen_one_phase
    wire unused = &{1'b0, phase_i, leaving_q};
  end

endmodule

`default_nettype wire
