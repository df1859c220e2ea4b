// SPDX-License-Identifier: Apache-2.0
// Constants and types of rdx_swirl and its parts; docs/number-formats.md explains the formats.
`default_nettype none

package rdx_swirl_pkg;

  `include "rdx_swirl.svh"

  // Lengths, coordinates, azimuth and place in turns, slopes (s3p25).
  localparam int unsigned SwirlCoordWidth = 2 + SwirlFrac;
  localparam int unsigned SlopeWidth = 28;
  typedef logic signed [SwirlWidth-1:0] swirl_t;
  typedef logic signed [SwirlCoordWidth-1:0] swirl_coord_t;
  typedef logic [SwirlFrac-1:0] azimuth_t;
  typedef logic signed [SlopeWidth-1:0] slope_t;
  typedef swirl_turns_t place_t;
  typedef swirl_pitch_t swirl_growth_t;

  // Latencies of the parts of rdx_swirl, and when its stages begin, after the point.
  localparam int unsigned SwirlSideLatency = 3;
  localparam int unsigned SwirlTurnLatency = 6;
  localparam int unsigned SwirlLegsLatency = 6;
  localparam int unsigned SwirlSlopeLatency = 3;
  localparam int unsigned SwirlEndLatency = 13;
  localparam int unsigned SwirlGradientLatency = 8;
  localparam int unsigned SwirlSide = SwirlIterations;
  localparam int unsigned SwirlLegs = SwirlIterations + 1 + SwirlTurnLatency;
  localparam int unsigned SwirlSlope = SwirlLegs + SwirlLegsLatency;
  localparam int unsigned SwirlChoice = SwirlLegs + SwirlEndLatency + 1;
  localparam int unsigned SwirlLatency = SwirlChoice + SwirlGradientLatency;

endpackage

`default_nettype wire
