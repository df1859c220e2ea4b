// SPDX-License-Identifier: Apache-2.0
// Shaded pixels to beats of the pixel stream, through a queue that takes the receiver's stalls.
//
// The shading cannot be stopped, so a beat's place in the queue is reserved when its first layer goes into the shading.
//
// Formats    pixel_i: R in bits 23:16, G, B; whole_i: it stands for all pixels of the beat. Stream: pixel p of a beat in
//            tdata[24*p +: 24], tkeep three bits of each pixel; tuser: first beat of a frame, tlast: last beat of a line.
// Timing     room_o: another beat may begin in this clock. The queue holds Depth beats.
// Reset      control only.
// Model      none: it moves pixels
`default_nettype none
`include "rdx_assert.svh"

module rdx_pixels #(
    parameter int unsigned Pixels = 1,
    parameter int unsigned Depth  = 128  // a power of two, above the latency of the shading
) (
    input  wire logic                            clk_i,
    input  wire logic                            rst_ni,
    input  wire rdx_pkg::pixel_t                 last_x_i,
    input  wire rdx_pkg::pixel_t                 last_y_i,
    input  wire logic                            begin_i,          // a beat begins
    output logic                                 room_o,
    input  wire logic                            pixel_valid_i,
    input  wire logic            [         23:0] pixel_i,
    input  wire logic                            whole_i,
    output logic                                 finish_o,         // the frame's last beat has left
    output logic                                 stalled_o,        // the receiver holds a beat
    output logic                                 m_axis_tvalid_o,
    input  wire logic                            m_axis_tready_i,
    output logic                 [24*Pixels-1:0] m_axis_tdata_o,
    output logic                 [ 3*Pixels-1:0] m_axis_tkeep_o,
    output logic                                 m_axis_tuser_o,
    output logic                                 m_axis_tlast_o
);
  import rdx_pkg::*;

  localparam int unsigned PixelBits = Pixels > 1 ? $clog2(Pixels) : 1;
  localparam int unsigned Shift = $clog2(Pixels);

  // ---- pixels to beats ----
  logic [PixelBits-1:0] at_q;
  logic [24*Pixels-1:0] beat_q;
  logic beat_valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      at_q <= '0;
      beat_valid_q <= 1'b0;
    end else begin
      beat_valid_q <= pixel_valid_i && (whole_i || 32'(at_q) == Pixels - 1);
      if (pixel_valid_i) at_q <= whole_i || 32'(at_q) == Pixels - 1 ? '0 : at_q + 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (pixel_valid_i) begin
      for (int unsigned p = 0; p < Pixels; p++) if (whole_i || 32'(at_q) == p) beat_q[24*p+:24] <= pixel_i;
    end
  end

  // ---- the queue ----
  localparam type reserved_t = logic [$clog2(Depth):0];
  reserved_t reserved_q;
  logic beat_valid, beat_ready, queue_ready;
  logic [24*Pixels-1:0] beat;
  rdx_fifo #(
      .W(24 * Pixels),
      .Depth(Depth)
  ) u_fifo (
      .clk_i,
      .rst_ni,
      .valid_i(beat_valid_q),
      .ready_o(queue_ready),
      .data_i (beat_q),
      .valid_o(beat_valid),
      .ready_i(beat_ready),
      .data_o (beat)
  );
  wire sent = beat_valid && beat_ready;
  assign room_o = reserved_q < reserved_t'(Depth - 1);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) reserved_q <= '0;
    else reserved_q <= reserved_q + reserved_t'(begin_i) - reserved_t'(sent);
  end
  `RDX_ASSERT(a_room, !beat_valid_q || queue_ready)

  // ---- the stream ----
  pixel_t x_q, y_q;  // beat of the line, line
  wire pixel_t last_beat = last_x_i >> Shift;
  wire line_end = x_q == last_beat;
  assign m_axis_tvalid_o = beat_valid;
  assign beat_ready = m_axis_tready_i;
  assign m_axis_tdata_o = beat;
  assign m_axis_tuser_o = x_q == '0 && y_q == '0;
  assign m_axis_tlast_o = line_end;
  always_comb begin
    for (int unsigned p = 0; p < Pixels; p++) begin
      m_axis_tkeep_o[3*p+:3] = {3{!line_end || (x_q << Shift) + pixel_t'(p) <= last_x_i}};
    end
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      x_q <= '0;
      y_q <= '0;
    end else if (sent) begin
      x_q <= line_end ? '0 : x_q + 1'b1;
      if (line_end) y_q <= y_q == last_y_i ? '0 : y_q + 1'b1;
    end
  end
  assign finish_o  = sent && line_end && y_q == last_y_i;
  assign stalled_o = beat_valid && !m_axis_tready_i;
  `RDX_STREAM(a_axis, m_axis_tvalid_o, m_axis_tready_i, {m_axis_tdata_o, m_axis_tkeep_o, m_axis_tuser_o, m_axis_tlast_o
              })

endmodule

`default_nettype wire
