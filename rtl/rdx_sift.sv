// SPDX-License-Identifier: Apache-2.0
// Drops the rays of algebraic surfaces that cannot have a hit, and queues the others: the control points of each of 2^Levels cells
// have one sign, or both ends of the segment lie beyond one face of the box.
//
// Every cell within such a cell has control points of that sign (averages stay within the hull), or ends beyond that face. With
// Levels up to N1 the cells are those of the ray's first step. The rings take most clocks for rays with a hit, which come in
// runs; the queue lets the walk go on meanwhile, and keeps the rings busy where none has a hit.
//
// Formats    ray_i, segment_i: as rdx_ring. rootless_i, boxes_i: 1 where that reason counts.
// Timing     one ray a clock; ray_ready_o is a register: the queue has a place for every ray under way. A ray is at the output
//            Levels*HalveStages + 5 clocks later at the earliest (Queue = 16: + 4). rootless_o, beyond_o: a ray is dropped in this clock,
//            row_o: lowest bits of its row.
// Reset      control only.
// Model      none: it changes no hit
`default_nettype none
`include "rdx_types.svh"
`include "rdx_assert.svh"

module rdx_sift #(
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned Levels = 3,
    parameter int unsigned HalveStages = (D + 1) / 2,
    parameter int unsigned Queue = 512,  // rays; a power of two
    localparam type segment_t = `RDX_SEGMENT_T(W, D)
) (
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire logic          rootless_i,
    input  wire logic          boxes_i,
    input  wire logic          ray_valid_i,
    output logic               ray_ready_o,
    input  wire rdx_pkg::ray_t ray_i,
    input  wire segment_t      segment_i,
    output logic               ray_valid_o,
    input  wire logic          ray_ready_i,
    output rdx_pkg::ray_t      ray_o,
    output segment_t           segment_o,
    output logic               rootless_o,
    output logic               beyond_o,
    output rdx_pkg::line_t     row_o
);
  import rdx_pkg::*;

  localparam int unsigned Cells = 1 << Levels;
  localparam int unsigned Latency = Levels * HalveStages + 2;
  localparam type count_t = logic [$clog2(Queue):0];
  if (Queue < 16 || Queue < Latency + 4) begin : gen_illegal_queue
    $fatal(1, "rdx_sift: Queue = %0d; allowed: %0d or more", Queue, Latency + 4 > 16 ? Latency + 4 : 16);
  end

  // ---- rays under way and in the queue ----
  count_t count_q, count_d;
  logic [Latency-1:0] valid_q;
  wire take = ray_valid_i && ray_ready_o;
  wire drop = rootless_o || beyond_o;
  assign count_d = count_q + count_t'(take) - count_t'(drop) - count_t'(ray_valid_o && ray_ready_i);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      count_q <= '0;
      valid_q <= '0;
      ray_ready_o <= 1'b0;
    end else begin
      count_q <= count_d;
      valid_q <= {valid_q[Latency-2:0], take};
      ray_ready_o <= count_d != count_t'(Queue);
    end
  end
  ray_t ray;
  segment_t segment;
  rdx_line #(
      .W($bits(ray_t) + $bits(segment_t)),
      .Depth(Latency)
  ) u_wait (
      .clk_i,
      .rst_ni,
      .en_i  (1'b1),
      .data_i({ray_i, segment_i}),
      .data_o({ray, segment})
  );

  // ---- signs of the control points ----
  logic signed [W-1:0] b[D+1], cells[Cells*D+1];
  always_comb for (int unsigned i = 0; i <= D; i++) b[i] = segment_i.b[i];
  if (Levels > 0) begin : gen_cells
    rdx_cells #(
        .W(W),
        .D(D),
        .N1(Levels),
        .HalveStages(HalveStages)
    ) u_cells (
        .clk_i,
        .b_i(b),
        .cells_o(cells)
    );
  end else begin : gen_whole
    assign cells = b;
  end
  logic [Cells*D:0] positive_q;
  logic [Cells-1:0] mixed;
  always_comb begin
    for (int unsigned c = 0; c < Cells; c++) mixed[c] = (|positive_q[c*D+:D+1]) && !(&positive_q[c*D+:D+1]);
  end
  logic rootless_q, beyond_q, beyond_late[1];
  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i <= Cells * D; i++) positive_q[i] <= cells[i] > 0;
    rootless_q <= rootless_i && mixed == '0;
    beyond_q   <= boxes_i && beyond_late[0];
  end

  // ---- the box ----
  if (Clip) begin : gen_clip
    coord_t ends  [3] [2];
    logic   beyond[1];
    always_comb begin
      for (int unsigned axis = 0; axis < 3; axis++)
      ends[axis] = '{segment_i.ends.start[axis], segment_i.ends.stop[axis]};
    end
    rdx_outside #(
        .J(1)
    ) u_outside (
        .boundaries_i(ends),
        .box_i(ray_i.box),
        .low_i('0),
        .high_i('0),
        .outside_o(beyond[0])
    );
    rdx_delay #(
        .T(logic),
        .Depth(Latency - 1)
    ) u_beyond (
        .clk_i,
        .data_i(beyond),
        .data_o(beyond_late)
    );
  end else begin : gen_no_clip
    assign beyond_late[0] = 1'b0;
  end

  // ---- those that may have a hit ----
  wire here = valid_q[Latency-1];
  assign rootless_o = here && rootless_q;
  assign beyond_o = here && !rootless_q && beyond_q;
  assign row_o = ray.y[1:0];
  logic queue_ready;
  rdx_fifo #(
      .W($bits(ray_t) + $bits(segment_t)),
      .Depth(Queue)
  ) u_queue (
      .clk_i,
      .rst_ni,
      .valid_i(here && !drop),
      .ready_o(queue_ready),
      .data_i ({ray, segment}),
      .valid_o(ray_valid_o),
      .ready_i(ray_ready_i),
      .data_o ({ray_o, segment_o})
  );
  wire unused = queue_ready;
  `RDX_ASSERT(a_place, queue_ready || !here)

endmodule

`default_nettype wire
