# SPDX-License-Identifier: Apache-2.0
"""One simulation by :func:`bench.run`, with one RTL file replaced and ``serve`` before the tests: a process of its own.

Argument: a JSON file with what ``serve`` is to do, the call of bench.run, and the changed file.
"""

import json
import os
import sys
import tempfile
from pathlib import Path

import bench
from raydix.files import RTL


def main():
    """Command line."""
    order, call, changed = json.loads(Path(sys.argv[1]).read_text())
    module, toplevel, parameters, checks = call
    changed = Path(changed)
    own = (RTL / changed.name).exists()
    files = [changed if p.name == changed.name else p for p in bench.reached(toplevel)] if own else [changed]
    bench.reached = lambda top: files
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(order, file)
        file.flush()
        os.environ["RDX_SERVE"] = file.name
        try:
            bench.run(f"mutation.serve,{module}", toplevel, parameters, checks)
        except AssertionError as error:  # the simulator that serves has no results of its own
            if "no results" not in str(error):
                raise
    return 0


if __name__ == "__main__":
    sys.exit(main())
