// SPDX-License-Identifier: Apache-2.0
// Assertions; nothing is left of them where SYNTHESIS is defined.
`ifndef RDX_ASSERT_SVH
`define RDX_ASSERT_SVH

`ifdef SYNTHESIS
`define RDX_ASSERT(name, condition)
`define RDX_STREAM(name, valid, ready, data)
`else
// `condition` holds at every clock out of reset.
`define RDX_ASSERT(name, condition) \
  name : assert property (@(posedge clk_i) disable iff (!rst_ni) condition) \
    else $error("%m: condition does not hold");

// The two rules of every stream port: valid stays until ready, and so does the data.
`define RDX_STREAM(name, valid, ready, data) \
  name``_valid : assert property (@(posedge clk_i) disable iff (!rst_ni) (valid) && !(ready) |=> (valid)) \
    else $error("%m: valid fell before ready"); \
  name``_data : assert property (@(posedge clk_i) disable iff (!rst_ni) (valid) && !(ready) |=> $stable(data)) \
    else $error("%m: data changed before ready");
`endif

`endif
