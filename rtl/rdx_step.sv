// SPDX-License-Identifier: Apache-2.0
// One step of the descent: subdivides the cell, chooses, and fixes the next N1 binary digits of t.
//
// Formats    control_*, segment_*: the item, RDX_CONTROL_T and RDX_SEGMENT_T of rdx_types.svh; ends s2p30 and s1p31,
//            control points sWp0, digits u0p<N1*K>. A Run item comes back as Run (digits left), Hit (the ends have met in the hit
//            point), Again (no root, a cell pending; depth_start of this one or its middle) or Done; others pass, so do a Hit's ends.
// Rounding   half up in each average; normalising is exact.    Overflow   cannot happen (rdx_halve, rdx_scale).
// Timing     latency rdx_pkg::step_latency clocks, one item a clock; no stall.
//            D = 1: one item every ceil((J-1)/Lanes) clocks, where phase_i = 0
// Reset      of waiting lines' places only: the status of an item comes from the ring.
// Error      docs/method.md, "Rounding"; D = 1: docs/spirals.md, "Error of the evaluator"
// Model      model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_step #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    localparam int unsigned N = N1 * K,
    localparam type control_t = `RDX_CONTROL_T(N),
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire logic            [3:0] phase_i,
    input  wire rdx_pkg::form_t        form_i,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire control_t              control_i,
    input  wire segment_t              segment_i,
    output control_t                   control_o,
    output segment_t                   segment_o
);
  import rdx_pkg::*;
  /*verilator no_inline_module*/  // U copies: compiled once, which halves the time of the build
  localparam int unsigned J = 1 << N1;
  localparam type cell_t = logic [N1-1:0];
  localparam int unsigned CellsLatency = cells_latency(N1, D, HalveStages, Lanes, VectorDrop);
  localparam int unsigned SelectLatency = select_latency(N1, Rules);
  localparam int unsigned PickLatency = pick_latency(N1, D, HalveStages);
  if (K < 1 || N > 32) begin : gen_illegal_k
    $fatal(1, "rdx_step: K = %0d; allowed: 1 to %0d (N1*K is at most 32)", K, 32 / N1);
  end
  if (W < 16 || W > 48) begin : gen_illegal_w
    $fatal(1, "rdx_step: W = %0d; allowed: 16 to 48", W);
  end
  if (D == 1 && (W != VectorWidth || HalveStages != 1)) begin : gen_illegal_d
    $fatal(1, "rdx_step: D = 1 with W = %0d, HalveStages = %0d; allowed: %0d, 1", W, HalveStages, VectorWidth);
  end
  // ---- cells: control points by halving, or the indicator at the boundaries by evaluating ----
  localparam bit Below = D > 1 && Rules == RuleCertified;  // signs are all that is needed of the cells
  logic signed [W+Below-1:0] cells[J*D+1];
  logic [J-1:0] outside, possible;
  cell_t pick, next, first;
  logic [D:0][W-1:0] b_q;
  coord_t [2:0] point;
  logic close;
  function automatic logic [N1-1:0] first_cell(logic [4:0] level, logic [N-1:0] t_min,
                                               logic follow);  // 0 unless t_min is followed
    first_cell = '0;
    for (int unsigned k = 0; k < K; k++) if (follow && level == 5'(k)) first_cell = t_min[N1*(K-1-k)+:N1];
  endfunction
  `define RDX_SEARCH(CONTROL) \
    {CONTROL.level == 5'(K - 1), CONTROL.paper, first_cell(CONTROL.level, CONTROL.t_min, CONTROL.follow)}
  `define RDX_LATE(NAME, TYPE, DEPTH, IN, OUT) \
    rdx_delay #(.T(TYPE), .Depth(DEPTH)) NAME (.clk_i, .data_i('{IN}), .data_o(OUT));
  `define RDX_HOLD(NAME, WIDTH, DEPTH, IN, OUT) \
    rdx_line #(.W(WIDTH), .Depth(DEPTH)) NAME (.clk_i, .rst_ni, .en_i(1'b1), .data_i(IN), .data_o(OUT));
  localparam type search_t = logic [N1+1:0];
  search_t search[1];  // what the choice needs of the control part, when the cells are there
  logic last, paper;
  assign {last, paper, first} = search[0];
  control_t waits;  // what enters the line of the control part
  if (D > 1) begin : gen_split
    rdx_split #(
        .N1(N1),
        .W(W),
        .D(D),
        .Clip(Clip),
        .HalveStages(HalveStages),
        .Wait(SelectLatency),
        .Below(Below)
    ) u_split (
        .clk_i,
        .rst_ni,
        .box_i(control_i.box),
        .segment_i,
        .pick_i(pick),
        .close_i(close),
        .cells_o(cells),
        .outside_o(outside),
        .b_o(b_q),
        .point_o(point),
        .ends_o(segment_o.ends)
    );
    `RDX_LATE(u_search, search_t, CellsLatency, `RDX_SEARCH(control_i), search)
    assign waits = control_i;
    assign possible = '0;
  end else begin : gen_sample
    rdx_sample #(
        .N1(N1),
        .K(K),
        .Lanes(Lanes),
        .General(General),
        .VectorDrop(VectorDrop),
        .Wait(SelectLatency)
    ) u_sample (
        .clk_i,
        .rst_ni,
        .phase_i,
        .form_i,
        .modes_i,
        .control_i,
        .segment_i,
        .pick_i(pick),
        .close_i(close),
        .control_o(waits),
        .cells_o(cells),
        .outside_o(outside),
        .possible_o(possible),
        .b_o(b_q),
        .point_o(point),
        .ends_o(segment_o.ends)
    );
    assign search[0] = `RDX_SEARCH(waits);
  end
  // ---- choice: cells before t_min and cells outside of the box are passed over ----
  logic found, more, was_found, was_more, dead_q;
  rdx_select #(
      .W(W + 32'(Below)),
      .D(D),
      .N1(N1),
      .Rules(Rules),
      .Below(Below)
  ) u_select (
      .clk_i,
      .cells_i(cells),
      .excluded_i((modes_i.boxes ? outside : '0) | ~({J{1'b1}} << first)),
      .possible_i(possible),
      .last_i(last),
      .paper_i(paper),
      .found_o(found),
      .more_o(more),
      .pick_o(pick),
      .next_o(next)
  );
  // ---- pick: the chosen cell becomes the item's, its number the next digits of t ----
  localparam type choice_t = logic [3*N1+1:0];
  choice_t choice_q[1];
  cell_t first_late[1], was_pick, was_next, was_first;
  `RDX_LATE(u_first, cell_t, SelectLatency, first, first_late)
  assign {was_found, was_more, was_pick, was_next, was_first} = choice_q[0];
  `RDX_LATE(u_choice, choice_t, PickLatency - 1, ({found, more, pick, next, first_late[0]}), choice_q)
  control_t chosen, picked_d, picked_q;
  assign close = chosen.status == Run && was_found && chosen.level == 5'(K - 1);
  `RDX_HOLD(u_control, $bits(control_t), (D > 1 ? CellsLatency : 0) + SelectLatency + PickLatency - 1, waits, chosen)
  rdx_pick #(
      .N1(N1),
      .K (K)
  ) u_pick (
      .control_i(chosen),
      .first_i  (was_first),
      .found_i  (was_found),
      .more_i   (was_more),
      .pick_i   (was_pick),
      .next_i   (was_next),
      .control_o(picked_d)
  );
  always_ff @(posedge clk_i) begin
    picked_q <= picked_d;
    dead_q   <= !was_found;
  end
  rdx_settle #(
      .N1(N1),
      .K(K),
      .W(W),
      .D(D),
      .Clip(Clip)
  ) u_settle (
      .clk_i,
      .control_i(picked_q),
      .b_i(b_q),
      .dead_i(dead_q),
      .point_i(point),
      .low_i(form_i.low),
      .high_i(form_i.high),
      .control_o,
      .b_o(segment_o.b)
  );
  wire unused = &{1'b0, modes_i, phase_i, form_i};
endmodule
`default_nettype wire
