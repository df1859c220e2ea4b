// SPDX-License-Identifier: Apache-2.0
// rdx_csr with a table that keeps to its interface: it acknowledges each request, once, a clock later or more.
//
// The stream rules are those that rdx_csr and rdx_check state themselves.
`default_nettype none
`include "formal.svh"

module formal_csr
  import rdx_pkg::*;
(
    input wire logic             clk_i,
    input wire logic             rst_ni,
    input wire logic             axil_awvalid_i,
    input wire logic      [17:0] axil_awaddr_i,
    input wire logic             axil_wvalid_i,
    input wire logic      [31:0] axil_wdata_i,
    input wire logic      [ 3:0] axil_wstrb_i,
    input wire logic             axil_bready_i,
    input wire logic             axil_arvalid_i,
    input wire logic      [17:0] axil_araddr_i,
    input wire logic             axil_rready_i,
    input wire logic             start_ready_i,
    input wire logic             busy_i,
    input wire logic             done_i,
    input wire counters_t        counters_i,
    input wire logic             error_valid_i,
    input wire error_e           error_code_i,
    input wire surface_t         error_slot_i,
    input wire logic             table_ack_i,
    input wire logic      [31:0] table_data_i
);

  logic axil_awready_o, axil_wready_o, axil_bvalid_o, axil_arready_o, axil_rvalid_o;
  logic [1:0] axil_bresp_o, axil_rresp_o;
  logic [31:0] axil_rdata_o, table_data_o, material_data_o;
  logic start_valid_o, abort_o, irq_o, table_req_o, table_we_o, material_we_o;
  frame_t frame_o;
  logic [13:0] table_addr_o;
  logic [3:0] table_strobe_o;
  surface_t material_surface_o;
  logic [5:0] material_constant_o;
  rdx_csr u_csr (.*);

  `RESET_FIRST
  `GIVEN(g_no_reset, !began_q || rst_ni)
  logic waiting_q = 1'b0;
  always_ff @(posedge clk_i) waiting_q <= rst_ni && (table_req_o || (waiting_q && !table_ack_i));
  `GIVEN(g_answer, !table_ack_i || waiting_q)
  `CHECK(p_one, !(rst_ni && table_req_o && waiting_q && !table_ack_i))  // no second request before the answer
  `REACH(r_answer, rst_ni && table_ack_i)

endmodule

`default_nettype wire
