// SPDX-License-Identifier: Apache-2.0
// Delays a value by a fixed number of clocks in a memory: rdx_delay for long waits.
//
// One place of the memory is written and the next one, the oldest, is read.
//
// Formats    data_i, data_o: W bits.
// Timing     latency Depth clocks in which en_i = 1, one value a clock.
// Reset      the place only; what was in the memory comes out for Depth clocks.
// Model      none: it changes no value
`default_nettype none

module rdx_line #(
    parameter int unsigned W = 32,
    parameter int unsigned Depth = 16
) (
    input  wire logic         clk_i,
    input  wire logic         rst_ni,
    input  wire logic         en_i,
    input  wire logic [W-1:0] data_i,
    output logic      [W-1:0] data_o
);

  if (Depth < 2) begin : gen_illegal_depth
    $fatal(1, "rdx_line: Depth = %0d; allowed: 2 or more", Depth);
  end
  localparam type place_t = logic [$clog2(Depth)-1:0];

  logic [W-1:0] memory[Depth];
  place_t write_q, read_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      write_q <= '0;
      read_q  <= place_t'(1);
    end else if (en_i) begin
      write_q <= read_q;
      read_q  <= read_q == place_t'(Depth - 1) ? '0 : read_q + 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      memory[write_q] <= data_i;
      data_o <= memory[read_q];
    end
  end

endmodule

`default_nettype wire
