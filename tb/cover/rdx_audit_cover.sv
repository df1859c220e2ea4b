// SPDX-License-Identifier: Apache-2.0
// Functional bins of rdx_audit.
`default_nettype none
`include "rdx_cover.svh"

module rdx_audit_cover #(
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Slots = 64
) (
    input wire logic            clk_i,
    input wire logic            clear_i,
    input wire logic            asked_i,
    input wire logic            asked_q,
    input wire logic            second_q,
    input wire rdx_pkg::error_e error,
    input wire rdx_pkg::error_e fault_o,
    input wire rdx_pkg::roots_t roots,
    input wire logic            quartic,
    input wire logic            vector,
    input wire rdx_pkg::pixel_t x0,
    input wire rdx_pkg::pixel_t y0,
    input wire rdx_pkg::pixel_t x1,
    input wire rdx_pkg::pixel_t y1,
    input wire rdx_pkg::pixel_t last_x_i,
    input wire rdx_pkg::pixel_t last_y_i
);
  import rdx_pkg::*;

  wire look = asked_q && second_q;
  wire first = look && fault_o == ErrorNone;
  `RDX_COVER(good, first && error == ErrorNone)
  `RDX_COVER(wrong_roots, first && error == ErrorRoots)
  `RDX_COVER(rectangle, first && error == ErrorRectangle)
  if (Rules != RuleBoth) begin : gen_rule
    `RDX_COVER(rule, first && error == ErrorRule)
  end
  if (Slots < 64) begin : gen_surface
    `RDX_COVER(surface, first && error == ErrorSurface)
  end
  if (D != 4 || Vecsum == VecsumNone) begin : gen_kind
    `RDX_COVER(kind, first && error == ErrorKind)
  end
  if (Slots > 1) begin : gen_several
    `RDX_COVER(later_error, look && fault_o != ErrorNone && error != ErrorNone && error != fault_o)
    `RDX_COVER(good_after_error, look && fault_o != ErrorNone && error == ErrorNone)
  end
  `RDX_COVER(no_roots, look && roots == 0)
  `RDX_COVER(four_roots, look && roots == 4)
  `RDX_COVER(five_roots, look && roots == 5)
  `RDX_COVER(columns_reversed, look && x0 > x1)
  `RDX_COVER(rows_reversed, look && y0 > y1)
  `RDX_COVER(columns_outside, look && x1 > last_x_i && x0 <= x1)
  `RDX_COVER(rows_outside, look && y1 > last_y_i && y0 <= y1)
  `RDX_COVER(last_column, first && error == ErrorNone && x1 == last_x_i)
  `RDX_COVER(last_row, first && error == ErrorNone && y1 == last_y_i)
  `RDX_COVER(one_pixel, first && error == ErrorNone && x0 == x1 && y0 == y1)
  `RDX_COVER(quartic_and_vector, look && quartic && vector)
  `RDX_COVER(asked_as_cleared, clear_i && asked_i)
endmodule

bind rdx_audit rdx_audit_cover #(
    .D(D),
    .Rules(Rules),
    .Vecsum(Vecsum),
    .Slots(Slots)
) u_cover (.*);

`default_nettype wire
