// SPDX-License-Identifier: Apache-2.0
// The zone of a set of points: how near to the axis they come, as a power of two.
//
// The larger magnitude of x and y is a lower bound of a point's distance from the axis. Zone i > 0 is [2^(i-15),
// 2^(i-14)), zone 0 what is below; the zone of a set is the least of its points.
//
// Formats    x_i, y_i: s2p30. zone_o: 0 to Zones - 1. A negative number's magnitude is taken one ulp less.
// Timing     combinational
// Model      model/raydix/bound.py (zone_of)
`default_nettype none

module rdx_zone #(
    parameter int unsigned Count = 9,
    localparam int unsigned Z = $clog2(rdx_pkg::Zones)
) (
    input  wire rdx_pkg::coord_t         x_i   [Count],
    input  wire rdx_pkg::coord_t         y_i   [Count],
    output logic                 [Z-1:0] zone_o
);
  import rdx_pkg::*;

  localparam int unsigned Lowest = CoordFrac - Zones + 2;  // bit of the least distance of zone 1

  // at_least[i]: every point is in zone i or beyond
  logic [Zones-1:0] at_least;
  always_comb begin
    at_least = '1;
    for (int unsigned p = 0; p < Count; p++) begin
      coord_t near;
      near = (x_i[p] ^ (x_i[p] >>> (CoordWidth - 1))) | (y_i[p] ^ (y_i[p] >>> (CoordWidth - 1)));
      for (int unsigned i = 1; i < Zones; i++) if (near >> (Lowest + i - 1) == '0) at_least[i] = 1'b0;
    end
    zone_o = '0;
    for (int unsigned i = 1; i < Zones; i++) if (at_least[i]) zone_o = Z'(i);
  end

endmodule

`default_nettype wire
