// SPDX-License-Identifier: Apache-2.0
// Value and gradient of a quadric of the material at a point: g = M p + m, q = (g + m) p / 2 + c.
//
// Formats    point_i: s2p16. constants s1p17. value_o, gradient_o: s2p16.
// Rounding   half up, once: g, g + m, q.    Overflow   saturates; the material is scaled so that it does not.
// Timing     point_i rdx_pkg::ConstantLatency = 2 clocks after material_i; value_o rdx_pkg::QuadricLatency = 10 clocks after
//            point_i, and gradient_o with it; one point a clock.
// Reset      of the waiting lines' places only.
// Model      model/raydix/gradient.py (quadric)
`default_nettype none

module rdx_quadric #(
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Matrix   = 0,   // numbers of the constants
    parameter int unsigned Linear   = 6,
    parameter int unsigned Constant = 9
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::normal_t         point_i   [3],
    output rdx_pkg::normal_t              value_o,
    output rdx_pkg::normal_t              gradient_o[3]
);
  import rdx_pkg::*;

  // ---- constants when they are needed: matrix at once, linear part after the slopes, constant after the products ----
  material_t of_linear[1], of_constant[1];
  rdx_delay #(
      .T(material_t),
      .Depth(MatrixLatency)
  ) u_of_linear (
      .clk_i,
      .data_i('{material_i}),
      .data_o(of_linear)
  );
  rdx_delay #(
      .T(material_t),
      .Depth(5)
  ) u_of_constant (
      .clk_i,
      .data_i(of_linear),
      .data_o(of_constant)
  );
  normal_t linear[3], constant;
  for (genvar axis = 0; axis < 3; axis++) begin : gen_linear
    rdx_constant #(
        .Surfaces(Surfaces),
        .W(NormalWidth),
        .Index(Linear + axis)
    ) u_linear (
        .clk_i,
        .write_i,
        .material_i(of_linear[0]),
        .data_o(linear[axis])
    );
  end
  rdx_constant #(
      .Surfaces(Surfaces),
      .W(NormalWidth),
      .Index(Constant)
  ) u_constant (
      .clk_i,
      .write_i,
      .material_i(of_constant[0]),
      .data_o(constant)
  );

  // ---- gradient g, and g + m: half up by a carry; what is below the linear part's last bit cannot change it ----
  logic signed [36:0] slope[3];
  rdx_matrix #(
      .Surfaces(Surfaces),
      .Index(Matrix)
  ) u_slope (
      .clk_i,
      .write_i,
      .material_i,
      .vector_i (point_i),
      .product_o(slope)
  );
  normal_t point[3], wide_q[3], gradient_q[3];
  logic [2:0][NormalWidth-1:0] waiting;
  rdx_line #(
      .W(3 * NormalWidth),
      .Depth(MatrixLatency + 2)
  ) u_point (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({point_i[2], point_i[1], point_i[0]}),
      .data_o(waiting)
  );
  product_t parts_q[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    logic signed [22:0] once_q, twice_q;
    assign point[axis] = normal_t'(waiting[axis]);
    always_ff @(posedge clk_i) begin
      once_q <= 23'($signed({slope[axis][36:16], 1'b1})) + 23'($signed({linear[axis], 1'b1}));
      twice_q <= 23'($signed({slope[axis][36:16], 1'b0})) + 23'($signed({linear[axis], 2'b10}));
      gradient_q[axis] <= saturated(22'($signed(once_q[22:2])));
      wide_q[axis] <= saturated(22'($signed(twice_q[22:2])));
      parts_q[axis] <= product_t'(wide_q[axis]) * product_t'(point[axis]);
    end
    wire unused = &{1'b0, slope[axis][15:0], once_q[1:0], twice_q[1:0]};
  end

  // ---- value ----
  logic signed [36:0] two_q, sum_q;
  logic signed [22:0] value_q;
  product_t third_q;
  always_ff @(posedge clk_i) begin
    two_q   <= 37'(parts_q[0]) + 37'(parts_q[1]);
    third_q <= parts_q[2];
    sum_q   <= two_q + 37'(third_q);
    value_q <= 23'($signed({sum_q[36:16], 1'b1})) + 23'($signed({constant, 1'b1}));
    value_o <= saturated(22'($signed(value_q[22:2])));
  end
  wire unused = &{1'b0, sum_q[15:0], value_q[1:0]};

  logic [2:0][NormalWidth-1:0] held;
  rdx_line #(
      .W(3 * NormalWidth),
      .Depth(QuadricLatency - MatrixLatency - 2)
  ) u_gradient (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({gradient_q[2], gradient_q[1], gradient_q[0]}),
      .data_o(held)
  );
  for (genvar axis = 0; axis < 3; axis++) begin : gen_held
    assign gradient_o[axis] = normal_t'(held[axis]);
  end

endmodule

`default_nettype wire
