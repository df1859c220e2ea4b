// SPDX-License-Identifier: Apache-2.0
// A length on the scale of the tube: times a power of two, 18 bits.
//
// Formats    length_i: s4p22. scale_i: E + 1. part_o: s1p17, the length times 2^E.
// Rounding   floor.    Overflow   saturates: so long is no leg of a triangle inside of the tube.
// Timing     latency 2 clocks, one length a clock; no reset.
// Model      model/raydix/swirl.py (part)
`default_nettype none

module rdx_swirl_part (
    input  wire logic                        clk_i,
    input  wire rdx_swirl_pkg::swirl_t       length_i,
    input  wire rdx_swirl_pkg::swirl_scale_t scale_i,
    output rdx_pkg::normal_t                 part_o
);
  import rdx_pkg::*;
  import rdx_swirl_pkg::*;

  localparam int unsigned Most = (1 << $bits(swirl_scale_t)) - 1;
  localparam int unsigned Drop = SwirlFrac + 1 - (NormalWidth - 1);
  localparam type shifted_t = logic signed [SwirlWidth+Most-1:0];
  localparam type kept_t = logic signed [SwirlWidth+Most-Drop-1:0];

  kept_t shifted_q;
  always_ff @(posedge clk_i) begin
    shifted_q <= kept_t'((shifted_t'(length_i) <<< scale_i) >>> Drop);
    if (shifted_q > kept_t'((1 << (NormalWidth - 1)) - 1)) part_o <= {1'b0, {(NormalWidth - 1) {1'b1}}};
    else if (shifted_q < -kept_t'(1 << (NormalWidth - 1))) part_o <= {1'b1, {(NormalWidth - 1) {1'b0}}};
    else part_o <= normal_t'(shifted_q);
  end

endmodule

`default_nettype wire
