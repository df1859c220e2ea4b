// SPDX-License-Identifier: Apache-2.0
// Colour of a layer: normal, cosine of the angle between normal and light, the light's and the material's colour.
//
// N = T G; cos = N3 / |N|, its sign turned where the ray does not enter, 0 where that is negative; the level is
// ambient + (1 - ambient) cos. Where G is 0, cos is.
//
// Formats    gradient_i: 18 bits of any scale. ambient_i, color_o: u1p16.
// Rounding   half up: N to s3p29, cos, the products of u1p16; floor: N scaled to 18 bits.
// Overflow   cos is cut to 1; nothing else can overflow: |N| < 3, |N|^2 <= 3 * 2^34, |N3 root| < 2^34.
// Timing     material_i, enters_i with gradient_i; latency rdx_pkg::LightLatency = 27 clocks, one layer a clock.
// Reset      of the waiting lines' places only.
// Error      cos: 2^-14 where T is a rotation, G exact; tb/test_light.py
// Model      model/raydix/light.py
`default_nettype none

module rdx_light #(
    parameter int unsigned Surfaces = 64
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::unit_t           ambient_i,      // constant
    input  wire rdx_pkg::normal_t         gradient_i[3],
    input  wire logic                     enters_i,
    output rdx_pkg::unit_t                color_o   [3]
);
  import rdx_pkg::*;

  localparam int unsigned Normal = ConstantLatency + MatrixLatency + FillLatency;  // latency up to the normal
  localparam int unsigned Level = Normal + RsqrtLatency + 9;  // and up to the level

  // ---- normal ----
  normal_t gradient[3], normal[3];
  logic signed [36:0] product[3];
  logic signed [31:0] wide[3];
  rdx_delay #(
      .T(normal_t),
      .Count(3),
      .Depth(ConstantLatency)
  ) u_gradient (
      .clk_i,
      .data_i(gradient_i),
      .data_o(gradient)
  );
  rdx_matrix #(
      .Surfaces (Surfaces),
      .Index    (AtLight),
      .Symmetric(1'b0)
  ) u_matrix (
      .clk_i,
      .write_i,
      .material_i,
      .vector_i (gradient),
      .product_o(product)
  );
  rdx_fill u_fill (
      .clk_i,
      .values_i(wide),
      .values_o(normal)
  );

  // ---- cosine ----
  product_t squares_q[3];
  logic [35:0] two_q, third_q, square_q;
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    always_comb wide[axis] = product[axis][36:5] + 32'(product[axis][4]);
    always_ff @(posedge clk_i) squares_q[axis] <= product_t'(normal[axis]) * product_t'(normal[axis]);
    wire unused = &{1'b0, product[axis][3:0]};
  end
  always_ff @(posedge clk_i) begin
    two_q <= squares_q[0] + squares_q[1];
    third_q <= squares_q[2];
    square_q <= two_q + third_q;
  end
  logic [16:0] root;
  logic doubled, doubled_q[2], enters[1], turned_q;
  normal_t third;
  logic [NormalWidth-1:0] waiting;
  rdx_rsqrt u_rsqrt (
      .clk_i,
      .square_i (square_q),
      .root_o   (root),
      .doubled_o(doubled)
  );
  rdx_line #(
      .W(NormalWidth),
      .Depth(RsqrtLatency + 3)
  ) u_third (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(normal[2]),
      .data_o(waiting)
  );
  rdx_line #(
      .W(1),
      .Depth(Normal + 3 + RsqrtLatency)
  ) u_enters (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(enters_i),
      .data_o(enters[0])
  );
  assign third = normal_t'(waiting);

  product_t product_q, signed_q;
  logic signed [19:0] cosine_q;
  unit_t cosine_qq;
  wire product_t scaled = doubled_q[1] ? signed_q <<< 1 : signed_q;
  always_ff @(posedge clk_i) begin
    turned_q  <= !enters[0];
    doubled_q <= '{doubled, doubled_q[0]};
    product_q <= product_t'(third) * product_t'($signed({1'b0, root}));
    signed_q  <= turned_q ? -product_q : product_q;
    cosine_q  <= 20'($signed({scaled[35:18], 1'b1})) + 20'($signed({1'b0, scaled[17]}));
    cosine_qq <= cosine_q[19] ? '0 : cosine_q[18:1] > 18'(One) ? One : cosine_q[17:1];
  end
  wire unused = &{1'b0, scaled[16:0], cosine_q[0]};

  // ---- level and colour ----
  material_t of_color;
  unit_t color[3], level_q;
  unit_t rest_q;
  unit_product_t lit_q;
  logic [UnitWidth:0] level;
  always_comb level = {ambient_i, 1'b1} + {lit_q[UnitFrac+:UnitWidth], lit_q[UnitFrac-1]};
  rdx_line #(
      .W($bits(material_t)),
      .Depth(Level - ConstantLatency)
  ) u_of_color (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(material_i),
      .data_o(of_color)
  );
  always_ff @(posedge clk_i) begin
    rest_q  <= One - ambient_i;
    lit_q   <= unit_product_t'(rest_q) * unit_product_t'(cosine_qq);
    level_q <= level[UnitWidth:1];
  end
  for (genvar channel = 0; channel < 3; channel++) begin : gen_color
    unit_product_t tinted_q;
    rdx_constant #(
        .Surfaces(Surfaces),
        .W(UnitWidth),
        .Index(AtColor + channel)
    ) u_color (
        .clk_i,
        .write_i,
        .material_i(of_color),
        .data_o(color[channel])
    );
    always_ff @(posedge clk_i) begin
      tinted_q <= unit_product_t'(level_q) * unit_product_t'(color[channel]);
      color_o[channel] <= rounded(tinted_q);
    end
  end
  wire unused_bits = &{1'b0, lit_q[UnitFrac-2:0], lit_q[2*UnitWidth-1], level[0]};

endmodule

`default_nettype wire
