// SPDX-License-Identifier: Apache-2.0
// A hit takes its place among the layers of a pixel.
//
// The order is that of depth, of equal depth that of the surface numbers, of one surface that in which hits come. What is behind
// an opaque hit is dropped. Of more than Layers the farthest is dropped, too, and that is told.
//
// Formats    count_i, entries_i: the layers so far, nearest first; those from count_i on mean nothing. count_o, entries_o:
//            with the hit.
// Timing     combinational
// Model      model/raydix/layers.py
`default_nettype none

module rdx_insert #(
    parameter int unsigned Layers = 1,
    localparam type count_t = logic [$clog2(Layers+1)-1:0]
) (
    input  wire count_t          count_i,
    input  wire rdx_pkg::entry_t entries_i[Layers],
    input  wire rdx_pkg::entry_t hit_i,
    output count_t               count_o,
    output rdx_pkg::entry_t      entries_o[Layers],
    output logic                 lost_o              // there was no room for one that would have been seen
);
  import rdx_pkg::*;

  logic [Layers-1:0] there, ahead;  // an entry; it stays in front of the hit
  logic hidden;  // the hit is behind an opaque one
  always_comb begin
    hidden = 1'b0;
    for (int unsigned i = 0; i < Layers; i++) begin
      there[i] = 32'(count_i) > i;
      ahead[i] = there[i] && (entries_i[i].depth < hit_i.depth ||
          (entries_i[i].depth == hit_i.depth && entries_i[i].surface <= hit_i.surface));
      if (ahead[i] && entries_i[i].opaque) hidden = 1'b1;
    end
  end

  always_comb begin
    count_o = '0;
    for (int unsigned i = 0; i < Layers; i++) begin
      entries_o[i] = entries_i[i];
      if (hidden ? there[i] : ahead[i]) count_o = count_t'(i + 1);
      if (!hidden && !ahead[i]) begin
        if (i == 0 || ahead[i-1]) begin
          entries_o[i] = hit_i;
          count_o = count_t'(i + 1);
        end else if (!hit_i.opaque) begin
          entries_o[i] = entries_i[i-1];
          if (there[i-1]) count_o = count_t'(i + 1);
        end
      end
    end
    lost_o = !hidden && (ahead[Layers-1] || there[Layers-1] && !hit_i.opaque);
  end

endmodule

`default_nettype wire
