// SPDX-License-Identifier: Apache-2.0
// One step of the descent: subdivides the cell, chooses, and fixes the next N1 binary digits of t.
//
// Formats    item_i, item_o: RDX_ITEM_T of rdx_types.svh; ends s2p30 and s1p31, control points sWp0, digits u0p<N1*K>.
//            A Run item comes back as Run (digits left), Hit (last digit fixed: the ends have met in the middle of the
//            cell, which is the hit point), Again (no cell left here, one is pending) or Done. Others pass unchanged,
//            but for the control points, which only Run items need.
// Rounding   half up in each average; normalising is exact.    Overflow   cannot happen (rdx_halve, rdx_normalize).
// Timing     latency rdx_pkg::step_latency(N1, HalveStages, Rules) clocks, one item a clock; no stall.
//            Without reset: the status of an item comes from the ring, which resets its own.
// Error      docs/method.md, "Rounding"
// Model      model/raydix/step.py
`default_nettype none
`include "rdx_types.svh"

module rdx_step #(
    parameter int unsigned N1 = 3,
    parameter int unsigned K = 8,
    parameter int unsigned W = 36,
    parameter int unsigned D = 4,
    parameter int unsigned Rules = rdx_pkg::RuleBoth,
    parameter int unsigned HalveStages = (D + 1) / 2,
    localparam int unsigned N = N1 * K,
    localparam type item_t = `RDX_ITEM_T(N, W, D)
) (
    input  wire logic  clk_i,
    input  wire item_t item_i,
    output      item_t item_o
);
  import rdx_pkg::*;

  localparam int unsigned J = 1 << N1;
  localparam int unsigned CellsLatency = N1 * HalveStages;
  localparam int unsigned SelectLatency = select_latency(N1, Rules);

  if (K < 1 || N > 32) begin : gen_illegal_k
    $fatal(1, "rdx_step: K = %0d; allowed: 1 to %0d (N1*K is at most 32)", K, 32 / N1);
  end
  if (W < 16 || W > 48) begin : gen_illegal_w
    $fatal(1, "rdx_step: W = %0d; allowed: 16 to 48", W);
  end

  // ---- cells: control points, coordinates and depth, all by the same averages ----
  logic signed [W-1:0] b[D+1];
  coord_t ends[3][2];
  depth_t depths[2];
  always_comb begin
    for (int unsigned i = 0; i <= D; i++) b[i] = item_i.b[i];
    for (int unsigned axis = 0; axis < 3; axis++) begin
      ends[axis][0] = item_i.ends.start[axis];
      ends[axis][1] = item_i.ends.stop[axis];
    end
    depths[0] = item_i.ends.depth_start;
    depths[1] = item_i.ends.depth_stop;
  end

  logic signed [W-1:0] cells[J*D+1], cells_q[J*D+1];
  coord_t coords[3][J+1], coords_q[3][J+1];
  depth_t depth[J+1], depth_q[J+1];
  rdx_cells #(.W(W), .D(D), .N1(N1), .HalveStages(HalveStages)) u_cells (.clk_i, .b_i(b), .cells_o(cells));
  rdx_delay #(.T(logic signed [W-1:0]), .Count(J * D + 1), .Depth(SelectLatency)) u_cells_q (.clk_i, .data_i(cells), .data_o(cells_q));
  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    rdx_cells #(.W(CoordWidth), .D(1), .N1(N1), .HalveStages(HalveStages)) u_cells (
        .clk_i, .b_i(ends[axis]), .cells_o(coords[axis])
    );
    rdx_delay #(.T(coord_t), .Count(J + 1), .Depth(SelectLatency)) u_cells_q (
        .clk_i, .data_i(coords[axis]), .data_o(coords_q[axis])
    );
  end
  rdx_cells #(.W(DepthWidth), .D(1), .N1(N1), .HalveStages(HalveStages)) u_depth (
      .clk_i, .b_i(depths), .cells_o(depth)
  );
  rdx_delay #(.T(depth_t), .Count(J + 1), .Depth(SelectLatency)) u_depth_q (
      .clk_i, .data_i(depth), .data_o(depth_q)
  );

  item_t items[1], split[1], chosen[1];  // the item as it came, when the cells are there, and when the choice is
  assign items[0] = item_i;
  rdx_delay #(.T(item_t), .Depth(CellsLatency)) u_split (.clk_i, .data_i(items), .data_o(split));
  rdx_delay #(.T(item_t), .Depth(SelectLatency)) u_chosen (.clk_i, .data_i(split), .data_o(chosen));

  // ---- choice: cells before t_min and cells outside of the box are passed over ----
  logic [J-1:0] outside;
  rdx_outside #(.J(J)) u_outside (.boundaries_i(coords), .box_i(split[0].box), .outside_o(outside));

  // the digits of t_min at the item's level, 0 unless they are followed
  function automatic logic [N1-1:0] first_cell(logic [4:0] level, logic [N-1:0] t_min, logic follow);
    logic [N1-1:0] digit;
    digit = '0;
    for (int unsigned k = 0; k < K; k++) if (level == 5'(k)) digit = t_min[N1*(K-1-k)+:N1];
    return follow ? digit : '0;
  endfunction

  logic found, more;
  logic [N1-1:0] pick, next;
  rdx_select #(.W(W), .D(D), .N1(N1), .Rules(Rules)) u_select (
      .clk_i,
      .cells_i(cells),
      .excluded_i(outside | ~({J{1'b1}} << first_cell(split[0].level, split[0].t_min, split[0].follow))),
      .last_i(split[0].level == 5'(K - 1)),
      .paper_i(split[0].paper),
      .found_o(found),
      .more_o(more),
      .pick_o(pick),
      .next_o(next)
  );

  // ---- pick: the chosen cell becomes the item's, its number the next digits of t ----
  item_t picked_d, picked_q;
  logic  dead_d, dead_q;
  always_comb begin
    picked_d = chosen[0];
    dead_d   = chosen[0].status == Run && !found;
    for (int unsigned i = 0; i <= D; i++) picked_d.b[i] = cells_q[32'(pick)*D+i];
    for (int unsigned axis = 0; axis < 3; axis++) begin
      picked_d.ends.start[axis] = coords_q[axis][(N1+1)'(pick)];
      picked_d.ends.stop[axis]  = coords_q[axis][(N1+1)'(pick)+1];
    end
    picked_d.ends.depth_start = depth_q[(N1+1)'(pick)];
    picked_d.ends.depth_stop  = depth_q[(N1+1)'(pick)+1];
    if (chosen[0].status == Run) begin
      picked_d.steps = chosen[0].steps + 1'b1;
      if (found) begin
        picked_d.follow = chosen[0].follow && pick == first_cell(chosen[0].level, chosen[0].t_min, chosen[0].follow);
        if (more) begin
          picked_d.pending = 1'b1;
          picked_d.t_next  = chosen[0].t;
        end
        for (int unsigned k = 0; k < K; k++) begin
          if (chosen[0].level == 5'(k)) begin
            picked_d.t[N1*(K-1-k)+:N1] = pick;
            if (more) picked_d.t_next[N1*(K-1-k)+:N1] = next;
          end
        end
      end
    end
  end
  always_ff @(posedge clk_i) begin
    picked_q <= picked_d;
    dead_q   <= dead_d;
  end

  // ---- settle: scale the control points; after the last digit take the middle of the cell and judge it ----
  logic signed [W-1:0] picked_b[D+1], scaled_b[D+1];
  coord_t              points[3][2];
  always_comb for (int unsigned i = 0; i <= D; i++) picked_b[i] = picked_q.b[i];
  rdx_normalize #(.WIn(W), .WOut(W), .Count(D + 1), .Limit(norm_limit(N1))) u_normalize (
      .clk_i, .en_i(1'b1), .values_i(picked_b), .values_o(scaled_b)
  );

  coord_t cell_ends[3][2], left[3][2], right[3][2];
  depth_t cell_depth[2], left_depth[2], right_depth[2];
  for (genvar axis = 0; axis < 3; axis++) begin : gen_middle
    assign cell_ends[axis] = '{picked_q.ends.start[axis], picked_q.ends.stop[axis]};
    rdx_halve #(.W(CoordWidth), .D(1), .Stages(0)) u_middle (
        .clk_i, .b_i(cell_ends[axis]), .left_o(left[axis]), .right_o(right[axis])
    );
  end
  assign cell_depth = '{picked_q.ends.depth_start, picked_q.ends.depth_stop};
  rdx_halve #(.W(DepthWidth), .D(1), .Stages(0)) u_middle_depth (
      .clk_i, .b_i(cell_depth), .left_o(left_depth), .right_o(right_depth)
  );

  item_t middle_d, middle_q;
  logic  dead_qq, last_d, last_q, changes_q, point_outside;
  assign last_d = picked_q.status == Run && !dead_q && picked_q.level == 5'(K - 1);
  always_comb begin
    middle_d = picked_q;
    if (last_d) begin
      for (int unsigned axis = 0; axis < 3; axis++) begin
        middle_d.ends.start[axis] = left[axis][1];
        middle_d.ends.stop[axis]  = right[axis][0];
      end
      middle_d.ends.depth_start = left_depth[1];
      middle_d.ends.depth_stop  = right_depth[0];
    end
  end
  always_ff @(posedge clk_i) begin
    middle_q  <= middle_d;
    last_q    <= last_d;
    dead_qq   <= dead_q;
    changes_q <= (picked_b[0] > 0) != (picked_b[D] > 0);
  end

  always_comb for (int unsigned axis = 0; axis < 3; axis++) points[axis] = '{default: middle_q.ends.start[axis]};
  rdx_outside #(.J(1)) u_point (.boundaries_i(points), .box_i(middle_q.box), .outside_o(point_outside));

  item_t item_d, item_q;
  always_comb begin
    item_d = middle_q;
    if (middle_q.status == Run) begin
      if (!dead_qq && !last_q) item_d.level = middle_q.level + 1'b1;
      if (last_q && changes_q && !point_outside) item_d.status = Hit;
      else if (last_q || dead_qq) item_d.status = middle_q.pending ? Again : Done;
      if (item_d.status != Hit && (&middle_q.steps)) item_d.status = Done;
    end
  end
  always_ff @(posedge clk_i) item_q <= item_d;

  always_comb begin
    item_o = item_q;
    for (int unsigned i = 0; i <= D; i++) item_o.b[i] = scaled_b[i];
  end

endmodule

`default_nettype wire
