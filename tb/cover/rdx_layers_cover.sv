// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_layers.
`default_nettype none
`include "rdx_cover.svh"

module rdx_layers_cover #(
    parameter int unsigned Pixels = 1,
    parameter int unsigned Lines = 2,
    localparam type index_t = logic [$clog2(Lines)-1:0],
    parameter bit Limit = 1'b1
) (
    input wire logic                  clk_i,
    input wire logic                  rst_ni,
    input wire logic                  hit_valid_i,
    input wire rdx_pkg::hit_t         hit_i,
    input wire logic                  hazard,
    input wire logic            [3:0] valid_q,
    input wire logic                  write_valid_q,
    input wire rdx_pkg::hit_t         stage_q      [4],
    input wire rdx_pkg::hit_t         write_q,
    input wire logic                  read_i,
    input wire index_t                read_row_i,
    input wire logic                  clear_q,
    input wire logic                  look_i,
    input wire rdx_pkg::pixel_t       look_x_i,
    input wire rdx_pkg::line_t        look_row_i,
    input wire logic                  limit_valid_o,
    input wire logic                  lost_o,
    input wire logic                  last_o
);
  wire asked = valid_q[0] && stage_q[0].hit && stage_q[0].x == hit_i.x && stage_q[0].y[1:0] == hit_i.y[1:0];
  wire is_read = valid_q[1] && stage_q[1].hit && stage_q[1].x == hit_i.x && stage_q[1].y[1:0] == hit_i.y[1:0];
  wire picked = valid_q[2] && stage_q[2].hit && stage_q[2].x == hit_i.x && stage_q[2].y[1:0] == hit_i.y[1:0];
  wire written = write_valid_q && write_q.hit && write_q.x == hit_i.x && write_q.y[1:0] == hit_i.y[1:0];
  wire offered = hit_valid_i && hit_i.hit;
  `RDX_COVER_RUN(waits_for_last_clock, offered && asked)
  `RDX_COVER_RUN(waits_for_clock_before, offered && is_read && !asked)
  `RDX_COVER_RUN(waits_for_picked, offered && picked && !asked && !is_read)
  `RDX_COVER_RUN(waits_for_written, offered && written && !asked && !is_read && !picked)
  `RDX_COVER_RUN(miss_does_not_wait, hit_valid_i && !hit_i.hit && (asked || is_read || written))
  `RDX_COVER_RUN(same_column_of_other_row,
                 offered && valid_q[0] && stage_q[0].x == hit_i.x && stage_q[0].y[1:0] != hit_i.y[1:0])
  for (genvar p = 0; p < Pixels; p++) begin : gen_pixel
    for (genvar r = 0; r < Lines; r++) begin : gen_row
      `RDX_COVER_RUN(hit, offered && !hazard && 32'(hit_i.x) % Pixels == p && index_t'(hit_i.y) == index_t'(r))
      if (Limit) begin : gen_limit
        `RDX_COVER_RUN(look, look_i && 32'(look_x_i) % Pixels == p && index_t'(look_row_i) == index_t'(r))
      end
    end
  end
  for (genvar r = 0; r < Lines; r++) begin : gen_row
    `RDX_COVER_RUN(reads_while_filled,
                   read_i && read_row_i == index_t'(r) && offered && index_t'(hit_i.y) != index_t'(r))
  end
  `RDX_COVER_RUN(clears_and_writes, clear_q && write_valid_q && write_q.hit)
  `RDX_COVER_RUN(last_without_hit, last_o && !write_q.hit)
  `RDX_COVER_RUN(last_with_hit, last_o && write_q.hit)
  `RDX_COVER_RUN(lost, lost_o)
  if (Limit) begin : gen_limit
    `RDX_COVER_RUN(limit, limit_valid_o)
    `RDX_COVER_RUN(no_limit, !limit_valid_o)
    `RDX_COVER_RUN(looks_at_what_is_written, look_i && write_valid_q && write_q.hit && write_q.x == look_x_i)
  end
endmodule

bind rdx_layers rdx_layers_cover #(
    .Pixels(Pixels),
    .Lines (Lines),
    .Limit (Limit)
) u_cover (.*);

`default_nettype wire
