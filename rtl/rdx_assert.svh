// SPDX-License-Identifier: Apache-2.0
// Assertions; nothing is left of them where SYNTHESIS is defined. With RDX_FORMAL those of streams are written for a prover
// that knows no sequences. At time 0, before the reset of a simulation that begins with random values, nothing is asserted.
`ifndef RDX_ASSERT_SVH
`define RDX_ASSERT_SVH

`ifdef RDX_FORMAL
`define RDX_ASSERT(name, condition)
`ifdef RDX_REACH
`define RDX_STREAM(name, valid, ready, data) \
  logic name``_reset_q = 1'b0; \
  always_ff @(posedge clk_i) if (!rst_ni) name``_reset_q <= 1'b1; \
  always_comb name``_offer : assert (!(name``_reset_q && rst_ni && (valid) && !(ready)));
`else
`define RDX_STREAM(name, valid, ready, data) \
  logic name``_reset_q = 1'b0; \
  logic name``_waits_q = 1'b0; \
  logic [$bits(data)-1:0] name``_data_q; \
  always_ff @(posedge clk_i) begin \
    if (!rst_ni) name``_reset_q <= 1'b1; \
    name``_waits_q <= name``_reset_q && rst_ni && (valid) && !(ready); \
    name``_data_q <= data; \
  end \
  always_comb name``_valid : assert (!name``_waits_q || !rst_ni || (valid)); \
  always_comb name``_data : assert (!name``_waits_q || !rst_ni || name``_data_q == (data));
`endif
`elsif SYNTHESIS
`define RDX_ASSERT(name, condition)
`define RDX_STREAM(name, valid, ready, data)
`else
// `condition` holds at every clock out of reset.
`define RDX_ASSERT(name, condition) \
  name : assert property (@(posedge clk_i) disable iff (!rst_ni || $time == 0) condition) \
    else $error("%m: condition does not hold");

// The two rules of every stream port: valid stays until ready, and so does the data.
`define RDX_STREAM(name, valid, ready, data) \
  name``_valid : assert property (@(posedge clk_i) disable iff (!rst_ni) (valid) && !(ready) |=> (valid)) \
    else $error("%m: valid fell before ready"); \
  name``_data : assert property (@(posedge clk_i) disable iff (!rst_ni) (valid) && !(ready) |=> $stable(data)) \
    else $error("%m: data changed before ready");
`endif

`endif
