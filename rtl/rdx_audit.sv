// SPDX-License-Identifier: Apache-2.0
// Whether the descriptors can be rendered by what is built, in the frame at hand; and what the walk has to know of them.
//
// Words 0 and 1 of each descriptor are asked of the table before a frame, and looked at a clock later.
//
// Formats    asked_i, second_i, slot_i: word 0 or 1 of a slot is asked for in this clock; table_i: the word asked for a clock
//            ago. fault_o: the first error there was, of fault_slot_o. info_o: of slot_i, combinational. opaque_o: bit i for
//            surface i.
// Timing     fault_o two clocks after the last word was asked for.
// Reset      clear_i: no error.
// Model      none: the tests repeat it (tb/test_processor.py)
`default_nettype none

module rdx_audit #(
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter bit Clip = 1'b1,  // boxes cut surfaces
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Slots = 64,
    localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
    input  wire logic                            clk_i,
    input  wire logic                            clear_i,
    input  wire logic                            asked_i,
    input  wire logic                            second_i,
    input  wire logic            [SlotWidth-1:0] slot_i,
    input  wire logic            [         63:0] table_i,
    input  wire rdx_pkg::pixel_t                 last_x_i,
    input  wire rdx_pkg::pixel_t                 last_y_i,
    output rdx_pkg::error_e                      fault_o,
    output rdx_pkg::surface_t                    fault_slot_o,
    output rdx_pkg::row_info_t                   info_o,
    output logic                 [         63:0] opaque_o
);
  import rdx_pkg::*;

  localparam int unsigned PaperAt = SurfaceWidth + RootsWidth;
  localparam int unsigned QuarticAt = PaperAt + 1;
  localparam int unsigned VectorAt = QuarticAt + 1 + 3 * BoxWidth;
  localparam int unsigned OpaqueAt = VectorAt + 1;

  logic asked_q, second_q;
  logic [SlotWidth-1:0] slot_q;
  logic [OpaqueAt:0] header_q;
  always_ff @(posedge clk_i) begin
    asked_q  <= asked_i && !clear_i;
    second_q <= second_i;
    slot_q   <= slot_i;
    if (asked_q && !second_q) header_q <= table_i[OpaqueAt:0];
  end

  wire surface_t surface = header_q[0+:SurfaceWidth];
  wire roots_t roots = header_q[SurfaceWidth+:RootsWidth];
  wire [1:0] rule = header_q[PaperAt] ? 2'(RulePaper) : 2'(RuleCertified);
  wire quartic = header_q[QuarticAt];
  wire [3*BoxWidth-1:0] box = header_q[QuarticAt+1+:3*BoxWidth];
  wire vector = header_q[VectorAt];
  wire pixel_t x0 = table_i[0+:PixelWidth];
  wire pixel_t y0 = table_i[16+:PixelWidth];
  wire pixel_t x1 = table_i[32+:PixelWidth];
  wire pixel_t y1 = table_i[48+:PixelWidth];

  wire unused = &{1'b0, table_i};

  error_e error;
  always_comb begin
    error = ErrorNone;
    if (x0 > x1 || y0 > y1 || x1 > last_x_i || y1 > last_y_i) error = ErrorRectangle;
    if (roots == 0 || roots > 4) error = ErrorRoots;
    if ((rule & 2'(Rules)) == 0) error = ErrorRule;
    if (32'(surface) >= Slots) error = ErrorSurface;
    if (!Clip && !vector && box != '0) error = ErrorClip;
    if (vector ? Vecsum == VecsumNone : quartic ? D != 4 : D == 0) error = ErrorKind;
  end

  always_ff @(posedge clk_i) begin
    if (clear_i) fault_o <= ErrorNone;
    else if (asked_q && second_q && fault_o == ErrorNone) begin
      fault_o <= error;
      fault_slot_o <= surface_t'(slot_q);
    end
  end

  row_info_t infos[1<<SlotWidth];
  always_ff @(posedge clk_i) begin
    if (asked_q && second_q) begin
      infos[slot_q] <= '{vector: vector, quartic: quartic, y0: y0, y1: y1, width: x1 - x0};
      opaque_o[surface] <= header_q[OpaqueAt];
    end
  end
  assign info_o = infos[slot_i];

endmodule

`default_nettype wire
