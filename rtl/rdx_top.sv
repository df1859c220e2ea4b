// SPDX-License-Identifier: Apache-2.0
// The processor: descriptors and materials by AXI4-Lite, pixels by AXI4-Stream (docs/processor.md).
//
// A queued start begins when the frame before has left; then the banks of both tables are exchanged: the host writes ahead.
//
// Formats    axil_*: see rdx_csr and docs/registers.md. m_axis_*: see rdx_pixels. tap_*: each record of the rings, for test benches.
// Timing     one clock; a beat of the pixel stream a clock at most.
// Reset      rst_ni, synchronous, active low; a frame under way is lost. Then busy for 2*MaxWidth/Pixels clocks.
// Model      model/raydix/render.py
`default_nettype none

module rdx_top #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter int unsigned VectorUnits = 1,
    parameter int unsigned VectorDrop = 0,
    parameter int unsigned Rings = 1,
    parameter int unsigned VectorRings = 1,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned Layers = 4,
    parameter int unsigned MaxWidth = 1920,
    parameter int unsigned Pixels = 1
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire logic                     axil_awvalid_i,
    output logic                          axil_awready_o,
    input  wire logic     [         17:0] axil_awaddr_i,
    input  wire logic                     axil_wvalid_i,
    output logic                          axil_wready_o,
    input  wire logic     [         31:0] axil_wdata_i,
    input  wire logic     [          3:0] axil_wstrb_i,
    output logic                          axil_bvalid_o,
    input  wire logic                     axil_bready_i,
    output logic          [          1:0] axil_bresp_o,
    input  wire logic                     axil_arvalid_i,
    output logic                          axil_arready_o,
    input  wire logic     [         17:0] axil_araddr_i,
    output logic                          axil_rvalid_o,
    input  wire logic                     axil_rready_i,
    output logic          [         31:0] axil_rdata_o,
    output logic          [          1:0] axil_rresp_o,
    output logic                          irq_o,
    output logic                          m_axis_tvalid_o,
    input  wire logic                     m_axis_tready_i,
    output logic          [24*Pixels-1:0] m_axis_tdata_o,
    output logic          [ 3*Pixels-1:0] m_axis_tkeep_o,
    output logic                          m_axis_tuser_o,
    output logic                          m_axis_tlast_o,
    output logic                          tap_valid_o,
    output rdx_pkg::hit_t                 tap_o
);
  import rdx_pkg::*;

  frame_t next_frame, frame_q;
  logic start_valid, abort, start_q, busy_q, bank_q, ready, done;
  wire start = start_valid && ready && !busy_q;
  error_e error;
  surface_t error_slot, slot;
  counters_t counters;
  logic [2:0] done_q;  // while the last events are counted
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      bank_q <= 1'b0;
      done_q <= '0;
    end else begin
      if (start) busy_q <= 1'b1;
      else if (done_q[2] || error != ErrorNone) busy_q <= 1'b0;
      if (start) bank_q <= !bank_q;
      done_q <= {done_q[1:0], done};
    end
  end
  always_ff @(posedge clk_i) if (start) frame_q <= next_frame;
  always_ff @(posedge clk_i) start_q <= start && rst_ni;
  logic table_req, table_we, table_ack;
  logic [13:0] table_addr;
  logic [31:0] table_data, table_read;
  logic [3:0] table_strobe;
  material_write_t material;
  assign material.material.bank = !bank_q;
  rdx_csr #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .Clip(Clip),
      .Vecsum(Vecsum),
      .Lanes(Lanes),
      .VectorUnits(VectorUnits),
      .VectorDrop(VectorDrop),
      .Rings(Rings),
      .VectorRings(VectorRings),
      .Surfaces(Surfaces),
      .Layers(Layers),
      .MaxWidth(MaxWidth),
      .Pixels(Pixels)
  ) u_csr (
      .*,
      .start_valid_o(start_valid),
      .start_ready_i(start),
      .frame_o(next_frame),
      .abort_o(abort),
      .busy_i(busy_q),
      .done_i(done_q[2]),
      .counters_i(counters),
      .error_valid_i(error != ErrorNone),
      .error_code_i(error),
      .error_slot_i(error_slot),
      .table_req_o(table_req),
      .table_we_o(table_we),
      .table_addr_o(table_addr),
      .table_data_o(table_data),
      .table_strobe_o(table_strobe),
      .table_ack_i(table_ack),
      .table_data_i(table_read),
      .material_we_o(material.we),
      .material_surface_o(material.material.surface),
      .material_constant_o(material.constant),
      .material_data_o(material.data)
  );
  logic [ 6:0] place;
  logic [63:0] word;
  rdx_table #(
      .Slots(Surfaces)
  ) u_table (
      .clk_i,
      .rst_ni,
      .swap_i(start),
      .read_i(1'b1),
      .slot_i(slot),
      .word_i(place),
      .data_o(word),
      .host_req_i(table_req),
      .host_we_i(table_we),
      .host_addr_i(table_addr),
      .host_data_i(table_data),
      .host_strobe_i(table_strobe),
      .host_ack_o(table_ack),
      .host_data_o(table_read)
  );
  rdx_render #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .U(U),
      .Rules(Rules),
      .Clip(Clip),
      .HalveStages(HalveStages),
      .Vecsum(Vecsum),
      .Lanes(Lanes),
      .VectorUnits(VectorUnits),
      .VectorDrop(VectorDrop),
      .Rings(Rings),
      .VectorRings(VectorRings),
      .Surfaces(Surfaces),
      .Layers(Layers),
      .MaxWidth(MaxWidth),
      .Pixels(Pixels)
  ) u_render (
      .clk_i,
      .rst_ni,
      .ready_o(ready),
      .start_i(start_q),
      .abort_i(abort),
      .frame_i(frame_q),
      .done_o(done),
      .error_o(error),
      .error_slot_o(error_slot),
      .counters_o(counters),
      .slot_o(slot),
      .place_o(place),
      .table_i(word),
      .bank_i(bank_q),
      .material_i(material),
      .m_axis_tvalid_o,
      .m_axis_tready_i,
      .m_axis_tdata_o,
      .m_axis_tkeep_o,
      .m_axis_tuser_o,
      .m_axis_tlast_o,
      .tap_valid_o,
      .tap_o
  );
endmodule

`default_nettype wire
