// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_slots.
`default_nettype none
`include "rdx_cover.svh"

module rdx_slots_cover #(
    parameter int unsigned Slots = 64,
    parameter int unsigned Phases = 1,
    localparam type slot_t = logic [$clog2(Slots)-1:0]
) (
    input wire logic        clk_i,
    input wire logic        rst_ni,
    input wire logic        take_i,
    input wire logic        next_o,
    input wire logic        filled_o,
    input wire slot_t       enter_q,
    input wire slot_t       leave_q,
    input wire logic  [3:0] leave_phase_q
);
  for (genvar p = 0; p < Phases; p++) begin : gen_phase
    `RDX_COVER_RUN(phase, 32'(leave_phase_q) == p)
  end
  `RDX_COVER_RUN(first_turn, !filled_o)
  `RDX_COVER_RUN(takes_in_first_slot, take_i && enter_q == '0)
  `RDX_COVER_RUN(takes_in_last_slot, take_i && 32'(enter_q) == Slots - 1)
  `RDX_COVER_RUN(turns, filled_o && leave_q == '0)
  `RDX_COVER_RUN(slot_not_taken, filled_o && next_o && !take_i)
  if (Phases > 1) begin : gen_bubble
    `RDX_COVER_RUN(bubble, !next_o)
  end
endmodule

bind rdx_slots rdx_slots_cover #(
    .Slots (Slots),
    .Phases(Phases)
) u_cover (.*);

`default_nettype wire
