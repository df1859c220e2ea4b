// SPDX-License-Identifier: Apache-2.0
// The gradient at a layer's point, of an algebraic surface or of a vector sum, whichever its material says.
//
// Both are computed side by side, and the faster one waits. What is not built (D = 0, Vecsum = 0) leaves nothing behind.
//
// Formats    write_i, material_i: see rdx_constant. point_i: s2p30; gradient_o: s1p17 of a common positive factor.
// Rounding   as rdx_gradient and rdx_swirl.    Overflow   as there.
// Timing     latency rdx_pkg::normal_latency(D, Vecsum) clocks, a layer a clock.
// Reset      of waiting lines' places only.
// Model      model/raydix/shade.py (_paint)
`default_nettype none

module rdx_normal #(
    parameter int unsigned D = 4,
    parameter int unsigned Vecsum = rdx_pkg::VecsumNone,
    parameter int unsigned Surfaces = 64
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire rdx_pkg::material_write_t write_i,
    input  wire rdx_pkg::material_t       material_i,
    input  wire rdx_pkg::coord_t          point_i   [3],
    output rdx_pkg::normal_t              gradient_o[3]
);
  import rdx_pkg::*;

  localparam int unsigned Latency = normal_latency(D, Vecsum);
  localparam bit Algebraic = D > 0;
  localparam bit Vector = Vecsum != VecsumNone;

  triple_t algebraic, vector;
  if (Algebraic) begin : gen_algebraic
    normal_t gradient[3];
    rdx_gradient #(
        .D(D),
        .Surfaces(Surfaces)
    ) u_gradient (
        .clk_i,
        .rst_ni,
        .write_i,
        .material_i,
        .point_i,
        .gradient_o(gradient)
    );
    if (Latency > gradient_latency(D)) begin : gen_wait
      rdx_line #(
          .W($bits(triple_t)),
          .Depth(Latency - gradient_latency(D))
      ) u_wait (
          .clk_i,
          .rst_ni,
          .en_i  (1'b1),
          .data_i({gradient[2], gradient[1], gradient[0]}),
          .data_o(algebraic)
      );
    end else begin : gen_now
      assign algebraic = {gradient[2], gradient[1], gradient[0]};
    end
  end else begin : gen_no_algebraic
    assign algebraic = '0;
  end

  if (Vector) begin : gen_vector
    normal_t gradient[3];
    rdx_swirl #(
        .General (Vecsum == VecsumGeneral),
        .Surfaces(Surfaces)
    ) u_swirl (
        .clk_i,
        .rst_ni,
        .write_i,
        .material_i,
        .point_i,
        .gradient_o(gradient)
    );
    if (Latency > rdx_swirl_pkg::SwirlLatency) begin : gen_wait
      rdx_line #(
          .W($bits(triple_t)),
          .Depth(Latency - rdx_swirl_pkg::SwirlLatency)
      ) u_wait (
          .clk_i,
          .rst_ni,
          .en_i  (1'b1),
          .data_i({gradient[2], gradient[1], gradient[0]}),
          .data_o(vector)
      );
    end else begin : gen_now
      assign vector = {gradient[2], gradient[1], gradient[0]};
    end
  end else begin : gen_no_vector
    assign vector = '0;
  end

  // ---- which of them ----
  logic is_vector;
  if (Algebraic && Vector) begin : gen_both
    logic is_vector_now;
    rdx_constant #(
        .Surfaces(Surfaces),
        .W(1),
        .Index(AtVector)
    ) u_vector_of (
        .clk_i,
        .write_i,
        .material_i,
        .data_o(is_vector_now)
    );
    rdx_line #(
        .W(1),
        .Depth(Latency - ConstantLatency)
    ) u_vector (
        .clk_i,
        .rst_ni,
        .en_i  (1'b1),
        .data_i(is_vector_now),
        .data_o(is_vector)
    );
  end else begin : gen_one
    assign is_vector = Vector;
  end
  wire triple_t chosen = is_vector ? vector : algebraic;
  assign gradient_o = '{chosen[0], chosen[1], chosen[2]};
  wire unused = &{1'b0, rst_ni};

endmodule

`default_nettype wire
