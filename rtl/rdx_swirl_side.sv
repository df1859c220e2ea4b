// SPDX-License-Identifier: Apache-2.0
// Which of the balls at the ends of a spiral is the nearer one.
//
// Both have the same power, distance squared less radius squared, on a plane. A helix has balls of one size and a turn
// at least, so that the height is enough (docs/spirals.md, "The nearer ball").
//
// Formats    point_i: s2p22. stop_o: 1: the ball at the end.
// Rounding   coordinates down to s2p16 (General).    Overflow   cannot happen.
// Timing     latency SwirlSideLatency = 3 clocks, one point a clock; material_i two clocks before. No reset.
// Model      model/raydix/swirl.py (at_end)
`default_nettype none

module rdx_swirl_side #(
    parameter bit General = 1'b0,
    parameter int unsigned Surfaces = 1
) (
    input  wire logic                        clk_i,
    input  wire rdx_pkg::material_write_t    write_i,
    input  wire rdx_pkg::material_t          material_i,
    input  wire rdx_swirl_pkg::swirl_coord_t point_i   [3],
    output logic                             stop_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  if (General) begin : gen_plane
    localparam type product_t = logic signed [2*NormalWidth-1:0];
    localparam type sum_t = logic signed [2*NormalWidth+1:0];
    material_t material_q;
    product_t product_q[3];
    swirl_plane_offset_t offset;
    sum_t left_q, right_q;
    always_ff @(posedge clk_i) material_q <= material_i;
    for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
      normal_t normal;
      rdx_constant #(
          .W(NormalWidth),
          .Index(SwirlPlane + axis),
          .Surfaces(Surfaces)
      ) u_normal (
          .clk_i,
          .write_i,
          .material_i,
          .data_o(normal)
      );
      wire normal_t place = normal_t'(point_i[axis] >>> (SwirlFrac - 16));
      always_ff @(posedge clk_i) product_q[axis] <= product_t'(place) * product_t'(normal);
      wire unused = &{1'b0, point_i[axis]};
    end
    rdx_constant #(
        .W($bits(swirl_plane_offset_t)),
        .Index(SwirlPlaneOffset),
        .Surfaces(Surfaces)
    ) u_offset (
        .clk_i,
        .write_i,
        .material_i(material_q),
        .data_o(offset)
    );
    always_ff @(posedge clk_i) begin
      left_q  <= sum_t'(product_q[0]) + sum_t'(product_q[1]);
      right_q <= (sum_t'(offset) <<< 5) - sum_t'(product_q[2]);
      stop_o  <= left_q >= right_q;
    end
  end else begin : gen_height
    swirl_coord_t split;
    logic down, above_q, stop_q;
    rdx_constant #(
        .W($bits(swirl_coord_t)),
        .Index(SwirlSplit),
        .Surfaces(Surfaces)
    ) u_split (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(split)
    );
    rdx_constant #(
        .W(1),
        .Index(SwirlDown),
        .Surfaces(Surfaces)
    ) u_down (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(down)
    );
    always_ff @(posedge clk_i) begin
      stop_q  <= (point_i[2] >= split) ^ down;
      above_q <= stop_q;
      stop_o  <= above_q;
    end
    wire unused = &{1'b0, point_i[0], point_i[1]};
  end

endmodule

`default_nettype wire
