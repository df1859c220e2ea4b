// SPDX-License-Identifier: Apache-2.0
// Types that depend on the parameters N (digits of t), W (bits of a control point) and D (degree).
`ifndef RDX_TYPES_SVH
`define RDX_TYPES_SVH

// The cell at work: its ends and its Bernstein coefficients b[0] to b[D], sWp0; vector sums (D = 1): the indicator at both
// ends.
`define RDX_SEGMENT_T(W, D) \
  struct packed { \
    rdx_pkg::ends_t          ends; \
    logic [D:0][W-1:0] b; \
  }

// What an item needs beside its cell.
`define RDX_CONTROL_T(N) \
  struct packed { \
    rdx_pkg::status_e        status; \
    logic                    paper;   /* 1: paper rule, 0: certified rule */ \
    rdx_pkg::roots_t         roots;   /* roots still wanted */ \
    rdx_pkg::box_t [2:0]     box;     /* box exponents of x, y, z */ \
    logic [4:0]              level;   /* steps done of this descent */ \
    rdx_pkg::steps_t         steps;   /* steps done in all */ \
    logic                    follow;  /* the digits so far are those of t_min */ \
    logic                    pending; /* t_next holds a cell */ \
    logic                    enters;  /* of a Hit: the indicator is positive before it */ \
    logic [N-1:0]            t;       /* digits fixed, most significant first */ \
    logic [N-1:0]            t_min;   /* where this descent starts */ \
    logic [N-1:0]            t_next;  /* start of the deepest cell passed over that is still to be searched */ \
  }

`endif
