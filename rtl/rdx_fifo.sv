// SPDX-License-Identifier: Apache-2.0
// A queue in a memory. What is at its head stands in a register.
//
// Formats    data_i, data_o: W bits.
// Timing     one word in and one out a clock; an entry is at the head two clocks after it came, at the earliest, three with
//            Depth > 16 (block RAM, which has a register of its own). ready_o depends on registers only, valid_o on neither input.
// Reset      pointers and valid.
// Model      none: it changes no value
`default_nettype none
`include "rdx_assert.svh"

module rdx_fifo #(
    parameter int unsigned W = 32,
    parameter int unsigned Depth = 16  // a power of two
) (
    input  wire logic         clk_i,
    input  wire logic         rst_ni,
    input  wire logic         valid_i,
    output logic              ready_o,
    input  wire logic [W-1:0] data_i,
    output logic              valid_o,
    input  wire logic         ready_i,
    output logic      [W-1:0] data_o
);

  localparam int unsigned Bits = $clog2(Depth);
  if (Depth < 2 || Depth != 1 << Bits) begin : gen_illegal_depth
    $fatal(1, "rdx_fifo: Depth = %0d; allowed: a power of two, 2 or more", Depth);
  end

  logic [Bits:0] write_place_q, read_place_q;
  wire filled = write_place_q != read_place_q;
  wire advance = !valid_o || ready_i;
  wire store = valid_i && ready_o;
  logic fetch, next_valid;
  logic [W-1:0] next;
  assign ready_o = (Bits + 1)'(write_place_q - read_place_q) != (Bits + 1)'(Depth);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      write_place_q <= '0;
      read_place_q <= '0;
      valid_o <= 1'b0;
    end else begin
      if (store) write_place_q <= write_place_q + 1'b1;
      if (fetch) read_place_q <= read_place_q + 1'b1;
      if (advance) valid_o <= next_valid;
    end
  end
  always_ff @(posedge clk_i) if (advance && next_valid) data_o <= next;

  // ---- the memory: a place is read only where it was written before ----
  if (Depth > 16) begin : gen_block
    (* ram_style = "block", no_rw_check *)
    logic [W-1:0] memory[Depth];
    logic [W-1:0] read_q;
    logic read_valid_q;  // read_q holds the next entry
    assign fetch = filled && (!read_valid_q || advance);
    assign next_valid = read_valid_q;
    assign next = read_q;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) read_valid_q <= 1'b0;
      else if (fetch) read_valid_q <= 1'b1;
      else if (advance) read_valid_q <= 1'b0;
    end
    always_ff @(posedge clk_i) begin
      if (store) memory[write_place_q[Bits-1:0]] <= data_i;
      if (fetch) read_q <= memory[read_place_q[Bits-1:0]];
    end
  end else begin : gen_distributed
    (* no_rw_check *)
    logic [W-1:0] memory[Depth];
    always_ff @(posedge clk_i) if (store) memory[write_place_q[Bits-1:0]] <= data_i;
    assign fetch = filled && advance;
    assign next_valid = filled;
    assign next = memory[read_place_q[Bits-1:0]];
  end

  `RDX_STREAM(a_out, valid_o, ready_i, data_o)

endmodule

`default_nettype wire
