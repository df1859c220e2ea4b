// SPDX-License-Identifier: Apache-2.0
// What the slots of the ring began with: a memory, addressed by a counter that turns with the ring.
//
// A slot takes Phases places, and an item is in the first of them.
//
// Formats    first_i, first_o: the packed type T.
// Timing     take_i writes first_i for the item that enters in this clock, where enter_o = 1; first_o: of the item that
//            leaves the last unit in this clock. phase_o: of the place at the first unit. filled_o: the ring has turned once
//            since the reset, so what leaves the last unit has entered it.
// Reset      the counters and filled_o.
// Model      none: which slot an item has changes no value
`default_nettype none

module rdx_slots #(
    parameter int unsigned Slots = 64,
    parameter int unsigned Phases = 1,
    parameter type T = logic,
    localparam type slot_t = logic [$clog2(Slots)-1:0]
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       take_i,
    input  wire T           first_i,
    output T                first_o,
    output logic            enter_o,
    output logic      [3:0] phase_o,
    output logic            filled_o
);

  slot_t leave_q, behind, enter_q;  // the slot that leaves the last unit, the one behind it, the one that enters
  logic [3:0] leave_phase_q, enter_phase_q;
  wire turned = leave_phase_q == 4'(Phases - 1);
  wire last = leave_q == slot_t'(Slots - 1);
  assign behind = !turned ? leave_q : last ? '0 : leave_q + 1'b1;
  always_ff @(posedge clk_i) begin
    enter_q <= leave_q;
    enter_phase_q <= leave_phase_q;
    phase_o <= enter_phase_q;
    if (!rst_ni) begin
      leave_q <= '0;
      leave_phase_q <= '0;
      filled_o <= 1'b0;
    end else begin
      leave_q <= behind;
      leave_phase_q <= turned ? '0 : leave_phase_q + 1'b1;
      if (last && turned) filled_o <= 1'b1;
    end
  end

  assign enter_o = enter_phase_q == '0;

  logic [$bits(T)-1:0] memory[Slots];
  always_ff @(posedge clk_i) begin
    first_o <= memory[behind];
    if (take_i) memory[enter_q] <= first_i;
  end

endmodule

`default_nettype wire
