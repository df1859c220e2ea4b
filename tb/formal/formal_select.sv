// SPDX-License-Identifier: Apache-2.0
// rdx_select with rdx_guess: the choice is that of docs/modules/select.md and docs/method.md ("A step"), written here once more.
`default_nettype none
`include "formal.svh"

module formal_select #(
    parameter int unsigned W = 3,
    parameter int unsigned D = 2,
    parameter int unsigned N1 = 2,
    parameter int unsigned Rules = 3,
    parameter bit Below = 1'b0,
    localparam int unsigned J = 1 << N1
) (
    input wire logic                clk_i,
    input wire logic signed [W-1:0] cells_i   [J*D+1],
    input wire logic        [J-1:0] excluded_i,
    input wire logic        [J-1:0] possible_i,
    input wire logic                last_i,
    input wire logic                paper_i
);

  localparam int unsigned Latency = rdx_pkg::select_latency(N1, Rules);

  logic found, more;
  logic [N1-1:0] pick, next;
  rdx_select #(
      .W(W),
      .D(D),
      .N1(N1),
      .Rules(Rules),
      .Below(Below)
  ) u_select (
      .clk_i,
      .cells_i,
      .excluded_i,
      .possible_i,
      .last_i,
      .paper_i,
      .found_o(found),
      .more_o (more),
      .pick_o (pick),
      .next_o (next)
  );

  // ---- Case 1: the boundary of least magnitude, the first of equals; of the two cells beside it the one of the smaller
  // difference, the right one of equals ----
  localparam type number_t = logic signed [W+1:0];  // magnitudes and differences, none wraps
  number_t value[J*D+1];  // with Below = 1 what comes in is less by one
  always_comb for (int i = 0; i <= J * D; i++) value[i] = number_t'(cells_i[i]) + number_t'(Below);
  number_t boundary[J+1], magnitude[J+1], difference[J];
  always_comb begin
    for (int j = 0; j <= J; j++) begin
      boundary[j]  = value[j*D];
      magnitude[j] = boundary[j] < 0 ? -boundary[j] : boundary[j];
    end
    for (int j = 0; j < J; j++) begin
      difference[j] = boundary[j+1] - boundary[j];
      if (difference[j] < 0) difference[j] = -difference[j];
    end
  end
  logic [  J:0] nearest;
  logic [J-1:0] guess;
  always_comb begin
    for (int j = 0; j <= J; j++) begin
      nearest[j] = 1'b1;
      for (int i = 0; i < j; i++) if (magnitude[i] <= magnitude[j]) nearest[j] = 1'b0;
      for (int i = j + 1; i <= J; i++) if (magnitude[i] < magnitude[j]) nearest[j] = 1'b0;
    end
  end
  for (genvar j = 0; j < J; j++) begin : gen_guess
    logic right_of, left_of;  // the boundary to the left, to the right of the cell is the nearest and prefers it
    if (j == 0) assign right_of = nearest[0];
    else assign right_of = nearest[j] && difference[j] <= difference[j-1];
    if (j == J - 1) assign left_of = nearest[J];
    else assign left_of = nearest[j+1] && difference[j] < difference[j+1];
    assign guess[j] = right_of || left_of;
  end

  logic paper, crossing;
  logic [J-1:0] crosses, holds, candidates;
  always_comb begin
    paper = Rules == 2 || (Rules == 3 && paper_i);
    for (int j = 0; j < J; j++) begin
      logic above, below;
      above = 1'b0;
      below = 1'b0;
      for (int i = 0; i <= D; i++) if (value[j*D+i] > 0) above = 1'b1;
      for (int i = 0; i <= D; i++) if (value[j*D+i] <= 0) below = 1'b1;
      holds[j]   = above && below;
      crosses[j] = (boundary[j] > 0 && boundary[j+1] <= 0) || (boundary[j] <= 0 && boundary[j+1] > 0);
    end
    crossing = crosses != '0;
    for (int j = 0; j < J; j++) begin
      if (paper && !crossing) candidates[j] = guess[j];
      else if (excluded_i[j]) candidates[j] = 1'b0;
      else if (paper || last_i) candidates[j] = crosses[j];
      else candidates[j] = holds[j] || possible_i[j];
    end
  end

  // ---- the first candidate is one, and none is before it; the second likewise behind the first ----
  logic [J-1:0] set[Latency];
  always_ff @(posedge clk_i) begin
    set[0] <= candidates;
    for (int i = 1; i < Latency; i++) set[i] <= set[i-1];
  end
  wire  [J-1:0] wanted = set[Latency-1];
  wire  [J-1:0] without = wanted & ~(J'(1) << pick);
  logic [  3:0] clocks = '0;  // until the registers hold what came in
  always_ff @(posedge clk_i) if (clocks != 4'(Latency)) clocks <= clocks + 1'b1;
  wire full = clocks == 4'(Latency);

  `CHECK(p_found, !full || found == (wanted != '0))
  `CHECK(p_pick, !full || !found || wanted[pick] && (wanted & ~({J{1'b1}} << pick)) == '0)
  `CHECK(p_more, !full || more == (without != '0))
  `CHECK(p_next, !full || !more || without[next] && (without & ~({J{1'b1}} << next)) == '0)
  `CHECK(p_none, !full || ((found || pick == '0) && (more || next == '0)))

endmodule

`default_nettype wire
