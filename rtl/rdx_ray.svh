// SPDX-License-Identifier: Apache-2.0
// Types of rays, of the items that they become in the ring, and of the records that these leave; part of rdx_pkg.
`ifndef RDX_RAY_SVH
`define RDX_RAY_SVH

// Status of an item in the ring.
typedef enum logic [2:0] {
  Idle  = 3'd0,  // no item in the slot
  Run   = 3'd1,  // the next step is to be done
  Again = 3'd2,  // to be restarted, following t_min
  Hit   = 3'd3,  // a root stands in t, the segment has shrunk to the point
  Done  = 3'd4   // no (further) root
} status_e;

// Which ray, and how it is to be searched.
typedef struct packed {
  surface_t   surface;
  pixel_t     x;
  pixel_t     y;
  logic       paper;    // 1: paper rule, 0: certified rule
  roots_t     roots;    // roots wanted, 1 to 4
  box_t [2:0] box;      // box exponents of x, y, z
  limit_t     limit;    // what lies behind it cannot be seen
} ray_t;

// What the ring has to know of an item's ray beside its first segment.
typedef struct packed {
  surface_t surface;
  pixel_t   x;
  pixel_t   y;
  limit_t   limit;
} origin_t;

// A limit: the highest bits of a depth, which is not negative. A depth is surely behind it where its own are greater.
function automatic limit_t limit_of(depth_t depth);
  return limit_t'(depth >> (DepthWidth - 1 - LimitWidth));
endfunction
localparam limit_t NoLimit = '1;  // nothing is behind it

// What a segment from h to e carries linearly: local coordinates (x, y, z) and camera depth at both ends.
typedef struct packed {
  coord_t [2:0] start;
  coord_t [2:0] stop;
  depth_t       depth_start;
  depth_t       depth_stop;
} ends_t;

// One record of the hit stream. t, depth and point are meaningful where hit = 1.
typedef struct packed {
  surface_t     surface;
  pixel_t       x;
  pixel_t       y;
  logic         hit;      // 1: a root; 0: the ray has no (further) root
  logic         last;     // the ray's last record
  logic [31:0]  t;        // digits of t, u0p<n>, right-aligned
  depth_t       depth;
  coord_t [2:0] point;
  logic         enters;   // the indicator is positive before the hit
  steps_t       steps;    // steps that the ray has taken so far
} hit_t;

`endif
