// SPDX-License-Identifier: Apache-2.0
// The ends of a chosen cell: the segment's ends halved towards it, a binary digit of its number a clock.
//
// Formats    ends_i, ends_o: s2p30 and s1p31. pick_i: number of the cell.
// Rounding   half up in each average.    Overflow   cannot happen: an average lies between its inputs.
// Timing     latency N1 clocks, one segment a clock; no reset, no stall.
// Model      model/raydix/carry.py
`default_nettype none

module rdx_descend #(
    parameter int unsigned N1 = 3
) (
    input  wire logic                    clk_i,
    input  wire rdx_pkg::ends_t          ends_i,
    input  wire logic           [N1-1:0] pick_i,
    output rdx_pkg::ends_t               ends_o
);
  import rdx_pkg::*;

  function automatic coord_t average(coord_t a, coord_t b);
    return coord_t'(((CoordWidth + 1)'(a) + (CoordWidth + 1)'(b) + (CoordWidth + 1)'(1)) >>> 1);
  endfunction

  // the half of the segment that a digit names
  function automatic ends_t half(ends_t ends, logic upper);
    ends_t  result;
    coord_t middle;
    result = ends;
    for (int unsigned axis = 0; axis < 3; axis++) begin
      middle = average(ends.start[axis], ends.stop[axis]);
      if (upper) result.start[axis] = middle;
      else result.stop[axis] = middle;
    end
    middle = average(ends.depth_start, ends.depth_stop);
    if (upper) result.depth_start = middle;
    else result.depth_stop = middle;
    return result;
  endfunction

  ends_t ends_q[N1];
  logic [N1-1:0] pick_q[N1];  // the digits that are left, the next one on top
  always_ff @(posedge clk_i) begin
    ends_q[0] <= half(ends_i, pick_i[N1-1]);
    pick_q[0] <= pick_i << 1;
    for (int unsigned i = 1; i < N1; i++) begin
      ends_q[i] <= half(ends_q[i-1], pick_q[i-1][N1-1]);
      pick_q[i] <= pick_q[i-1] << 1;
    end
  end
  assign ends_o = ends_q[N1-1];
  wire unused = &{1'b0, pick_q[N1-1]};

endmodule

`default_nettype wire
