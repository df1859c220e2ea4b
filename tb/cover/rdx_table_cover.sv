// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_table.
`default_nettype none
`include "rdx_cover.svh"

module rdx_table_cover (
    input wire logic       clk_i,
    input wire logic       rst_ni,
    input wire logic       swap_i,
    input wire logic       read_i,
    input wire logic       host_req_i,
    input wire logic       host_we_i,
    input wire logic [3:0] host_strobe_i,
    input wire logic       host_ack_o,
    input wire logic       bank_q
);
  for (genvar b = 0; b < 2; b++) begin : gen_bank
    `RDX_COVER_RUN(read, bank_q == 1'(b) && read_i)
    `RDX_COVER_RUN(host_read, bank_q == 1'(b) && host_req_i && !host_we_i)
    `RDX_COVER_RUN(host_write, bank_q == 1'(b) && host_req_i && host_we_i)
    `RDX_COVER_RUN(all_at_once, bank_q == 1'(b) && read_i && host_req_i && swap_i)
  end
  for (genvar k = 0; k < 4; k++) begin : gen_byte
    `RDX_COVER_RUN(left_out, host_req_i && host_we_i && !host_strobe_i[k])
  end
  `RDX_COVER_RUN(answer_after_exchange, swap_i && host_ack_o)
  `RDX_COVER_RUN(host_every_clock, host_ack_o && host_req_i)
endmodule

bind rdx_table rdx_table_cover u_cover (.*);

`default_nettype wire
