// SPDX-License-Identifier: Apache-2.0
// The nearest hits of each pixel of some lines: one is filled while another is read and emptied.
//
// A hit is read with the layers of its pixel, takes its place among them (rdx_insert), and all are written back. Each line has a
// memory of its own for each pixel of a beat of the pixel stream, so a whole beat is read at once.
//
// Formats    hit_i: rdx_pkg::hit_t. Groups are Pixels neighbouring pixels. count_o, entries_o: of each pixel of the group.
//            limit_o: depth of the nearest opaque hit, valid where limit_valid_o = 1.
// Timing     a hit a clock, but one to a pixel that another of the last four clocks went to waits. last_o: a ray's last record
//            has been written, two clocks before in the layers. The group asked for by read_i is there two clocks later, and
//            becomes empty. The pixel of look_x_i has its limit in the next clock with look_i = 1.
// Reset      control only: each pixel has to be read once before its first hit.
// Model      model/raydix/layers.py
`default_nettype none
`include "rdx_assert.svh"

module rdx_layers #(
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1,
    parameter int unsigned Layers = 1,
    parameter int unsigned Lines = 2,  // 2 or 4
    parameter bit Limit = 1'b1,  // the nearest opaque hit is asked for
    localparam int unsigned Groups = MaxWidth / Pixels,
    localparam int unsigned GroupWidth = $clog2(Groups),
    localparam type index_t = logic [$clog2(Lines)-1:0],
    localparam type count_t = logic [$clog2(Layers+1)-1:0]
) (
    input  wire logic                             clk_i,
    input  wire logic                             rst_ni,
    input  wire logic            [          63:0] opaque_i,
    input  wire logic                             hit_valid_i,
    output logic                                  hit_ready_o,
    input  wire rdx_pkg::hit_t                    hit_i,
    output logic                                  last_o,
    output rdx_pkg::line_t                        last_row_o,
    output logic                                  lost_o,
    input  wire logic                             read_i,
    input  wire index_t                           read_row_i,
    input  wire logic            [GroupWidth-1:0] read_group_i,
    output count_t                                count_o      [Pixels],
    output rdx_pkg::entry_t                       entries_o    [Pixels][Layers],
    input  wire logic                             look_i,
    input  wire rdx_pkg::pixel_t                  look_x_i,
    input  wire rdx_pkg::line_t                   look_row_i,
    output logic                                  limit_valid_o,
    output rdx_pkg::depth_t                       limit_o
);
  import rdx_pkg::*;

  localparam int unsigned PixelBits = $clog2(Pixels);
  localparam int unsigned Banks = Lines * Pixels;  // bank row * Pixels + pixel
  localparam type word_t = logic [$bits(count_t)+Layers*$bits(entry_t)-1:0];
  localparam type bank_t = logic [$clog2(Banks)-1:0];
  if (Pixels != 1 << PixelBits || MaxWidth != Groups * Pixels) begin : gen_illegal
    $fatal(1, "rdx_layers: Pixels = %0d, MaxWidth = %0d; allowed: a power of two, a multiple of it", Pixels, MaxWidth);
  end

  function automatic bank_t bank_of(index_t row, pixel_t x);
    return bank_t'(32'(row) * Pixels + 32'(x) % Pixels);
  endfunction
  function automatic logic [GroupWidth-1:0] group_of(pixel_t x);
    return GroupWidth'(x >> PixelBits);
  endfunction

  // ---- a hit on its way: asked for, read, its bank picked, placed and written ----
  localparam int unsigned Stages = 4;
  localparam int unsigned Pick = 2;
  logic [Stages-1:0] valid_q;
  hit_t stage_q[Stages];
  logic hazard;
  always_comb begin
    hazard = 1'b0;
    for (int unsigned s = 0; s < Stages; s++) begin
      if (valid_q[s] && stage_q[s].hit && hit_i.hit && {stage_q[s].x, stage_q[s].y[1:0]} == {hit_i.x, hit_i.y[1:0]})
        hazard = 1'b1;
    end
  end
  assign hit_ready_o = !hazard;
  always_ff @(posedge clk_i) begin
    valid_q <= rst_ni ? {valid_q[Stages-2:0], hit_valid_i && hit_ready_o} : '0;
    stage_q[0] <= hit_i;
    for (int unsigned s = 1; s < Stages; s++) stage_q[s] <= stage_q[s-1];
  end
  wire hit_t pick_q = stage_q[Pick];
  wire hit_t write_q = stage_q[Stages-1];
  wire write_valid_q = valid_q[Stages-1];

  // ---- memories ----
  word_t words_q[Banks];
  word_t write_word_q;
  logic [GroupWidth-1:0] clear_group_q;
  logic clear_q;
  index_t clear_row_q, clear_row_qq;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) clear_q <= 1'b0;
    else clear_q <= read_i;
  end
  always_ff @(posedge clk_i) begin
    clear_row_q   <= read_row_i;
    clear_row_qq  <= clear_row_q;
    clear_group_q <= read_group_i;
  end
  for (genvar b = 0; b < Banks; b++) begin : gen_bank
    localparam index_t Row = index_t'(b / Pixels);
    wire reading = read_i && read_row_i == Row;
    wire clearing = clear_q && clear_row_q == Row;
    wire writing = write_valid_q && write_q.hit && bank_of(index_t'(write_q.y), write_q.x) == bank_t'(b);
    word_t memory[Groups], read_word_q, read_word_qq;
    assign words_q[b] = read_word_qq;
    always_ff @(posedge clk_i) begin
      read_word_q <= memory[reading?read_group_i : group_of(hit_i.x)];
      if (clearing || writing) memory[clearing?clear_group_q : group_of(write_q.x)] <= clearing ? '0 : write_word_q;
      read_word_qq <= read_word_q;
    end
    `RDX_ASSERT(a_one_writer, !(clearing && writing))
  end

  // ---- the layers with the hit ----
  count_t count, count_d;
  entry_t entries[Layers], entries_d[Layers];
  logic [Layers*$bits(entry_t)-1:0] packed_entries;
  logic lost;
  word_t chosen;
  always_ff @(posedge clk_i) chosen <= words_q[bank_of(index_t'(stage_q[Pick-1].y), stage_q[Pick-1].x)];
  always_comb begin
    count = chosen[Layers*$bits(entry_t)+:$bits(count_t)];
    for (int unsigned i = 0; i < Layers; i++) entries[i] = chosen[i*$bits(entry_t)+:$bits(entry_t)];
  end
  always_comb begin
    for (int unsigned i = 0; i < Layers; i++) packed_entries[i*$bits(entry_t)+:$bits(entry_t)] = entries_d[i];
  end
  wire entry_t hit = {opaque_i[pick_q.surface], pick_q.enters, pick_q.surface, pick_q.depth, pick_q.point};
  rdx_insert #(
      .Layers(Layers)
  ) u_insert (
      .count_i(count),
      .entries_i(entries),
      .hit_i(hit),
      .count_o(count_d),
      .entries_o(entries_d),
      .lost_o(lost)
  );
  always_ff @(posedge clk_i) begin
    write_word_q <= {count_d, packed_entries};
    lost_o <= lost && valid_q[Pick] && pick_q.hit;
  end
  assign last_o = write_valid_q && write_q.last;
  assign last_row_o = write_q.y[1:0];
  wire unused_hit = &{1'b0, pick_q, write_q, look_row_i};
  always_comb begin
    for (int unsigned p = 0; p < Pixels; p++) begin
      automatic word_t word = words_q[32'(clear_row_qq)*Pixels+p];
      count_o[p] = word[Layers*$bits(entry_t)+:$bits(count_t)];
      for (int unsigned i = 0; i < Layers; i++) entries_o[p][i] = word[i*$bits(entry_t)+:$bits(entry_t)];
    end
  end

  // ---- the nearest opaque hit ----
  if (Limit) begin : gen_limit
    typedef struct packed {
      logic   valid;
      depth_t depth;
    } limit_t;
    limit_t limits[Banks], limit_d;
    entry_t written[Layers];
    always_comb for (int unsigned i = 0; i < Layers; i++) written[i] = write_word_q[i*$bits(entry_t)+:$bits(entry_t)];
    bank_t look_q;
    always_comb begin
      limit_d = '0;
      for (int unsigned i = 0; i < Layers; i++) begin
        if (32'(write_word_q[Layers*$bits(entry_t)+:$bits(count_t)]) == i + 1)
          limit_d = '{valid: written[i].opaque, depth: written[i].depth};
      end
    end
    for (genvar b = 0; b < Banks; b++) begin : gen_bank
      localparam index_t Row = index_t'(b / Pixels);
      wire clearing = clear_q && clear_row_q == Row;
      wire writing = write_valid_q && write_q.hit && bank_of(index_t'(write_q.y), write_q.x) == bank_t'(b);
      limit_t memory[Groups], limit_q;
      assign limits[b] = limit_q;
      always_ff @(posedge clk_i) begin
        if (look_i) limit_q <= memory[group_of(look_x_i)];
        if (clearing || writing) memory[clearing?clear_group_q : group_of(write_q.x)] <= clearing ? '0 : limit_d;
      end
    end
    always_ff @(posedge clk_i) if (look_i) look_q <= bank_of(index_t'(look_row_i), look_x_i);
    assign limit_valid_o = limits[look_q].valid;
    assign limit_o = limits[look_q].depth;
  end else begin : gen_no_limit
    assign limit_valid_o = 1'b0;
    assign limit_o = '0;
    wire unused = &{1'b0, look_i, look_x_i, look_row_i};
  end

endmodule

`default_nettype wire
