# SPDX-License-Identifier: Apache-2.0
"""Entry point of the command and of scripts: an interrupt while the libraries are loaded is one like any other.

python -m raydix.entry SCRIPT [ARGUMENT …] runs a script as ``python SCRIPT`` does.
"""

import runpy
import sys
from pathlib import Path


def main() -> int:
    """Load and run the command line; exit status 130 where it is interrupted."""
    try:
        from .cli import main as run

        return run()
    except KeyboardInterrupt:
        return _interrupted("raydix")


def script() -> int:
    """Load and run a script with the arguments behind its path; status 130 as of :func:`main`, 2 where it is none."""
    del sys.argv[0]
    path = Path(*sys.argv[:1])
    if not path.is_file():
        print(f"entry: found '{path}'; allowed: the file of a script", file=sys.stderr)
        return 2
    sys.path[0] = str(path.parent.resolve())
    try:
        runpy.run_path(str(path), run_name="__main__")
        return 0
    except KeyboardInterrupt:
        return _interrupted(path.stem)


def _interrupted(name: str) -> int:
    print(f"{name}: interrupted; nothing half written", file=sys.stderr)
    return 130


if __name__ == "__main__":
    sys.exit(script())
