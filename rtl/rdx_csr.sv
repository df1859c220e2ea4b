// SPDX-License-Identifier: Apache-2.0
// The host's side of the processor by AXI4-Lite: registers, start of a frame, interrupt, windows into the tables.
//
// The registers themselves are rdx_csr_regs, generated from rdx_csr.rdl; docs/registers.md lists them.
//
// Formats    axil_*: 32 bits of data, byte addresses; table_addr_o: {slot, word, half}; material_data_o: a constant of
//            material_surface_o. counters_i is taken with done_i.
// Overflow   the count of frames wraps.
// Timing     a legal start: start_valid_o two clocks after its address and data have been taken, with frame_o as the registers
//            were; both stay until start_ready_i. table_ack_i: one clock after table_req_o or later; it must come.
//            material_we_o and abort_o: one clock. irq_o: a level.
// Reset      everything but the frame and the code of the error.
// Model      none: the map in build/csr and the tests
`default_nettype none
`include "rdx_assert.svh"

module rdx_csr
  import rdx_pkg::*;
#(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rules = RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned Vecsum = VecsumNone,
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
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             axil_awvalid_i,
    output logic                  axil_awready_o,
    input  wire logic      [17:0] axil_awaddr_i,
    input  wire logic             axil_wvalid_i,
    output logic                  axil_wready_o,
    input  wire logic      [31:0] axil_wdata_i,
    input  wire logic      [ 3:0] axil_wstrb_i,
    output logic                  axil_bvalid_o,
    input  wire logic             axil_bready_i,
    output logic           [ 1:0] axil_bresp_o,
    input  wire logic             axil_arvalid_i,
    output logic                  axil_arready_o,
    input  wire logic      [17:0] axil_araddr_i,
    output logic                  axil_rvalid_o,
    input  wire logic             axil_rready_i,
    output logic           [31:0] axil_rdata_o,
    output logic           [ 1:0] axil_rresp_o,
    output logic                  start_valid_o,
    input  wire logic             start_ready_i,
    output frame_t                frame_o,
    output logic                  abort_o,
    input  wire logic             busy_i,
    input  wire logic             done_i,
    input  wire counters_t        counters_i,
    input  wire logic             error_valid_i,
    input  wire error_e           error_code_i,
    input  wire surface_t         error_slot_i,
    output logic                  irq_o,
    output logic                  table_req_o,
    output logic                  table_we_o,
    output logic           [13:0] table_addr_o,
    output logic           [31:0] table_data_o,
    output logic           [ 3:0] table_strobe_o,
    input  wire logic             table_ack_i,
    input  wire logic      [31:0] table_data_i,
    output logic                  material_we_o,
    output surface_t              material_surface_o,
    output constant_t             material_constant_o,
    output logic           [31:0] material_data_o
);

  rdx_csr_regs_pkg::rdx_csr_regs__in_t  to_regs;
  rdx_csr_regs_pkg::rdx_csr_regs__out_t regs;
  rdx_csr_regs u_regs (
      .clk           (clk_i),
      .rst_n         (rst_ni),
      .s_axil_awready(axil_awready_o),
      .s_axil_awvalid(axil_awvalid_i),
      .s_axil_awaddr (axil_awaddr_i),
      .s_axil_awprot ('0),
      .s_axil_wready (axil_wready_o),
      .s_axil_wvalid (axil_wvalid_i),
      .s_axil_wdata  (axil_wdata_i),
      .s_axil_wstrb  (axil_wstrb_i),
      .s_axil_bready (axil_bready_i),
      .s_axil_bvalid (axil_bvalid_o),
      .s_axil_bresp  (axil_bresp_o),
      .s_axil_arready(axil_arready_o),
      .s_axil_arvalid(axil_arvalid_i),
      .s_axil_araddr (axil_araddr_i),
      .s_axil_arprot ('0),
      .s_axil_rready (axil_rready_i),
      .s_axil_rvalid (axil_rvalid_o),
      .s_axil_rdata  (axil_rdata_o),
      .s_axil_rresp  (axil_rresp_o),
      .hwif_in       (to_regs),
      .hwif_out      (regs)
  );

  request_t request;  // the registers as they are
  assign request.width  = regs.SIZE.width.value;
  assign request.height = regs.SIZE.height.value;
  assign request.count  = regs.COUNT.count.value;
  assign request.k_stop = regs.K_STOP.k_stop.value;
  rdx_csr_regs_pkg::rdx_csr_regs__SKIP__out_t skip;
  assign skip = regs.SKIP;
  assign request.skip = {
    skip.early.value, skip.depth.value, skip.rootless.value, skip.boxes.value, skip.rectangle.value
  };
  assign request.ambient = regs.AMBIENT.ambient.value;
  assign request.background = {
    regs.BACKGROUND_B.blue.value, regs.BACKGROUND_G.green.value, regs.BACKGROUND_R.red.value
  };
  logic done, error;
  wire known = regs.IRQ_STATUS.error.value;
  error_e code;
  surface_t slot;
  rdx_check #(
      .K       (K),
      .Surfaces(Surfaces),
      .MaxWidth(MaxWidth)
  ) u_check (
      .*,
      .start_i  (regs.CONTROL.start.value),
      .request_i(request),
      .done_o   (done),
      .known_i  (known && !regs.IRQ_STATUS.error.swmod),
      .error_o  (error),
      .code_o   (code),
      .slot_o   (slot)
  );
  assign abort_o = regs.CONTROL.abort.value;
  assign irq_o = (regs.IRQ_STATUS.done.value && regs.IRQ_ENABLE.done.value) || (known && regs.IRQ_ENABLE.error.value);

  assign table_req_o = regs.DESCRIPTORS.req;
  assign table_we_o = regs.DESCRIPTORS.req_is_wr;
  assign table_addr_o = regs.DESCRIPTORS.addr[15:2];
  assign table_data_o = regs.DESCRIPTORS.wr_data;
  for (genvar k = 0; k < 4; k++) begin : gen_strobe
    assign table_strobe_o[k] = &regs.DESCRIPTORS.wr_biten[8*k+:8];
  end
  logic table_we_q;  // of the access that waits for its acknowledgement
  always_ff @(posedge clk_i) if (table_req_o) table_we_q <= table_we_o;

  assign material_we_o = regs.MATERIALS.req && regs.MATERIALS.req_is_wr && &regs.MATERIALS.wr_biten;
  assign {material_surface_o, material_constant_o} = regs.MATERIALS.addr[13:2];
  assign material_data_o = regs.MATERIALS.wr_data;
  counters_t counters_q;
  always_ff @(posedge clk_i) if (!rst_ni || done_i) counters_q <= rst_ni ? counters_i : '0;

  always_comb begin
    to_regs.PARAMETERS_SEARCH = '{'{8'(N1)}, '{8'(K)}, '{8'(U)}, '{8'(W)}};  // fields in the order of rdx_csr.rdl
    to_regs.PARAMETERS_KINDS = '{'{8'(D)}, '{4'(Vecsum)}, '{4'(Rules)}, '{8'(Lanes)}, '{8'(VectorUnits)}};
    to_regs.PARAMETERS_RINGS = '{'{8'(Rings)}, '{8'(VectorRings)}, '{1'(Clip)}, '{4'(VectorDrop)}};
    to_regs.PARAMETERS_FRAME = '{'{8'(Surfaces)}, '{8'(Layers)}, '{13'(MaxWidth)}, '{3'(Pixels)}};
    to_regs.STATUS = '{busy: '{busy_i}, queued: '{start_valid_o}, done: '{done}, error: '{known}};
    to_regs.IRQ_STATUS = '{done: '{done_i}, error: '{error}};
    to_regs.ERROR = known ? '{code: '{code}, slot: '{slot}} : '{code: '{'0}, slot: '{'0}};
    {to_regs.CYCLES_HIGH.count.next, to_regs.CYCLES_LOW.count.next} = counters_q.cycles;
    {to_regs.STEPS_HIGH.count.next, to_regs.STEPS_LOW.count.next} = counters_q.steps;
    to_regs.RAYS.count.next = counters_q.rays;
    to_regs.HITS.count.next = counters_q.hits;
    to_regs.SKIPPED_RECTANGLE.count.next = counters_q.skipped_rectangle;
    to_regs.SKIPPED_ROOTLESS.count.next = counters_q.skipped_rootless;
    to_regs.SKIPPED_DEPTH.count.next = counters_q.skipped_depth;
    to_regs.SKIPPED_BOXES.count.next = counters_q.skipped_boxes;
    to_regs.SKIPPED_CELLS.count.next = counters_q.skipped_cells;
    to_regs.SKIPPED_EARLY.count.next = counters_q.skipped_early;
    to_regs.VISIBLE.count.next = counters_q.visible;
    to_regs.LAYERS_LOST.count.next = counters_q.layers_lost;
    to_regs.GIVEN_UP.count.next = counters_q.given_up;
    to_regs.STALLED.count.next = counters_q.stalled;
    to_regs.FRAMES.count.incr = done_i;
    to_regs.DESCRIPTORS = '{
        rd_ack: table_ack_i && !table_we_q,
        rd_data: table_data_i,
        wr_ack: table_ack_i && table_we_q
    };
    to_regs.MATERIALS = '{rd_ack: 1'b0, rd_data: '0, wr_ack: regs.MATERIALS.req};
  end

  `RDX_STREAM(a_written, axil_bvalid_o, axil_bready_i, axil_bresp_o)
  `RDX_STREAM(a_read, axil_rvalid_o, axil_rready_i, {axil_rresp_o, axil_rdata_o})

endmodule

`default_nettype wire
