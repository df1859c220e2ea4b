// SPDX-License-Identifier: Apache-2.0
// The counters of a frame.
//
// Formats    events_i: what happens in this clock. counters_o: sums since clear_i.
// Overflow   wraps.
// Timing     counters_o follows by two clocks.
// Reset      none: clear_i.
// Model      none: the tests repeat it (tb/test_processor.py)
`default_nettype none

module rdx_count (
    input  wire logic                   clk_i,
    input  wire logic                   clear_i,
    input  wire logic             [5:0] k_stop_i,
    input  wire logic                   hit_valid_i,  // a record leaves the rings
    input  wire rdx_pkg::hit_t          hit_i,
    input  wire rdx_pkg::events_t       events_i,
    output rdx_pkg::counters_t          counters_o
);
  import rdx_pkg::*;

  events_t events_q;
  wire last = hit_valid_i && hit_i.last;
  logic ray_q, hit_q, given_up_q;
  logic [4:0] early_q;  // steps that the ray did not take
  always_ff @(posedge clk_i) begin
    ray_q <= last && !clear_i;
    hit_q <= hit_valid_i && hit_i.hit && !clear_i;
    given_up_q <= last && (&hit_i.steps) && !clear_i;
    early_q <= last && !clear_i && hit_i.steps < steps_t'(k_stop_i) ? 5'(k_stop_i - hit_i.steps[5:0]) : '0;
    events_q <= clear_i ? '0 : events_i;
    if (clear_i) begin
      counters_o <= '0;
    end else begin
      counters_o.cycles <= counters_o.cycles + 1'b1;
      counters_o.steps <= counters_o.steps + 64'(events_q.steps);
      counters_o.rays <= counters_o.rays + 32'(ray_q);
      counters_o.hits <= counters_o.hits + 32'(hit_q);
      counters_o.skipped_rectangle <= counters_o.skipped_rectangle + 32'(events_q.rectangle);
      counters_o.skipped_rootless <= counters_o.skipped_rootless + 32'(events_q.rootless);
      counters_o.skipped_depth <= counters_o.skipped_depth + 32'(events_q.hidden);
      counters_o.skipped_boxes <= counters_o.skipped_boxes + 32'(events_q.beyond);
      counters_o.skipped_cells <= counters_o.skipped_cells + 32'(events_q.ended);
      counters_o.skipped_early <= counters_o.skipped_early + 32'(early_q);
      counters_o.visible <= counters_o.visible + 32'(events_q.visible);
      counters_o.layers_lost <= counters_o.layers_lost + 32'(events_q.lost);
      counters_o.given_up <= counters_o.given_up + 32'(given_up_q);
      counters_o.stalled <= counters_o.stalled + 32'(events_q.stalled);
    end
  end

  wire unused = &{1'b0, hit_i};

endmodule

`default_nettype wire
