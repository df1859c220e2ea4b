// SPDX-License-Identifier: Apache-2.0
// Types of the processor around the rings; part of rdx_pkg.
`ifndef RDX_FRAME_SVH
`define RDX_FRAME_SVH

// What may be skipped; each bit off leaves the picture as it is.
typedef struct packed {
  logic early;      // items that are done leave the ring at once
  logic depth;      // rays, and items in the rings, behind the nearest opaque hit so far
  logic rootless;   // rays on whose segment no root can be
  logic boxes;      // cells beyond a face of the box
  logic rectangle;  // pixels outside of a surface's screen rectangle
} skip_t;

// How items are searched, for all of a frame.
typedef struct packed {
  logic [4:0] first_level;  // K less the steps to a hit: a descent begins there, so that t has fewer digits
  logic       boxes;        // cells beyond a face of the box are no candidates; else only the hit point is tested
  logic       early;        // items that are done leave the ring at once; else after as many steps as a hit takes
} modes_t;
localparam modes_t ModesDefault = '{first_level: '0, boxes: 1'b1, early: 1'b1};

// Shading: linear intensities, and components of normals.
typedef logic [UnitWidth-1:0] unit_t;
typedef logic signed [NormalWidth-1:0] normal_t;
typedef logic [$clog2(MaterialWords)-1:0] constant_t;  // number of a material's constant

// A layer of a pixel on its way to the shading, or a pixel without one.
typedef struct packed {
  logic         shade;    // 0: nothing was hit
  logic         first;    // the pixel's first
  logic         last;     // the pixel's last
  logic         enters;   // the indicator is positive before the hit
  surface_t     surface;
  coord_t [2:0] point;
} layer_t;

// What holds for all of a frame.
typedef struct packed {
  pixel_t      last_x;      // columns less one
  pixel_t      last_y;      // rows less one
  surface_t    last_slot;   // descriptors less one
  logic        empty;       // there is no descriptor
  logic [5:0]  k_stop;      // steps to a hit, 1 to K
  skip_t       skip;
  unit_t       ambient;
  unit_t [2:0] background;  // [0] red, [1] green, [2] blue
} frame_t;

// The registers that a start copies, as the host wrote them.
typedef struct packed {
  logic [12:0] width;       // pixels
  logic [12:0] height;
  logic [6:0]  count;       // descriptors
  logic [5:0]  k_stop;
  skip_t       skip;
  unit_t       ambient;
  unit_t [2:0] background;  // [0] red, [1] green, [2] blue
} request_t;

// Why a frame is not made, or not as it was meant; the numbers are those of rdx_csr.rdl.
typedef enum logic [3:0] {
  ErrorNone      = 4'd0,
  ErrorSize      = 4'd1,  // a side of 0, or above what is built
  ErrorCount     = 4'd2,  // more descriptors than built
  ErrorKStop     = 4'd3,  // k_stop is 0 or above K
  ErrorKind      = 4'd4,  // a descriptor of a kind that is not built
  ErrorRoots     = 4'd5,  // roots out of range
  ErrorRectangle = 4'd6,  // reversed, or not within the frame
  ErrorSurface   = 4'd7,  // a surface number that is not built
  ErrorQueued    = 4'd8,  // a start while another waited
  ErrorRule      = 4'd9,  // a rule that is not built
  ErrorClip      = 4'd10  // a box that cuts, and boxes are not built
} error_e;

// What is counted in a frame.
typedef struct packed {
  logic [63:0] cycles;             // clocks from the start to the last pixel
  logic [63:0] steps;              // steps of all rays
  logic [31:0] rays;               // that entered a ring
  logic [31:0] hits;               // that left a ring
  logic [31:0] skipped_rectangle;  // pixels outside of a surface's rectangle
  logic [31:0] skipped_rootless;   // rays without a root on the segment
  logic [31:0] skipped_depth;      // rays behind the nearest opaque hit
  logic [31:0] skipped_boxes;      // cells beyond a face of the box
  logic [31:0] skipped_cells;      // items ended in a ring, behind the nearest opaque hit
  logic [31:0] skipped_early;      // turns of the ring saved by items that left at once
  logic [31:0] visible;            // pixels that were shaded
  logic [31:0] layers_lost;        // hits dropped because a pixel had more than Layers
  logic [31:0] given_up;           // items given up after too many steps
  logic [31:0] stalled;            // clocks in which the pixel stream waited
} counters_t;

`endif

// A word of a row on its way from rdx_rows to rdx_scan.
typedef enum logic [1:0] {
  RowHeader = 2'd0,  // index 0: word 0 of the descriptor; 1: columns and row, as word 1; 2: depths
  RowLane   = 2'd1,  // of a lane; index 0: value, 1: difference, 2: second difference per column
  RowForm   = 2'd2   // constant of a vector sum
} row_kind_e;
typedef struct packed {
  row_kind_e   kind;
  logic        last;   // the row is complete
  logic [3:0]  lane;
  logic [6:0]  index;
  logic [63:0] word;
} row_word_t;

// What rdx_rows has to know of a descriptor.
typedef struct packed {
  logic   vector;
  logic   quartic;
  pixel_t y0;
  pixel_t y1;
  pixel_t width;    // less one
} row_info_t;

// A hit among the layers of a pixel.
typedef struct packed {
  logic         opaque;
  logic         enters;
  surface_t     surface;
  depth_t       depth;
  coord_t [2:0] point;
} entry_t;

// What happens in a clock, for the counters.
typedef struct packed {
  logic [PixelWidth:0] rectangle;  // pixels outside of a surface's rectangle that were skipped
  logic                hidden;     // a ray behind the nearest opaque hit
  logic                rootless;   // a ray without a root on its segment
  logic                beyond;     // a ray beyond a face of the box
  logic [5:0]          steps;      // items that take a step
  logic [5:0]          ended;      // items that end in a ring, behind the nearest opaque hit
  logic                visible;    // a layer that is shaded
  logic                lost;       // a hit that would have been seen had no room
  logic                stalled;    // the receiver holds a beat
} events_t;
