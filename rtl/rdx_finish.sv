// SPDX-License-Identifier: Apache-2.0
// Layers to the pixel stream: shading, and the queue behind it.
//
// Formats    as rdx_shade and rdx_pixels.
// Timing     as there.
// Reset      control only.
// Model      model/raydix/shade.py
`default_nettype none

module rdx_finish #(
    parameter int unsigned D = 4,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Layers = 1,
    parameter int unsigned Pixels = 1
) (
    input  wire logic                                     clk_i,
    input  wire logic                                     rst_ni,
    input  wire rdx_pkg::frame_t                          frame_i,
    input  wire logic                                     bank_i,           // that is read
    input  wire rdx_pkg::material_write_t                 material_i,
    input  wire logic                                     begin_i,
    output logic                                          room_o,
    input  wire logic                                     layer_valid_i,
    input  wire rdx_pkg::layer_t                          layer_i,
    input  wire logic                                     whole_i,
    output logic                                          finish_o,
    output logic                                          stalled_o,
    output logic                                          m_axis_tvalid_o,
    input  wire logic                                     m_axis_tready_i,
    output logic                          [24*Pixels-1:0] m_axis_tdata_o,
    output logic                          [ 3*Pixels-1:0] m_axis_tkeep_o,
    output logic                                          m_axis_tuser_o,
    output logic                                          m_axis_tlast_o
);
  import rdx_pkg::*;

  localparam int unsigned Latency = shade_latency(D, Vecsum);

  logic pixel_valid, whole;
  logic  [23:0] pixel;
  unit_t        background[3];
  assign background = '{frame_i.background[0], frame_i.background[1], frame_i.background[2]};
  rdx_shade #(
      .D(D),
      .Vecsum(Vecsum),
      .Surfaces(Surfaces),
      .Layers(Layers)
  ) u_shade (
      .clk_i,
      .rst_ni,
      .we_i(material_i.we),
      .bank_i(material_i.material.bank),
      .surface_i(material_i.material.surface),
      .constant_i(material_i.constant),
      .data_i(material_i.data),
      .read_bank_i(bank_i),
      .ambient_i(frame_i.ambient),
      .background_i(background),
      .layer_valid_i,
      .layer_i,
      .pixel_valid_o(pixel_valid),
      .pixel_o(pixel)
  );
  rdx_line #(
      .W(1),
      .Depth(Latency)
  ) u_whole (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i(whole_i),
      .data_o(whole)
  );
  rdx_pixels #(
      .Pixels(Pixels),
      .Depth (2 << $clog2(Latency + 8))
  ) u_pixels (
      .clk_i,
      .rst_ni,
      .last_x_i(frame_i.last_x),
      .last_y_i(frame_i.last_y),
      .begin_i,
      .room_o,
      .pixel_valid_i(pixel_valid),
      .pixel_i(pixel),
      .whole_i(whole),
      .finish_o,
      .stalled_o,
      .m_axis_tvalid_o,
      .m_axis_tready_i,
      .m_axis_tdata_o,
      .m_axis_tkeep_o,
      .m_axis_tuser_o,
      .m_axis_tlast_o
  );
  wire unused = &{1'b0, frame_i};

endmodule

`default_nettype wire
