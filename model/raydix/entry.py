# SPDX-License-Identifier: Apache-2.0
"""Entry point of the command: an interrupt while the libraries are loaded is an interrupt like any other."""

import sys


def main() -> int:
    """Load and run the command line; exit status 130 where it is interrupted."""
    try:
        from .cli import main as run

        return run()
    except KeyboardInterrupt:
        print("raydix: interrupted; nothing half written", file=sys.stderr)
        return 130
