// SPDX-License-Identifier: Apache-2.0
// rdx_merge: what it offers is what one of the inputs offers, each is taken once, and none waits for more than one other.
`default_nettype none
`include "formal.svh"

module formal_merge #(
    parameter int unsigned W = 4
) (
    input wire logic              clk_i,
    input wire logic              rst_ni,
    input wire logic [1:0]        valid_i,
    input wire logic [1:0][W-1:0] data_i,
    input wire logic              ready_i
);

  logic [1:0] ready;
  logic valid;
  logic [W-1:0] data, offered[2];
  assign offered = '{data_i[0], data_i[1]};
  rdx_merge #(
      .T(logic [W-1:0])
  ) u_merge (
      .clk_i,
      .rst_ni,
      .valid_i,
      .ready_o(ready),
      .data_i (offered),
      .valid_o(valid),
      .ready_i,
      .data_o (data)
  );

  // ---- both inputs keep the rules of a stream ----
  `RESET_FIRST
  logic [1:0] waits_q = '0;
  logic [1:0][W-1:0] data_q;
  always_ff @(posedge clk_i) begin
    waits_q <= {2{rst_ni}} & valid_i & ~ready;
    data_q  <= data_i;
  end
  for (genvar i = 0; i < 2; i++) begin : gen_input
    `GIVEN(g_stream, !waits_q[i] || !rst_ni || (valid_i[i] && data_i[i] == data_q[i]))

    // ---- nobody is passed by twice ----
    logic passed_q;  // the other one was served while this one waited
    always_ff @(posedge clk_i) begin
      passed_q <= rst_ni && valid_i[i] && !ready[i] && (passed_q || (valid_i[1-i] && ready[1-i]));
    end
    `CHECK(p_fair, !rst_ni || !passed_q || !(valid_i[1-i] && ready[1-i]))
    `CHECK(p_offer, !rst_ni || !(valid_i[i] && ready[i]) || (valid && data == data_i[i]))
    `REACH(r_passed, rst_ni && passed_q)
  end

  // ---- one goes in where one goes out ----
  wire [1:0] taken = valid_i & ready;
  `CHECK(p_one, !rst_ni || !(&taken))
  `CHECK(p_count, !rst_ni || (valid && ready_i) == (|taken))
  `CHECK(p_work, valid == (|valid_i))
  `REACH(r_both, rst_ni && (&waits_q) && (&valid_i) && ready_i)

endmodule

`default_nettype wire
