// SPDX-License-Identifier: Apache-2.0
// Layers of the pixels to colours: gradient, light, blending, sRGB, each a part of one pipeline.
//
// Formats    we_i, bank_i, surface_i, constant_i, data_i: a write of a constant of a material, right-aligned. read_bank_i: the bank
//            that is read. layer_i: see rdx_pkg::layer_t; without shade it has first = last = 1. pixel_o: red, green, blue, 8 bits
//            each, sRGB-encoded.
// Rounding   that of the parts.    Overflow   cannot happen, or saturates: see the parts.
// Timing     a layer a clock or less often, without back-pressure; those of a pixel come one after the other. pixel_o
//            rdx_pkg::shade_latency(D, Vecsum) clocks after a pixel's last layer.
// Reset      of valid bits and the places of waiting lines.
// Error      one code of the exact colour for nearly all pixels: docs/processor.md
// Model      model/raydix/shade.py
`default_nettype none

module rdx_shade #(
    parameter int unsigned D = 4,
    parameter int unsigned Vecsum = 0,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Layers = 4
) (
    input  wire logic                      clk_i,
    input  wire logic                      rst_ni,
    input  wire logic                      we_i,
    input  wire logic                      bank_i,
    input  wire rdx_pkg::surface_t         surface_i,
    input  wire rdx_pkg::constant_t        constant_i,
    input  wire logic               [31:0] data_i,
    input  wire logic                      read_bank_i,
    input  wire rdx_pkg::unit_t            ambient_i,         // constant during a frame
    input  wire rdx_pkg::unit_t            background_i [3],  // constant during a frame
    input  wire logic                      layer_valid_i,
    input  wire rdx_pkg::layer_t           layer_i,
    output logic                           pixel_valid_o,
    output logic                    [23:0] pixel_o
);
  import rdx_pkg::*;

  localparam int unsigned Normal = normal_latency(D, Vecsum);
  localparam int unsigned Color = Normal + LightLatency;

  material_write_t write_q;
  always_ff @(posedge clk_i) write_q <= '{we_i, '{bank_i, surface_i}, constant_i, data_i};

  // ---- what the stages ask for, later and later ----
  typedef struct packed {
    material_t material;
    logic      shade;
    logic      first;
    logic      last;
    logic      enters;
  } asked_t;
  asked_t asked, at_normal, at_opacity;
  logic [2:0] at_color[1];
  always_comb begin
    asked = '{'{read_bank_i, layer_i.surface}, layer_i.shade, layer_i.first, layer_i.last, layer_i.enters};
  end
  rdx_line #(
      .W($bits(asked_t)),
      .Depth(Normal)
  ) u_normal (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(asked),
      .data_o(at_normal)
  );
  rdx_line #(
      .W($bits(asked_t)),
      .Depth(LightLatency - ConstantLatency)
  ) u_opacity (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(at_normal),
      .data_o(at_opacity)
  );
  rdx_delay #(
      .T(logic [2:0]),
      .Depth(ConstantLatency)
  ) u_color (
      .clk_i,
      .data_i('{{at_opacity.shade, at_opacity.first, at_opacity.last}}),
      .data_o(at_color)
  );
  logic [Color-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= '0;
    else valid_q <= {valid_q[Color-2:0], layer_valid_i};
  end

  // ---- gradient ----
  coord_t  point   [3];
  normal_t gradient[3];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_point
    assign point[axis] = coord_t'(layer_i.point[axis]);
  end
  rdx_normal #(
      .D(D),
      .Vecsum(Vecsum),
      .Surfaces(Surfaces)
  ) u_normal_of (
      .clk_i,
      .rst_ni,
      .write_i(write_q),
      .material_i(asked.material),
      .point_i(point),
      .gradient_o(gradient)
  );

  // ---- light, blending, codes ----
  unit_t color[3], linear[3];
  logic [UnitWidth-1:0] opacity;
  logic blended;
  rdx_light #(
      .Surfaces(Surfaces)
  ) u_light (
      .clk_i,
      .rst_ni,
      .write_i(write_q),
      .material_i(at_normal.material),
      .ambient_i,
      .gradient_i(gradient),
      .enters_i(at_normal.enters),
      .color_o(color)
  );
  rdx_constant #(
      .Surfaces(Surfaces),
      .W(UnitWidth),
      .Index(AtOpacity)
  ) u_opacity_of (
      .clk_i,
      .write_i(write_q),
      .material_i(at_opacity.material),
      .data_o(opacity)
  );
  rdx_blend #(
      .Layers(Layers)
  ) u_blend (
      .clk_i,
      .rst_ni,
      .background_i,
      .valid_i(valid_q[Color-1]),
      .first_i(at_color[0][1]),
      .last_i(at_color[0][0]),
      .opacity_i(at_color[0][2] ? opacity : '0),
      .color_i(color),
      .valid_o(blended),
      .linear_o(linear)
  );
  for (genvar channel = 0; channel < 3; channel++) begin : gen_code
    rdx_srgb u_srgb (
        .clk_i,
        .linear_i(linear[channel]),
        .code_o  (pixel_o[8*(2-channel)+:8])
    );
  end
  logic [SrgbLatency-1:0] pixel_valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) pixel_valid_q <= '0;
    else pixel_valid_q <= {pixel_valid_q[SrgbLatency-2:0], blended};
  end
  assign pixel_valid_o = pixel_valid_q[SrgbLatency-1];
  wire unused = &{1'b0, at_normal.shade, at_opacity.enters};

endmodule

`default_nettype wire
