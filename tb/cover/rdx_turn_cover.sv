// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_turn.
`default_nettype none
`include "rdx_cover.svh"

module rdx_turn_cover #(
    parameter bit General = 1'b0,
    localparam int unsigned Turns = General ? 2 : 1,
    localparam type number_t = logic signed [15:0]
) (
    input wire logic                  clk_i,
    input wire logic                  en_i,
    input wire rdx_pkg::form_t        form_i,
    input wire logic           [27:0] azimuth_q[5],
    input wire number_t               first,
    input wire number_t               last
);
  for (genvar i = 0; i < Turns; i++) begin : gen_turn
    wire number_t wanted = first + number_t'(i);
    `RDX_COVER(before_start, last >= 0 && wanted < 0)
    `RDX_COVER(at_start, last > 0 && wanted == 0)
    `RDX_COVER(between, last > 1 && wanted > 0 && wanted < last)
    `RDX_COVER(at_end, last > 0 && wanted == last)
    `RDX_COVER(beyond_end, last >= 0 && wanted > last)
  end
  `RDX_COVER(none, last < 0)
  `RDX_COVER(one, last == 0)
  for (genvar q = 0; q < 4; q++) begin : gen_quadrant
    `RDX_COVER(azimuth, azimuth_q[4][27:26] == 2'(q))
  end
  `RDX_COVER(wrap_up, en_i && &azimuth_q[0][27:26] && azimuth_q[1][27:26] == '0)
  `RDX_COVER(wrap_down, en_i && azimuth_q[0][27:26] == '0 && &azimuth_q[1][27:26])
  if (General) begin : gen_general
    for (genvar s = 0; s < 2; s++) begin : gen_way
      `RDX_COVER(shifted, form_i.skew_back == s && form_i.skew_offset != '0)
    end
  end
  `RDX_COVER(stalled, !en_i)
endmodule

bind rdx_turn rdx_turn_cover #(.General(General)) u_cover (.*);

`default_nettype wire
