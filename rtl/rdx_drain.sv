// SPDX-License-Identifier: Apache-2.0
// Reads the layers of finished lines from left to right and gives them to the shading, a layer a clock.
//
// A group of pixels without any hit takes one clock. After a reset every pixel of all lines is read once, which empties it.
//
// Formats    last_group_i: number of the line's last group. layer_o: see rdx_pkg::layer_t. whole_o: layer_o stands for all pixels of
//            the group, none of which was hit.
// Timing     a group is read ahead of need. No group begins while room_i = 0; begin_o: one begins, its first layer is
//            there a clock later.
// Reset      control only; then a sweep of Groups clocks before ready_o.
// Model      model/raydix/layers.py
`default_nettype none

module rdx_drain #(
    parameter int unsigned MaxWidth = 2048,
    parameter int unsigned Pixels = 1,
    parameter int unsigned Layers = 1,
    parameter int unsigned Lines = 2,
    localparam type index_t = logic [$clog2(Lines)-1:0],
    localparam int unsigned Groups = MaxWidth / Pixels,
    localparam int unsigned GroupWidth = $clog2(Groups),
    localparam type count_t = logic [$clog2(Layers+1)-1:0]
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    output logic ready_o,  // swept
    input wire logic [GroupWidth-1:0] last_group_i,
    input wire logic [Lines-1:0] line_i,  // finished lines; index: lowest bits of the row
    input wire logic start_i,  // the next line is row 0
    output logic [Lines-1:0] free_o,  // the line has been read
    output logic read_o,
    output index_t read_row_o,
    output logic [GroupWidth-1:0] read_group_o,
    input wire count_t count_i[Pixels],
    input wire rdx_pkg::entry_t entries_i[Pixels][Layers],
    input wire logic room_i,
    output logic begin_o,
    output logic layer_valid_o,
    output rdx_pkg::layer_t layer_o,
    output logic whole_o
);
  import rdx_pkg::*;

  localparam int unsigned Ahead = 4;  // groups read and not yet given
  localparam int unsigned PixelBits = Pixels > 1 ? $clog2(Pixels) : 1;
  localparam int unsigned LayerBits = Layers > 1 ? $clog2(Layers) : 1;
  localparam type group_t = logic [Pixels*($bits(count_t)+Layers*$bits(entry_t))-1:0];

  // ---- reading ----
  logic sweep_q;
  index_t row_q;
  logic [GroupWidth-1:0] group_q;
  logic [2:0] ahead_q;  // groups asked for and not yet given
  logic popped;
  wire line_end = group_q == (sweep_q ? GroupWidth'(Groups - 1) : last_group_i);
  wire ask = sweep_q || (line_i[row_q] && ahead_q < 3'(Ahead));
  assign ready_o = !sweep_q;
  assign read_o = ask;
  assign read_row_o = row_q;
  assign read_group_o = group_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      sweep_q <= 1'b1;
      row_q   <= '0;
      group_q <= '0;
      ahead_q <= '0;
      free_o  <= '0;
    end else begin
      free_o <= '0;
      if (ask) begin
        group_q <= line_end ? '0 : group_q + 1'b1;
        if (line_end) begin
          row_q <= row_q + 1'b1;
          if (&row_q) sweep_q <= 1'b0;
          if (!sweep_q) free_o[row_q] <= 1'b1;
        end
      end
      if (start_i) row_q <= '0;
      ahead_q <= ahead_q + 3'(ask && !sweep_q) - 3'(popped);
    end
  end

  // ---- groups that were read wait here ----
  logic [2:0] arrived_q;
  logic [1:0] put_q, get_q;
  group_t waiting_q[Ahead], packed_group;
  logic ask_q, ask_qq;
  always_comb begin
    for (int unsigned p = 0; p < Pixels; p++) begin
      packed_group[p*$bits(count_t)+:$bits(count_t)] = count_i[p];
      for (int unsigned i = 0; i < Layers; i++) begin
        packed_group[Pixels*$bits(count_t)+(p*Layers+i)*$bits(entry_t)+:$bits(entry_t)] = entries_i[p][i];
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      {ask_q, ask_qq} <= '0;
      arrived_q <= '0;
      put_q <= '0;
      get_q <= '0;
    end else begin
      {ask_q, ask_qq} <= {ask && !sweep_q, ask_q};
      arrived_q <= arrived_q + 3'(ask_qq) - 3'(popped);
      if (ask_qq) put_q <= put_q + 1'b1;
      if (popped) get_q <= get_q + 1'b1;
    end
  end
  always_ff @(posedge clk_i) if (ask_qq) waiting_q[put_q] <= packed_group;

  // ---- giving: the layers of the group at the head ----
  logic busy_q;  // layers of this group have been given
  logic [PixelBits-1:0] pixel_q;
  logic [LayerBits-1:0] at_q;
  count_t counts[Pixels];
  logic empty;
  wire group_t head = waiting_q[get_q];
  always_comb begin
    empty = 1'b1;
    for (int unsigned p = 0; p < Pixels; p++) begin
      counts[p] = head[p*$bits(count_t)+:$bits(count_t)];
      if (counts[p] != '0) empty = 1'b0;
    end
  end
  wire give = arrived_q != '0 && (busy_q || room_i);
  wire [31:0] place = 32'(pixel_q) * Layers + 32'(at_q);
  wire entry_t entry = head[Pixels*$bits(count_t)+place*$bits(entry_t)+:$bits(entry_t)];
  wire none = counts[pixel_q] == '0;
  wire pixel_end = none || 32'(counts[pixel_q]) == 32'(at_q) + 1;
  assign popped  = give && (empty || (pixel_end && 32'(pixel_q) == Pixels - 1));
  assign begin_o = give && !busy_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      layer_valid_o <= 1'b0;
      pixel_q <= '0;
      at_q <= '0;
    end else begin
      layer_valid_o <= give;
      if (give) begin
        busy_q <= !popped;
        at_q   <= pixel_end ? '0 : at_q + 1'b1;
        if (popped) pixel_q <= '0;
        else if (pixel_end) pixel_q <= pixel_q + 1'b1;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    whole_o <= empty;
    layer_o <= '{
        shade: !none,
        first: at_q == '0,
        last: pixel_end,
        enters: entry.enters,
        surface: entry.surface,
        point: entry.point
    };
  end
  wire unused = &{1'b0, entry};

endmodule

`default_nettype wire
