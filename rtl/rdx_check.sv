// SPDX-License-Identifier: Apache-2.0
// Whether a frame can be started with what stands in the registers; keeps the frame until it is taken, and the first error.
//
// Formats    request_i: see request_t; code_o: why, and slot_o: of which descriptor.
// Overflow   ambient and background above 1 count as 1.
// Timing     start_i = 1 for one clock. A legal start: start_valid_o in the next clock. Another: error_o at once, and nothing
//            else happens; of several reasons the code is the first of queued, size, count, k_stop. error_valid_i, from the
//            processor, goes before it. code_o and slot_o change in the clock after error_o with known_i = 0. done_o: done_i
//            came since the last legal start.
// Reset      start_valid_o and done_o.
// Model      none: comparisons only; the test repeats them
`default_nettype none
`include "rdx_assert.svh"

module rdx_check
  import rdx_pkg::*;
#(
    parameter int unsigned K = 8,
    parameter int unsigned Surfaces = 64,
    parameter int unsigned MaxWidth = 1920
) (
    input  wire logic     clk_i,
    input  wire logic     rst_ni,
    input  wire logic     start_i,
    input  wire request_t request_i,
    output logic          start_valid_o,
    input  wire logic     start_ready_i,
    output frame_t        frame_o,
    input  wire logic     done_i,
    output logic          done_o,
    input  wire logic     error_valid_i,
    input  wire error_e   error_code_i,
    input  wire surface_t error_slot_i,
    input  wire logic     known_i,
    output logic          error_o,
    output error_e        code_o,
    output surface_t      slot_o
);

  if (K < 1 || K > 32) begin : gen_illegal_k
    $fatal(1, "rdx_check: K = %0d; allowed: 1 to 32", K);
  end
  if (Surfaces < 1 || Surfaces > 1 << SurfaceWidth) begin : gen_illegal_surfaces
    $fatal(1, "rdx_check: Surfaces = %0d; allowed: 1 to %0d", Surfaces, 1 << SurfaceWidth);
  end
  if (MaxWidth < 1 || MaxWidth > 1 << PixelWidth) begin : gen_illegal_width
    $fatal(1, "rdx_check: MaxWidth = %0d; allowed: 1 to %0d", MaxWidth, 1 << PixelWidth);
  end

  localparam logic [12:0] MaxHeight = 13'(1 << PixelWidth);

  function automatic unit_t unit(unit_t value);
    return value[UnitWidth-1] ? unit_t'(1 << (UnitWidth - 1)) : value;
  endfunction

  error_e code;
  always_comb begin
    if (start_valid_o && !start_ready_i) code = ErrorQueued;
    else if (request_i.width == '0 || request_i.width > 13'(MaxWidth)) code = ErrorSize;
    else if (request_i.height == '0 || request_i.height > MaxHeight) code = ErrorSize;
    else if (request_i.count > 7'(Surfaces)) code = ErrorCount;
    else if (request_i.k_stop == '0 || request_i.k_stop > 6'(K)) code = ErrorKStop;
    else code = ErrorNone;
  end

  frame_t frame;
  assign frame.last_x = pixel_t'(request_i.width - 1'b1);
  assign frame.last_y = pixel_t'(request_i.height - 1'b1);
  assign frame.last_slot = surface_t'(request_i.count - 1'b1);
  assign frame.empty = request_i.count == '0;
  assign frame.k_stop = request_i.k_stop;
  assign frame.skip = request_i.skip;
  assign frame.ambient = unit(request_i.ambient);
  for (genvar i = 0; i < 3; i++) begin : gen_background
    assign frame.background[i] = unit(request_i.background[i]);
  end

  wire legal = start_i && code == ErrorNone;
  assign error_o = error_valid_i || (start_i && code != ErrorNone);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      start_valid_o <= 1'b0;
      done_o <= 1'b0;
    end else begin
      if (legal) start_valid_o <= 1'b1;
      else if (start_ready_i) start_valid_o <= 1'b0;
      if (done_i) done_o <= 1'b1;
      else if (legal) done_o <= 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    if (legal) frame_o <= frame;
    if (error_o && !known_i) begin
      code_o <= error_valid_i ? error_code_i : code;
      slot_o <= error_valid_i ? error_slot_i : '0;
    end
  end

  `RDX_STREAM(a_start, start_valid_o, start_ready_i, frame_o)

endmodule

`default_nettype wire
