// SPDX-License-Identifier: Apache-2.0
// The ends of a chosen cell: the segment's ends halved towards it, and, where asked for, shrunk to its middle.
//
// Start p and distance e to the stop are carried instead of two ends. Halving leaves p, with the distance ceil(e/2), or
// moves p by ceil(e/2), with floor(e/2) left: the same values as averages that round half up, by one addition each and no
// multiplexer. A move that is not made is a register reset to 0. The middle is one more move, the stop the last.
//
// Formats    ends_i, ends_o: s2p30 and s1p31; point_o: the start of x, y, z. pick_i: number of the cell; close_i: to its middle.
// Rounding   half up in each average.    Overflow   cannot happen: an average lies between its inputs.
// Timing     P = ceil((N1 + 1)/Moves) clocks of so many moves each, the last maybe of fewer: close_i comes P - 1 clocks
//            after ends_i and pick_i, point_o after P + 1, ends_o after P + 3 clocks. One segment a clock; no reset, no stall.
// Model      model/raydix/carry.py, and the middle in model/raydix/settle.py
`default_nettype none

module rdx_descend #(
    parameter int unsigned N1 = 3,
    parameter int unsigned Moves = 2  // a clock
) (
    input  wire logic                    clk_i,
    input  wire rdx_pkg::ends_t          ends_i,
    input  wire logic           [N1-1:0] pick_i,
    input  wire logic                    close_i,
    output rdx_pkg::coord_t     [   2:0] point_o,
    output rdx_pkg::ends_t               ends_o
);
  import rdx_pkg::*;

  localparam int unsigned All = N1 + 1;  // moves, the last one to the middle
  localparam int unsigned Stages = descend_stages(N1, Moves);
  typedef logic signed [CoordWidth:0] distance_t;
  typedef logic signed [CoordWidth+1:0] move_t;  // and a bit that carries into it

  function automatic coord_t moved(coord_t start, move_t move);
    return coord_t'((move_t'({start, 1'b1}) + move) >> 1);  // the bits above are not asked for
  endfunction

  // ---- which moves are made: those of the digits, known from the beginning, and the one to the middle ----
  logic [N1-1:0] pick[Stages];
  logic closed_q;
  assign pick[0] = pick_i;
  always_ff @(posedge clk_i) begin
    for (int unsigned s = 1; s < Stages; s++) pick[s] <= pick[s-1];
    closed_q <= close_i;
  end
  logic [All-1:0] made[Stages];
  always_comb begin
    for (int unsigned s = 0; s < Stages; s++) begin
      made[s][N1] = close_i;
      for (int unsigned i = 0; i < N1; i++) made[s][i] = pick[s][N1-1-i];
    end
  end

  coord_t starts[4], stops[4], ends_start[4], ends_stop[4];  // x, y, z, depth
  always_comb begin
    for (int unsigned axis = 0; axis < 3; axis++) begin
      starts[axis] = ends_i.start[axis];
      stops[axis] = ends_i.stop[axis];
      ends_o.start[axis] = ends_start[axis];
      ends_o.stop[axis] = ends_stop[axis];
    end
    {starts[3], stops[3]} = {ends_i.depth_start, ends_i.depth_stop};
    {ends_o.depth_start, ends_o.depth_stop} = {ends_start[3], ends_stop[3]};
  end

  for (genvar lane = 0; lane < 4; lane++) begin : gen_lane
    // The distance after i moves is that of the segment >>> i, and one more where odd; the move to the middle is not counted.
    coord_t start[Stages+1];
    distance_t whole[Stages+1];
    logic odd[Stages+1];
    assign start[0] = starts[lane];
    assign whole[0] = distance_t'(stops[lane]) - distance_t'(starts[lane]);
    assign odd[0]   = 1'b0;
    for (genvar s = 0; s < Stages; s++) begin : gen_stage
      localparam int unsigned Here = All - Moves * s < Moves ? All - Moves * s : Moves;
      localparam int unsigned Halvings = s == Stages - 1 ? Here - 1 : Here;
      coord_t start_q;
      distance_t whole_q;
      move_t moves[Here], moves_q[Here];
      logic odds  [Here+1];
      logic odd_q;
      always_comb begin
        odds[0] = odd[s];
        for (int unsigned i = 0; i < Here; i++) begin
          // ceil((d + c) / 2) = (d >>> 1) + (d[0] | c), floor((d + c) / 2) = (d >>> 1) + (d[0] & c)
          moves[i]  = {whole[s] >>> (i + 1), whole[s][i] | odds[i]};
          odds[i+1] = made[s][Moves*s+i] ? whole[s][i] & odds[i] : whole[s][i] | odds[i];
        end
      end
      always_ff @(posedge clk_i) begin
        start_q <= start[s];
        whole_q <= whole[s] >>> Halvings;
        odd_q   <= odds[Halvings];
        for (int unsigned i = 0; i < Here; i++) begin
          moves_q[i] <= moves[i];
          if (!made[s][Moves*s+i]) moves_q[i] <= '0;
        end
      end
      assign whole[s+1] = whole_q;
      assign odd[s+1]   = odd_q;
      coord_t after[Here+1];
      always_comb begin
        after[0] = start_q;
        for (int unsigned i = 0; i < Here; i++) after[i+1] = moved(after[i], moves_q[i]);
      end
      assign start[s+1] = after[Here];
    end

    // ---- the stop: the start moved by the distance that is left, none in a cell that is closed ----
    coord_t point_q, start_q, stop_q;
    move_t left_q;
    always_ff @(posedge clk_i) begin
      point_q <= start[Stages];
      left_q  <= {whole[Stages], odd[Stages]};
      if (closed_q) left_q <= '0;
      start_q <= point_q;
      stop_q <= moved(point_q, left_q);
      ends_start[lane] <= start_q;
      ends_stop[lane] <= stop_q;
    end
    if (lane < 3) begin : gen_point
      assign point_o[lane] = point_q;
    end
  end

endmodule

`default_nettype wire
