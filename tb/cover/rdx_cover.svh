// SPDX-License-Identifier: Apache-2.0
// Functional bins: cover properties of the modules that are bound to the design for `make coverage`.
`ifndef RDX_COVER_SVH
`define RDX_COVER_SVH

// `condition` was seen at a clock.
`define RDX_COVER(name, condition) \
  name : cover property (@(posedge clk_i) (condition));

// The same out of reset.
`define RDX_COVER_RUN(name, condition) \
  name : cover property (@(posedge clk_i) disable iff (!rst_ni) (condition));

// The same in a module without a clock.
`define RDX_COVER_NOW(name, condition) \
  always_comb name : cover (condition);

`endif
