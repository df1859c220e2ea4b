// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_csr.
`default_nettype none
`include "rdx_cover.svh"

module rdx_csr_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       axil_awvalid_i,
    input wire logic       axil_awready_o,
    input wire logic       axil_wvalid_i,
    input wire logic       axil_wready_o,
    input wire logic [3:0] axil_wstrb_i,
    input wire logic       axil_bvalid_o,
    input wire logic       axil_bready_i,
    input wire logic [1:0] axil_bresp_o,
    input wire logic       axil_arvalid_i,
    input wire logic       axil_arready_o,
    input wire logic       axil_rvalid_o,
    input wire logic       axil_rready_i,
    input wire logic [1:0] axil_rresp_o,
    input wire logic       start_valid_o,
    input wire logic       abort_o,
    input wire logic       done_i,
    input wire logic       error_valid_i,
    input wire logic       irq_o,
    input wire logic       table_req_o,
    input wire logic       table_we_o,
    input wire logic       material_we_o
);
  `RDX_COVER_RUN(address_first, axil_awvalid_i && axil_awready_o && !axil_wvalid_i)
  `RDX_COVER_RUN(data_first, axil_wvalid_i && axil_wready_o && !axil_awvalid_i)
  `RDX_COVER_RUN(write_and_read, axil_awvalid_i && axil_arvalid_i)
  `RDX_COVER_RUN(part_of_a_word, axil_wvalid_i && axil_wready_o && axil_wstrb_i != '1)
  `RDX_COVER_RUN(write_answer_waits, axil_bvalid_o && !axil_bready_i)
  `RDX_COVER_RUN(read_answer_waits, axil_rvalid_o && !axil_rready_i)
  `RDX_COVER_RUN(write_waits, axil_wvalid_i && !axil_wready_o)
  `RDX_COVER_RUN(read_waits, axil_arvalid_i && !axil_arready_o)
  `RDX_COVER_RUN(write_refused, axil_bvalid_o && axil_bresp_o == 2'd2)
  `RDX_COVER_RUN(read_refused, axil_rvalid_o && axil_rresp_o == 2'd2)
  `RDX_COVER_RUN(start, start_valid_o)
  `RDX_COVER_RUN(abort_while_queued, abort_o && start_valid_o)
  `RDX_COVER_RUN(done, done_i)
  `RDX_COVER_RUN(error, error_valid_i)
  `RDX_COVER_RUN(interrupt, irq_o)
  `RDX_COVER_RUN(descriptor_read, table_req_o && !table_we_o)
  `RDX_COVER_RUN(descriptor_write, table_req_o && table_we_o)
  `RDX_COVER_RUN(material, material_we_o)
endmodule

bind rdx_csr rdx_csr_cover u_cover (.*);

`default_nettype wire
