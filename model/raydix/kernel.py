# SPDX-License-Identifier: Apache-2.0
"""One source, two ways to run it.

Every function of the golden model is a scalar integer function marked ``@kernel``. As a rule numba
compiles it to 64-bit machine integers. With the environment variable ``RAYDIX_INTERPRET=1`` the same
source runs as plain Python on unbounded integers; equal results then prove that no intermediate value
leaves 64 bits (``tb/test_golden.py``).
"""

import hashlib
import os
from pathlib import Path

import numpy as np

INTERPRETED = os.environ.get("RAYDIX_INTERPRET", "0") == "1"

if INTERPRETED:

    def kernel(function):
        """Leave the function as it is: plain Python."""
        return function

    subroutine = kernel
else:
    import numba

    # numba looks only at the file that a kernel stands in, not at those that it calls: one cache for each state
    # of the sources
    _sources = sorted(Path(__file__).parent.glob("*.py"))
    _digest = hashlib.sha256(b"".join(p.read_bytes() for p in _sources)).hexdigest()[:16]
    _cache = Path(__file__).resolve().parents[2] / "build" / "numba" / _digest
    numba.config.CACHE_DIR = str(_cache)  # type: ignore[attr-defined]

    def kernel(function):
        """Compile with numba: 64-bit integers, no global interpreter lock, cached on disk.

        Calls are inlined, so that parameters which are constant in the outermost kernel are constant everywhere. No
        kernel allocates; counting references all the same took more than half of the time (131 of 192 ns a step).
        """
        return numba.njit(nogil=True, cache=True, boundscheck=False, inline="always", _nrt=False)(function)  # type: ignore[call-overload]

    def subroutine(function):
        """The same for a long one that is called from several places: compiled once, and called."""
        return numba.njit(nogil=True, cache=True, boundscheck=False, _nrt=False)(function)  # type: ignore[call-overload]


def words(values):
    """A vector of integers for the kernels: int64 when compiled, unbounded Python integers when not."""
    return np.array([int(v) for v in values], dtype=object if INTERPRETED else np.int64)


def zeros(count):
    """``count`` zeros in the form of :func:`words`."""
    return np.zeros(count, object if INTERPRETED else np.int64)
