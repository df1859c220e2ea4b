// SPDX-License-Identifier: Apache-2.0
// rdx_fifo: words come out as they came in, in their order, none lost or doubled, and none waits for nothing.
//
// One word of all, any, is watched: as many words leave before it as were in the queue when it came.
`default_nettype none
`include "formal.svh"

module formal_fifo #(
    parameter int unsigned W = 2,
    parameter int unsigned Depth = 4
) (
    input wire logic         clk_i,
    input wire logic         rst_ni,
    input wire logic         valid_i,
    input wire logic [W-1:0] data_i,
    input wire logic         ready_i
);

  localparam int unsigned Most = Depth + (Depth > 16 ? 2 : 1);  // words that it holds
  localparam type count_t = logic [$clog2(Most + 1)-1:0];
  logic ready, valid;
  logic [W-1:0] data;
  rdx_fifo #(
      .W(W),
      .Depth(Depth)
  ) u_fifo (
      .clk_i,
      .rst_ni,
      .valid_i,
      .ready_o(ready),
      .data_i,
      .valid_o(valid),
      .ready_i,
      .data_o (data)
  );

  `RESET_FIRST
  `GIVEN(g_no_reset, !began_q || rst_ni)
  wire take = rst_ni && valid_i && ready;
  wire give = rst_ni && valid && ready_i;

  logic watch;  // anything: the driver leaves what nothing drives free
  logic held_q = 1'b0;
  logic [W-1:0] value_q;
  count_t inside_q = '0, ahead_q = '0;
  logic [1:0] dry_q = '0;  // clocks in which words were inside and none was offered
  always_ff @(posedge clk_i) begin
    inside_q <= inside_q + count_t'(take) - count_t'(give);
    dry_q <= inside_q == '0 || valid ? '0 : dry_q + 2'(dry_q != '1);
    if (take && watch && !held_q) begin
      held_q  <= 1'b1;
      value_q <= data_i;
      ahead_q <= inside_q - count_t'(give);
    end else if (held_q && give) begin
      if (ahead_q == '0) held_q <= 1'b0;
      else ahead_q <= ahead_q - 1'b1;
    end
  end

  `CHECK(p_room, !began_q || 32'(inside_q) <= Most)
  `CHECK(p_none, !began_q || inside_q != '0 || !valid)
  `CHECK(p_soon, dry_q != '1)
  `CHECK(p_value, !(held_q && give && ahead_q == '0) || data == value_q)
  `REACH(r_full, 32'(inside_q) == Most && !ready)
  `REACH(r_value, held_q && give && ahead_q == '0 && value_q == '1)

endmodule

`default_nettype wire
