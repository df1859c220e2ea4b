// SPDX-License-Identifier: Apache-2.0
// rdx_slots: what an item began with comes back when it leaves the last unit, turn after turn, until the slot is given anew.
//
// One slot of all, any, is watched. It is at the wrap every Slots*Phases clocks; what is written there is the first thing of
// the item that enters, and what is read when it leaves.
`default_nettype none
`include "formal.svh"

module formal_slots #(
    parameter int unsigned Slots = 5,
    parameter int unsigned Phases = 2,
    parameter int unsigned W = 4
) (
    input wire logic         clk_i,
    input wire logic         rst_ni,
    input wire logic         take_i,
    input wire logic [W-1:0] origin_i,
    input wire logic [W-1:0] segment_i
);

  localparam int unsigned Turn = Slots * Phases;
  logic [W-1:0] origin, segment;
  logic [3:0] phase;
  logic next, filled;
  rdx_slots #(
      .Slots(Slots),
      .Phases(Phases),
      .O(logic [W-1:0]),
      .S(logic [W-1:0])
  ) u_slots (
      .clk_i,
      .rst_ni,
      .take_i,
      .origin_i,
      .segment_i,
      .origin_o(origin),
      .segment_o(segment),
      .next_o(next),
      .phase_o(phase),
      .filled_o(filled)
  );

  `RESET_FIRST
  `GIVEN(g_no_reset, !began_q || rst_ni)
  logic enter_q;  // the place that enters is the first of its slot
  always_ff @(posedge clk_i) enter_q <= next;
  `GIVEN(g_enter, !take_i || (enter_q && filled))

  // ---- the watched item: written once at its entry, kept since ----
  logic watch;  // anything: the driver leaves what nothing drives free
  logic held_q = 1'b0;
  logic [W-1:0] origin_q, segment_q;
  logic [7:0] age_q = '0;  // clocks since the entry, within a turn
  wire begins = take_i && watch && !held_q && rst_ni;
  // it enters in clock 0, is at the first unit in clock 1, and leaves the last unit a turn less two clocks after its entry
  wire leaves = held_q && age_q == 8'(Turn - 2);
  wire left = held_q && age_q == 8'(Turn - 1);
  wire at_entry = held_q && age_q == 8'(0);
  `GIVEN(g_kept, !(take_i && at_entry))  // while the item is there its place is not free
  always_ff @(posedge clk_i) begin
    if (begins) begin
      held_q <= 1'b1;
      {origin_q, segment_q} <= {origin_i, segment_i};
    end
    if (begins) age_q <= 8'd1;
    else if (held_q) age_q <= age_q == 8'(Turn - 1) ? '0 : age_q + 1'b1;
  end

  `CHECK(p_origin, !leaves || origin == origin_q)
  `CHECK(p_segment, !left || segment == segment_q)
  `CHECK(p_enter, !at_entry || enter_q)
  `CHECK(p_phase, !(held_q && age_q == 8'd1) || phase == '0)
  `REACH(r_turns, leaves && origin != origin_i)

endmodule

`default_nettype wire
