# SPDX-License-Identifier: Apache-2.0
"""A pytest plugin: notes the calls of ``bench.run`` in the file RDX_CALLS, a JSON line each, and runs none."""

import json
import os

import bench


def run(module, toplevel, parameters=None, checks=None, later=()):
    """In place of :func:`bench.run`; all checks, whatever is left to the long run."""
    with open(os.environ["RDX_CALLS"], "a") as file:
        print(json.dumps([module, toplevel, parameters or {}, checks]), file=file)


bench.run = run
