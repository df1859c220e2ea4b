// SPDX-License-Identifier: Apache-2.0
// Chooses the cell: candidate masks of the certified and the paper rule, the first candidate and the second.
//
// Certified  a cell is a candidate if its control points are mixed in sign, or possible_i (vector sums: a bound does not
//            exclude a root); at the last level if its ends differ.
// Paper      Case 2: cells whose ends differ in sign (10)(11). Case 1, no such cell: rdx_guess (8)(9).
// Both       a value is positive if above zero; excluded cells are no candidates (paper rule: in Case 2).
//
// Formats    cells_i: J*D+1 control points, sWp0, cell j at [j*D +: D+1]; with Below = 1 less by one, so that the sign tells
//            whether one is positive. Masks have bit j for cell j.
//            pick_o, next_o: numbers of the first two candidates, valid where found_o, more_o; 0 where
//            there is none.
// Timing     latency rdx_pkg::select_latency(N1, Rules) clocks, one choice a clock; no reset, no stall.
// Model      model/raydix/select.py
`default_nettype none

module rdx_select #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned N1 = 3,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Below = 1'b0,  // 1, certified rule only: values are less by one
    localparam int unsigned J = 1 << N1
) (
    input  wire logic                 clk_i,
    input  wire logic signed [ W-1:0] cells_i   [J*D+1],
    input  wire logic        [ J-1:0] excluded_i,
    input  wire logic        [ J-1:0] possible_i,
    input  wire logic                 last_i,
    input  wire logic                 paper_i,
    output logic                      found_o,
    output logic                      more_o,
    output logic             [N1-1:0] pick_o,
    output logic             [N1-1:0] next_o
);

  localparam bit HasCertified = (Rules & rdx_pkg::RuleCertified) != 0;
  localparam bit HasPaper = (Rules & rdx_pkg::RulePaper) != 0;
  if (Rules < 1 || Rules > 3) begin : gen_illegal_rules
    $fatal(1, "rdx_select: Rules = %0d; allowed: 1 certified, 2 paper, 3 both", Rules);
  end
  if (Below && HasPaper) begin : gen_illegal_below
    $fatal(1, "rdx_select: Below = 1 with Rules = %0d; allowed: 1 certified", Rules);
  end

  // First clock: signs of the control points
  logic [J*D:0] positive;
  logic [J-1:0] excluded, possible;
  logic last, paper;
  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i <= J * D; i++) positive[i] <= Below ? !cells_i[i][W-1] : cells_i[i] > 0;
    excluded <= excluded_i;
    possible <= possible_i;
    last <= last_i;
    paper <= paper_i;
  end

  // Second clock: masks
  logic [J-1:0] mixed;
  logic [J-1:0] changes;
  always_comb begin
    for (int unsigned j = 0; j < J; j++) begin
      mixed[j]   = (|positive[j*D+:D+1]) & ~(&positive[j*D+:D+1]);
      changes[j] = positive[j*D] ^ positive[(j+1)*D];
    end
  end

  wire [J-1:0] certified = (last ? changes : mixed | possible) & ~excluded;
  wire [J-1:0] crossed = changes & ~excluded;
  logic [J-1:0] mask_d, mask;

  if (!HasPaper) begin : gen_certified
    wire unused = &{1'b0, paper, crossed};
    assign mask_d = certified;
  end else begin : gen_paper
    // The guess takes its time; the masks wait for it.
    localparam int unsigned Wait = rdx_pkg::select_latency(N1, Rules) - 3;
    logic [N1-1:0] guess;
    logic signed [W-1:0] boundaries[J+1];
    for (genvar j = 0; j <= J; j++) begin : gen_boundary
      assign boundaries[j] = cells_i[j*D];
    end
    rdx_guess #(
        .W (W),
        .N1(N1)
    ) u_guess (
        .clk_i,
        .values_i(boundaries),
        .cell_o  (guess)
    );

    typedef struct packed {
      logic         guessed;  // Case 1: no sign change
      logic [J-1:0] mask;     // otherwise
    } choice_t;
    choice_t choice_d[1], choice_q[1];
    wire by_paper = paper || !HasCertified;
    assign choice_d[0] = '{guessed: by_paper && changes == '0, mask: by_paper ? crossed : certified};
    rdx_delay #(
        .T(choice_t),
        .Depth(Wait)
    ) u_wait (
        .clk_i,
        .data_i(choice_d),
        .data_o(choice_q)
    );
    assign mask_d = choice_q[0].guessed ? J'(1) << guess : choice_q[0].mask;
  end

  always_ff @(posedge clk_i) mask <= mask_d;

  // Last clock: the first two candidates
  logic found_d, more_d;
  logic [N1-1:0] pick_d, next_d;
  always_comb begin
    found_d = 1'b0;
    more_d  = 1'b0;
    pick_d  = '0;
    next_d  = '0;
    for (int unsigned j = 0; j < J; j++) begin
      if (mask[j] && !found_d) begin
        found_d = 1'b1;
        pick_d  = N1'(j);
      end else if (mask[j] && !more_d) begin
        more_d = 1'b1;
        next_d = N1'(j);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    found_o <= found_d;
    more_o  <= more_d;
    pick_o  <= pick_d;
    next_o  <= next_d;
  end

endmodule

`default_nettype wire
