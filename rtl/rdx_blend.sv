// SPDX-License-Identifier: Apache-2.0
// Layers of a pixel from front to back, and the background behind them.
//
// A layer takes part = T a of the light and lets T (1 - a) through; T is 1 before the first. Where no layer comes the
// share is 0 and all is let through, whatever stands at the other ports; so no register needs an enable. With opacity 0 the
// colour does not count, so it may be unknown.
//
// Formats    all numbers u1p16, at most 1. valid_i: a layer comes; first_i, last_i: of its pixel; Layers = 1: both are taken for 1.
// Rounding   half up, each product; what is let through: down, because the loop from layer to layer is one clock.
// Overflow   none: part <= T a + 1/2 and what is let through <= T (1 - a) are whole numbers, so both together are T at most. Shares
//            of a part are no more than it, as a colour is at most 1; so the sum over all layers and the background is 1 at most.
// Timing     latency rdx_pkg::BlendLatency = 8 clocks from the last layer, a layer a clock.
// Reset      of valid_o only.
// Model      model/raydix/blend.py
`default_nettype none

module rdx_blend #(
    parameter int unsigned Layers = 4
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire rdx_pkg::unit_t background_i[3],  // constant
    input  wire logic           valid_i,
    input  wire logic           first_i,
    input  wire logic           last_i,
    input  wire rdx_pkg::unit_t opacity_i,
    input  wire rdx_pkg::unit_t color_i     [3],
    output logic                valid_o,
    output rdx_pkg::unit_t      linear_o    [3]
);
  import rdx_pkg::*;

  if (Layers < 1) begin : gen_illegal_layers
    $fatal(1, "rdx_blend: Layers = %0d; allowed: 1 or more", Layers);
  end

  logic [BlendLatency-1:0] done_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) done_q <= '0;
    else done_q <= {done_q[BlendLatency-2:0], valid_i && (last_i || Layers == 1)};
  end
  assign valid_o = done_q[BlendLatency-1];

  // ---- what is seen of a layer, and of what is behind it ----
  unit_t opacity_q, rest_q, seen_q, opacity_qq, through_q, part_q;
  logic [6:1] first_q;
  logic [5:1] shown_q;
  unit_product_t part_product_q;
  always_ff @(posedge clk_i) begin
    opacity_q <= opacity_i;
    rest_q <= valid_i ? One - opacity_i : One;
    first_q <= {first_q[5:1], valid_i && first_i};
    shown_q <= {shown_q[4:1], valid_i && opacity_i != '0};
    opacity_qq <= opacity_q;
    part_product_q <= unit_product_t'(seen_q) * unit_product_t'(opacity_qq);
    part_q <= rounded(part_product_q);
  end
  if (Layers == 1) begin : gen_single
    always_ff @(posedge clk_i) begin
      seen_q <= One;
      through_q <= rest_q;
    end
  end else begin : gen_many
    wire unit_product_t through = unit_product_t'(through_q) * unit_product_t'(rest_q);
    wire unused_through = &{1'b0, through[UnitFrac-1:0], through[2*UnitWidth-1]};
    always_ff @(posedge clk_i) begin
      seen_q <= first_q[1] ? One : through_q;
      through_q <= first_q[1] ? rest_q : through[UnitFrac+:UnitWidth];
    end
  end

  // ---- colour; where its opacity is 0 it may be unknown, and four states know no 0 * x = 0 ----
  unit_t through[1];
  unit_t color  [3];
  rdx_delay #(
      .T(unit_t),
      .Depth(3)
  ) u_through (
      .clk_i,
      .data_i('{through_q}),
      .data_o(through)
  );
  rdx_delay #(
      .T(unit_t),
      .Count(3),
      .Depth(4)
  ) u_color (
      .clk_i,
      .data_i(color_i),
      .data_o(color)
  );
  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    unit_product_t term_q, behind_q;
    unit_t share_q, rest_qq, sum_q;
    always_ff @(posedge clk_i) begin
      term_q <= unit_product_t'(part_q) * unit_product_t'(color[channel]);
      share_q <= shown_q[5] ? rounded(term_q) : '0;
      sum_q <= (Layers == 1 || first_q[6] ? '0 : sum_q) + share_q;
      behind_q <= unit_product_t'(through[0]) * unit_product_t'(background_i[channel]);
      rest_qq <= rounded(behind_q);
      linear_o[channel] <= sum_q + rest_qq;
    end
  end
  wire unused = &{1'b0, first_i, first_q};

endmodule

`default_nettype wire
