// SPDX-License-Identifier: Apache-2.0
// One step of the descent: subdivides the cell, chooses, and fixes the next N1 binary digits of t.
//
// Formats    control_*, segment_*: the item, RDX_CONTROL_T and RDX_SEGMENT_T of rdx_types.svh; ends s2p30 and s1p31,
//            control points sWp0, digits u0p<N1*K>. A Run item comes back as Run (digits left), Hit (last digit fixed,
//            the ends have met in the hit point), Again (nothing found here, a cell is pending) or Done. The control
//            part of others passes unchanged, and so do the ends of a Hit, which are equal.
// Rounding   half up in each average; normalising is exact.    Overflow   cannot happen (rdx_halve, rdx_normalize).
// Timing     latency rdx_pkg::step_latency(N1, HalveStages, Rules) clocks, one item a clock; no stall.
//            Without reset: the status of an item comes from the ring, which resets its own.
// Error      docs/method.md, "Rounding"
// Model      model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_step #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned HalveStages = (D + 1) / 2,
    localparam int unsigned N = N1 * K,
    localparam type control_t = `RDX_CONTROL_T(N),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic     clk_i,
    input  wire control_t control_i,
    input  wire segment_t segment_i,
    output control_t      control_o,
    output segment_t      segment_o
);
  import rdx_pkg::*;
  /*verilator no_inline_module*/  // U copies: compiled once, which halves the time of the build

  localparam int unsigned J = 1 << N1;
  localparam int unsigned CellsLatency = N1 * HalveStages;
  localparam int unsigned SelectLatency = select_latency(N1, Rules);

  if (K < 1 || N > 32) begin : gen_illegal_k
    $fatal(1, "rdx_step: K = %0d; allowed: 1 to %0d (N1*K is at most 32)", K, 32 / N1);
  end
  if (W < 16 || W > 48) begin : gen_illegal_w
    $fatal(1, "rdx_step: W = %0d; allowed: 16 to 48", W);
  end

  // ---- cells: control points, and what is carried linearly, by the same averages ----
  logic signed [W-1:0] b[D+1], cells[J*D+1], cells_q[J*D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = segment_i.b[i];
  rdx_cells #(
      .W(W),
      .D(D),
      .N1(N1),
      .HalveStages(HalveStages)
  ) u_cells (
      .clk_i,
      .b_i(b),
      .cells_o(cells)
  );
  rdx_delay #(
      .T(logic signed [W-1:0]),
      .Count(J * D + 1),
      .Depth(SelectLatency)
  ) u_cells_q (
      .clk_i,
      .data_i(cells),
      .data_o(cells_q)
  );

  coord_t coords[3][J+1];
  logic [N1-1:0] pick, next;
  segment_t cell_d, cell_q;
  rdx_carry #(
      .N1(N1),
      .HalveStages(HalveStages),
      .Wait(SelectLatency)
  ) u_carry (
      .clk_i,
      .ends_i  (segment_i.ends),
      .coords_o(coords),
      .pick_i  (pick),
      .cell_o  (cell_d.ends)
  );

  control_t control[1], split[1], chosen[1];  // as it came, when the cells are there, and when the choice is
  assign control[0] = control_i;
  rdx_delay #(
      .T(control_t),
      .Depth(CellsLatency)
  ) u_split (
      .clk_i,
      .data_i(control),
      .data_o(split)
  );
  rdx_delay #(
      .T(control_t),
      .Depth(SelectLatency)
  ) u_chosen (
      .clk_i,
      .data_i(split),
      .data_o(chosen)
  );

  // ---- choice: cells before t_min and cells outside of the box are passed over ----
  // the digits of t_min at a level, 0 unless they are followed
  function automatic logic [N1-1:0] first_cell(logic [4:0] level, logic [N-1:0] t_min, logic follow);
    logic [N1-1:0] digit;
    digit = '0;
    for (int unsigned k = 0; k < K; k++) if (level == 5'(k)) digit = t_min[N1*(K-1-k)+:N1];
    return follow ? digit : '0;
  endfunction

  wire  [N1-1:0] first = first_cell(split[0].level, split[0].t_min, split[0].follow);
  wire  [N1-1:0] chosen_first = first_cell(chosen[0].level, chosen[0].t_min, chosen[0].follow);
  logic [ J-1:0] outside;
  rdx_outside #(
      .J(J)
  ) u_outside (
      .boundaries_i(coords),
      .box_i(split[0].box),
      .outside_o(outside)
  );

  logic found, more;
  rdx_select #(
      .W(W),
      .D(D),
      .N1(N1),
      .Rules(Rules)
  ) u_select (
      .clk_i,
      .cells_i(cells),
      .excluded_i(outside | ~({J{1'b1}} << first)),
      .last_i(split[0].level == 5'(K - 1)),
      .paper_i(split[0].paper),
      .found_o(found),
      .more_o(more),
      .pick_o(pick),
      .next_o(next)
  );

  // ---- pick: the chosen cell becomes the item's, its number the next digits of t ----
  control_t picked_d, picked_q;
  logic dead_q;
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) cell_d.b[i] = cells_q[32'(pick)*D+i];

    picked_d = chosen[0];
    if (chosen[0].status == Run) begin
      picked_d.steps = chosen[0].steps + 1'b1;
      if (found) begin
        picked_d.follow = chosen[0].follow && pick == chosen_first;
        if (more) begin
          picked_d.pending = 1'b1;
          picked_d.t_next  = chosen[0].t;
        end
        for (int unsigned k = 0; k < K; k++) begin
          if (chosen[0].level == 5'(k)) begin
            picked_d.t[N1*(K-1-k)+:N1] = pick;
            if (more) picked_d.t_next[N1*(K-1-k)+:N1] = next;
          end
        end
      end
    end
  end
  always_ff @(posedge clk_i) begin
    picked_q <= picked_d;
    cell_q   <= cell_d;
    dead_q   <= !found;
  end

  rdx_settle #(
      .N1(N1),
      .K (K),
      .W (W),
      .D (D)
  ) u_settle (
      .clk_i,
      .control_i(picked_q),
      .segment_i(cell_q),
      .dead_i(dead_q),
      .control_o,
      .segment_o
  );

endmodule

`default_nettype wire
