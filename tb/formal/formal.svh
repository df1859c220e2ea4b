// SPDX-License-Identifier: Apache-2.0
// What the harnesses say: CHECK is proved for every state that can be reached, GIVEN restricts the inputs, and REACH must be
// possible under what is given. With RDX_REACH defined a harness asks for the latter only: each as an assertion of its opposite,
// which has to be refuted.
`ifndef FORMAL_SVH
`define FORMAL_SVH

`define GIVEN(name, condition) \
  always_comb name : assume (condition);

`ifdef RDX_REACH
`define CHECK(name, condition)
`define REACH(name, condition) \
  always_comb name : assert (!(condition));
`else
`define CHECK(name, condition) \
  always_comb name : assert (condition);
`define REACH(name, condition)
`endif

// A step on the way to a CHECK: proved at its Stage, given from then on. The module has the parameter Stage, and the driver
// proves the stages in their order. With RDX_ALL, where a counterexample is looked for, all are checked at once.
`ifdef RDX_ALL
`define LEMMA(stage, name, condition) \
  `CHECK(name, condition)
`else
`define LEMMA(stage, name, condition) \
  if (Stage == stage) begin : gen_prove_``name \
    `CHECK(name, condition) \
  end else if (Stage > stage) begin : gen_given_``name \
    `GIVEN(name, condition) \
  end
`endif

// The first clock is one of reset; what no reset sets is arbitrary then.
`define RESET_FIRST \
  logic began_q = 1'b0; \
  always_ff @(posedge clk_i) began_q <= 1'b1; \
  `GIVEN(g_reset, began_q || !rst_ni)

`endif
