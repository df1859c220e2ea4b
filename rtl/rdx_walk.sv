// SPDX-License-Identifier: Apache-2.0
// The pixels of a row, each with the question whether anything nearer is known there already.
//
// A pixel goes through three places: its number, and the question for the nearest opaque hit; the answer; its ray. One that
// is hidden has no ray: its surface begins behind that hit.
//
// Formats    next_*_i: the row that waits, its first and last column, lowest bits of its number, depth of the near plane
//            (s1p31); held while next_i = 1. limit_i: s1p31.
// Timing     a pixel a clock; a row that waits follows the one before without a gap. start_o and step_o: the next ray is the
//            first of the row that waits, or the next one of this row; the lanes follow by a clock. limit_i answers in the
//            clock with look_o = 1 after the one of look_x_o.
// Reset      control only.
// Model      none: which rays are left out changes no visible hit (docs/processor.md)
`default_nettype none

module rdx_walk (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            next_i,
    input  wire rdx_pkg::pixel_t next_x0_i,
    input  wire rdx_pkg::pixel_t next_x1_i,
    input  wire rdx_pkg::line_t  next_row_i,
    input  wire rdx_pkg::depth_t next_near_i,
    output logic                 start_o,
    output logic                 step_o,
    output logic                 idle_o,         // no pixel is under way
    output logic                 look_o,
    output rdx_pkg::pixel_t      look_x_o,
    output rdx_pkg::line_t       look_row_o,
    input  wire logic            limit_valid_i,  // there is an opaque hit
    input  wire rdx_pkg::depth_t limit_i,
    output logic                 hidden_o,       // in this clock a pixel has no ray
    output rdx_pkg::line_t       hidden_row_o,
    output logic                 ray_valid_o,
    input  wire logic            ray_ready_i,
    output rdx_pkg::pixel_t      ray_x_o,
    output rdx_pkg::limit_t      ray_limit_o     // the answer
);
  import rdx_pkg::*;

  logic taken_q;  // the row that waits is being walked, its first ray has not begun
  logic walk_q, first_q, answer_q, answer_first_q, valid_q, hidden_q;
  pixel_t x_q, x1_q, answer_x_q;
  line_t row_q, answer_row_q;
  depth_t near_q, answer_near_q;

  wire en = !valid_q || hidden_q || ray_ready_i;
  wire row_end = x_q == x1_q;
  wire begins = en && next_i && !taken_q && (!walk_q || row_end);
  assign start_o = en && answer_q && answer_first_q;
  assign step_o  = en && answer_q && !answer_first_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      taken_q  <= 1'b0;
      walk_q   <= 1'b0;
      answer_q <= 1'b0;
      valid_q  <= 1'b0;
    end else if (en) begin
      taken_q  <= begins || (taken_q && !start_o);
      walk_q   <= begins || (walk_q && !row_end);
      answer_q <= walk_q;
      valid_q  <= answer_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (en) begin
      first_q <= begins;
      x_q <= begins ? next_x0_i : x_q + 1'b1;
      if (begins) begin
        x1_q   <= next_x1_i;
        near_q <= next_near_i;
        row_q  <= next_row_i;
      end
      answer_first_q <= first_q;
      answer_x_q <= x_q;
      answer_row_q <= row_q;
      answer_near_q <= near_q;
      ray_x_o <= answer_x_q;
      ray_limit_o <= limit_valid_i ? limit_of(limit_i) : NoLimit;
      hidden_row_o <= answer_row_q;
      hidden_q <= limit_valid_i && limit_i < answer_near_q;
    end
  end

  assign look_o = en;
  assign look_x_o = x_q;
  assign look_row_o = row_q;
  assign idle_o = !walk_q && !answer_q && !valid_q;
  assign hidden_o = en && valid_q && hidden_q;
  assign ray_valid_o = valid_q && !hidden_q;

endmodule

`default_nettype wire
