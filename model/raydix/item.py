# SPDX-License-Identifier: Apache-2.0
"""The item that travels in the ring: one ray and one surface (mirrors the types of ``rtl/rdx_types.svh``).

In the golden model an item is a vector of integers; these are the positions of its fields.
"""

# Status of an item
IDLE = 0  # no item in the slot
RUN = 1  # the next step is to be done
AGAIN = 2  # to be restarted from its first control points, following TMIN
HIT = 3  # a root stands in T, both ends of C and DEPTH are the point
DONE = 4  # no (further) root

STATUS = 0
PAPER = 1  # 1: paper rule, 0: certified rule
ROOTS = 2  # roots still wanted
LEVEL = 3  # steps done of this descent, 0 to K-1
STEPS = 4  # steps done in all
FOLLOW = 5  # the digits so far are those of TMIN
PENDING = 6  # TNEXT holds a cell
T = 7  # digits fixed, most significant first; u0p<n>
TMIN = 8  # where this descent starts
TNEXT = 9  # start of the deepest cell passed over that is still to be searched
ENTERS = 10  # of a HIT: the indicator is positive before it
FIRST = 11  # level at which a descent begins: K less the steps to a hit
BOX = 12  # box exponents of x, y, z
C = 15  # x, y, z of the cell's start, then of its end; s2p30
DEPTH = 21  # depth of the cell's start, of its end; s1p31
B = 23  # D+1 Bernstein coefficients of the cell; sWp0
SIZE = 28
