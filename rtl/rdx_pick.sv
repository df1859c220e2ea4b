// SPDX-License-Identifier: Apache-2.0
// Enters the choice of a step into the item's control part: the number of the chosen cell becomes the next digits of t.
//
// The second candidate is remembered as t_next. The digits of t_min are followed on while the first cell allowed is chosen.
//
// Formats    control_*: RDX_CONTROL_T; first_i: first cell allowed; pick_i, next_i: the first two candidates, valid where
//            found_i, more_i. The control part of an item that is not Run passes unchanged.
// Timing     combinational
// Model      model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_pick #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    localparam type control_t = `RDX_CONTROL_T(N1 * K)
) (
    input  wire control_t          control_i,
    input  wire logic     [N1-1:0] first_i,
    input  wire logic              found_i,
    input  wire logic              more_i,
    input  wire logic     [N1-1:0] pick_i,
    input  wire logic     [N1-1:0] next_i,
    output control_t               control_o
);
  import rdx_pkg::*;

  always_comb begin
    control_o = control_i;
    if (control_i.status == Run) begin
      control_o.steps = control_i.steps + 1'b1;
      if (found_i) begin
        control_o.follow = control_i.follow && pick_i == first_i;
        if (more_i) begin
          control_o.pending = 1'b1;
          control_o.t_next  = control_i.t;
        end
        for (int unsigned k = 0; k < K; k++) begin
          if (control_i.level == 5'(k)) begin
            control_o.t[N1*(K-1-k)+:N1] = pick_i;
            if (more_i) control_o.t_next[N1*(K-1-k)+:N1] = next_i;
          end
        end
      end
    end
  end

endmodule

`default_nettype wire
