// SPDX-License-Identifier: Apache-2.0
// Gradient of an algebraic surface at a point: G = q1 g2 + q2 g1 + g3, or g3 alone where no quartics are built (D = 2).
//
// g3 = M p + m of Q3; rdx_quadric has values and gradients of Q1 and Q2.
//
// Formats    point_i: s2p30, rounded to s2p16. gradient_o: scaled by a power of two so that it fills 18 bits.
// Rounding   half up: point, q and g, and G to s5p27; then floor by the scaling.
// Overflow   the point, q and g saturate; G cannot overflow: below 4 + 4 + 7 of its 16.
// Timing     latency rdx_pkg::gradient_latency(D) clocks, one point a clock.
// Reset      of the waiting lines' places only.
// Model      model/raydix/gradient.py
`default_nettype none

module rdx_gradient #(
    parameter int unsigned D = 4,
    parameter int unsigned Surfaces = 64
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::coord_t          point_i   [3],
    output rdx_pkg::normal_t              gradient_o[3]
);
  import rdx_pkg::*;

  if (D != 2 && D != 4) begin : gen_illegal_d
    $fatal(1, "rdx_gradient: D = %0d; allowed: 2, 4", D);
  end
  localparam int unsigned Drop = CoordFrac - 16;

  // ---- point: half up, saturated ----
  normal_t point_q[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_point
    logic signed [NormalWidth+1:0] sum_q;
    always_ff @(posedge clk_i) begin
      sum_q <= (NormalWidth + 2)'($signed(
          {point_i[axis][CoordWidth-1:Drop], 1'b1}
      )) + (NormalWidth + 2)'($signed(
          {1'b0, point_i[axis][Drop-1]}
      ));
      point_q[axis] <= saturated(22'($signed(sum_q[NormalWidth+1:1])));
    end
    wire unused = &{1'b0, point_i[axis][Drop-2:0], sum_q[0]};
  end

  // ---- g3; 32 is half of what is dropped of G ----
  logic signed [36:0] slope[3], steep_q[3];
  rdx_matrix #(
      .Surfaces(Surfaces),
      .Index(AtQ3Matrix)
  ) u_slope (
      .clk_i,
      .write_i,
      .material_i,
      .vector_i (point_q),
      .product_o(slope)
  );
  material_t of_linear[1];
  rdx_delay #(
      .T(material_t),
      .Depth(MatrixLatency)
  ) u_of_linear (
      .clk_i,
      .data_i('{material_i}),
      .data_o(of_linear)
  );
  for (genvar axis = 0; axis < 3; axis++) begin : gen_linear
    normal_t linear;
    rdx_constant #(
        .Surfaces(Surfaces),
        .W(NormalWidth),
        .Index(AtQ3Linear + axis)
    ) u_linear (
        .clk_i,
        .write_i,
        .material_i(of_linear[0]),
        .data_o(linear)
    );
    always_ff @(posedge clk_i) steep_q[axis] <= slope[axis] + 37'($signed({linear, 16'd32}));
  end

  // ---- G ----
  logic signed [31:0] total[3];
  if (D == 2) begin : gen_quadric
    for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
      assign total[axis] = 32'($signed(steep_q[axis][36:6]));
      wire unused = &{1'b0, steep_q[axis][5:0]};
    end
    wire unused_rst = rst_ni;
  end else begin : gen_quartic
    normal_t value[2];
    normal_t other[2] [3];  // gradient of the other factor
    rdx_quadric #(
        .Surfaces(Surfaces),
        .Matrix  (AtQ1Matrix),
        .Linear  (AtQ1Linear),
        .Constant(AtQ1Constant)
    ) u_q1 (
        .clk_i,
        .rst_ni,
        .write_i,
        .material_i,
        .point_i(point_q),
        .value_o(value[0]),
        .gradient_o(other[1])
    );
    rdx_quadric #(
        .Surfaces(Surfaces),
        .Matrix  (AtQ2Matrix),
        .Linear  (AtQ2Linear),
        .Constant(AtQ2Constant)
    ) u_q2 (
        .clk_i,
        .rst_ni,
        .write_i,
        .material_i,
        .point_i(point_q),
        .value_o(value[1]),
        .gradient_o(other[0])
    );
    logic [2:0][36:0] waiting;
    rdx_line #(
        .W(3 * 37),
        .Depth(QuadricLatency + 2 - (MatrixLatency + 1))
    ) u_steep (
        .clk_i,
        .rst_ni,
        .en_i  (1'b1),
        .data_i({steep_q[2], steep_q[1], steep_q[0]}),
        .data_o(waiting)
    );
    for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
      product_t parts_q[2];
      logic signed [36:0] both_q;
      logic signed [37:0] sum_q;
      always_ff @(posedge clk_i) begin
        for (int unsigned i = 0; i < 2; i++) parts_q[i] <= product_t'(value[i]) * product_t'(other[i][axis]);
        both_q <= 37'(parts_q[0]) + 37'(parts_q[1]);
        sum_q  <= 38'($signed({both_q, 1'b0})) + 38'($signed(waiting[axis]));
      end
      assign total[axis] = sum_q[37:6];
      wire unused = &{1'b0, sum_q[5:0]};
    end
  end
  rdx_fill u_fill (
      .clk_i,
      .values_i(total),
      .values_o(gradient_o)
  );

endmodule

`default_nettype wire
