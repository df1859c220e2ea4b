// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_ask.
`default_nettype none
`include "rdx_cover.svh"

module rdx_ask_cover (
    input wire logic                     clk_i,
    input wire logic                     start_i,
    input wire logic                     lanes_i,
    input wire logic                     form_i,
    input wire logic                     vector_i,
    input wire logic                     quartic_i,
    input wire logic                     loaded_i,
    input wire logic                     lanes_end_o,
    input wire logic                     form_end_o,
    input wire logic               [6:0] place_q,
    input wire rdx_pkg::row_word_t       ask_o
);
  import rdx_pkg::*;

  for (genvar k = 0; k < 3; k++) begin : gen_kind
    `RDX_COVER(asked, (lanes_i || form_i) && ask_o.kind == row_kind_e'(k))
  end
  for (genvar l = 0; l < 15; l++) begin : gen_lane
    `RDX_COVER(asked, lanes_i && ask_o.kind == RowLane && 32'(ask_o.lane) == l)
  end
  `RDX_COVER(quadric_ends, lanes_i && lanes_end_o && !vector_i && !quartic_i)
  `RDX_COVER(quartic_ends, lanes_i && lanes_end_o && !vector_i && quartic_i)
  `RDX_COVER(vector_ends, lanes_i && lanes_end_o && vector_i && loaded_i)
  `RDX_COVER(constants_follow, lanes_i && lanes_end_o && vector_i && !loaded_i)
  `RDX_COVER(constants_end, form_i && form_end_o)
  `RDX_COVER(waits, !start_i && !lanes_i && !form_i && place_q != '0)
  `RDX_COVER(begins_anew, start_i && place_q != '0)
endmodule

bind rdx_ask rdx_ask_cover u_cover (.*);

`default_nettype wire
