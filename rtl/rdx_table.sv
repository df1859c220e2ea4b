// SPDX-License-Identifier: Apache-2.0
// The descriptors of frames in two banks: one is read while the host writes the other, for the next frame.
//
// A bank has Slots descriptors of 128 words, 64 bits each, in two memories of 32 bits. Each memory has one port to write and
// one to read; the reader has those of the bank in use, the host those of the other.
//
// Formats    host_addr_i: {slot, word, half}, half 0 the low one; host_strobe_i: bytes, [0] the lowest; data_o: a word.
// Timing     latency 1 clock for both. data_o: of the last clock with read_i = 1; it stays until an exchange. host_ack_o: in
//            the clock after host_req_i, with host_data_o if it was no write. The bank is that of the clock of the request;
//            swap_i exchanges the banks from the next clock on.
//            A slot that is not built: the host writes nothing and reads 0; the reader's data have no meaning.
// Reset      the banks' order and host_ack_o; not the memories.
// Model      none: it changes no value
`default_nettype none

module rdx_table #(
    parameter int unsigned Slots = 64
) (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        swap_i,
    input  wire logic        read_i,
    input  wire logic [ 5:0] slot_i,
    input  wire logic [ 6:0] word_i,
    output logic      [63:0] data_o,
    input  wire logic        host_req_i,
    input  wire logic        host_we_i,
    input  wire logic [13:0] host_addr_i,
    input  wire logic [31:0] host_data_i,
    input  wire logic [ 3:0] host_strobe_i,
    output logic             host_ack_o,
    output logic      [31:0] host_data_o
);

  if (Slots < 1 || Slots > 64) begin : gen_illegal_slots
    $fatal(1, "rdx_table: Slots = %0d; allowed: 1 to 64", Slots);
  end
  localparam int unsigned Words = Slots * 128;
  localparam type place_t = logic [$clog2(Words)-1:0];

  logic bank_q;  // the one in use
  always_ff @(posedge clk_i) begin
    if (!rst_ni) bank_q <= 1'b0;
    else if (swap_i) bank_q <= !bank_q;
  end

  wire half = host_addr_i[0];
  wire built = 32'(host_addr_i[13:8]) < Slots;
  wire place_t host_place = place_t'(host_addr_i[13:1]);
  wire place_t reader_place = place_t'({slot_i, word_i});

  logic [1:0][63:0] words;  // of the banks
  for (genvar b = 0; b < 2; b++) begin : gen_bank
    wire in_use = bank_q == 1'(b);
    wire place_t place = in_use ? reader_place : host_place;
    for (genvar h = 0; h < 2; h++) begin : gen_half
      wire write = !in_use && host_req_i && host_we_i && built && half == 1'(h);
      wire read = in_use ? read_i : host_req_i && !host_we_i;
      logic [31:0] memory[Words];
      logic [31:0] word_q;
      always_ff @(posedge clk_i) begin
        for (int unsigned k = 0; k < 4; k++) begin
          if (write && host_strobe_i[k]) memory[host_place][8*k+:8] <= host_data_i[8*k+:8];
        end
        if (read) word_q <= memory[place];
      end
      assign words[b][32*h+:32] = word_q;
    end
  end

  logic reader_bank_q, host_bank_q, host_half_q, host_built_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) host_ack_o <= 1'b0;
    else host_ack_o <= host_req_i;
  end
  always_ff @(posedge clk_i) begin
    if (read_i) reader_bank_q <= bank_q;
    host_bank_q  <= !bank_q;
    host_half_q  <= half;
    host_built_q <= built;
  end
  assign data_o = words[reader_bank_q];
  assign host_data_o = host_built_q ? words[host_bank_q][32*host_half_q+:32] : '0;

endmodule

`default_nettype wire
