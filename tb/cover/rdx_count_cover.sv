// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_count.
`default_nettype none
`include "rdx_cover.svh"

module rdx_count_cover (
    input wire logic                   clk_i,
    input wire logic                   clear_i,
    input wire logic             [5:0] k_stop_i,
    input wire logic                   hit_valid_i,
    input wire rdx_pkg::hit_t          hit_i,
    input wire rdx_pkg::events_t       events_i
);
  wire last = hit_valid_i && hit_i.last && !clear_i;
  `RDX_COVER(cleared_with_events, clear_i && events_i != '0 && hit_valid_i)
  wire all = &{events_i.hidden, events_i.rootless, events_i.beyond, events_i.visible, events_i.lost, events_i.stalled};
  `RDX_COVER(all_events, !clear_i && all)
  `RDX_COVER(no_event, !clear_i && events_i == '0)
  `RDX_COVER(hit_that_is_not_last, hit_valid_i && hit_i.hit && !hit_i.last)
  `RDX_COVER(last_without_hit, last && !hit_i.hit)
  `RDX_COVER(stops_early, last && hit_i.steps < rdx_pkg::steps_t'(k_stop_i))
  `RDX_COVER(stops_at_k, last && hit_i.steps == rdx_pkg::steps_t'(k_stop_i))
  `RDX_COVER(takes_more, last && hit_i.steps > rdx_pkg::steps_t'(k_stop_i) && !(&hit_i.steps))
  `RDX_COVER(given_up, last && &hit_i.steps)
  `RDX_COVER(most_steps_but_not_last, hit_valid_i && !hit_i.last && &hit_i.steps)
endmodule

bind rdx_count rdx_count_cover u_cover (.*);

`default_nettype wire
