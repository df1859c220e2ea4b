// SPDX-License-Identifier: Apache-2.0
// Rings of step units side by side: a new ray goes to the first that is free to take one, their hits become one stream.
//
// A ray occupies its slot until the wrap of its ring, whatever it needed. So one long ring does whole turns of U steps for rays
// that need one, while rings of one unit do no step in vain; one ring of U = K units is the paper's pipeline.
//
// Formats    as rdx_ring.
// Timing     as rdx_ring; a hit waits five clocks more. Rays may overtake each other.
// Reset      as rdx_ring.
// Model      model/raydix/ring.py
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_rings #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned U = 8,
    parameter int unsigned Rings = 1,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Lanes = (1 << N1) - 1,
    parameter bit General = 1'b0,
    parameter int unsigned VectorDrop = 0,
    parameter bit Limit = 1'b0,
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire rdx_pkg::form_t        form_i,
    input  wire rdx_pkg::modes_t       modes_i,
    input  wire logic                  ray_valid_i,
    output logic                       ray_ready_o,
    input  wire rdx_pkg::ray_t         ray_i,
    input  wire segment_t              segment_i,
    output logic                       hit_valid_o,
    input  wire logic                  hit_ready_i,
    output rdx_pkg::hit_t              hit_o,
    output logic                 [5:0] steps_o,      // items that take a step, a clock ago
    output logic                 [5:0] ended_o       // items that have ended behind their limit, a clock ago
);
  import rdx_pkg::*;

  localparam int unsigned Queue = 32;  // records behind a ring, in block RAM; one that finds it full goes round
  if (Rings < 1 || Rings * U > 32) begin : gen_illegal_rings
    $fatal(1, "rdx_rings: Rings = %0d, U = %0d; allowed: 1 or more, 32 step units in all", Rings, U);
  end

  // ---- rays: to the first ring that has a place in this clock ----
  logic [Rings-1:0] free, chosen;
  assign ray_ready_o = |free;
  assign chosen = free & (~free + 1'b1);

  // ---- hits: in turns ----
  logic [Rings-1:0] valid, ready;
  logic merged_valid, merged_ready;
  hit_t hits[Rings], merged;
  rdx_merge #(
      .Count(Rings),
      .T(hit_t)
  ) u_merge (
      .clk_i,
      .rst_ni,
      .valid_i(valid),
      .ready_o(ready),
      .data_i (hits),
      .valid_o(merged_valid),
      .ready_i(merged_ready),
      .data_o (merged)
  );
  rdx_fifo #(
      .W($bits(hit_t)),
      .Depth(2)
  ) u_out (
      .clk_i,
      .rst_ni,
      .valid_i(merged_valid),
      .ready_o(merged_ready),
      .data_i (merged),
      .valid_o(hit_valid_o),
      .ready_i(hit_ready_i),
      .data_o (hit_o)
  );

  // ---- rings ----
  logic [5:0] steps[Rings];
  logic [Rings-1:0] ended;
  for (genvar r = 0; r < Rings; r++) begin : gen_ring
    logic hit_valid, hit_ready;
    hit_t hit;
    rdx_ring #(
        .N1(N1),
        .K(K),
        .W(W),
        .D(D),
        .U(U),
        .Rules(Rules),
        .Clip(Clip),
        .HalveStages(HalveStages),
        .Lanes(Lanes),
        .General(General),
        .VectorDrop(VectorDrop),
        .Limit(Limit)
    ) u_ring (
        .clk_i,
        .rst_ni,
        .form_i,
        .modes_i,
        .ray_valid_i(ray_valid_i && chosen[r]),
        .ray_ready_o(free[r]),
        .ray_i,
        .segment_i,
        .hit_valid_o(hit_valid),
        .hit_ready_i(hit_ready),
        .hit_o(hit),
        .steps_o(steps[r]),
        .ended_o(ended[r])
    );
    rdx_fifo #(
        .W($bits(hit_t)),
        .Depth(Queue)
    ) u_queue (
        .clk_i,
        .rst_ni,
        .valid_i(hit_valid),
        .ready_o(hit_ready),
        .data_i (hit),
        .valid_o(valid[r]),
        .ready_i(ready[r]),
        .data_o (hits[r])
    );
  end
  always_comb begin
    steps_o = '0;
    for (int unsigned r = 0; r < Rings; r++) steps_o = steps_o + steps[r];
  end
  assign ended_o = 6'($countones(ended));

  `RDX_STREAM(a_hit, hit_valid_o, hit_ready_i, hit_o)

endmodule

`default_nettype wire
