// SPDX-License-Identifier: Apache-2.0
// One constant of the materials: a word for each surface, in two banks.
//
// Formats    write_i: a write to any constant; only those to number Index are taken, the low W bits of their data.
//            material_i, data_o: which word is read, and it. Of the surface's number the low bits
//            count that Surfaces needs.
// Timing     latency 2 clocks, one word a clock; no reset. A word that is written while
//            it is read comes out as it was or as it will be.
// Model      none: model/raydix/material.py makes the words
`default_nettype none

module rdx_constant #(
    parameter int unsigned Surfaces = 64,
    parameter int unsigned W = 18,
    parameter int unsigned Index = 0
) (
    input  wire logic                             clk_i,
    input  wire rdx_pkg::material_write_t         write_i,
    input  wire rdx_pkg::material_t               material_i,
    output logic                          [W-1:0] data_o
);

  if (Surfaces < 1 || Surfaces > 1 << rdx_pkg::SurfaceWidth) begin : gen_illegal_surfaces
    $fatal(1, "rdx_constant: Surfaces = %0d; allowed: 1 to %0d", Surfaces, 1 << rdx_pkg::SurfaceWidth);
  end
  if (Index >= rdx_pkg::MaterialWords) begin : gen_illegal_index
    $fatal(1, "rdx_constant: Index = %0d; allowed: below %0d", Index, rdx_pkg::MaterialWords);
  end
  localparam int unsigned Bits = $clog2(Surfaces) + 1;
  localparam type place_t = logic [Bits-1:0];

  wire place_t write = place_t'({write_i.material.surface, write_i.material.bank});
  wire place_t read = place_t'({material_i.surface, material_i.bank});
  wire mine = write_i.we && write_i.constant == rdx_pkg::constant_t'(Index);

  logic [W-1:0] read_q;
  if (Surfaces == 1) begin : gen_registers
    logic [W-1:0] first_q, second_q;
    always_ff @(posedge clk_i) begin
      if (mine && write == 0) first_q <= write_i.data[W-1:0];
      if (mine && write == 1) second_q <= write_i.data[W-1:0];
      read_q <= read == 0 ? first_q : second_q;
    end
  end else begin : gen_memory
    logic [W-1:0] memory[1<<Bits];
    always_ff @(posedge clk_i) begin
      if (mine) memory[write] <= write_i.data[W-1:0];
      read_q <= memory[read];
    end
  end
  always_ff @(posedge clk_i) data_o <= read_q;
  wire unused = &{1'b0, write_i, material_i};

endmodule

`default_nettype wire
