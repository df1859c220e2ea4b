// SPDX-License-Identifier: Apache-2.0
// What the slots of the ring began with: two memories, addressed by a counter that turns with the ring.
//
// A slot takes Phases places, and an item is in the first of them. The wrap has three places: the one that leaves, the next, the
// one that enters.
//
// Formats    origin_i, origin_o: the packed type O; segment_i, segment_o: the packed type S.
// Timing     take_i writes both for the item that enters in this clock. origin_o: of the item that leaves the last unit in this
//            clock; segment_o: of the one that left it a clock ago. next_o: the place that enters in the next clock is the first of
//            its slot. phase_o: of the place at the first unit. filled_o: the ring has turned once since the reset, so what
//            leaves the last unit has entered it.
// Reset      the counter, the phases and filled_o.
// Model      none: which slot an item has changes no value
`default_nettype none

module rdx_slots #(
    parameter int unsigned Slots = 64,
    parameter int unsigned Phases = 1,
    parameter type O = logic,
    parameter type S = logic,
    localparam type slot_t = logic [$clog2(Slots)-1:0]
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       take_i,
    input  wire O           origin_i,
    input  wire S           segment_i,
    output O                origin_o,
    output S                segment_o,
    output logic            next_o,
    output logic      [3:0] phase_o,
    output logic            filled_o
);

  slot_t leave_q, behind, next_q, enter_q;  // the slot that leaves the last unit, the one behind it, those at the wrap
  logic [3:0] leave_phase_q, next_phase_q, enter_phase_q;
  wire turned = leave_phase_q == 4'(Phases - 1);
  wire last = leave_q == slot_t'(Slots - 1);
  assign behind = !turned ? leave_q : last ? '0 : leave_q + 1'b1;
  always_ff @(posedge clk_i) begin
    {enter_q, next_q} <= {next_q, leave_q};
    if (!rst_ni) begin
      leave_q <= '0;
      {phase_o, enter_phase_q, next_phase_q, leave_phase_q} <= '0;
      filled_o <= 1'b0;
    end else begin
      leave_q <= behind;
      {phase_o, enter_phase_q, next_phase_q} <= {enter_phase_q, next_phase_q, leave_phase_q};
      leave_phase_q <= turned ? '0 : leave_phase_q + 1'b1;
      if (last && turned) filled_o <= 1'b1;
    end
  end

  assign next_o = next_phase_q == '0;

  logic [$bits(O)-1:0] origins [Slots];
  (* ram_style = "block", no_rw_check *)
  // what is read in the clock in which it is written does not count
  logic [$bits(S)-1:0] segments[Slots];
  always_ff @(posedge clk_i) begin
    origin_o  <= origins[behind];
    segment_o <= segments[leave_q];
    if (take_i) begin
      origins[enter_q]  <= origin_i;
      segments[enter_q] <= segment_i;
    end
  end

endmodule

`default_nettype wire
