// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_select.
`default_nettype none
`include "rdx_cover.svh"

module rdx_select_cover #(
    parameter int unsigned N1 = 3,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    localparam int unsigned J = 1 << N1
) (
    input wire logic          clk_i,
    input wire logic [ J-1:0] excluded,
    input wire logic [ J-1:0] possible,
    input wire logic          last,
    input wire logic          paper,
    input wire logic [ J-1:0] mixed,
    input wire logic [ J-1:0] changes,
    input wire logic          found_d,
    input wire logic          more_d,
    input wire logic [N1-1:0] pick_d,
    input wire logic [N1-1:0] next_d
);
  localparam bit Certified = (Rules & rdx_pkg::RuleCertified) != 0;
  localparam bit Paper = (Rules & rdx_pkg::RulePaper) != 0;
  wire by_paper = Paper && (paper || !Certified);
  wire [J-1:0] left = ~excluded;

  for (genvar j = 0; j < J; j++) begin : gen_cell
    `RDX_COVER(first, found_d && 32'(pick_d) == j)
    if (j > 0) begin : gen_second
      `RDX_COVER(second, more_d && 32'(next_d) == j)
    end
  end
  `RDX_COVER(none, !found_d)
  `RDX_COVER(one, found_d && !more_d)
  `RDX_COVER(all_excluded, left == '0)
  `RDX_COVER(some_excluded, left != '0 && left != '1)
  if (Certified) begin : gen_certified
    `RDX_COVER(mixed_only, !by_paper && !last && (mixed & ~changes & left) != '0)
    `RDX_COVER(possible_only, !by_paper && !last && (possible & ~mixed & left) != '0)
    `RDX_COVER(last_change, !by_paper && last && (changes & left) != '0)
    `RDX_COVER(last_mixed_is_none, !by_paper && last && (mixed & ~changes & left) != '0 && (changes & left) == '0)
    `RDX_COVER(last_possibles_none, !by_paper && last && (possible & left) != '0 && (changes & left) == '0)
  end
  if (Paper) begin : gen_paper
    `RDX_COVER(case_1, by_paper && changes == '0)
    `RDX_COVER(case_1_all_excluded, by_paper && changes == '0 && left == '0)
    `RDX_COVER(case_2, by_paper && (changes & left) != '0)
    `RDX_COVER(case_2_all_excluded, by_paper && changes != '0 && (changes & left) == '0)
    `RDX_COVER(last_level, by_paper && last)
  end
endmodule

bind rdx_select rdx_select_cover #(
    .N1(N1),
    .Rules(Rules)
) u_cover (.*);

`default_nettype wire
